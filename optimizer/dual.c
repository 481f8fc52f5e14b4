#include "dual.h"

#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

#define LOOK 25        /* iterations between two looks at the bound */
#define RESTART 0.5    /* starts anew from the average once that has closed this share of the gap */
#define STALE 0.4      /* or once that share of all iterations has passed without */
#define WEIGHT_FIRST 5 /* primal weight to begin with, in mean texel areas */

/* Everything that one solve needs besides. Resources: water, number, ports. */
typedef struct {
    sp_dual *dual;
    const sp_rows *rows;
    const sp_dual_task *task;
    double *tau;                         /* [rows], of the step in x; 0: a row that cannot be chosen */
    double *sigma;                       /* [texels] */
    double *sigma_resource, *load, *use; /* [resources]; load: Σ of a row's use over the rows */
    double *price, *price_sum;           /* [rows] */
    double *x_sum, *x_bar;               /* [rows] */
    double *u_sum;                       /* [texels] */
    float *u_last, *u_mean;              /* [texels] */
    double *resource_sum;
    float *cover; /* [texels], Σ share x */
    double *x_start, *u_start;
    double *table; /* of the knapsack */
    sp_offers offers;
    double scale; /* of the resource rows, so that their steps keep up with the texels' */
    size_t resources, since;
    double gap_start;
} solver;

bool sp_dual_create(const sp_cover *cover, sp_dual *dual, sp_error *error)
{
    size_t texels = cover->texel_count ? cover->texel_count : 1;
    *dual = (sp_dual){.cover = cover, .texels = cover->texel_count};
    dual->price = malloc(texels * sizeof *dual->price);
    dual->u = malloc(texels * sizeof *dual->u);
    dual->dual_resource = calloc(2 + cover->port_count, sizeof *dual->dual_resource);
    if (!dual->price || !dual->u || !dual->dual_resource) {
        sp_dual_free(dual);
        return sp_fail_memory(error);
    }
    memcpy(dual->price, cover->area, cover->texel_count * sizeof *dual->price);
    memcpy(dual->u, cover->area, cover->texel_count * sizeof *dual->u);
    return true;
}

void sp_dual_free(sp_dual *dual)
{
    free(dual->price);
    free(dual->choice);
    free(dual->u);
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

static bool grow(sp_dual *dual, size_t rows)
{
    if (rows <= dual->row_capacity)
        return true;
    size_t capacity = 2 * rows;
    double *x = realloc(dual->x, capacity * sizeof *x);
    if (x)
        dual->x = x;
    double *choice = realloc(dual->choice, capacity * sizeof *choice);
    if (choice)
        dual->choice = choice;
    if (!x || !choice)
        return false;
    for (; dual->row_capacity < capacity; dual->row_capacity++)
        dual->x[dual->row_capacity] = dual->choice[dual->row_capacity] = 0;
    return true;
}

/* What one unit of a row takes of each resource is 1/limit of it. */
static double use_of(const solver *s, size_t row, size_t resource)
{
    const sp_cover *cover = s->dual->cover;
    if (resource == 0)
        return s->scale * cover->weight[s->rows->tier[row]] / (double)s->task->water;
    return s->scale / (double)s->task->nozzles; /* number, and the row's port */
}

static bool can_choose(const solver *s, size_t row)
{
    return s->dual->cover->weight[s->rows->tier[row]] <= s->task->water &&
           s->rows->start[row + 1] > s->rows->start[row];
}

/* Diagonal steps: the inverse sums of rows and columns. */
static void set_steps(solver *s)
{
    const sp_rows *rows = s->rows;
    double mean = 0, most = 0;
    size_t chosen = 0;
    for (size_t t = 0; t < s->dual->texels; t++)
        s->sigma[t] = 0;
    for (size_t c = 0; c < rows->count; c++) {
        s->tau[c] = 0;
        if (!can_choose(s, c))
            continue;
        for (size_t i = rows->start[c]; i < rows->start[c + 1]; i++) {
            s->tau[c] += (double)rows->share[i];
            s->sigma[rows->texel[i]] += (double)rows->share[i];
        }
        mean += s->tau[c];
        most = fmax(most, s->tau[c]);
        chosen++;
    }
    s->scale = chosen ? 0.5 * mean / (double)chosen * (double)s->task->nozzles : 1;
    for (size_t r = 0; r < s->resources; r++)
        s->load[r] = 0;
    for (size_t c = 0; c < rows->count; c++) {
        if (s->tau[c] <= 0)
            continue;
        double water = use_of(s, c, 0), number = use_of(s, c, 1);
        s->load[0] += water;
        s->load[1] += number;
        if (rows->port[c] != SP_NO_PORT)
            s->load[2 + rows->port[c]] += number;
        s->tau[c] = 1 / (s->tau[c] + water + number + (rows->port[c] != SP_NO_PORT ? number : 0));
    }
    for (size_t t = 0; t < s->dual->texels; t++)
        s->sigma[t] = s->sigma[t] > 0 ? 1 / s->sigma[t] : 0;
    for (size_t r = 0; r < s->resources; r++)
        s->sigma_resource[r] = s->load[r] > 0 ? 1 / s->load[r] : 0;
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

/* cover = Σ share x. Each thread adds to texels of its own, row after row, so that the sums do not depend on how many
 * there are. */
static void add_up(solver *s, const double *x)
{
    const sp_rows *rows = s->rows;
    size_t texels = s->dual->texels;
    int threads = s->dual->cover->threads;
#pragma omp parallel for num_threads(threads) schedule(static, 1)
    for (int part = 0; part < threads; part++) {
        size_t first = texels * (size_t)part / (size_t)threads, end = texels * ((size_t)part + 1) / (size_t)threads;
        for (size_t t = first; t < end; t++)
            s->cover[t] = 0;
        for (size_t c = 0; c < rows->count; c++) {
            float amount = (float)x[c];
            if (amount == 0)
                continue;
            size_t i = lower_bound(rows->texel, rows->start[c], rows->start[c + 1], first);
            for (; i < rows->start[c + 1] && rows->texel[i] < end; i++)
                s->cover[rows->texel[i]] += rows->share[i] * amount;
        }
    }
}

static void find_prices(solver *s, const float *u)
{
    int threads = s->dual->cover->threads;
#pragma omp parallel for num_threads(threads) schedule(static, 16)
    for (size_t c = 0; c < s->rows->count; c++)
        s->price[c] = s->tau[c] > 0 ? sp_rows_price(s->rows, c, u) : 0;
}

static void step(solver *s)
{
    sp_dual *dual = s->dual;
    const double weight = dual->weight, most = dual->cover->repeats ? (double)s->task->nozzles : 1;
    find_prices(s, dual->u);
    for (size_t r = 0; r < s->resources; r++)
        s->use[r] = 0;
    for (size_t c = 0; c < s->rows->count; c++) {
        size_t port = s->rows->port[c];
        double water = use_of(s, c, 0), number = use_of(s, c, 1);
        double gain = s->price[c] - dual->dual_resource[0] * water - dual->dual_resource[1] * number;
        if (port != SP_NO_PORT)
            gain -= dual->dual_resource[2 + port] * number;
        double x = fmin(fmax(dual->x[c] + s->tau[c] / weight * gain, 0), port == SP_NO_PORT ? most : 1);
        s->x_bar[c] = s->tau[c] > 0 ? 2 * x - dual->x[c] : 0;
        dual->x[c] = s->tau[c] > 0 ? x : 0;
        s->x_sum[c] += dual->x[c];
        s->price_sum[c] += s->price[c];
        s->use[0] += water * s->x_bar[c];
        s->use[1] += number * s->x_bar[c];
        if (port != SP_NO_PORT)
            s->use[2 + port] += number * s->x_bar[c];
    }
    add_up(s, s->x_bar);
    for (size_t t = 0; t < dual->texels; t++) {
        double u = (double)dual->u[t];
        s->u_sum[t] += u;
        s->u_last[t] = dual->u[t];
        dual->u[t] = (float)fmin(fmax(u - weight * s->sigma[t] * ((double)s->cover[t] - 1), 0), dual->cover->area[t]);
    }
    for (size_t r = 0; r < s->resources; r++) {
        double limit = r < 1 ? s->scale : r < 2 ? s->scale : s->scale / (double)s->task->nozzles;
        s->resource_sum[r] += dual->dual_resource[r];
        dual->dual_resource[r] = fmax(0, dual->dual_resource[r] + weight * s->sigma_resource[r] * (s->use[r] - limit));
    }
    s->since++;
}

/* The bound of prices u at which the rows are worth `price` / `over`. */
static double bound_of(solver *s, const float *u, const double *price, double over)
{
    sp_offers_clear(&s->offers);
    for (size_t c = 0; c < s->rows->count; c++)
        if (s->tau[c] > 0 && price[c] > 0)
            sp_offers_add(&s->offers, s->rows->port[c], s->rows->tier[c], price[c] / over);
    sp_knapsack(&s->offers, s->task->nozzles, s->task->water, s->table);
    return s->dual->cover->base + sp_cover_rest(s->dual->cover, u) +
           s->table[(s->task->nozzles + 1) * (s->task->water + 1) - 1];
}

/* What fractions x / over cover once brought within the limits. */
static double reached_by(solver *s, const double *x, double over)
{
    const sp_cover *cover = s->dual->cover;
    double beyond = 1;
    for (size_t r = 0; r < s->resources; r++)
        s->use[r] = 0;
    for (size_t c = 0; c < s->rows->count; c++) {
        s->use[0] += use_of(s, c, 0) * x[c];
        s->use[1] += use_of(s, c, 1) * x[c];
        if (s->rows->port[c] != SP_NO_PORT)
            s->use[2 + s->rows->port[c]] += use_of(s, c, 1) * x[c];
    }
    for (size_t r = 0; r < s->resources; r++)
        beyond = fmax(beyond, s->use[r] / over / (r < 2 ? s->scale : s->scale / (double)s->task->nozzles));
    add_up(s, x);
    double area = cover->base;
    for (size_t t = 0; t < cover->texel_count; t++)
        area += (double)cover->area[t] * fmin(1, (double)s->cover[t] / (over * beyond));
    return area;
}

static void note_best(solver *s, double bound, const float *u, double reached, const double *x, double over)
{
    sp_dual *dual = s->dual;
    if (bound < dual->bound) {
        dual->bound = bound;
        memcpy(dual->price, u, dual->texels * sizeof *u);
    }
    if (reached > dual->reached) {
        dual->reached = reached;
        for (size_t c = 0; c < s->rows->count; c++)
            dual->choice[c] = x[c] / over;
    }
}

/* The primal weight follows the distances that both sides went since the last restart. */
static void restart(solver *s, bool from_mean, double gap)
{
    sp_dual *dual = s->dual;
    double over = (double)s->since, far_x = 0, far_u = 0;
    for (size_t c = 0; c < s->rows->count; c++) {
        if (from_mean)
            dual->x[c] = s->x_sum[c] / over;
        double way = dual->x[c] - s->x_start[c];
        far_x += s->tau[c] > 0 ? way * way / s->tau[c] : 0;
        s->x_start[c] = dual->x[c];
        s->x_sum[c] = s->price_sum[c] = 0;
    }
    for (size_t t = 0; t < dual->texels; t++) {
        if (from_mean)
            dual->u[t] = s->u_mean[t];
        double way = (double)dual->u[t] - s->u_start[t];
        far_u += s->sigma[t] > 0 ? way * way / s->sigma[t] : 0;
        s->u_start[t] = (double)dual->u[t];
        s->u_sum[t] = 0;
    }
    for (size_t r = 0; r < s->resources; r++) {
        if (from_mean)
            dual->dual_resource[r] = s->resource_sum[r] / over;
        s->resource_sum[r] = 0;
    }
    if (far_x > 0 && far_u > 0)
        dual->weight = sqrt(dual->weight * sqrt(far_u / far_x));
    s->since = 0;
    s->gap_start = gap;
}

/* Looks at where the iterations stand and at their average; true where they are near enough. */
static bool look(solver *s, size_t iteration)
{
    sp_dual *dual = s->dual;
    double over = (double)s->since;
    for (size_t t = 0; t < dual->texels; t++)
        s->u_mean[t] = fminf((float)(s->u_sum[t] / over), dual->cover->area[t]);
    double mean_bound = bound_of(s, s->u_mean, s->price_sum, over), last_bound = bound_of(s, s->u_last, s->price, 1);
    double mean_reached = reached_by(s, s->x_sum, over), last_reached = reached_by(s, dual->x, 1);
    note_best(s, mean_bound, s->u_mean, mean_reached, s->x_sum, over);
    note_best(s, last_bound, s->u_last, last_reached, dual->x, 1);
    if (dual->bound - dual->reached <= s->task->tolerance * dual->bound)
        return true;
    double mean_gap = mean_bound - mean_reached, last_gap = last_bound - last_reached, gap = fmin(mean_gap, last_gap);
    if (gap <= RESTART * s->gap_start || (double)s->since >= fmax(2 * LOOK, STALE * (double)iteration))
        restart(s, mean_gap <= last_gap, gap);
    return false;
}

static void solver_free(solver *s)
{
    free(s->tau);
    free(s->u_last);
    free(s->table);
    sp_offers_free(&s->offers);
}

/* Two blocks: all doubles, all floats. */
static bool solver_create(solver *s, sp_error *error)
{
    const sp_cover *cover = s->dual->cover;
    size_t rows = s->rows->count, texels = cover->texel_count;
    s->resources = 2 + cover->port_count;
    if (s->task->water + 1 > SIZE_MAX / sizeof(double) / (s->task->nozzles + 1))
        return sp_fail_memory(error);
    s->tau = calloc(6 * rows + 3 * texels + 4 * s->resources + 1, sizeof *s->tau);
    s->u_last = calloc(3 * texels + 1, sizeof *s->u_last);
    s->table = malloc((s->task->nozzles + 1) * (s->task->water + 1) * sizeof *s->table);
    bool offers = sp_offers_create(cover->tier_count, cover->weight, cover->port_count, s->task->nozzles,
                                   cover->repeats, &s->offers, error);
    if (!s->tau || !s->u_last || !s->table || !offers || !grow(s->dual, rows)) {
        solver_free(s);
        return offers ? sp_fail_memory(error) : false;
    }
    s->price = s->tau + rows;
    s->price_sum = s->price + rows;
    s->x_sum = s->price_sum + rows;
    s->x_bar = s->x_sum + rows;
    s->x_start = s->x_bar + rows;
    s->sigma = s->x_start + rows;
    s->u_sum = s->sigma + texels;
    s->u_start = s->u_sum + texels;
    s->sigma_resource = s->u_start + texels;
    s->load = s->sigma_resource + s->resources;
    s->use = s->load + s->resources;
    s->resource_sum = s->use + s->resources;
    s->u_mean = s->u_last + texels;
    s->cover = s->u_mean + texels;
    return true;
}

bool sp_dual_solve(sp_dual *dual, const sp_rows *rows, const sp_dual_task *task, sp_error *error)
{
    solver s = {.dual = dual, .rows = rows, .task = task, .gap_start = INFINITY};
    if (!solver_create(&s, error))
        return false;
    set_steps(&s);
    if (!(dual->weight > 0)) {
        double area = 0;
        for (size_t t = 0; t < dual->texels; t++)
            area += (double)dual->cover->area[t];
        dual->weight = fmax(WEIGHT_FIRST * area / (double)(dual->texels ? dual->texels : 1), 1e-30);
    }
    memcpy(s.x_start, dual->x, rows->count * sizeof *dual->x);
    for (size_t t = 0; t < dual->texels; t++)
        s.u_start[t] = (double)dual->u[t];
    dual->bound = INFINITY;
    dual->reached = -INFINITY;
    for (size_t i = 1; i <= task->iterations; i++) {
        step(&s);
        if (i % LOOK == 0 && look(&s, i))
            break;
    }
    solver_free(&s);
    return true;
}
