#include "bound/pdhg.h"

#include <assert.h>
#include <math.h>

#define SHARES_A_THREAD 80000

/* A step is short and there are thousands: no more threads than have enough to do. With less, where others use the
 * cores too, they wait for each other longer than they work. */
static int threads_for(const sp_pdhg *h)
{
    double shares = (double)h->rows->used + (double)h->dual->texels;
    return (int)fmax(1, fmin(h->dual->cover->threads, floor(shares / SHARES_A_THREAD)));
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

/* The texels of one part of so many. */
static size_t part_start(const sp_pdhg *h, int part, int parts)
{
    return h->dual->texels * (size_t)part / (size_t)parts;
}

/* What x covers of the texels of one part, row after row, so that the sums do not depend on how many parts there are.
 */
static void add_up_part(sp_pdhg *h, const double *x, int part, int parts)
{
    const sp_rows *rows = h->rows;
    size_t texels = h->dual->texels, first = part_start(h, part, parts), end = part_start(h, part + 1, parts);
    for (size_t t = first; t < end; t++)
        h->cover[t] = h->cover[texels + t] = 0;
    for (size_t c = 0; c < rows->count; c++) {
        float amount = (float)x[c];
        if (amount == 0)
            continue;
        size_t i = lower_bound(rows->texel, rows->start[c], rows->start[c + 1], first);
        size_t stop = lower_bound(rows->texel, i, rows->start[c + 1], end);
        for (size_t k = i; k < stop; k++)
            h->cover[rows->texel[k]] += sp_share_of(rows->share[k]) * amount;
        for (size_t k = i; h->strengthened && k < stop; k++)
            h->cover[texels + rows->texel[k]] += h->strengthened[k] * amount;
    }
}

void sp_pdhg_add_up(sp_pdhg *h, const double *x)
{
    int threads = threads_for(h);
#pragma omp parallel for num_threads(threads) schedule(static, 1)
    for (int part = 0; part < threads; part++)
        add_up_part(h, x, part, threads);
}

/* What a row is worth where the iterations stand. Four sums side by side, so that none waits for the one before. */
static double worth(const uint32_t *texel, const float *share, size_t count, const float *u)
{
    double total[4] = {0};
    size_t i = 0;
    for (; i + 4 <= count; i += 4)
        for (size_t k = 0; k < 4; k++)
            total[k] += (double)sp_share_of(share[i + k]) * (double)u[texel[i + k]];
    for (; i < count; i++)
        total[0] += (double)sp_share_of(share[i]) * (double)u[texel[i]];
    return (total[0] + total[1]) + (total[2] + total[3]);
}

static double price_of(const sp_pdhg *h, size_t row)
{
    const sp_rows *rows = h->rows;
    const sp_multipliers *u = &h->dual->u;
    size_t first = rows->start[row], count = rows->start[row + 1] - first;
    if (h->tau[row] <= 0)
        return 0;
    double price = worth(rows->texel + first, rows->share + first, count, u->plain);
    if (h->strengthened)
        price += worth(rows->texel + first, h->strengthened + first, count, u->strengthened);
    return price;
}

/* A step in a texel's two multipliers, which together stay within its area. */
static void step_texel(sp_pdhg *h, size_t t)
{
    sp_dual *dual = h->dual;
    size_t texels = dual->texels;
    double area = (double)dual->cover->area[t], *const sum = h->u_sum;
    double plain_step = dual->weight * h->sigma[t], strengthened_step = dual->weight * h->sigma[texels + t];
    double plain = (double)dual->u.plain[t], strengthened = (double)dual->u.strengthened[t];
    sum[t] += plain;
    sum[texels + t] += strengthened;
    h->u_last.plain[t] = dual->u.plain[t];
    h->u_last.strengthened[t] = dual->u.strengthened[t];
    plain = fmax(plain - plain_step * ((double)h->cover[t] - 1), 0);
    strengthened = h->strengthened ? fmax(strengthened - strengthened_step * ((double)h->cover[texels + t] - 1), 0) : 0;
    double excess = plain + strengthened - area, steps = plain_step + strengthened_step;
    if (excess > 0 && strengthened > 0 && steps > 0) {
        double from_plain = fmin(plain, fmax(excess - strengthened, excess * plain_step / steps));
        plain -= from_plain;
        strengthened = fmin(strengthened, fmax(0, area - plain));
    }
    dual->u.plain[t] = (float)fmin(plain, area);
    dual->u.strengthened[t] = (float)strengthened;
}

static double most_of(const sp_pdhg *h, size_t row)
{
    bool once = !h->dual->cover->repeats || h->rows->port[row] != SP_NO_PORT;
    return once ? 1 : (double)h->task->nozzles;
}

static void step_rows(sp_pdhg *h)
{
    sp_dual *dual = h->dual;
    for (size_t r = 0; r < h->resources; r++)
        h->use[r] = 0;
    for (size_t c = 0; c < h->rows->count; c++) {
        h->x_bar[c] = 0;
        if (h->tau[c] <= 0)
            continue;
        sp_takes takes = sp_pdhg_takes(h, c);
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

static void step_resources(sp_pdhg *h)
{
    double weight = h->dual->weight;
    for (size_t r = 0; r < h->resources; r++) {
        double beyond = h->use[r] - sp_pdhg_limit(h, r);
        h->resource_sum[r] += h->dual_resource[r];
        assert(h->dual_resource[r] >= 0 && h->sigma_resource[r] >= 0);
        h->dual_resource[r] = fmax(0, h->dual_resource[r] + weight * h->sigma_resource[r] * beyond);
    }
}

/* One team for all of a step: threads wait for one another thrice. */
void sp_pdhg_step(sp_pdhg *h)
{
    int threads = threads_for(h);
    assert(h->dual->weight > 0 && isfinite(h->dual->weight));
#pragma omp parallel num_threads(threads)
    {
#pragma omp for schedule(static, 4)
        for (size_t c = 0; c < h->rows->count; c++)
            h->price[c] = price_of(h, c);
#pragma omp single
        step_rows(h);
#pragma omp for schedule(static, 1)
        for (int part = 0; part < threads; part++) {
            add_up_part(h, h->x_bar, part, threads);
            for (size_t t = part_start(h, part, threads); t < part_start(h, part + 1, threads); t++)
                step_texel(h, t);
        }
    }
    step_resources(h);
    h->since++;
}
