#define SP_KERNEL(name) name##_portable
#include "trace/parabola_hits_kernel.h"
