#define SP_KERNEL(name) name##_portable
#include "trace/volley_kernel.h"
