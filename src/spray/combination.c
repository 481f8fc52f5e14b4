#include "combination.h"

#include <assert.h>
#include <stdlib.h>

static bool is_single(const sp_combination *combination)
{
    return combination->evaluator->setup.criterion.combine == SP_COMBINE_SINGLE;
}

bool sp_combination_create(const sp_evaluator *evaluator, sp_deposits *deposits, sp_combination *combination,
                           sp_error *error)
{
    *combination = (sp_combination){.evaluator = evaluator, .deposits = deposits};
    if (!sp_edges_create(evaluator, &combination->edges, error))
        return false;
    combination->counted = deposits->counted;
    combination->even = deposits->even;
    if (!is_single(combination))
        return true;
    combination->counted = calloc(deposits->count + 1, sizeof *combination->counted);
    combination->even = calloc(deposits->count + 1, sizeof *combination->even);
    return (combination->counted && combination->even) || sp_fail_memory(error);
}

void sp_combination_free(sp_combination *combination)
{
    if (combination->evaluator && is_single(combination)) {
        free(combination->counted);
        free(combination->even);
    }
    sp_edges_free(&combination->edges);
    *combination = (sp_combination){0};
}

void sp_combination_add(sp_combination *combination, uint32_t patch, double counted, const sp_wetting *wetting,
                        sp_edge_samples samples)
{
    sp_wetting settled = sp_wetting_settle(*wetting, combination->evaluator->setup.criterion.flux);
    assert(counted >= 0 && settled.even >= 0 && settled.dry >= 0 && settled.dry <= 1);
    combination->counted[patch] += counted;
    combination->even[patch] += settled.even;
    if (!combination->repeats)
        sp_edges_add(&combination->edges, patch, settled.dry, samples, combination->deposits->dry);
}

void sp_combination_begin_nozzle(sp_combination *combination, const sp_layout *layout, size_t i)
{
    combination->repeats = sp_layout_repeats(layout, i, &combination->evaluator->setup.liquid);
}

void sp_combination_begin_pattern(sp_combination *combination, const sp_nozzle *patterns, size_t i, size_t count)
{
    sp_edges_begin(&combination->edges, patterns, i, count);
}

void sp_combination_end_pattern(sp_combination *combination, const sp_nozzle *patterns, size_t i, size_t count)
{
    sp_edges_end(&combination->edges, patterns, i, count, combination->deposits->dry);
}

void sp_combination_end_nozzle(sp_combination *combination)
{
    sp_deposits *deposits = combination->deposits;
    for (size_t i = 0; is_single(combination) && i < deposits->count; i++) {
        deposits->counted[i] = fmax(deposits->counted[i], combination->counted[i]);
        deposits->even[i] = fmax(deposits->even[i], combination->even[i]);
        combination->counted[i] = combination->even[i] = 0;
    }
}
