/* Whether a nozzle can stand where a layout puts it. */
#include "nozzle_bodies.h"
#include "movers.h"

#include "spray/wet/wet.h"
#include "trace/distance.h"

#define TOUCH 1e-6 /* of the geometry's diagonal: nearer than this a nozzle is in the wall */

/* What sees the cavity's point is in its space, though it may see more of the sky than of walls: above an open tank. */
static bool sees_cavity(const sp_evaluator *evaluator, sp_vec3 point)
{
    sp_ray sight = {
        .origin = point, .velocity = sp_sub(evaluator->setup.cavity_point, point), .t_max = 1, .skip = SP_NONE};
    return evaluator->setup.cavity == SP_CAVITY_POINT &&
           (!(sp_length(sight.velocity) > 0) || !sp_trace_occluded(evaluator->tracer, &sight, sp_v(0, 0, 0)));
}

/* What stands; all where nothing moves. */
static const sp_tracer *standing(const sp_evaluator *evaluator)
{
    return evaluator->movers ? evaluator->movers->tracer[SP_STANDING] : evaluator->tracer;
}

/* Goods that pass a point do so as the point would pass them. */
static bool is_out_of_the_way(const sp_evaluator *evaluator, sp_vec3 point, double clearance)
{
    const sp_sweep *sweep = &evaluator->setup.sweep;
    return !evaluator->movers ||
           sp_tracer_way_is_clear(evaluator->movers->tracer[SP_MOVING], sp_sub(point, sweep->from),
                                  sp_sub(point, sweep->to), clearance);
}

static double touch(const sp_evaluator *evaluator)
{
    return TOUCH * sp_distance(evaluator->low, evaluator->high);
}

bool sp_evaluator_is_clear(const sp_evaluator *evaluator, sp_vec3 point, double clearance, uint32_t own)
{
    return sp_tracer_is_clear(standing(evaluator), point, touch(evaluator), SP_NONE) &&
           sp_tracer_is_clear(standing(evaluator), point, clearance, own) &&
           is_out_of_the_way(evaluator, point, fmax(clearance, touch(evaluator)));
}

/* It may be the cavity's point that is wrong: where it lies outside of what the nozzle is within, both are reported. */
static bool fail_outside(const sp_evaluator *evaluator, const sp_nozzle *exit, sp_error *error)
{
    const sp_setup *setup = &evaluator->setup;
    sp_vec3 p = exit->position, point = setup->cavity == SP_CAVITY_POINT ? setup->cavity_point : p;
    sp_vec3 outside = sp_setup_outside(setup, p), from = sp_setup_outside(setup, point);
    if (sp_is_within(evaluator->low, evaluator->high, p) && !sp_is_within(evaluator->low, evaluator->high, point))
        return sp_fail(
            error, SP_ERROR_INPUT, NULL, 0, 0,
            "cavity: the point (%.12g m, %.12g m, %.12g m) lies outside the geometry's box, and nozzle %s at "
            "[%.6g m, %.6g m, %.6g m] is not in the space around it; expected both in the space where the "
            "liquid flies",
            from.x, from.y, from.z, exit->name, outside.x, outside.y, outside.z);
    uint32_t part = sp_wet_part_around(evaluator->wet, setup->mesh, p);
    if (part != SP_NONE && sp_wet_part_around(evaluator->wet, setup->mesh, point) == SP_NONE)
        return sp_fail(
            error, SP_ERROR_INPUT, NULL, 0, 0,
            "nozzles: %s at [%.6g m, %.6g m, %.6g m] is not inside the cavity: it is within part \"%s\", and "
            "the cavity's point [%.6g m, %.6g m, %.6g m] is not; expected both in the space where the liquid "
            "flies",
            exit->name, outside.x, outside.y, outside.z, setup->mesh->parts[part].name, from.x, from.y, from.z);
    return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                   "nozzles: %s at [%.6g m, %.6g m, %.6g m] is not inside the cavity; expected a place in the space "
                   "where the liquid flies",
                   exit->name, outside.x, outside.y, outside.z);
}

/* Where liquid leaves a nozzle. */
static bool admits_exit(const sp_evaluator *evaluator, const sp_nozzle *exit, sp_error *error)
{
    const sp_tracer *tracer = standing(evaluator);
    sp_vec3 p = exit->position, outside = sp_setup_outside(&evaluator->setup, p);
    if (!is_out_of_the_way(evaluator, p, touch(evaluator)))
        return sp_fail(
            error, SP_ERROR_INPUT, NULL, 0, 0,
            "nozzles: %s at [%.6g m, %.6g m, %.6g m] is in the way of the goods of the sweep; expected a place "
            "that they pass by",
            exit->name, outside.x, outside.y, outside.z);
    if (!sp_tracer_is_clear(tracer, p, touch(evaluator), SP_NONE)) {
        const sp_mesh *mesh = sp_tracer_mesh(tracer);
        uint32_t triangle = sp_tracer_nearest_triangle(tracer, SP_NONE, p);
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                       "nozzles: %s at [%.6g m, %.6g m, %.6g m] is in a wall, part \"%s\"; expected a place clear of "
                       "all surfaces",
                       exit->name, outside.x, outside.y, outside.z, mesh->parts[mesh->part[triangle]].name);
    }
    return sp_evaluator_inside(evaluator, p) || sees_cavity(evaluator, p) || fail_outside(evaluator, exit, error);
}

bool sp_evaluator_admits(const sp_evaluator *evaluator, const sp_nozzle *nozzle, sp_error *error)
{
    if (!evaluator || !nozzle)
        return false;
    sp_layout one = {.count = 1, .nozzles = (sp_nozzle[]){*nozzle}};
    sp_bodies bodies;
    bool done = sp_bodies_create(evaluator, &one, &bodies, error);
    for (size_t i = 0; done && i < bodies.patterns->count; i++)
        done = admits_exit(evaluator, &bodies.patterns->nozzles[i], error);
    sp_bodies_free(&bodies);
    return done;
}
