#define SP_KERNEL(name) name##_avx2
#include "trace/parabola/parabola_packet_kernel.h"
