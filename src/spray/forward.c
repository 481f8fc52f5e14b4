/* The forward evaluator: jets are traced from the nozzles through their reflections, and leave their liquid on the
 * patches that they hit (study 3.2.3 and 3.3.1). */
#include "nozzle_bodies.h"
#include "reflection.h"
#include "criterion.h"
#include "emitter.h"
#include "launch.h"
#include "lit_share.h"
#include "movers.h"
#include "nozzle/valid.h"
#include "splat.h"
#include "combination.h"

#include <stdlib.h>

#define BATCH 65536 /* jets in flight at once */

/* What one jet does where it hits. */
typedef struct {
    sp_shares shares; /* of the flow; none: a dry side, an obstacle or a miss */
    double flow;      /* m³/s */
    double speed, incidence;
    unsigned cell; /* of the patch, where all of the flow is one patch's */
    bool passes;   /* the criterion's speed and incidence */
    bool goes_on;  /* is reflected */
} jet_impact;

typedef struct {
    const sp_evaluator *evaluator;
    sp_deposits *deposits;
    sp_combination combination;
    double *counted;     /* [patches], m³/s per m² of the pattern in hand */
    sp_lit lit;          /* by the pattern in hand */
    sp_balance *balance; /* of all */
    sp_work *work;
    double lowest;        /* g · x, m²/s², of the geometry's lowest point */
    sp_vec3 gravity;      /* of the pattern in hand; zero for lines */
    double able;          /* m³/s that flies on in the end and may yet be fast enough to count */
    sp_ray *rays;         /* [BATCH] */
    sp_vec3 *offset;      /* [BATCH], m, of goods that move, as they are while the jet flies */
    double *flow;         /* [BATCH], m³/s */
    sp_hit *hits;         /* [BATCH] */
    sp_drag drag;         /* of the pattern in hand */
    bool drops;           /* it flies with drag */
    sp_landing *landings; /* [BATCH]; NULL where none does */
    jet_impact *impacts;  /* [BATCH] */
    int threads;
    int reflections;
    double per_jet; /* m³/s that a jet carries; 0: each pattern has jets of its own number */
} jet_flight;

/* Where jet i has come to, which hit something. */
static sp_landing landing_of(const jet_flight *flight, size_t i)
{
    return flight->drops ? flight->landings[i] : sp_landing_of(&flight->rays[i], &flight->hits[i], flight->gravity);
}

/* Turns a hit into an impact, and the ray and its flow into what flies on. */
static void strike(jet_flight *flight, size_t i)
{
    const sp_evaluator *evaluator = flight->evaluator;
    const sp_mesh *mesh = evaluator->setup.mesh;
    const sp_criterion *criterion = &evaluator->setup.criterion;
    sp_hit *hit = &flight->hits[i];
    jet_impact *impact = &flight->impacts[i];
    impact->shares.count = 0;
    impact->goes_on = false;
    if (hit->triangle == SP_NONE)
        return;

    sp_landing landing = landing_of(flight, i);
    sp_vec3 velocity = landing.velocity;
    sp_vec3 normal = sp_triangle_normal(mesh, hit->triangle);
    double along_normal = sp_dot(velocity, normal);
    impact->flow = flight->flow[i];
    impact->speed = sp_length(velocity);
    impact->incidence = sp_incidence(velocity, normal, fabs(along_normal));
    impact->passes = sp_impact_passes(criterion, impact->speed, impact->incidence);
    uint32_t patch = sp_patch_at(evaluator, hit->triangle, hit->u, hit->v, along_normal > 0);
    if (patch != SP_NONE && evaluator->fidelity.splat == SP_SPLAT_LINEAR)
        sp_share_linearly(evaluator, hit, along_normal > 0, patch, &impact->shares);
    else if (patch != SP_NONE)
        impact->shares = (sp_shares){.patch = {patch}, .share = {1}, .count = 1};
    impact->cell = sp_lit_cell(evaluator, hit->triangle, hit->u, hit->v);

    impact->goes_on = sp_bounce(evaluator, &landing, flight->gravity, &flight->rays[i], &flight->flow[i]);
}

/* Adds the impacts up. Each thread sees all of them but owns a range of the patches, so that every patch adds up in the
 * order of the jets however many threads there are. */
static void settle(jet_flight *flight, size_t count)
{
    const sp_patches *patches = &flight->evaluator->patches;
    double density = flight->evaluator->setup.liquid.density;
#pragma omp parallel num_threads(flight->threads)
    {
        size_t own = (size_t)omp_get_thread_num(), all = (size_t)omp_get_num_threads();
        size_t first = patches->count * own / all, end = patches->count * (own + 1) / all;
        for (size_t i = 0; i < count; i++) {
            const jet_impact *impact = &flight->impacts[i];
            for (int k = 0; k < impact->shares.count; k++) {
                uint32_t patch = impact->shares.patch[k];
                double share = impact->shares.share[k];
                if (patch < first || patch >= end)
                    continue;
                double flux = impact->flow * share / patches->area[patch];
                sp_deposit(flight->deposits, patch, flux, share, impact->speed, impact->incidence, density);
                if (!impact->passes)
                    continue;
                flight->counted[patch] += flux;
                sp_lit_add(&flight->lit, patch, impact->cell);
            }
        }
    }
}

/* Moves the jets that fly on to the front, in their order; returns how many there are. */
static size_t gather(jet_flight *flight, size_t count)
{
    size_t kept = 0;
    for (size_t i = 0; i < count; i++) {
        if (!flight->impacts[i].goes_on)
            continue;
        flight->rays[kept] = flight->rays[i];
        flight->offset[kept] = flight->offset[i];
        flight->flow[kept++] = flight->flow[i];
    }
    return kept;
}

/* In the order of the jets, whatever the number of threads. */
static void keep_balance(jet_flight *flight, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const jet_impact *impact = &flight->impacts[i];
        bool hit = flight->hits[i].triangle != SP_NONE;
        sp_balance_add(flight->balance, hit, impact->shares.count > 0, hit ? impact->flow : flight->flow[i],
                       impact->goes_on ? flight->flow[i] : 0);
    }
}

/* Whether liquid that falls all the way down from where it is meets the criterion's speed: it meets no more. */
static bool may_be_fast(const jet_flight *flight, const sp_ray *ray)
{
    double least = flight->evaluator->setup.criterion.impact_speed;
    double fall = sp_length(flight->gravity) > 0 ? flight->lowest - sp_dot(ray->origin, flight->gravity) : 0;
    return sp_dot(ray->velocity, ray->velocity) + 2 * fmax(fall, 0) >= least * least;
}

/* To what each of `count` jets meets next. What has met a wall is drops, whatever it was before. */
static void fly_on(const jet_flight *flight, size_t count, bool drops)
{
    const sp_evaluator *evaluator = flight->evaluator;
    sp_drag drag = flight->drag;
    drag.delay = drops ? 0 : drag.delay;
    if (!flight->drops) {
        sp_jets_hit(evaluator, flight->rays, flight->gravity, flight->offset, count, flight->threads, flight->hits);
        return;
    }
    sp_drops_land(evaluator, &drag, flight->rays, flight->gravity, flight->offset, count, flight->threads,
                  flight->landings);
    for (size_t i = 0; i < count; i++)
        flight->hits[i] = flight->landings[i].hit;
}

/* Flies `count` jets to their end. */
static void fly(jet_flight *flight, size_t count)
{
    for (int bounce = 0; bounce <= flight->reflections && count > 0; bounce++) {
        fly_on(flight, count, bounce > 0);
        flight->work->rays += count;
#pragma omp parallel for num_threads(flight->threads)
        for (size_t i = 0; i < count; i++)
            strike(flight, i);
        settle(flight, count);
        keep_balance(flight, count);
        count = gather(flight, count);
    }
    for (size_t i = 0; i < count; i++) {
        flight->balance->unfollowed += flight->flow[i];
        flight->able += may_be_fast(flight, &flight->rays[i]) ? flight->flow[i] : 0;
    }
}

static uint64_t pattern_jets(const jet_flight *flight, const sp_nozzle *pattern)
{
    if (flight->per_jet > 0)
        return (uint64_t)ceil(sp_nozzle_flow(pattern, &flight->evaluator->setup.liquid) / flight->per_jet);
    return pattern->jets;
}

/* Starts jets [first, first + count) of a pattern. */
static void spray_jets(jet_flight *flight, const sp_nozzle *pattern, uint64_t first, size_t count)
{
    uint64_t jets = pattern_jets(flight, pattern);
    double flow = sp_nozzle_flow(pattern, &flight->evaluator->setup.liquid);
    sp_emitter emitter = sp_emitter_of(flight->evaluator, pattern, NULL);
    flight->gravity = emitter.source.gravity;
    flight->drag = sp_drag_of(pattern, &flight->evaluator->setup.liquid, &flight->evaluator->setup.air);
    flight->drops = sp_flies_as_drops(flight->evaluator, pattern);
#pragma omp parallel for num_threads(flight->threads)
    for (size_t i = 0; i < count; i++) {
        flight->rays[i] = sp_emitter_jet(&emitter, first + i, jets);
        flight->offset[i] = sp_jet_offset(flight->evaluator, first + i);
        flight->flow[i] = flow / (double)jets;
    }
}

/* `done` and `all` count the layout's jets, for the progress. */
static bool fly_pattern(jet_flight *flight, const sp_nozzle *pattern, double *done, double all, sp_error *error)
{
    const sp_setup *setup = &flight->evaluator->setup;
    uint64_t jets = pattern_jets(flight, pattern);
    if (!(sp_nozzle_speed(pattern, &setup->liquid) > 0) || !(sp_nozzle_flow(pattern, &setup->liquid) > 0))
        return true;
    for (uint64_t first = 0; first < jets; first += BATCH) {
        size_t count = jets - first < BATCH ? (size_t)(jets - first) : BATCH;
        spray_jets(flight, pattern, first, count);
        fly(flight, count);
        *done += (double)count;
        if (!sp_evaluator_stage(flight->evaluator, "jets", *done / all, error))
            return false;
    }
    return true;
}

/* Counts what the pattern in hand has brought. What a linear splat spreads it spreads over whole patches. */
static void count_pattern(jet_flight *flight)
{
    const sp_evaluator *evaluator = flight->evaluator;
    /* what passes by lights up all of a patch in the end */
    bool spread = evaluator->fidelity.splat == SP_SPLAT_LINEAR || evaluator->movers;
#pragma omp parallel for num_threads(flight->threads)
    for (size_t i = 0; i < flight->deposits->count; i++) {
        double flux = flight->counted[i],
               share = flux > 0 && !spread ? sp_lit_share(evaluator, &flight->lit, (uint32_t)i) : 1;
        sp_wetting wetting = {0, 1, 0};
        sp_wetting_add(&wetting, flux / share, evaluator->setup.criterion.flux, 1, share, share >= 0.5);
        sp_combination_add(&flight->combination, (uint32_t)i, flux, &wetting,
                           share < 1 ? sp_lit_samples(&flight->lit, (uint32_t)i) : sp_edge_samples_dark());
        flight->counted[i] = 0;
    }
    sp_lit_clear(evaluator, &flight->lit);
}

static bool fly_bodies(jet_flight *flight, const sp_bodies *bodies, sp_error *error)
{
    const sp_layout *patterns = bodies->patterns;
    double done = 0, all = 0;
    for (size_t n = 0; n < patterns->count; n++)
        all += (double)pattern_jets(flight, &patterns->nozzles[n]);
    for (size_t b = 0; b < bodies->layout->count; b++) {
        sp_combination_begin_nozzle(&flight->combination, bodies->layout, b);
        const sp_nozzle *own = &patterns->nozzles[bodies->first[b]];
        size_t count = bodies->first[b + 1] - bodies->first[b];
        for (size_t i = 0; i < count; i++) {
            if (!fly_pattern(flight, &own[i], &done, all, error))
                return false;
            sp_combination_begin_pattern(&flight->combination, own, i, count);
            count_pattern(flight);
            sp_combination_end_pattern(&flight->combination, own, i, count);
        }
        sp_combination_end_nozzle(&flight->combination);
    }
    return true;
}

/* Of what falls. */
static double lowest_point(const sp_evaluator *evaluator)
{
    sp_vec3 gravity = sp_gravity_for(&evaluator->setup, SP_TRAJECTORY_PARABOLA);
    const sp_mesh *mesh = evaluator->setup.mesh;
    double lowest = -INFINITY;
    for (size_t i = 0; i < mesh->vertex_count; i++)
        lowest = fmax(lowest, sp_dot(mesh->vertices[i], gravity));
    return lowest;
}

static void flight_free(jet_flight *flight)
{
    sp_combination_free(&flight->combination);
    sp_lit_free(&flight->lit);
    free(flight->counted);
    free(flight->rays);
    free(flight->offset);
    free(flight->flow);
    free(flight->hits);
    free(flight->landings);
    free(flight->impacts);
}

static bool evaluate_bodies(const sp_evaluator *evaluator, const sp_bodies *bodies, int reflections, double per_jet,
                            double *able, sp_coverage *coverage, sp_error *error)
{
    jet_flight flight = {.evaluator = evaluator,
                         .deposits = &coverage->deposits,
                         .counted = calloc(coverage->deposits.count + 1, sizeof *flight.counted),
                         .balance = &coverage->balance,
                         .work = &coverage->work,
                         .rays = malloc(BATCH * sizeof *flight.rays),
                         .offset = malloc(BATCH * sizeof *flight.offset),
                         .flow = malloc(BATCH * sizeof *flight.flow),
                         .hits = malloc(BATCH * sizeof *flight.hits),
                         .impacts = malloc(BATCH * sizeof *flight.impacts),
                         .threads = sp_thread_count(evaluator->setup.run.threads),
                         .reflections = reflections,
                         .lowest = lowest_point(evaluator),
                         .per_jet = per_jet};
    bool drag = sp_bodies_hold_drops(evaluator, bodies);
    flight.landings = drag ? malloc(BATCH * sizeof *flight.landings) : NULL;
    bool room = (flight.landings || !drag) && flight.rays && flight.offset && flight.flow && flight.hits &&
                flight.impacts && flight.counted;
    bool done = (room || sp_fail_memory(error)) &&
                sp_combination_create(evaluator, &coverage->deposits, &flight.combination, error) &&
                sp_lit_create(evaluator, &flight.lit, error) && fly_bodies(&flight, bodies, error) &&
                sp_coverage_conclude(evaluator, bodies, coverage, error);
    flight_free(&flight);
    coverage->balance.known = done;
    if (able)
        *able = flight.able;
    return done;
}

static sp_coverage *evaluate(const sp_evaluator *evaluator, const sp_layout *layout, int reflections, double per_jet,
                             double *able, sp_error *error)
{
    sp_bodies bodies;
    sp_coverage *coverage =
        sp_bodies_create(evaluator, layout, &bodies, error) ? sp_coverage_create(evaluator, error) : NULL;
    bool done = coverage && evaluate_bodies(evaluator, &bodies, reflections, per_jet, able, coverage, error);
    sp_bodies_free(&bodies);
    if (done)
        return coverage;
    sp_coverage_destroy(coverage);
    return NULL;
}

sp_coverage *sp_evaluate_jets(const sp_evaluator *evaluator, const sp_layout *layout, double *able, sp_error *error)
{
    return evaluate(evaluator, layout, evaluator->fidelity.reflections, 0, able, error);
}

sp_coverage *sp_evaluate_forward(const sp_evaluator *evaluator, const sp_layout *layout, int reflections, uint64_t jets,
                                 sp_error *error)
{
    if (!evaluator || !layout)
        return NULL;
    if (jets == 0) {
        sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "evaluator: no jets found, expected at least 1");
        return NULL;
    }
    if (reflections < 0) {
        sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "evaluator: %d reflections found, expected 0 or more",
                reflections);
        return NULL;
    }
    if (!sp_layout_is_valid(layout, error))
        return NULL;
    double flow = sp_layout_flow(layout, &evaluator->setup.liquid);
    return evaluate(evaluator, layout, reflections, flow / (double)jets, NULL, error);
}
