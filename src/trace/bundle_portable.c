#define SP_KERNEL(name) name##_portable
#include "trace/bundle_kernel.h"
