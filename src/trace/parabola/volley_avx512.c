#define SP_KERNEL(name) name##_avx512
#include "trace/parabola/volley_kernel.h"
