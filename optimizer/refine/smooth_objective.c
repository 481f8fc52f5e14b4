#include "refine/smooth_objective.h"

#include "ceres/least_squares.h"
#include "refine/smooth_sum.h"
#include "scoring/footprints.h"
#include "team.h"

#include <stdlib.h>
#include <string.h>

#define ITERATIONS 8
#define TOLERANCE 1e-6
#define ARRIVALS_A_PART 1024 /* some 200 µs of work */
#define WATER_PENALTY 10.0   /* beside the root of the share that is dry, per share of water above the budget */
#define EDGE_LEAST 0.2       /* cosine of the unknown's angle at the start: at 0 it would be stuck at its limit */

/* The values at x, whose entries are angles: value = middle + half range * sin(x). That keeps the limits without
 * telling Ceres, which searches long where bounds are many. */
static void values_at(const sp_smooth_nozzle *own, const double *x, double values[SP_UNKNOWNS])
{
    const sp_pose_parameters *parameters = own->parameters;
    for (size_t k = 0; k < parameters->count; k++) {
        double half = 0.5 * (parameters->high[k] - parameters->low[k]);
        values[k] = parameters->low[k] + half + half * sin(x[own->first + k]);
    }
}

/* What all threads that set arrivals share. */
typedef struct {
    sp_smooth_objective *smooth;
    const double *x;
    bool slopes;
    size_t parts_each; /* of every nozzle's arrivals */
} setting;

/* Half of the range of unknown k, and how fast its value changes with x. */
static double chain_of(const sp_smooth_nozzle *own, const double *x, size_t k)
{
    const sp_pose_parameters *parameters = own->parameters;
    return 0.5 * (parameters->high[k] - parameters->low[k]) * cos(x[own->first + k]);
}

/* A part of a nozzle's arrivals. */
static void set_part(void *user, size_t part)
{
    const setting *setting = user;
    sp_smooth_objective *smooth = setting->smooth;
    size_t i = part / setting->parts_each, piece = part % setting->parts_each;
    sp_smooth_nozzle *own = &smooth->nozzles[i];
    size_t count = own->sight->count, first = count * piece / setting->parts_each,
           end = count * (piece + 1) / setting->parts_each;
    double values[SP_UNKNOWNS];
    values_at(own, setting->x, values);
    sp_brought brought = {0};
    if (smooth->film.count)
        brought = (sp_brought){smooth->film.runs[i].brought.amount,
                               setting->slopes ? smooth->film.runs[i].brought.slope : NULL};
    sp_smooth_arrivals arrivals = own->arrivals;
    if (!setting->slopes)
        arrivals.alone_slope = arrivals.flux_slope = NULL;
    sp_smooth_arrivals_set(smooth->search, own->parameters, own->sight, smooth->width, values, first, end, &arrivals,
                           smooth->film.count ? &brought : NULL);
    for (size_t k = 0; setting->slopes && k < own->parameters->count; k++) {
        double chain = chain_of(own, setting->x, k);
        for (size_t a = k * count + first; a < k * count + end; a++) {
            arrivals.alone_slope[a] *= chain;
            arrivals.flux_slope[a] *= chain;
        }
    }
}

/* A nozzle's film, once all its arrivals are set. */
static void set_film(void *user, size_t i)
{
    const setting *setting = user;
    const sp_smooth_nozzle *own = &setting->smooth->nozzles[i];
    double chain[SP_UNKNOWNS];
    for (size_t k = 0; setting->slopes && k < own->parameters->count; k++)
        chain[k] = chain_of(own, setting->x, k);
    sp_smooth_film_set(&setting->smooth->film, i, setting->slopes ? chain : NULL);
}

/* The smooth arrivals at x and, where asked for, their derivatives by x. */
static void set_arrivals(sp_smooth_objective *smooth, const double *x, bool slopes)
{
    int threads = sp_threads(&smooth->search->options->run);
    size_t most = 0;
    for (size_t i = 0; i < smooth->nozzle_count; i++)
        most = smooth->nozzles[i].sight->count > most ? smooth->nozzles[i].sight->count : most;
    setting setting = {smooth, x, slopes, most / ARRIVALS_A_PART + 1};
    sp_team_do(smooth->nozzle_count * setting.parts_each, threads, set_part, &setting);
    if (smooth->film.count)
        sp_team_do(smooth->nozzle_count, threads, set_film, &setting);
}

/* Water above the budget as one more residual. */
static void add_water(sp_smooth_objective *smooth, const double *x, bool slopes)
{
    size_t n = smooth->unknowns;
    double flow = smooth->search->kept_flow;
    double *row = smooth->chunk_gradient + n; /* chunk 1's, summed up already */
    for (size_t i = 0; i < smooth->nozzle_count; i++) {
        const sp_smooth_nozzle *own = &smooth->nozzles[i];
        double values[SP_UNKNOWNS];
        values_at(own, x, values);
        sp_nozzle nozzle = sp_pose_parameters_nozzle(own->parameters, values);
        flow += sp_nozzle_flow(&nozzle, &sp_evaluator_setup(smooth->search->coarse)->liquid);
        for (size_t k = 0; k < own->parameters->count; k++) {
            double half = 0.5 * (own->parameters->high[k] - own->parameters->low[k]);
            row[own->first + k] = own->parameters->kind[k] == SP_UNKNOWN_FLOW
                                      ? WATER_PENALTY * half * cos(x[own->first + k]) / smooth->budget
                                      : 0;
        }
    }
    double over = WATER_PENALTY * (flow / smooth->budget - 1);
    if (over <= 0)
        return;
    smooth->chunk_cost[0] += over * over;
    for (size_t i = 0; slopes && i < n; i++) {
        smooth->chunk_gradient[i] += over * row[i];
        for (size_t j = 0; j <= i; j++)
            smooth->chunk_normal[i * n + j] += row[i] * row[j];
    }
}

/* The lower triangle of `a` [n x n] becomes L with L Lᵀ = a (Cholesky). */
static bool factorise(double *a, size_t n)
{
    for (size_t j = 0; j < n; j++) {
        for (size_t k = 0; k < j; k++)
            for (size_t i = j; i < n; i++)
                a[i * n + j] -= a[i * n + k] * a[j * n + k];
        if (!(a[j * n + j] > 0) || !isfinite(a[j * n + j]))
            return false;
        double scale = 1 / sqrt(a[j * n + j]);
        for (size_t i = j; i < n; i++)
            a[i * n + j] *= scale;
    }
    return true;
}

/* As many residuals as patches would be slow and fat. With JᵀJ = L Lᵀ the n residuals L⁻¹Jᵀr with Jacobian Lᵀ have the
 * same gradient and normal matrix, and one more without slope makes up the cost. */
static bool condense(sp_smooth_objective *smooth, double *residuals, double *jacobian)
{
    size_t n = smooth->unknowns;
    double *normal = smooth->chunk_normal, largest = 0, explained = 0;
    for (size_t i = 0; i < n; i++)
        largest = fmax(largest, normal[i * n + i]);
    /* an unknown that nothing depends on must not make the matrix singular */
    for (size_t i = 0; i < n; i++)
        normal[i * n + i] += 1e-10 * normal[i * n + i] + 1e-12 * largest + 1e-30;
    if (!factorise(normal, n))
        return false;
    for (size_t i = 0; i < n; i++) {
        residuals[i] = smooth->chunk_gradient[i];
        for (size_t k = 0; k < i; k++)
            residuals[i] -= normal[i * n + k] * residuals[k];
        residuals[i] /= normal[i * n + i];
        explained += residuals[i] * residuals[i];
        for (size_t k = 0; k < n; k++)
            jacobian[i * n + k] = k >= i ? normal[k * n + i] : 0;
    }
    residuals[n] = sqrt(fmax(0, smooth->chunk_cost[0] - explained));
    memset(&jacobian[n * n], 0, n * sizeof *jacobian);
    return true;
}

static bool evaluate(void *user, const double *x, double *residuals, double *jacobian)
{
    sp_smooth_objective *smooth = user;
    size_t n = smooth->unknowns;
    set_arrivals(smooth, x, jacobian != NULL);
    if (!sp_smooth_sum(smooth, jacobian != NULL))
        return sp_fail_memory(smooth->error);
    add_water(smooth, x, jacobian != NULL);
    if (!isfinite(smooth->chunk_cost[0]))
        return false;
    if (jacobian)
        return condense(smooth, residuals, jacobian);
    memset(residuals, 0, n * sizeof *residuals);
    residuals[n] = sqrt(smooth->chunk_cost[0]);
    return true;
}

static bool link_patches(sp_smooth_objective *smooth, sp_error *error)
{
    size_t patches = smooth->search->patch_count, total = 0;
    for (size_t i = 0; i < smooth->nozzle_count; i++)
        total += smooth->nozzles[i].sight->count;
    smooth->start = calloc(patches + 2, sizeof *smooth->start);
    smooth->links = malloc((total ? total : 1) * sizeof *smooth->links);
    if (!smooth->start || !smooth->links)
        return sp_fail_memory(error);
    /* counted two places on, so that filling moves each start to its own place */
    for (size_t i = 0; i < smooth->nozzle_count; i++)
        for (size_t a = 0; a < smooth->nozzles[i].sight->count; a++)
            smooth->start[smooth->nozzles[i].sight->seen[a].patch + 2]++;
    for (size_t p = 0; p < patches; p++)
        smooth->start[p + 2] += smooth->start[p + 1];
    for (size_t i = 0; i < smooth->nozzle_count; i++)
        for (size_t a = 0; a < smooth->nozzles[i].sight->count; a++)
            smooth->links[smooth->start[smooth->nozzles[i].sight->seen[a].patch + 1]++] =
                (sp_smooth_link){(uint32_t)i, (uint32_t)a};
    return true;
}

static bool smooth_create(sp_smooth_objective *smooth, const sp_pose_parameters *parameters,
                          const sp_sight *const *sights, sp_error *error)
{
    smooth->nozzles = calloc(smooth->nozzle_count, sizeof *smooth->nozzles);
    if (!smooth->nozzles)
        return sp_fail_memory(error);
    size_t first = 0;
    for (size_t i = 0; i < smooth->nozzle_count; i++) {
        size_t most = sights[i]->count ? sights[i]->count : 1;
        smooth->nozzles[i] = (sp_smooth_nozzle){.parameters = &parameters[i], .sight = sights[i], .first = first};
        first += parameters[i].count;
        sp_smooth_arrivals *arrivals = &smooth->nozzles[i].arrivals;
        double *numbers = malloc(2 * most * (1 + SP_UNKNOWNS) * sizeof *numbers);
        if (!numbers)
            return sp_fail_memory(error);
        *arrivals = (sp_smooth_arrivals){numbers, numbers + most, numbers + most * (1 + SP_UNKNOWNS),
                                         numbers + most * (2 + SP_UNKNOWNS)};
    }
    size_t n = smooth->unknowns;
    smooth->chunk_cost = calloc(SP_SMOOTH_CHUNKS, sizeof *smooth->chunk_cost);
    smooth->chunk_gradient = calloc(SP_SMOOTH_CHUNKS * n, sizeof *smooth->chunk_gradient);
    smooth->chunk_normal = calloc(SP_SMOOTH_CHUNKS * n, n * sizeof *smooth->chunk_normal);
    if (!smooth->chunk_cost || !smooth->chunk_gradient || !smooth->chunk_normal)
        return sp_fail_memory(error);
    return link_patches(smooth, error);
}

static void smooth_free(sp_smooth_objective *smooth)
{
    for (size_t i = 0; smooth->nozzles && i < smooth->nozzle_count; i++)
        free(smooth->nozzles[i].arrivals.alone);
    free(smooth->nozzles);
    sp_smooth_film_free(&smooth->film);
    free(smooth->start);
    free(smooth->links);
    free(smooth->chunk_cost);
    free(smooth->chunk_gradient);
    free(smooth->chunk_normal);
}

static bool solve(sp_smooth_objective *smooth, double (*values)[SP_UNKNOWNS], sp_error *error)
{
    double *x = malloc(smooth->unknowns * sizeof *x);
    if (!x)
        return sp_fail_memory(error);
    const double most = acos(EDGE_LEAST);
    for (size_t i = 0; i < smooth->nozzle_count; i++) {
        const sp_pose_parameters *parameters = smooth->nozzles[i].parameters;
        for (size_t k = 0; k < parameters->count; k++) {
            double half = 0.5 * (parameters->high[k] - parameters->low[k]);
            double angle = asin(fmin(1, fmax(-1, (parameters->value[k] - parameters->low[k] - half) / half)));
            x[smooth->nozzles[i].first + k] = fmin(most, fmax(-most, angle));
        }
    }
    sp_least_squares problem = {.unknowns = smooth->unknowns,
                                .residuals = smooth->unknowns + 1,
                                .function = evaluate,
                                .user = smooth,
                                .iterations = ITERATIONS,
                                .tolerance = TOLERANCE};
    smooth->error = error;
    bool done = sp_least_squares_solve(&problem, x, NULL, error);
    for (size_t i = 0; done && i < smooth->nozzle_count; i++)
        values_at(&smooth->nozzles[i], x, values[i]);
    free(x);
    return done;
}

/* The nozzles that keep their fields, as though every layout contained them, but for their water. */
static bool hold(const sp_search *search, const sp_partial *partial, sp_search *held, sp_error *error)
{
    size_t bytes = (search->patch_count + 1) * sizeof(float), count = search->patch_count;
    *held = *search;
    held->kept_hit = malloc(bytes);
    held->kept_dry = malloc(bytes);
    held->kept_film = search->kept_film ? malloc(bytes) : NULL;
    if (!held->kept_hit || !held->kept_dry || (search->kept_film && !held->kept_film))
        return sp_fail_memory(error);
    memcpy(held->kept_hit, search->kept_hit, count * sizeof(float));
    memcpy(held->kept_dry, search->kept_dry, count * sizeof(float));
    if (held->kept_film)
        memcpy(held->kept_film, search->kept_film, count * sizeof(float));
    for (size_t i = 0; i < partial->count; i++)
        if (!sp_type_is_uniform(partial->items[i].nozzle.type))
            sp_footprint_pour(search, sp_footprints_look(search->footprints, partial->items[i].pose),
                              partial->items[i].again, held->kept_hit, held->kept_film, held->kept_dry);
    return true;
}

static void let_go(sp_search *held)
{
    free(held->kept_hit);
    free(held->kept_dry);
    free(held->kept_film);
}

bool sp_smooth_objective_minimise(const sp_search *search, const sp_partial *partial,
                                  const sp_pose_parameters *parameters, const sp_sight *const *sights, sp_width width,
                                  double budget, double (*values)[SP_UNKNOWNS], sp_error *error)
{
    sp_search held;
    sp_smooth_objective smooth = {.search = &held, .width = width, .budget = budget, .nozzle_count = partial->count};
    for (size_t i = 0; i < partial->count; i++)
        smooth.unknowns += parameters[i].count;
    if (!smooth.unknowns)
        return true;
    bool done = hold(search, partial, &held, error) && smooth_create(&smooth, parameters, sights, error) &&
                (!search->runoffs || sp_smooth_film_create(&held, parameters, sights, partial->count, width.coverage,
                                                           &smooth.film, error)) &&
                solve(&smooth, values, error);
    smooth_free(&smooth);
    let_go(&held);
    return done;
}
