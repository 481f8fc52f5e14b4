#include "bound/dual.h"

#include "mesh/grow.h"

#include <stdlib.h>
#include <string.h>

#define CHOICE_LEAST 1e-4f /* of a row, that is worth a look */
#define KIND_BETTER 1e-3f  /* by which another inequality must cover less */

bool sp_dual_create(const sp_cover *cover, sp_dual *dual, sp_error *error)
{
    *dual = (sp_dual){.cover = cover, .texels = cover->texel_count};
    if (!sp_multipliers_create(cover, &dual->multipliers, error) || !sp_multipliers_create(cover, &dual->u, error)) {
        sp_dual_free(dual);
        return false;
    }
    dual->dual_resource = calloc(2 + cover->port_count, sizeof *dual->dual_resource);
    if (dual->dual_resource)
        return true;
    sp_dual_free(dual);
    return sp_fail_memory(error);
}

void sp_dual_free(sp_dual *dual)
{
    sp_multipliers_free(&dual->multipliers);
    sp_multipliers_free(&dual->u);
    free(dual->choice);
    free(dual->x);
    free(dual->dual_resource);
    *dual = (sp_dual){0};
}

void sp_dual_keep(sp_dual *dual, size_t rows, const bool *marked)
{
    size_t kept = 0;
    for (size_t i = 0; i < rows && i < dual->row_capacity; i++)
        if (marked[i]) {
            dual->x[kept] = dual->x[i];
            dual->choice[kept++] = dual->choice[i];
        }
    for (; kept < dual->row_capacity; kept++)
        dual->x[kept] = dual->choice[kept] = 0;
}

bool sp_dual_make_room(sp_dual *dual, size_t rows, sp_error *error)
{
    if (rows <= dual->row_capacity)
        return true;
    size_t capacity = 2 * rows;
    if (!sp_reallocate(&dual->x, capacity, sizeof *dual->x) ||
        !sp_reallocate(&dual->choice, capacity, sizeof *dual->choice))
        return sp_fail_memory(error);
    for (; dual->row_capacity < capacity; dual->row_capacity++)
        dual->x[dual->row_capacity] = dual->choice[dual->row_capacity] = 0;
    return true;
}

bool sp_dual_strengthen(sp_dual *dual, const sp_rows *rows, const sp_valid_inequalities *inequalities, sp_error *error)
{
    size_t kinds = inequalities->kinds;
    float *sums = calloc(dual->texels * kinds + 1, sizeof *sums);
    if (!sums)
        return sp_fail_memory(error);
    for (size_t c = 0; c < rows->count; c++) {
        float amount = (float)sp_dual_choice(dual, c);
        for (size_t i = rows->start[c]; amount > CHOICE_LEAST && i < rows->start[c + 1]; i++)
            for (size_t k = 0; k < kinds; k++)
                sums[rows->texel[i] * kinds + k] += amount * sp_share_strengthened(inequalities, k, rows->share[i]);
    }
    for (size_t t = 0; t < dual->texels; t++) {
        uint8_t best = dual->u.kind[t];
        for (size_t k = 0; k < kinds; k++)
            if (sums[t * kinds + k] < sums[t * kinds + best] - KIND_BETTER)
                best = (uint8_t)k;
        dual->u.kind[t] = best;
    }
    free(sums);
    return true;
}
