/* What one point can reach at one speed: the flights to every patch, less those that something blocks. */
#include "arrival.h"

#include <stdlib.h>

/* A cone of directions, a hair wider than asked so that round-off never takes a jet of its edge away. */
typedef struct {
    sp_vec3 axis;
    double least_cosine;
} aim;

static aim aim_at(sp_vec3 axis, double half_angle)
{
    return (aim){axis, half_angle < M_PI ? cos(half_angle) - 1e-12 : -2};
}

/* Which of the flights to a patch arrive: bit 0 the low arc (or the line), bit 1 the high arc. */
static uint8_t free_arcs(const sp_source *source, const aim *aim, uint32_t patch)
{
    sp_target target = sp_patch_target(&source->evaluator->patches, patch);
    sp_flight flights[2];
    sp_arrival arrival;
    int count = sp_flights(source->position, target.point, source->speed, source->evaluator->gravity, flights);
    uint8_t arcs = 0;
    for (int k = 0; k < count; k++) {
        if (sp_dot(flights[k].direction, aim->axis) >= aim->least_cosine &&
            sp_arrive(source, &target, &flights[k], &arrival) && !sp_flight_blocked(source, &target, &flights[k]))
            arcs |= (uint8_t)(1u << k);
    }
    return arcs;
}

/* Writes a patch's arrivals and returns the place after them. */
static sp_arrival *write_arrivals(const sp_source *source, uint32_t patch, uint8_t arcs, sp_arrival *arrivals)
{
    sp_target target = sp_patch_target(&source->evaluator->patches, patch);
    sp_flight flights[2];
    int count = sp_flights(source->position, target.point, source->speed, source->evaluator->gravity, flights);
    for (int k = 0; k < count; k++) {
        if (arcs & 1u << k) {
            arrivals->patch = patch;
            sp_arrive(source, &target, &flights[k], arrivals++);
        }
    }
    return arrivals;
}

/* Finding the free arcs is what takes time and is shared among the threads; writing them down in order is not. */
static sp_reach *reach(const sp_source *source, const aim *aim, uint8_t *arcs, sp_error *error)
{
    const sp_evaluator *evaluator = source->evaluator;
    size_t patches = evaluator->patches.count, count = 0;
    int threads = omp_in_parallel() ? 1 : sp_thread_count(evaluator->setup.run.threads);
#pragma omp parallel for schedule(dynamic, 512) num_threads(threads)
    for (size_t i = 0; i < patches; i++)
        arcs[i] = free_arcs(source, aim, (uint32_t)i);
    for (size_t i = 0; i < patches; i++)
        count += (arcs[i] & 1u) + (arcs[i] >> 1);
    sp_reach *reach = malloc(sizeof *reach);
    sp_arrival *arrivals = malloc((count ? count : 1) * sizeof *arrivals);
    if (!reach || !arrivals) {
        free(reach);
        free(arrivals);
        return sp_fail_memory(error);
    }
    *reach = (sp_reach){count, arrivals};
    for (size_t i = 0; i < patches; i++) {
        if (arcs[i])
            arrivals = write_arrivals(source, (uint32_t)i, arcs[i], arrivals);
    }
    return reach;
}

sp_reach *sp_evaluator_reach(const sp_evaluator *evaluator, sp_vec3 position, double speed, sp_vec3 axis,
                             double half_angle, sp_error *error)
{
    if (!evaluator)
        return NULL;
    sp_source source = {evaluator, position, speed};
    aim aim = aim_at(axis, half_angle);
    uint8_t *arcs = malloc(evaluator->patches.count ? evaluator->patches.count : 1);
    if (!arcs)
        return sp_fail_memory(error);
    sp_reach *found = reach(&source, &aim, arcs, error);
    free(arcs);
    return found;
}

void sp_reach_destroy(sp_reach *reach)
{
    if (!reach)
        return;
    free(reach->arrivals);
    free(reach);
}
