/* What can be reckoned with in double precision, and errors for what cannot. */
#include "spray/wet/cuts.h"
#include "spray/state/state.h"

#define MOST_SPEED 1e30        /* m/s: far beyond, fourth powers that flights are reckoned from overflow */
#define MOST_LENGTH 1e50       /* m, and its inverse: far beyond, so do fourth powers of lengths */
#define COARSEST 0x1p-12       /* of the geometry's diagonal, that coordinates tell */
#define FINEST_TEXEL 0x1p-46   /* of the farthest coordinate */
#define SLOWEST_SQUARE 0x1p-58 /* of g times the diagonal, that v² is told beside */

double sp_farthest_coordinate(sp_vec3 low, sp_vec3 high)
{
    return fmax(fmax(fmax(-low.x, high.x), fmax(-low.y, high.y)), fmax(-low.z, high.z));
}

static bool gravity_is_resolved(const sp_setup *setup, double diagonal, sp_error *error)
{
    double speed = sqrt(2 * setup->gravity) * sqrt(diagonal);
    return speed <= MOST_SPEED ||
           sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                   "gravity: %g m/s2 found, by which what falls through the geometry gains %g m/s; expected at most "
                   "%g m/s",
                   setup->gravity, speed, MOST_SPEED);
}

bool sp_geometry_is_resolved(const sp_setup *setup, sp_error *error)
{
    sp_vec3 low, high;
    double diagonal = sp_mesh_box(setup->mesh, &low, &high);
    /* as they were read: about an origin of the setup's own they are no better told */
    double farthest = sp_farthest_coordinate(sp_setup_outside(setup, low), sp_setup_outside(setup, high));
    if (!(diagonal >= 1 / MOST_LENGTH && diagonal <= MOST_LENGTH))
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "geometry: %g m across found, expected %g m to %g m",
                       diagonal, 1 / MOST_LENGTH, MOST_LENGTH);
    /* wet sides are told by contacts */
    double most = diagonal * (setup->cavity == SP_CAVITY_NONE ? COARSEST : SP_CONTACT);
    double step = nextafter(farthest, INFINITY) - farthest;
    if (step > most)
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                       "geometry: coordinates up to %g m found for what is %g m across; there they tell no less than "
                       "%.2g m apart; expected it nearer to the origin, where they tell %.2g m",
                       farthest, diagonal, step, most);
    return setup->fidelity.trajectory == SP_TRAJECTORY_LINE || gravity_is_resolved(setup, diagonal, error);
}

bool sp_texel_is_resolved(const sp_evaluator *evaluator, double texel, sp_error *error)
{
    double farthest = evaluator->farthest;
    return texel >= FINEST_TEXEL * farthest ||
           sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                   "texel: %g m found, too small for coordinates up to %g m; expected at least %.2g m", texel, farthest,
                   FINEST_TEXEL * farthest);
}

static bool may_fall(const sp_setup *setup, sp_trajectory own)
{
    return (own == SP_TRAJECTORY_AUTO ? setup->fidelity.trajectory : own) != SP_TRAJECTORY_LINE;
}

/* What a nozzle's liquid, of all its patterns, may be pulled at by, m/s². */
static double strongest_pull(const sp_setup *setup, const sp_nozzle_type *type)
{
    bool falls = may_fall(setup, type->trajectory);
    for (size_t i = 0; i < type->member_count; i++)
        falls |= may_fall(setup, type->members[i].type.trajectory);
    return falls ? setup->gravity : 0;
}

/* Whether a nozzle's liquid leaves neither so fast nor so slowly that its flights cannot be told. */
static bool is_flying(const sp_evaluator *evaluator, const sp_nozzle *nozzle, double slowest, sp_error *error)
{
    double speed = sp_nozzle_speed(nozzle, &evaluator->setup.liquid);
    if (speed > MOST_SPEED)
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                       "nozzle %s: exit speed %g m/s found, from pressure and density; expected at most %g m/s",
                       nozzle->name, speed, MOST_SPEED);
    return speed >= slowest || !(speed > 0) ||
           sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                   "nozzle %s: exit speed %g m/s found, which under gravity of %g m/s2 cannot be told from none; "
                   "expected at least %.2g m/s",
                   nozzle->name, speed, evaluator->setup.gravity, slowest);
}

bool sp_evaluator_takes(const sp_evaluator *evaluator, const sp_layout *layout, sp_error *error)
{
    double diagonal = sp_distance(evaluator->low, evaluator->high);
    for (size_t i = 0; i < layout->count; i++) {
        double acceleration = strongest_pull(&evaluator->setup, layout->nozzles[i].type);
        if ((acceleration > 0 && !gravity_is_resolved(&evaluator->setup, diagonal, error)) ||
            !is_flying(evaluator, &layout->nozzles[i], sqrt(SLOWEST_SQUARE * acceleration) * sqrt(diagonal), error))
            return false;
    }
    return true;
}
