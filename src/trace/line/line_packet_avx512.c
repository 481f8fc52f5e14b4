#define SP_KERNEL(name) name##_avx512
#include "trace/line/line_packet_kernel.h"
