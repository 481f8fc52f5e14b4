#include "bound/pdhg.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

void sp_pdhg_free(sp_pdhg *h)
{
    free(h->tau);
    free(h->cover);
    free(h->strengthened);
    sp_multipliers_free(&h->u_last);
    sp_multipliers_free(&h->u_mean);
    sp_knapsack_free(&h->knapsack);
    sp_offers_free(&h->offers);
}

/* All doubles in one block. */
static bool allocate(sp_pdhg *h, sp_error *error)
{
    const sp_cover *cover = h->dual->cover;
    size_t rows = h->rows->count, texels = cover->texel_count;
    h->resources = 2 + cover->port_count;
    h->tau = calloc(6 * rows + 6 * texels + 6 * h->resources + 1, sizeof *h->tau);
    h->cover = calloc(2 * texels + 1, sizeof *h->cover);
    if (!h->tau || !h->cover)
        return sp_fail_memory(error);
    if (!sp_knapsack_create(h->task->nozzles, h->task->water, &h->knapsack, error))
        return false;
    h->price = h->tau + rows;
    h->price_sum = h->price + rows;
    h->x_sum = h->price_sum + rows;
    h->x_bar = h->x_sum + rows;
    h->x_start = h->x_bar + rows;
    h->sigma = h->x_start + rows;
    h->u_sum = h->sigma + 2 * texels;
    h->u_start = h->u_sum + 2 * texels;
    h->sigma_resource = h->u_start + 2 * texels;
    h->load = h->sigma_resource + h->resources;
    h->use = h->load + h->resources;
    h->resource_sum = h->use + h->resources;
    h->dual_resource = h->resource_sum + h->resources;
    return sp_offers_create(cover->tier_count, cover->weight, cover->port_count, h->task->nozzles + 1, cover->repeats,
                            &h->offers, error) &&
           sp_multipliers_create(cover, &h->u_last, error) && sp_multipliers_create(cover, &h->u_mean, error);
}

/* The rows' shares as the texels' inequalities make them. What they are worth changes with the inequalities. */
static bool strengthen_rows(sp_pdhg *h, sp_error *error)
{
    sp_multipliers *const all[] = {&h->dual->u, &h->u_last, &h->u_mean};
    const sp_rows *rows = h->rows;
    for (size_t i = 0; i < 3; i++) {
        all[i]->inequalities = h->task->inequalities;
        memcpy(all[i]->kind, h->dual->u.kind, h->dual->texels);
    }
    if (!h->task->inequalities) {
        memset(h->dual->u.strengthened, 0, h->dual->texels * sizeof *h->dual->u.strengthened);
        return true;
    }
    h->strengthened = malloc((rows->used + 1) * sizeof *h->strengthened);
    if (!h->strengthened)
        return sp_fail_memory(error);
    for (size_t i = 0; i < rows->used; i++) {
        assert(rows->texel[i] < h->dual->texels && (h->task->strengthened || fabsf(rows->share[i]) <= 1));
        h->strengthened[i] =
            h->task->strengthened
                ? h->task->strengthened[i]
                : sp_share_strengthened(h->task->inequalities, h->dual->u.kind[rows->texel[i]], rows->share[i]);
    }
    return true;
}

sp_takes sp_pdhg_takes(const sp_pdhg *h, size_t row)
{
    const sp_cover *cover = h->dual->cover;
    double one = h->scale / (double)h->task->nozzles;
    sp_takes takes = {2, {0, 1}, {h->scale * cover->weight[h->rows->tier[row]] / (double)h->task->water, one}};
    if (h->rows->port[row] != SP_NO_PORT) {
        takes.resource[2] = 2 + h->rows->port[row];
        takes.amount[2] = one;
        takes.count = 3;
    }
    return takes;
}

double sp_pdhg_limit(const sp_pdhg *h, size_t resource)
{
    return resource < 2 ? h->scale : h->scale / (double)h->task->nozzles;
}

static bool can_choose(const sp_pdhg *h, size_t row)
{
    return h->rows->start[row + 1] > h->rows->start[row] &&
           h->dual->cover->weight[h->rows->tier[row]] <= h->task->water;
}

/* Sums of columns, into tau, and of the texels' rows, into sigma. */
static void add_shares(sp_pdhg *h, double *mean)
{
    const sp_rows *rows = h->rows;
    size_t texels = h->dual->texels, chosen = 0;
    for (size_t t = 0; t < 2 * texels; t++)
        h->sigma[t] = 0;
    *mean = 0;
    for (size_t c = 0; c < rows->count; c++) {
        h->tau[c] = 0;
        if (!can_choose(h, c)) {
            h->dual->x[c] = 0;
            continue;
        }
        for (size_t i = rows->start[c]; i < rows->start[c + 1]; i++) {
            double share = (double)sp_share_of(rows->share[i]);
            h->tau[c] += share;
            h->sigma[rows->texel[i]] += share;
            if (h->strengthened) {
                h->tau[c] += (double)h->strengthened[i];
                h->sigma[texels + rows->texel[i]] += (double)h->strengthened[i];
            }
        }
        *mean += h->tau[c];
        chosen++;
    }
    *mean = chosen ? *mean / (double)chosen : 0;
}

/* Diagonal steps: the inverse sums of rows and columns. */
static void set_steps(sp_pdhg *h)
{
    double mean;
    add_shares(h, &mean);
    h->scale = mean > 0 ? 0.5 * mean * (double)h->task->nozzles : 1;
    assert(h->scale > 0 && isfinite(h->scale));
    for (size_t r = 0; r < h->resources; r++)
        h->load[r] = 0;
    for (size_t c = 0; c < h->rows->count; c++) {
        if (h->tau[c] <= 0)
            continue;
        sp_takes takes = sp_pdhg_takes(h, c);
        for (size_t k = 0; k < takes.count; k++) {
            h->load[takes.resource[k]] += takes.amount[k];
            h->tau[c] += takes.amount[k];
        }
        h->tau[c] = 1 / h->tau[c];
        assert(h->tau[c] > 0);
    }
    for (size_t t = 0; t < 2 * h->dual->texels; t++)
        h->sigma[t] = h->sigma[t] > 0 ? 1 / h->sigma[t] : 0;
    for (size_t r = 0; r < h->resources; r++)
        h->sigma_resource[r] = h->load[r] > 0 ? 1 / h->load[r] : 0;
}

bool sp_pdhg_create(sp_dual *dual, const sp_rows *rows, const sp_dual_task *task, sp_pdhg *h, sp_error *error)
{
    assert(task->nozzles > 0 && dual->weight > 0 && rows->count <= dual->row_capacity);
    *h = (sp_pdhg){.dual = dual, .rows = rows, .task = task, .gap_start = INFINITY};
    if (!allocate(h, error) || !strengthen_rows(h, error)) {
        sp_pdhg_free(h);
        return false;
    }
    if (rows->count)
        memcpy(h->x_start, dual->x, rows->count * sizeof *dual->x);
    for (size_t t = 0; t < dual->texels; t++) {
        h->u_start[t] = (double)dual->u.plain[t];
        h->u_start[dual->texels + t] = (double)dual->u.strengthened[t];
    }
    memcpy(h->dual_resource, dual->dual_resource, h->resources * sizeof *h->dual_resource);
    set_steps(h);
    return true;
}
