/* The kernels as every processor runs them. */
#include "scoring/pattern_kernel_loops.h"

static bool available(void)
{
    return true;
}

const sp_pattern_kernels sp_pattern_kernels_plain = {"plain",      available,   kernel_sum,  kernel_shares,
                                                     kernel_total, kernel_gain, kernel_room, kernel_score};
