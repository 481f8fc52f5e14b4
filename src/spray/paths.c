#include "paths.h"

#include "reflection.h"
#include "emitter.h"
#include "launch.h"
#include "mesh/grow.h"

#include <stdlib.h>

#define DRAG_LEGS 8 /* straight ones of a flight with drag */
#define MARCH 1e-4  /* relative error that nobody sees */

typedef struct {
    const sp_evaluator *evaluator;
    sp_paths *paths;
    bool drops;      /* the pattern in hand flies with drag, as `drag` says */
    sp_drag drag;    /* of the pattern in hand */
    sp_vec3 gravity; /* that pulls at it, m/s²; zero for lines */
    sp_vec3 box[2];
} sp_pathfinder;

static bool add_jet(sp_paths *paths, size_t pattern)
{
    if (!sp_grow(&paths->pattern, &paths->jet_room, paths->jet_count + 1, sizeof *paths->pattern))
        return false;
    paths->pattern[paths->jet_count++] = pattern;
    return true;
}

static bool add_leg(sp_paths *paths, sp_vec3 end, double rise, unsigned bounce)
{
    if (!sp_grow(&paths->legs, &paths->leg_room, paths->leg_count + 1, sizeof *paths->legs))
        return false;
    paths->legs[paths->leg_count++] = (sp_path_leg){end, rise, (unsigned)paths->jet_count - 1, bounce};
    return true;
}

/* A flight with drag until `time`, told by places that are as far apart in time. */
static bool add_held_legs(const sp_pathfinder *finder, const sp_drag *drag, const sp_ray *ray, double time,
                          unsigned bounce)
{
    sp_march march = sp_march_from(drag, finder->gravity, ray->origin, ray->velocity);
    double start = 0;
    sp_leg leg = sp_march_on(&march, MARCH);
    for (int i = 1; i <= DRAG_LEGS; i++) {
        double t = time * i / DRAG_LEGS;
        while (start + leg.time < t) {
            start = march.flown;
            leg = sp_march_on(&march, MARCH);
        }
        if (!add_leg(finder->paths, sp_leg_at(&leg, t - start).point, 0, bounce))
            return false;
    }
    return true;
}

/* What a jet meets next; without drag in closed form. */
static sp_landing land(const sp_pathfinder *finder, const sp_drag *drag, const sp_ray *ray)
{
    const sp_tracer *tracer = finder->evaluator->tracer;
    if (finder->drops) {
        sp_obstacle walls = {tracer, sp_v(0, 0, 0), finder->box, SP_NONE};
        return sp_drag_trace(&walls, 1, drag, ray, finder->gravity);
    }
    sp_hit hit = sp_trace_nearest(tracer, ray, finder->gravity);
    return sp_landing_of(ray, &hit, finder->gravity);
}

static bool add_flight(const sp_pathfinder *finder, const sp_drag *drag, const sp_ray *ray, double time,
                       unsigned bounce)
{
    sp_vec3 gravity = finder->gravity;
    if (finder->drops)
        return add_held_legs(finder, drag, ray, time, bounce);
    return add_leg(finder->paths, sp_ray_point(ray, gravity, time), 0.25 * sp_length(gravity) * time * time, bounce);
}

static bool follow(const sp_pathfinder *finder, sp_ray ray, size_t pattern)
{
    const sp_evaluator *evaluator = finder->evaluator;
    sp_drag drag = finder->drag;
    double flow = 1, size = sp_distance(finder->box[0], finder->box[1]);
    int bounces = evaluator->fidelity.reflections;
    bounces = bounces < SP_PATH_BOUNCES ? bounces : SP_PATH_BOUNCES;
    if (!add_jet(finder->paths, pattern))
        return false;
    for (int bounce = 0; bounce <= bounces; bounce++) {
        sp_landing landing = land(finder, &drag, &ray);
        bool meets = landing.hit.triangle != SP_NONE;
        double time = meets ? landing.time : size / sp_length(ray.velocity);
        if (!add_flight(finder, &drag, &ray, time, (unsigned)bounce))
            return false;
        if (!meets || !sp_bounce(evaluator, &landing, finder->gravity, &ray, &flow))
            return true;
        drag.delay = 0; /* what has met a wall is drops */
    }
    return true;
}

static bool follow_pattern(sp_pathfinder *finder, const sp_nozzle *pattern, size_t number)
{
    const sp_setup *setup = &finder->evaluator->setup;
    if (!(sp_nozzle_speed(pattern, &setup->liquid) > 0) || !(sp_nozzle_flow(pattern, &setup->liquid) > 0))
        return true;
    sp_emitter emitter = sp_emitter_of(finder->evaluator, pattern, NULL);
    finder->gravity = emitter.source.gravity;
    finder->drops = sp_flies_as_drops(finder->evaluator, pattern);
    if (finder->drops)
        finder->drag = sp_drag_of(pattern, &setup->liquid, &setup->air);
    for (uint64_t i = 0; i < pattern->jets; i++)
        if (!follow(finder, sp_emitter_jet(&emitter, i, pattern->jets), number))
            return false;
    return true;
}

bool sp_paths_fly(const sp_evaluator *evaluator, const sp_nozzle *nozzle, sp_paths *paths, sp_error *error)
{
    sp_pathfinder finder = {.evaluator = evaluator, .paths = paths, .box = {evaluator->low, evaluator->high}};
    size_t count = sp_nozzle_pattern_count(nozzle), step = (count + SP_PATH_JETS - 1) / SP_PATH_JETS;
    sp_nozzle *patterns = malloc(count * sizeof *patterns), body = *nozzle;
    *paths = (sp_paths){0};
    body.jets = SP_PATH_JETS;
    if (patterns)
        sp_nozzle_patterns(&body, &evaluator->setup.liquid, evaluator->setup.up, patterns);
    bool done = patterns != NULL;
    for (size_t i = 0; done && i < count; i += step)
        done = follow_pattern(&finder, &patterns[i], i);
    free(patterns);
    if (done)
        return true;
    sp_paths_free(paths);
    return sp_fail_memory(error);
}

void sp_paths_free(sp_paths *paths)
{
    free(paths->pattern);
    free(paths->legs);
    *paths = (sp_paths){0};
}
