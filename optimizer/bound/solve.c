#include "bound/solve.h"

#include "bound/coarse.h"
#include "bound/iterate.h"

#include <math.h>

#define WEIGHT_FIRST 5 /* primal weight to begin with, in mean texel areas */

bool sp_dual_solve(sp_dual *dual, const sp_rows *rows, const sp_dual_task *task, sp_error *error)
{
    if (!(dual->weight > 0)) {
        double area = 0;
        for (size_t t = 0; t < dual->texels; t++)
            area += (double)dual->cover->area[t];
        dual->weight = fmax(WEIGHT_FIRST * area / (double)(dual->texels ? dual->texels : 1), 1e-30);
    }
    if (!sp_dual_make_room(dual, rows->count, error))
        return false;
    if (task->coarse) {
        sp_dual_task coarse = *task;
        coarse.iterations = task->coarse;
        if (!sp_coarse_solve(dual, rows, &coarse, error))
            return false;
    }
    return sp_dual_iterate(dual, rows, task, error);
}
