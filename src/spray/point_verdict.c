/* Verdicts: whether what a layout sprays covers a point, by closed form at the point itself. */
#include "dose.h"
#include "reference.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#define CHUNK 4096    /* points whose flights from a nozzle are traced together */
#define CHUNK_SLOW 64 /* the same with drag and of goods that move, where each is traced for itself */

/* The flights of one pattern to a chunk of points, and what the points have received. */
typedef struct {
    size_t count;
    uint32_t *point; /* [2 CHUNK], as what follows: of the chunk */
    double *flux;    /* m³/s per m² */
    sp_ray *rays;
    bool *blocked;
    double *received; /* [CHUNK], m³/s per m² */
} flights;

static bool flights_create(flights *f)
{
    *f = (flights){.point = malloc(2 * CHUNK * sizeof *f->point),
                   .flux = malloc(2 * CHUNK * sizeof *f->flux),
                   .rays = malloc(2 * CHUNK * sizeof *f->rays),
                   .blocked = malloc(2 * CHUNK * sizeof *f->blocked),
                   .received = malloc(CHUNK * sizeof *f->received)};
    return f->point && f->flux && f->rays && f->blocked && f->received;
}

static void flights_free(flights *f)
{
    free(f->point);
    free(f->flux);
    free(f->rays);
    free(f->blocked);
    free(f->received);
}

/* The passing flights from a nozzle to a point, but for what may lie in the way. `index` is of the chunk. */
static void gather(const sp_emitter *emitter, double flow, const sp_point *point, uint32_t index, flights *f)
{
    const sp_source *source = &emitter->source;
    sp_target target = {
        .point = point->position, .normal = point->normal, .side = point->side, .triangle = point->triangle};
    sp_flight ways[2];
    int count = sp_source_flights(source, target.point, ways);
    for (int k = 0; k < count; k++) {
        sp_arrival arrival;
        if (!sp_emitter_holds(emitter, ways[k].direction) || !sp_arrive(source, &target, &ways[k], &arrival) ||
            !arrival.passes)
            continue;
        if (source->fronts ? sp_flight_is_blocked(source, &target, &ways[k])
                           : sp_flight_pierces(source, &target, &ways[k]))
            continue;
        assert(f->count < 2 * CHUNK);
        f->blocked[f->count] = false;
        f->point[f->count] = index;
        f->flux[f->count] = sp_emitter_flux(emitter, flow, &arrival, 0);
        f->rays[f->count++] = sp_flight_ray(source, &target, &ways[k]);
    }
}

/* What one pattern adds. Who is covered already stays so. */
static void spray(const sp_emitter *emitter, double flow, const sp_point *points, size_t count, flights *f,
                  bool *covered)
{
    const sp_evaluator *evaluator = emitter->source.evaluator;
    double threshold = evaluator->setup.criterion.flux;
    f->count = 0;
    for (size_t i = 0; i < count; i++)
        if (!covered[i])
            gather(emitter, flow, &points[i], (uint32_t)i, f);
    if (!emitter->source.fronts)
        sp_trace_occluded_many(evaluator->tracer, f->rays, f->count, emitter->source.gravity, 1, f->blocked);
    for (size_t i = 0; i < f->count; i++) {
        double *received = &f->received[f->point[i]];
        *received += f->blocked[i] ? 0 : f->flux[i];
        covered[f->point[i]] = sp_flux_suffices(*received, threshold);
    }
}

/* The same of goods that move, and of what they pass. */
static void spray_pass(const sp_emitter *emitter, double flow, const sp_point *points, size_t count, flights *f,
                       bool *covered)
{
    double threshold = emitter->source.evaluator->setup.criterion.flux;
    for (size_t i = 0; i < count; i++) {
        if (covered[i])
            continue;
        f->received[i] += sp_point_dose(emitter, flow, &points[i]);
        covered[i] = sp_flux_suffices(f->received[i], threshold);
    }
}

/* False where it was stopped. */
static bool judge(const sp_reference *reference, const sp_point *points, size_t count, flights *f, bool *covered)
{
    const sp_evaluator *truth = &reference->truth;
    const sp_bodies *bodies = &reference->bodies;
    memset(covered, 0, count * sizeof *covered);
    memset(f->received, 0, count * sizeof *f->received);
    for (size_t b = 0; b < bodies->layout->count; b++) {
        if (truth->setup.criterion.combine == SP_COMBINE_SINGLE)
            memset(f->received, 0, count * sizeof *f->received);
        for (size_t n = bodies->first[b]; n < bodies->first[b + 1]; n++) {
            sp_emitter emitter = sp_bodies_emitter(truth, bodies, n);
            double flow = sp_nozzle_flow(&bodies->patterns->nozzles[n], &truth->setup.liquid);
            if (reference->watch && !sp_watch_goes_on(reference->watch, 0))
                return false;
            if (flow > 0)
                (truth->movers ? spray_pass : spray)(&emitter, flow, points, count, f, covered);
        }
    }
    return !reference->watch || sp_watch_goes_on(reference->watch, count);
}

bool sp_judge_sprayed(const sp_reference *reference, const sp_point *points, size_t count, bool *covered,
                      sp_error *error)
{
    bool done = true;
    bool slow = reference->truth.movers || sp_bodies_hold_drops(&reference->truth, &reference->bodies);
    size_t chunk = slow ? CHUNK_SLOW : CHUNK, chunks = (count + chunk - 1) / chunk;
    int threads = omp_in_parallel() ? 1 : sp_thread_count(reference->truth.setup.run.threads);
#pragma omp parallel num_threads(threads) reduction(&& : done)
    {
        flights f;
        done = flights_create(&f);
#pragma omp for schedule(dynamic, 1)
        for (size_t c = 0; c < chunks; c++) {
            size_t first = c * chunk, part = count - first < chunk ? count - first : chunk;
            done = done && judge(reference, points + first, part, &f, covered + first);
        }
        flights_free(&f);
    }
    return done || sp_watch_fail(reference->watch, error);
}
