/* The sweep in vectors of sixteen. */
#ifdef __x86_64__
#include "scoring/sweep_kernel.h"

static bool available(void)
{
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl");
}

const sp_sweep_set sp_sweep_avx512 = {"avx512",     available,   kernel_sum,  kernel_shares,
                                      kernel_total, kernel_gain, kernel_room, kernel_score};

#endif
