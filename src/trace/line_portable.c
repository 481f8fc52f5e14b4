#define SP_KERNEL(name) name##_portable
#include "trace/line_kernel.h"
