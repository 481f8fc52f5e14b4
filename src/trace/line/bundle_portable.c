#define SP_KERNEL(name) name##_portable
#include "trace/line/bundle_kernel.h"
