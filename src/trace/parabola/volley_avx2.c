#define SP_KERNEL(name) name##_avx2
#include "trace/parabola/volley_kernel.h"
