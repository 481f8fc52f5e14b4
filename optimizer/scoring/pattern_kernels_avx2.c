/* The kernels in vectors of eight. */
#ifdef __x86_64__
#include "scoring/pattern_kernel_loops.h"

static bool available(void)
{
    return __builtin_cpu_supports("avx2");
}

const sp_pattern_kernels sp_pattern_kernels_avx2 = {"avx2",       available,   kernel_sum,  kernel_shares,
                                                    kernel_total, kernel_gain, kernel_room, kernel_score};

#endif
