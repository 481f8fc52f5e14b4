/* The sweep in vectors of eight. */
#ifdef __x86_64__
#include "scoring/sweep_kernel.h"

static bool available(void)
{
    return __builtin_cpu_supports("avx2");
}

const sp_sweep_set sp_sweep_avx2 = {"avx2",       available,   kernel_sum,  kernel_shares,
                                    kernel_total, kernel_gain, kernel_room, kernel_score};

#endif
