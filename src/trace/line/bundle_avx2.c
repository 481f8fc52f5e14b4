#define SP_KERNEL(name) name##_avx2
#include "trace/line/bundle_kernel.h"
