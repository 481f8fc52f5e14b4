/* Deposits and the figures drawn from them. */
#include "falling_film.h"
#include "nozzle_bodies.h"

#include <assert.h>
#include <stdlib.h>

sp_coverage *sp_coverage_create(const sp_evaluator *evaluator, sp_error *error)
{
    size_t count = evaluator->patches.count, room = count ? count : 1;
    sp_coverage *coverage = calloc(1, sizeof *coverage);
    if (!coverage)
        return sp_fail_memory(error);
    sp_deposits *deposits = &coverage->deposits;
    double **columns[] = {&deposits->flux,       &deposits->counted,   &deposits->jets,          &deposits->speed,
                          &deposits->speed_max,  &deposits->incidence, &deposits->incidence_min, &deposits->impact,
                          &deposits->impact_max, &deposits->even,      &deposits->dry,           &deposits->film,
                          &deposits->share};
    bool done = true;
    for (size_t i = 0; i < sizeof columns / sizeof *columns; i++) {
        *columns[i] = calloc(room, sizeof(double));
        done = done && *columns[i];
    }
    deposits->covered = calloc(room, sizeof *deposits->covered);
    deposits->by_film = calloc(room, sizeof *deposits->by_film);
    deposits->count = count;
    for (size_t i = 0; deposits->dry && i < count; i++)
        deposits->dry[i] = 1;
    if (!done || !deposits->covered || !deposits->by_film) {
        sp_coverage_destroy(coverage);
        return sp_fail_memory(error);
    }
    return coverage;
}

void sp_coverage_destroy(sp_coverage *coverage)
{
    if (!coverage)
        return;
    sp_deposits *deposits = &coverage->deposits;
    free(deposits->flux);
    free(deposits->counted);
    free(deposits->jets);
    free(deposits->speed);
    free(deposits->speed_max);
    free(deposits->incidence);
    free(deposits->incidence_min);
    free(deposits->impact);
    free(deposits->impact_max);
    free(deposits->even);
    free(deposits->dry);
    free(deposits->film);
    free(deposits->share);
    free(deposits->covered);
    free(deposits->by_film);
    free(coverage);
}

void sp_deposit(sp_deposits *deposits, uint32_t patch, double flux, double jets, double speed, double incidence,
                double density)
{
    double normal_speed = speed * cos(incidence), impact = density * normal_speed * normal_speed;
    bool first = !(deposits->jets[patch] > 0);
    deposits->flux[patch] += flux;
    deposits->jets[patch] += jets;
    deposits->speed[patch] += flux * speed;
    deposits->incidence[patch] += flux * incidence;
    deposits->impact[patch] += flux * impact;
    deposits->speed_max[patch] = fmax(deposits->speed_max[patch], speed);
    deposits->impact_max[patch] = fmax(deposits->impact_max[patch], impact);
    if (first || incidence < deposits->incidence_min[patch])
        deposits->incidence_min[patch] = incidence;
}

/* A patch's flux and area, to be sorted. */
typedef struct {
    double flux, area;
} flux_share;

static int by_flux(const void *left, const void *right)
{
    const flux_share *a = left, *b = right;
    if (a->flux != b->flux)
        return a->flux < b->flux ? -1 : 1;
    return (a->area > b->area) - (a->area < b->area);
}

/* The patches of no more flux than so much, into `shares`; returns how many. */
static size_t list_up_to(const sp_patches *patches, const double *flux, double most, flux_share *shares)
{
    size_t count = 0;
    for (size_t i = 0; i < patches->count; i++)
        if (flux[i] <= most)
            shares[count++] = (flux_share){flux[i], patches->area[i]};
    return count;
}

static double area_up_to(const sp_patches *patches, const double *flux, double most)
{
    double area = 0;
    for (size_t i = 0; i < patches->count; i++)
        area += flux[i] <= most ? patches->area[i] : 0;
    return area;
}

/* No flux, or one halved from the highest, up to which there are `share` of the area and more, by more than a sum in
 * another order is off: only these need be sorted. */
static double bound_percentile(const sp_patches *patches, const double *flux, double highest, double share)
{
    double enough = (share + 1e-6) * patches->total_area, bound = highest;
    if (area_up_to(patches, flux, 0) > enough)
        return 0;
    while (0.5 * bound < bound && area_up_to(patches, flux, 0.5 * bound) > enough)
        bound *= 0.5;
    return bound;
}

/* Minimum, mean, maximum and 5th percentile of the flux, by area. */
static bool draw_flux_figures(const sp_patches *patches, sp_coverage *coverage, sp_error *error)
{
    const double *flux = coverage->deposits.flux, share = 0.05;
    if (patches->count == 0)
        return true;
    flux_share *shares = malloc(patches->count * sizeof *shares);
    if (!shares)
        return sp_fail_memory(error);
    double liquid = 0, below = 0;
    for (size_t i = 0; i < patches->count; i++) {
        liquid += flux[i] * patches->area[i];
        coverage->flux_max = fmax(coverage->flux_max, flux[i]);
    }
    double most = bound_percentile(patches, flux, coverage->flux_max, share);
    size_t rank = 0, count = list_up_to(patches, flux, most, shares);
    qsort(shares, count, sizeof *shares, by_flux);
    while (rank + 1 < count && below + shares[rank].area < share * patches->total_area)
        below += shares[rank++].area;
    assert(count > 0 && shares[0].flux >= 0);
    coverage->flux_min = shares[0].flux;
    coverage->flux_p05 = shares[rank].flux;
    coverage->flux_mean = liquid / patches->total_area;
    free(shares);
    return true;
}

void sp_coverage_judge(const sp_evaluator *evaluator, sp_coverage *coverage)
{
    const sp_patches *patches = &evaluator->patches;
    sp_deposits *deposits = &coverage->deposits;
    double threshold = evaluator->setup.criterion.flux;
    for (uint32_t i = 0; i < patches->count; i++) {
        double area = sp_evaluator_counted(evaluator, i);
        coverage->area += area;
        if (deposits->flux[i] > 0) {
            deposits->speed[i] /= deposits->flux[i];
            deposits->incidence[i] /= deposits->flux[i];
            deposits->impact[i] /= deposits->flux[i];
        }
        deposits->share[i] = sp_wetting_share(&(sp_wetting){deposits->even[i], deposits->dry[i], 0}, threshold);
        if (evaluator->falling_film && deposits->film[i] >= evaluator->setup.criterion.film) {
            coverage->film.area += (1 - deposits->share[i]) * area;
            deposits->by_film[i] = deposits->share[i] < 0.5;
            deposits->share[i] = 1;
        }
        assert(deposits->share[i] >= 0 && deposits->share[i] <= 1);
        deposits->covered[i] = deposits->share[i] >= 0.5;
        coverage->covered_area += deposits->share[i] * area;
    }
    coverage->fraction = coverage->area > 0 ? coverage->covered_area / coverage->area : 0;
}

/* Of millions of jets alike a sum's round-off takes their mean beyond each of them. */
static void hold_means(sp_deposits *deposits)
{
    for (size_t i = 0; i < deposits->count; i++) {
        deposits->speed[i] = fmin(deposits->speed[i], deposits->speed_max[i]);
        deposits->incidence[i] = fmax(deposits->incidence[i], deposits->incidence_min[i]);
        deposits->impact[i] = fmin(deposits->impact[i], deposits->impact_max[i]);
    }
}

bool sp_coverage_conclude(const sp_evaluator *evaluator, const sp_bodies *bodies, sp_coverage *coverage,
                          sp_error *error)
{
    if (evaluator->falling_film && !sp_falling_film_find(evaluator->falling_film, bodies->patterns, coverage, error))
        return false;
    sp_coverage_judge(evaluator, coverage);
    hold_means(&coverage->deposits);
    coverage->flow = sp_layout_flow(bodies->layout, &evaluator->setup.liquid);
    coverage->area_per_water = coverage->flow > 0 ? coverage->covered_area / coverage->flow : 0;
    return draw_flux_figures(&evaluator->patches, coverage, error);
}
