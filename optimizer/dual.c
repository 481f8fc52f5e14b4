#include "dual.h"

#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

#define LOOK 25            /* iterations between two looks at the bound */
#define RESTART 0.5        /* starts anew from the average once that has closed this share of the gap */
#define STALE 0.4          /* or once that share of all iterations has passed without */
#define CHOICE_LEAST 1e-4f /* of a row, that is worth a look */
#define KIND_BETTER 1e-3f  /* by which another lift must cover less */
#define WEIGHT_FIRST 5     /* primal weight to begin with, in mean texel areas */

/* Everything that one solve needs besides. Resources: water, number, ports. */
typedef struct {
    sp_dual *dual;
    const sp_rows *rows;
    const sp_dual_task *task;
    double *tau;                         /* [rows], of the step in x; 0: a row that cannot be chosen */
    double *sigma; /* [2 texels], plain and lifted, as all that follows of [2 texels] */
    float *lifted; /* [rows->used], the shares lifted; NULL: no lifts */
    double *sigma_resource, *load, *use; /* [resources]; load: Σ of a row's use over the rows */
    double *price, *price_sum;           /* [rows] */
    double *x_sum, *x_bar;               /* [rows] */
    double *u_sum;                       /* [2 texels] */
    sp_prices u_last, u_mean;
    double *resource_sum;
    float *cover; /* [2 texels], Σ share x */
    double *x_start, *u_start;
    double *table; /* of the knapsack */
    sp_offers offers;
    double scale; /* of the resource rows, so that their steps keep up with the texels' */
    size_t resources, since;
    double gap_start;
} solver;

bool sp_dual_create(const sp_cover *cover, sp_dual *dual, sp_error *error)
{
    *dual = (sp_dual){.cover = cover, .texels = cover->texel_count};
    if (!sp_prices_create(cover, &dual->price, error) || !sp_prices_create(cover, &dual->u, error)) {
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
    sp_prices_free(&dual->price);
    sp_prices_free(&dual->u);
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
    size_t texels = s->dual->texels;
    for (size_t t = 0; t < 2 * texels; t++)
        s->sigma[t] = 0;
    for (size_t c = 0; c < rows->count; c++) {
        s->tau[c] = 0;
        if (!can_choose(s, c))
            continue;
        for (size_t i = rows->start[c]; i < rows->start[c + 1]; i++) {
            s->tau[c] += (double)rows->share[i];
            s->sigma[rows->texel[i]] += (double)rows->share[i];
            if (s->lifted) {
                s->tau[c] += (double)s->lifted[i];
                s->sigma[texels + rows->texel[i]] += (double)s->lifted[i];
            }
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
    for (size_t t = 0; t < 2 * texels; t++)
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
            s->cover[t] = s->cover[texels + t] = 0;
        for (size_t c = 0; c < rows->count; c++) {
            float amount = (float)x[c];
            if (amount == 0)
                continue;
            size_t i = lower_bound(rows->texel, rows->start[c], rows->start[c + 1], first);
            size_t stop = lower_bound(rows->texel, i, rows->start[c + 1], end);
            for (size_t k = i; k < stop; k++)
                s->cover[rows->texel[k]] += rows->share[k] * amount;
            for (size_t k = i; s->lifted && k < stop; k++)
                s->cover[texels + rows->texel[k]] += s->lifted[k] * amount;
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

static void find_prices(solver *s)
{
    const sp_rows *rows = s->rows;
    const sp_prices *u = &s->dual->u;
    int threads = s->dual->cover->threads;
#pragma omp parallel for num_threads(threads) schedule(static, 16)
    for (size_t c = 0; c < rows->count; c++) {
        size_t first = rows->start[c], count = rows->start[c + 1] - first;
        s->price[c] = 0;
        if (s->tau[c] <= 0)
            continue;
        s->price[c] = worth(rows->texel + first, rows->share + first, count, u->plain);
        if (s->lifted)
            s->price[c] += worth(rows->texel + first, s->lifted + first, count, u->lifted);
    }
}

/* A step in a texel's two prices, which together stay within its area. */
static void step_texel(solver *s, size_t t)
{
    sp_dual *dual = s->dual;
    size_t texels = dual->texels;
    double area = (double)dual->cover->area[t], *const sum = s->u_sum;
    double plain_step = dual->weight * s->sigma[t], lifted_step = dual->weight * s->sigma[texels + t];
    double plain = (double)dual->u.plain[t], lifted = (double)dual->u.lifted[t];
    sum[t] += plain;
    sum[texels + t] += lifted;
    s->u_last.plain[t] = dual->u.plain[t];
    s->u_last.lifted[t] = dual->u.lifted[t];
    plain = fmax(plain - plain_step * ((double)s->cover[t] - 1), 0);
    lifted = s->lifted ? fmax(lifted - lifted_step * ((double)s->cover[texels + t] - 1), 0) : 0;
    double excess = plain + lifted - area, steps = plain_step + lifted_step;
    if (excess > 0 && lifted > 0 && steps > 0) {
        double from_plain = fmin(plain, fmax(excess - lifted, excess * plain_step / steps));
        plain -= from_plain;
        lifted = fmin(lifted, fmax(0, area - plain));
    }
    dual->u.plain[t] = (float)fmin(plain, area);
    dual->u.lifted[t] = (float)lifted;
}

static void step(solver *s)
{
    sp_dual *dual = s->dual;
    const double weight = dual->weight, most = dual->cover->repeats ? (double)s->task->nozzles : 1;
    find_prices(s);
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
    int threads = dual->cover->threads;
#pragma omp parallel for num_threads(threads) schedule(static)
    for (size_t t = 0; t < dual->texels; t++)
        step_texel(s, t);
    for (size_t r = 0; r < s->resources; r++) {
        double limit = r < 1 ? s->scale : r < 2 ? s->scale : s->scale / (double)s->task->nozzles;
        s->resource_sum[r] += dual->dual_resource[r];
        dual->dual_resource[r] = fmax(0, dual->dual_resource[r] + weight * s->sigma_resource[r] * (s->use[r] - limit));
    }
    s->since++;
}

/* The bound of prices u at which the rows are worth `price` / `over`. */
static double bound_of(solver *s, const sp_prices *u, const double *price, double over)
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
    for (size_t t = 0; t < cover->texel_count; t++) {
        double least = (double)s->cover[t];
        if (s->lifted)
            least = fmin(least, (double)s->cover[cover->texel_count + t]);
        area += (double)cover->area[t] * fmin(1, least / (over * beyond));
    }
    return area;
}

static void note_best(solver *s, double bound, const sp_prices *u, double reached, const double *x, double over)
{
    sp_dual *dual = s->dual;
    if (bound < dual->bound) {
        dual->bound = bound;
        sp_prices_copy(dual->cover, u, &dual->price);
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
    for (size_t i = 0; i < 2 * dual->texels; i++) {
        size_t t = i < dual->texels ? i : i - dual->texels;
        float *u = i < dual->texels ? &dual->u.plain[t] : &dual->u.lifted[t];
        if (from_mean)
            *u = i < dual->texels ? s->u_mean.plain[t] : s->u_mean.lifted[t];
        double way = (double)*u - s->u_start[i];
        far_u += s->sigma[i] > 0 ? way * way / s->sigma[i] : 0;
        s->u_start[i] = (double)*u;
        s->u_sum[i] = 0;
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
    for (size_t t = 0; t < dual->texels; t++) {
        float area = dual->cover->area[t];
        s->u_mean.plain[t] = fminf((float)(s->u_sum[t] / over), area);
        s->u_mean.lifted[t] = fminf((float)(s->u_sum[dual->texels + t] / over), area - s->u_mean.plain[t]);
    }
    double mean_bound = bound_of(s, &s->u_mean, s->price_sum, over), last_bound = bound_of(s, &s->u_last, s->price, 1);
    double mean_reached = reached_by(s, s->x_sum, over), last_reached = reached_by(s, dual->x, 1);
    note_best(s, mean_bound, &s->u_mean, mean_reached, s->x_sum, over);
    note_best(s, last_bound, &s->u_last, last_reached, dual->x, 1);
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
    free(s->cover);
    free(s->lifted);
    sp_prices_free(&s->u_last);
    sp_prices_free(&s->u_mean);
    free(s->table);
    sp_offers_free(&s->offers);
}

/* All doubles in one block. */
static bool solver_create(solver *s, sp_error *error)
{
    const sp_cover *cover = s->dual->cover;
    size_t rows = s->rows->count, texels = cover->texel_count;
    s->resources = 2 + cover->port_count;
    if (s->task->water + 1 > SIZE_MAX / sizeof(double) / (s->task->nozzles + 1))
        return sp_fail_memory(error);
    s->tau = calloc(6 * rows + 6 * texels + 4 * s->resources + 1, sizeof *s->tau);
    s->cover = calloc(2 * texels + 1, sizeof *s->cover);
    s->table = malloc((s->task->nozzles + 1) * (s->task->water + 1) * sizeof *s->table);
    bool offers = sp_offers_create(cover->tier_count, cover->weight, cover->port_count, s->task->nozzles,
                                   cover->repeats, &s->offers, error) &&
                  sp_prices_create(cover, &s->u_last, error) && sp_prices_create(cover, &s->u_mean, error);
    if (!s->tau || !s->cover || !s->table || !offers || !grow(s->dual, rows)) {
        solver_free(s);
        return offers ? sp_fail_memory(error) : false;
    }
    s->price = s->tau + rows;
    s->price_sum = s->price + rows;
    s->x_sum = s->price_sum + rows;
    s->x_bar = s->x_sum + rows;
    s->x_start = s->x_bar + rows;
    s->sigma = s->x_start + rows;
    s->u_sum = s->sigma + 2 * texels;
    s->u_start = s->u_sum + 2 * texels;
    s->sigma_resource = s->u_start + 2 * texels;
    s->load = s->sigma_resource + s->resources;
    s->use = s->load + s->resources;
    s->resource_sum = s->use + s->resources;
    return true;
}

/* The rows' shares as the texels' lifts make them. What they are worth changes with the lifts. */
static bool lift_rows(solver *s, sp_error *error)
{
    sp_prices *const all[] = {&s->dual->u, &s->u_last, &s->u_mean};
    const sp_rows *rows = s->rows;
    for (size_t i = 0; i < 3; i++) {
        all[i]->lifts = s->task->lifts;
        memcpy(all[i]->kind, s->dual->u.kind, s->dual->texels);
    }
    if (!s->task->lifts) {
        memset(s->dual->u.lifted, 0, s->dual->texels * sizeof *s->dual->u.lifted);
        return true;
    }
    s->lifted = malloc((rows->used + 1) * sizeof *s->lifted);
    if (!s->lifted)
        return sp_fail_memory(error);
    for (size_t i = 0; i < rows->used; i++)
        s->lifted[i] = sp_lift(s->task->lifts, s->dual->u.kind[rows->texel[i]], rows->share[i]);
    return true;
}

bool sp_dual_solve(sp_dual *dual, const sp_rows *rows, const sp_dual_task *task, sp_error *error)
{
    solver s = {.dual = dual, .rows = rows, .task = task, .gap_start = INFINITY};
    if (!solver_create(&s, error))
        return false;
    if (!lift_rows(&s, error)) {
        solver_free(&s);
        return false;
    }
    set_steps(&s);
    if (!(dual->weight > 0)) {
        double area = 0;
        for (size_t t = 0; t < dual->texels; t++)
            area += (double)dual->cover->area[t];
        dual->weight = fmax(WEIGHT_FIRST * area / (double)(dual->texels ? dual->texels : 1), 1e-30);
    }
    if (rows->count)
        memcpy(s.x_start, dual->x, rows->count * sizeof *dual->x);
    for (size_t t = 0; t < dual->texels; t++) {
        s.u_start[t] = (double)dual->u.plain[t];
        s.u_start[dual->texels + t] = (double)dual->u.lifted[t];
    }
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

bool sp_dual_lift(sp_dual *dual, const sp_rows *rows, const sp_lifts *lifts, sp_error *error)
{
    size_t kinds = lifts->kinds;
    float *sums = calloc(dual->texels * kinds + 1, sizeof *sums);
    if (!sums)
        return sp_fail_memory(error);
    for (size_t c = 0; c < rows->count && c < dual->row_capacity; c++) {
        float amount = (float)dual->choice[c];
        for (size_t i = rows->start[c]; amount > CHOICE_LEAST && i < rows->start[c + 1]; i++)
            for (size_t k = 0; k < kinds; k++)
                sums[rows->texel[i] * kinds + k] += amount * sp_lift(lifts, k, rows->share[i]);
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
