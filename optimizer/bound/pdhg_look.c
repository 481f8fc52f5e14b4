#include "bound/pdhg.h"

#include <assert.h>
#include <math.h>

#define RESTART 0.5 /* starts anew from the average once that has closed this share of the gap */
#define STALE 0.4   /* or once that share of all iterations has passed without */
#define LEAST 50    /* iterations */

/* The bound of multipliers u at which the rows are worth `price` / `over`. */
static double bound_of(sp_pdhg *h, const sp_multipliers *u, const double *price, double over)
{
    sp_offers_clear(&h->offers);
    for (size_t c = 0; c < h->rows->count; c++)
        if (h->tau[c] > 0 && price[c] > 0)
            sp_offers_add(&h->offers, h->rows->port[c], h->rows->tier[c], price[c] / over);
    sp_knapsack_fill(&h->knapsack, &h->offers, h->task->water);
    return h->dual->cover->base + sp_cover_rest(h->dual->cover, u) +
           sp_knapsack_value(&h->knapsack, h->task->nozzles, h->task->water);
}

/* What fractions x / over cover once brought within the limits. */
static double reached_by(sp_pdhg *h, const double *x, double over)
{
    const sp_cover *cover = h->dual->cover;
    double beyond = 1;
    for (size_t r = 0; r < h->resources; r++)
        h->use[r] = 0;
    for (size_t c = 0; c < h->rows->count; c++) {
        if (h->tau[c] <= 0)
            continue;
        sp_takes takes = sp_pdhg_takes(h, c);
        for (size_t k = 0; k < takes.count; k++)
            h->use[takes.resource[k]] += takes.amount[k] * x[c];
    }
    for (size_t r = 0; r < h->resources; r++)
        if (h->use[r] > 0)
            beyond = fmax(beyond, h->use[r] / over / sp_pdhg_limit(h, r));
    sp_pdhg_add_up(h, x);
    double area = cover->base;
    for (size_t t = 0; t < cover->texel_count; t++) {
        double least = (double)h->cover[t];
        if (h->strengthened)
            least = fmin(least, (double)h->cover[cover->texel_count + t]);
        area += (double)cover->area[t] * fmin(1, least / (over * beyond));
    }
    return area;
}

static void note_best(sp_pdhg *h, double bound, const sp_multipliers *u, double reached, const double *x, double over)
{
    sp_dual *dual = h->dual;
    if (bound < dual->bound) {
        dual->bound = bound;
        sp_multipliers_copy(dual->cover, u, &dual->multipliers);
    }
    if (reached > dual->reached) {
        dual->reached = reached;
        for (size_t c = 0; c < h->rows->count; c++)
            dual->choice[c] = x[c] / over;
    }
}

/* The primal weight follows the distances that both sides went since the last restart. */
static void restart(sp_pdhg *h, bool from_mean, double gap)
{
    sp_dual *dual = h->dual;
    double over = (double)h->since, far_x = 0, far_u = 0;
    for (size_t c = 0; c < h->rows->count; c++) {
        if (from_mean)
            dual->x[c] = h->x_sum[c] / over;
        double way = dual->x[c] - h->x_start[c];
        far_x += h->tau[c] > 0 ? way * way / h->tau[c] : 0;
        h->x_start[c] = dual->x[c];
        h->x_sum[c] = h->price_sum[c] = 0;
    }
    for (size_t i = 0; i < 2 * dual->texels; i++) {
        size_t t = i < dual->texels ? i : i - dual->texels;
        float *u = i < dual->texels ? &dual->u.plain[t] : &dual->u.strengthened[t];
        if (from_mean)
            *u = i < dual->texels ? h->u_mean.plain[t] : h->u_mean.strengthened[t];
        double way = (double)*u - h->u_start[i];
        far_u += h->sigma[i] > 0 ? way * way / h->sigma[i] : 0;
        h->u_start[i] = (double)*u;
        h->u_sum[i] = 0;
    }
    for (size_t r = 0; r < h->resources; r++) {
        if (from_mean)
            h->dual_resource[r] = h->resource_sum[r] / over;
        h->resource_sum[r] = 0;
    }
    if (far_x > 0 && far_u > 0)
        dual->weight = sqrt(dual->weight * sqrt(far_u / far_x));
    h->since = 0;
    h->gap_start = gap;
}

bool sp_pdhg_look(sp_pdhg *h, size_t iteration)
{
    sp_dual *dual = h->dual;
    double over = (double)h->since;
    assert(h->since > 0); /* means are over the steps since the last restart */
    for (size_t t = 0; t < dual->texels; t++) {
        float area = dual->cover->area[t];
        h->u_mean.plain[t] = fminf((float)(h->u_sum[t] / over), area);
        h->u_mean.strengthened[t] = fminf((float)(h->u_sum[dual->texels + t] / over), area - h->u_mean.plain[t]);
    }
    double mean_bound = bound_of(h, &h->u_mean, h->price_sum, over), last_bound = bound_of(h, &h->u_last, h->price, 1);
    double mean_reached = reached_by(h, h->x_sum, over), last_reached = reached_by(h, dual->x, 1);
    note_best(h, mean_bound, &h->u_mean, mean_reached, h->x_sum, over);
    note_best(h, last_bound, &h->u_last, last_reached, dual->x, 1);
    if (dual->bound - dual->reached <= h->task->tolerance * dual->bound)
        return true;
    double mean_gap = mean_bound - mean_reached, last_gap = last_bound - last_reached, gap = fmin(mean_gap, last_gap);
    if (gap <= RESTART * h->gap_start || (double)h->since >= fmax(LEAST, STALE * (double)iteration))
        restart(h, mean_gap <= last_gap, gap);
    return false;
}
