#include "launch.h"

#include "nozzle/valid.h"
#include "spray/drag/chain.h"
#include "spray/state/state.h"

#include <assert.h>
#include <stdlib.h>

#define DROP_LEAST 1e-9 /* m */

struct sp_launch_table {
    const sp_evaluator *evaluator;
    double far; /* m */
    size_t count, capacity;
    sp_wavefronts **fronts; /* [count], with drag */
};

int sp_launch_flights(const sp_launch *launch, sp_vec3 from, sp_vec3 to, sp_vec3 gravity, sp_flight flights[2])
{
    return launch->fronts ? sp_wavefronts_flights(launch->fronts, from, to, flights)
                          : sp_flights(from, to, launch->speed, gravity, flights);
}

bool sp_launch_flight_near(const sp_launch *launch, sp_vec3 from, sp_vec3 to, sp_vec3 gravity, int arc,
                           const sp_flight *near, sp_flight *flight)
{
    sp_flight flights[2];
    if (launch->fronts && sp_wavefronts_flight_near(launch->fronts, from, to, near, flight))
        return true;
    if (!launch->fronts)
        return sp_flight_on_arc(from, to, launch->speed, gravity, arc, flight);
    if (arc >= sp_wavefronts_flights(launch->fronts, from, to, flights))
        return false;
    *flight = flights[arc];
    return true;
}

sp_launch_table *sp_launch_table_create(const sp_evaluator *evaluator, double far, sp_error *error)
{
    if (!evaluator)
        return NULL;
    sp_launch_table *table = calloc(1, sizeof *table);
    if (!table)
        return sp_fail_memory(error);
    assert(far >= 0 && isfinite(far));
    *table = (sp_launch_table){.evaluator = evaluator, .far = far};
    return table;
}

void sp_launch_table_destroy(sp_launch_table *table)
{
    if (!table)
        return;
    for (size_t i = 0; i < table->count; i++)
        sp_wavefronts_destroy(table->fronts[i]);
    free(table->fronts);
    free(table);
}

/* NULL where there are none yet, or nothing leaves. */
static const sp_wavefronts *fronts_of(const sp_launch_table *table, const sp_nozzle *pattern)
{
    const sp_setup *setup = &table->evaluator->setup;
    double speed = sp_nozzle_speed(pattern, &setup->liquid);
    sp_drag drag = sp_drag_of(pattern, &setup->liquid, &setup->air);
    for (size_t i = 0; i < table->count; i++) {
        const sp_wavefronts *own = table->fronts[i];
        if (own->speed == speed && own->drag.stokes == drag.stokes && own->drag.form == drag.form &&
            own->drag.delay == drag.delay)
            return own;
    }
    return NULL;
}

bool sp_are_drops(const sp_setup *setup, const sp_nozzle *pattern, sp_error *error)
{
    if (!sp_air_is_known(setup))
        return sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0,
                       "trajectory: drag found of nozzle %s; expected air with a density of 0 or more and a viscosity, "
                       "and a surface tension of the liquid",
                       pattern->name);
    return pattern->type->drop >= DROP_LEAST ||
           sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                   "trajectory: drag found with drops of %g m from nozzle %s; expected at least %g m",
                   pattern->type->drop, pattern->name, DROP_LEAST);
}

static bool make_room(sp_launch_table *table, sp_error *error)
{
    if (table->count < table->capacity)
        return true;
    size_t capacity = table->capacity ? 2 * table->capacity : 8;
    sp_wavefronts **fronts = realloc(table->fronts, capacity * sizeof(sp_wavefronts *));
    if (!fronts)
        return sp_fail_memory(error);
    table->fronts = fronts;
    table->capacity = capacity;
    return true;
}

static bool add_pattern(sp_launch_table *table, const sp_nozzle *pattern, sp_error *error)
{
    const sp_setup *setup = &table->evaluator->setup;
    double speed = sp_nozzle_speed(pattern, &setup->liquid);
    if (!sp_flies_as_drops(table->evaluator, pattern))
        return true;
    if (!sp_are_drops(setup, pattern, error))
        return false;
    if (!(speed > 0) || fronts_of(table, pattern))
        return true;
    if (!make_room(table, error))
        return false;
    sp_drag drag = sp_drag_of(pattern, &setup->liquid, &setup->air);
    sp_wavefronts *fronts =
        sp_wavefronts_create(&drag, speed, sp_gravity_for(setup, SP_TRAJECTORY_DRAG), table->far, error);
    if (fronts)
        table->fronts[table->count++] = fronts;
    return fronts;
}

bool sp_launch_table_add(sp_launch_table *table, const sp_nozzle *nozzle, sp_error *error)
{
    if (!table || !nozzle || !sp_nozzle_is_valid(nozzle, error))
        return false;
    const sp_setup *setup = &table->evaluator->setup;
    size_t count = sp_nozzle_pattern_count(nozzle);
    sp_nozzle *patterns = malloc((count + 1) * sizeof *patterns);
    if (!patterns)
        return sp_fail_memory(error);
    sp_nozzle_patterns(nozzle, &setup->liquid, setup->up, patterns);
    bool done = true;
    for (size_t i = 0; done && i < count; i++)
        done = add_pattern(table, &patterns[i], error);
    free(patterns);
    return done;
}

bool sp_launch_table_find(const sp_launch_table *table, const sp_nozzle *pattern, sp_launch *launch, sp_error *error)
{
    if (!table || !pattern)
        return false;
    *launch = (sp_launch){.speed = sp_nozzle_speed(pattern, &table->evaluator->setup.liquid),
                          .trajectory = pattern->type->trajectory};
    if (!sp_flies_as_drops(table->evaluator, pattern) || !(launch->speed > 0))
        return true;
    launch->fronts = fronts_of(table, pattern);
    return launch->fronts || sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0,
                                     "nozzle %s: its drops' flights were not found beforehand", pattern->name);
}

/* With drag. */
static sp_meeting meet_as_drops(const sp_evaluator *evaluator, sp_launch launch, const sp_ray *ray, bool drops)
{
    sp_drag drag = launch.fronts->drag;
    sp_landing landing;
    drag.delay = drops ? 0 : drag.delay;
    sp_drag_trace_many(evaluator->tracer, &drag, ray, 1, sp_evaluator_gravity(evaluator, &launch), 1, &landing);
    return (sp_meeting){landing.hit, sp_ray_point(&landing.piece.ray, landing.piece.acceleration, landing.hit.t),
                        landing.velocity};
}

sp_meeting sp_evaluator_meet(const sp_evaluator *evaluator, sp_launch launch, const sp_ray *ray, bool drops)
{
    if (launch.fronts)
        return meet_as_drops(evaluator, launch, ray, drops);
    sp_vec3 acceleration = sp_evaluator_gravity(evaluator, &launch);
    sp_hit hit = sp_trace_nearest(evaluator->tracer, ray, acceleration);
    return (sp_meeting){hit, sp_ray_point(ray, acceleration, hit.t), sp_ray_velocity(ray, acceleration, hit.t)};
}
