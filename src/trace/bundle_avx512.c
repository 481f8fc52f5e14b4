#define SP_KERNEL(name) name##_avx512
#include "trace/bundle_kernel.h"
