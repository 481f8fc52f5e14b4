#define SP_KERNEL(name) name##_avx2
#include "trace/bundle_kernel.h"
