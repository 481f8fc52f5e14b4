/* How fast series of runs come nearer to the truth. */
#include "state.h"

#include <math.h>
#include <stdlib.h>

enum { MOST_IN_SERIES = 8 };

/* A run's settings without the one that varies. */
static sp_fidelity series_of(const sp_study_run *run, bool along_texel)
{
    sp_fidelity fidelity = run->fidelity;
    if (along_texel)
        fidelity.texel = 0;
    else
        fidelity.jets = 0;
    if (fidelity.method == SP_METHOD_INVERSE)
        fidelity.jets = 0;
    return fidelity;
}

static bool same(const sp_fidelity *a, const sp_fidelity *b)
{
    return a->trajectory == b->trajectory && a->method == b->method && a->reflections == b->reflections &&
           a->jets == b->jets && a->texel == b->texel;
}

/* The order along the series that the run `first` begins; count 0 where an earlier run began it. */
static sp_study_order order_of(const sp_study *study, size_t first, bool along_texel)
{
    double at[MOST_IN_SERIES], error[MOST_IN_SERIES], misjudged[MOST_IN_SERIES];
    sp_study_order order = {.fidelity = series_of(&study->runs[first], along_texel)};
    for (size_t i = 0; i < study->run_count && order.count < MOST_IN_SERIES; i++) {
        const sp_study_run *run = &study->runs[i];
        sp_fidelity series = series_of(run, along_texel);
        if (run->chosen || !same(&series, &order.fidelity))
            continue;
        if (i < first)
            return (sp_study_order){.count = 0};
        at[order.count] = along_texel ? run->fidelity.texel : 1 / (double)run->fidelity.jets;
        error[order.count] = fabs(run->error) > run->spread ? fabs(run->error) : 0;
        misjudged[order.count++] = run->misjudged;
    }
    order.error = sp_study_slope(at, error, order.count);
    order.misjudged = sp_study_slope(at, misjudged, order.count);
    return order;
}

bool sp_study_find_orders(sp_study *study, sp_error *error)
{
    study->orders = calloc(2 * study->run_count + 1, sizeof *study->orders);
    if (!study->orders)
        return sp_fail_memory(error);
    for (int along_texel = 1; along_texel >= 0; along_texel--)
        for (size_t i = 0; i < study->run_count; i++) {
            if (study->runs[i].chosen || (!along_texel && study->runs[i].fidelity.method == SP_METHOD_INVERSE))
                continue;
            sp_study_order order = order_of(study, i, along_texel);
            if (order.count >= 3)
                study->orders[study->order_count++] = order;
        }
    return true;
}
