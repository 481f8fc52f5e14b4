#define SP_KERNEL(name) name##_portable
#include "trace/line/line_packet_kernel.h"
