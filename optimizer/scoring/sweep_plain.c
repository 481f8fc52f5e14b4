/* The sweep as every processor runs it. */
#include "scoring/sweep_kernel.h"

static bool available(void)
{
    return true;
}

const sp_sweep_set sp_sweep_plain = {"plain",      available,   kernel_sum,  kernel_shares,
                                     kernel_total, kernel_gain, kernel_room, kernel_score};
