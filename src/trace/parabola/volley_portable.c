#define SP_KERNEL(name) name##_portable
#include "trace/parabola/volley_kernel.h"
