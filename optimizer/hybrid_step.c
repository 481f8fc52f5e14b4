#include "hybrid.h"

#include <math.h>
#include <omp.h>

static uint32_t slot_of(const sp_hybrid *h, size_t row)
{
    return h->task->slot_of ? h->task->slot_of[row] : SP_NO_SLOT;
}

/* Nozzles that all limits together let in. */
static double nozzles_of(const sp_hybrid *h)
{
    double nozzles = (double)h->task->nozzles;
    for (size_t i = 0; i < h->task->slot_count; i++)
        nozzles += (double)h->task->slot_room[i];
    return nozzles;
}

sp_takes sp_hybrid_takes(const sp_hybrid *h, size_t row)
{
    const sp_cover *cover = h->dual->cover;
    uint32_t slot = slot_of(h, row);
    double one = h->scale / nozzles_of(h);
    if (slot != SP_NO_SLOT)
        return (sp_takes){1, {2 + cover->port_count + slot}, {one}};
    sp_takes takes = {2, {0, 1}, {h->scale * cover->weight[h->rows->tier[row]] / (double)h->task->water, one}};
    if (h->rows->port[row] != SP_NO_PORT) {
        takes.resource[2] = 2 + h->rows->port[row];
        takes.amount[2] = one;
        takes.count = 3;
    }
    return takes;
}

double sp_hybrid_limit(const sp_hybrid *h, size_t resource)
{
    size_t ports = h->dual->cover->port_count;
    double one = h->scale / nozzles_of(h);
    if (resource == 0)
        return h->scale;
    if (resource == 1)
        return one * (double)h->task->nozzles;
    return resource < 2 + ports ? one : one * (double)h->task->slot_room[resource - 2 - ports];
}

static bool can_choose(const sp_hybrid *h, size_t row)
{
    uint32_t slot = slot_of(h, row);
    if (slot == SP_SHUT_OUT || h->rows->start[row + 1] == h->rows->start[row])
        return false;
    return slot != SP_NO_SLOT || (h->task->nozzles && h->dual->cover->weight[h->rows->tier[row]] <= h->task->water);
}

/* Sums of columns, into tau, and of the texels' rows, into sigma. */
static void add_shares(sp_hybrid *h, double *mean)
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
            h->tau[c] += (double)rows->share[i];
            h->sigma[rows->texel[i]] += (double)rows->share[i];
            if (h->lifted) {
                h->tau[c] += (double)h->lifted[i];
                h->sigma[texels + rows->texel[i]] += (double)h->lifted[i];
            }
        }
        *mean += h->tau[c];
        chosen++;
    }
    *mean = chosen ? *mean / (double)chosen : 0;
}

/* Diagonal steps: the inverse sums of rows and columns. */
static void set_steps(sp_hybrid *h)
{
    double mean;
    add_shares(h, &mean);
    h->scale = mean > 0 ? 0.5 * mean * nozzles_of(h) : 1;
    for (size_t r = 0; r < h->resources; r++)
        h->load[r] = 0;
    for (size_t c = 0; c < h->rows->count; c++) {
        if (h->tau[c] <= 0)
            continue;
        sp_takes takes = sp_hybrid_takes(h, c);
        for (size_t k = 0; k < takes.count; k++) {
            h->load[takes.resource[k]] += takes.amount[k];
            h->tau[c] += takes.amount[k];
        }
        h->tau[c] = 1 / h->tau[c];
    }
    for (size_t t = 0; t < 2 * h->dual->texels; t++)
        h->sigma[t] = h->sigma[t] > 0 ? 1 / h->sigma[t] : 0;
    for (size_t r = 0; r < h->resources; r++)
        h->sigma_resource[r] = h->load[r] > 0 ? 1 / h->load[r] : 0;
}

static size_t lower_bound(const uint32_t *texel, size_t first, size_t end, size_t least)
{
    while (first < end) {
        size_t middle = first + (end - first) / 2;
        if (texel[middle] < least)
            first = middle + 1;
        else
            end = middle;
    }
    return first;
}

/* Each thread adds to texels of its own, row after row, so that the sums do not depend on how many there are. */
void sp_hybrid_add_up(sp_hybrid *h, const double *x)
{
    const sp_rows *rows = h->rows;
    size_t texels = h->dual->texels;
    int threads = h->dual->cover->threads;
#pragma omp parallel for num_threads(threads) schedule(static, 1)
    for (int part = 0; part < threads; part++) {
        size_t first = texels * (size_t)part / (size_t)threads, end = texels * ((size_t)part + 1) / (size_t)threads;
        for (size_t t = first; t < end; t++)
            h->cover[t] = h->cover[texels + t] = 0;
        for (size_t c = 0; c < rows->count; c++) {
            float amount = (float)x[c];
            if (amount == 0)
                continue;
            size_t i = lower_bound(rows->texel, rows->start[c], rows->start[c + 1], first);
            size_t stop = lower_bound(rows->texel, i, rows->start[c + 1], end);
            for (size_t k = i; k < stop; k++)
                h->cover[rows->texel[k]] += rows->share[k] * amount;
            for (size_t k = i; h->lifted && k < stop; k++)
                h->cover[texels + rows->texel[k]] += h->lifted[k] * amount;
        }
    }
}

/* What a row is worth where the iterations stand. Four sums side by side, so that none waits for the one before. */
static double worth(const uint32_t *texel, const float *share, size_t count, const float *u)
{
    double total[4] = {0};
    size_t i = 0;
    for (; i + 4 <= count; i += 4)
        for (size_t k = 0; k < 4; k++)
            total[k] += (double)share[i + k] * (double)u[texel[i + k]];
    for (; i < count; i++)
        total[0] += (double)share[i] * (double)u[texel[i]];
    return (total[0] + total[1]) + (total[2] + total[3]);
}

static void find_prices(sp_hybrid *h)
{
    const sp_rows *rows = h->rows;
    const sp_prices *u = &h->dual->u;
    int threads = h->dual->cover->threads;
#pragma omp parallel for num_threads(threads) schedule(static, 16)
    for (size_t c = 0; c < rows->count; c++) {
        size_t first = rows->start[c], count = rows->start[c + 1] - first;
        h->price[c] = 0;
        if (h->tau[c] <= 0)
            continue;
        h->price[c] = worth(rows->texel + first, rows->share + first, count, u->plain);
        if (h->lifted)
            h->price[c] += worth(rows->texel + first, h->lifted + first, count, u->lifted);
    }
}

/* A step in a texel's two prices, which together stay within its area. */
static void step_texel(sp_hybrid *h, size_t t)
{
    sp_dual *dual = h->dual;
    size_t texels = dual->texels;
    double area = (double)dual->cover->area[t], *const sum = h->u_sum;
    double plain_step = dual->weight * h->sigma[t], lifted_step = dual->weight * h->sigma[texels + t];
    double plain = (double)dual->u.plain[t], lifted = (double)dual->u.lifted[t];
    sum[t] += plain;
    sum[texels + t] += lifted;
    h->u_last.plain[t] = dual->u.plain[t];
    h->u_last.lifted[t] = dual->u.lifted[t];
    plain = fmax(plain - plain_step * ((double)h->cover[t] - 1), 0);
    lifted = h->lifted ? fmax(lifted - lifted_step * ((double)h->cover[texels + t] - 1), 0) : 0;
    double excess = plain + lifted - area, steps = plain_step + lifted_step;
    if (excess > 0 && lifted > 0 && steps > 0) {
        double from_plain = fmin(plain, fmax(excess - lifted, excess * plain_step / steps));
        plain -= from_plain;
        lifted = fmin(lifted, fmax(0, area - plain));
    }
    dual->u.plain[t] = (float)fmin(plain, area);
    dual->u.lifted[t] = (float)lifted;
}

static double most_of(const sp_hybrid *h, size_t row)
{
    uint32_t slot = slot_of(h, row);
    if (!h->dual->cover->repeats || (slot == SP_NO_SLOT && h->rows->port[row] != SP_NO_PORT))
        return 1;
    return slot == SP_NO_SLOT ? (double)h->task->nozzles : (double)h->task->slot_room[slot];
}

static void step_rows(sp_hybrid *h)
{
    sp_dual *dual = h->dual;
    for (size_t r = 0; r < h->resources; r++)
        h->use[r] = 0;
    for (size_t c = 0; c < h->rows->count; c++) {
        h->x_bar[c] = 0;
        if (h->tau[c] <= 0)
            continue;
        sp_takes takes = sp_hybrid_takes(h, c);
        double gain = h->price[c];
        for (size_t k = 0; k < takes.count; k++)
            gain -= h->dual_resource[takes.resource[k]] * takes.amount[k];
        double x = fmin(fmax(dual->x[c] + h->tau[c] / dual->weight * gain, 0), most_of(h, c));
        h->x_bar[c] = 2 * x - dual->x[c];
        dual->x[c] = x;
        h->x_sum[c] += x;
        h->price_sum[c] += h->price[c];
        for (size_t k = 0; k < takes.count; k++)
            h->use[takes.resource[k]] += takes.amount[k] * h->x_bar[c];
    }
}

void sp_hybrid_step(sp_hybrid *h)
{
    sp_dual *dual = h->dual;
    if (!(h->scale > 0))
        set_steps(h);
    find_prices(h);
    step_rows(h);
    sp_hybrid_add_up(h, h->x_bar);
    int threads = dual->cover->threads;
#pragma omp parallel for num_threads(threads) schedule(static)
    for (size_t t = 0; t < dual->texels; t++)
        step_texel(h, t);
    for (size_t r = 0; r < h->resources; r++) {
        double beyond = h->use[r] - sp_hybrid_limit(h, r);
        h->resource_sum[r] += h->dual_resource[r];
        h->dual_resource[r] = fmax(0, h->dual_resource[r] + dual->weight * h->sigma_resource[r] * beyond);
    }
    h->since++;
}
