/* The kernels in vectors of sixteen. */
#ifdef __x86_64__
#include "scoring/pattern_kernel_loops.h"

static bool available(void)
{
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl");
}

const sp_pattern_kernels sp_pattern_kernels_avx512 = {"avx512",     available,   kernel_sum,  kernel_shares,
                                                      kernel_total, kernel_gain, kernel_room, kernel_score};

#endif
