#define SP_KERNEL(name) name##_avx2
#include "trace/volley_kernel.h"
