#define SP_KERNEL(name) name##_avx512
#include "trace/parabola/parabola_packet_kernel.h"
