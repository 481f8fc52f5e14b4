#define SP_KERNEL(name) name##_avx512
#include "trace/line/line_kernel.h"
#include "trace/line/single_kernel.h"
