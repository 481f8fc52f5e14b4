#define SP_KERNEL(name) name##_portable
#include "trace/parabola/parabola_packet_kernel.h"
