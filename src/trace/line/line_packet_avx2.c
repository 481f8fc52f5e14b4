#define SP_KERNEL(name) name##_avx2
#include "trace/line/line_packet_kernel.h"
