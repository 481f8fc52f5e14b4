#define SP_KERNEL(name) name##_avx2
#include "trace/line/line_kernel.h"
#include "trace/line/single_kernel.h"
