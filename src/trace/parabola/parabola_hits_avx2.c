#define SP_KERNEL(name) name##_avx2
#include "trace/parabola/parabola_hits_kernel.h"
