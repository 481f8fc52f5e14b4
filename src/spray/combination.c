#include "combination.h"

#include <assert.h>
#include <stdlib.h>

static bool is_single(const sp_combination *tally)
{
    return tally->evaluator->setup.criterion.combine == SP_COMBINE_SINGLE;
}

bool sp_combination_create(const sp_evaluator *evaluator, sp_deposits *deposits, sp_combination *tally, sp_error *error)
{
    *tally = (sp_combination){evaluator, deposits, false, deposits->counted, deposits->even};
    if (!is_single(tally))
        return true;
    tally->counted = calloc(deposits->count + 1, sizeof *tally->counted);
    tally->even = calloc(deposits->count + 1, sizeof *tally->even);
    return (tally->counted && tally->even) || sp_fail_memory(error);
}

void sp_combination_free(sp_combination *tally)
{
    if (tally->evaluator && is_single(tally)) {
        free(tally->counted);
        free(tally->even);
    }
    *tally = (sp_combination){0};
}

void sp_combination_add(sp_combination *tally, uint32_t patch, double counted, const sp_wetting *wetting)
{
    sp_wetting settled = sp_wetting_settle(*wetting, tally->evaluator->setup.criterion.flux);
    assert(counted >= 0 && settled.even >= 0 && settled.dry >= 0 && settled.dry <= 1);
    tally->counted[patch] += counted;
    tally->even[patch] += settled.even;
    if (!tally->repeats)
        tally->deposits->dry[patch] *= settled.dry;
}

void sp_combination_begin_nozzle(sp_combination *tally, const sp_layout *layout, size_t i)
{
    tally->repeats = sp_layout_repeats(layout, i, &tally->evaluator->setup.liquid);
}

void sp_combination_end_nozzle(sp_combination *tally)
{
    sp_deposits *deposits = tally->deposits;
    for (size_t i = 0; is_single(tally) && i < deposits->count; i++) {
        deposits->counted[i] = fmax(deposits->counted[i], tally->counted[i]);
        deposits->even[i] = fmax(deposits->even[i], tally->even[i]);
        tally->counted[i] = tally->even[i] = 0;
    }
}
