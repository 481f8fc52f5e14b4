#define SP_KERNEL(name) name##_avx512
#include "trace/parabola_hits_kernel.h"
