#define SP_KERNEL(name) name##_portable
#include "trace/parabola_start_kernel.h"
