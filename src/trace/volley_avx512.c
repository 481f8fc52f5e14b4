#define SP_KERNEL(name) name##_avx512
#include "trace/volley_kernel.h"
