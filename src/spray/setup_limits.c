/* What a setup has to hold before there can be an evaluator of it. */
#include "valid_range.h"
#include "spray/state/state.h"

static const sp_owner of_setup = {"setup", ""};

static bool in_range(double value, double low, double high)
{
    return value >= low && value <= high;
}

static bool check_surfaces(const sp_setup *setup, sp_error *error)
{
    bool clean = false;
    for (size_t i = 0; i < setup->mesh->part_count; i++) {
        const sp_surface *surface = &setup->surfaces[i];
        if (!in_range(surface->restitution, 0, 1) || !in_range(surface->rebound, 0, 1))
            return sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0,
                           "part \"%s\": restitution %g and rebound %g found, expected 0 to 1",
                           setup->mesh->parts[i].name, surface->restitution, surface->rebound);
        clean = clean || surface->clean;
    }
    return clean || sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "nothing is to be cleaned: every part is an obstacle");
}

static bool check_sweep(const sp_setup *setup, sp_error *error)
{
    const sp_sweep *sweep = &setup->sweep;
    double travel = sp_distance(sweep->from, sweep->to), speed = sweep->speed;
    bool moves = false;
    for (size_t i = 0; i < setup->mesh->part_count; i++)
        moves = moves || setup->surfaces[i].moves;
    if (moves != (speed != 0) || (moves && !(in_range(travel, 1e-300, 1e300) && in_range(speed, 1e-300, 1e300))))
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                       "sweep: a way of %g m at %g m/s and %s found; expected parts that move, ends that are apart and "
                       "a speed above 0, or nothing of these",
                       travel, speed, moves ? "parts that move" : "no part that moves");
    return !moves || !(setup->criterion.film > 0) ||
           sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                   "film: found beside a sweep, which carries it along; expected a criterion of dose");
}

static bool check_caps(const sp_setup *setup, sp_error *error)
{
    if (!sp_is_listed(of_setup, "caps", setup->caps, setup->cap_count, error))
        return false;
    for (size_t i = 0; i < setup->cap_count; i++) {
        const sp_cap *cap = &setup->caps[i];
        if (!isfinite(sp_length(cap->point)) || !in_range(sp_length(cap->normal), 1e-300, 1e300) ||
            !in_range(cap->radius, 1e-300, 1e300))
            return sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0,
                           "cap %zu: expected a finite point, a normal of some length and a radius above 0", i + 1);
    }
    return true;
}

bool sp_air_is_known(const sp_setup *setup)
{
    return in_range(setup->air.density, 0, 1e300) && in_range(setup->air.viscosity, 1e-300, 1e300) &&
           in_range(setup->liquid.surface_tension, 1e-300, 1e300);
}

static bool check_words(const sp_setup *setup, sp_error *error)
{
    const sp_fidelity *fidelity = &setup->fidelity;
    return sp_is_word(of_setup, "trajectory", fidelity->trajectory, SP_TRAJECTORY_DRAG, error) &&
           sp_is_word(of_setup, "method", fidelity->method, SP_METHOD_INVERSE, error) &&
           sp_is_word(of_setup, "splat", fidelity->splat, SP_SPLAT_LINEAR, error) &&
           sp_is_word(of_setup, "cavity", setup->cavity, SP_CAVITY_OUTSIDE, error) &&
           sp_is_word(of_setup, "combine", setup->criterion.combine, SP_COMBINE_SINGLE, error);
}

/* Up is z or y: frames of nozzles, and what runs down, know no other. */
static bool is_upright(sp_vec3 up)
{
    return up.x == 0 && ((up.y == 0 && up.z == 1) || (up.y == 1 && up.z == 0));
}

bool sp_setup_is_valid(const sp_setup *setup, sp_error *error)
{
    const sp_criterion *criterion = &setup->criterion;
    const sp_fidelity *fidelity = &setup->fidelity;
    const char *wrong = NULL;
    if (!setup->mesh || !setup->surfaces || setup->mesh->triangle_count == 0)
        wrong = "a mesh with triangles and a surface for each of its parts";
    else if (!in_range(setup->liquid.density, 1e-300, 1e300))
        wrong = "a positive density of the liquid";
    else if (fidelity->trajectory == SP_TRAJECTORY_DRAG && !sp_air_is_known(setup))
        wrong = "air with a density of 0 or more and a viscosity, and a surface tension of the liquid, for drag";
    else if (!is_upright(setup->up))
        wrong = "up as (0, 0, 1) or (0, 1, 0)";
    else if (!in_range(setup->gravity, 0, 1e300))
        wrong = "a gravity of 0 or more";
    else if (!in_range(criterion->flux, 0, 1e300) || !in_range(criterion->impact_speed, 0, 1e300) ||
             !in_range(criterion->incidence, 0, M_PI / 2))
        wrong = "a criterion with flux and impact speed of 0 or more and incidence of 0 to 90 deg";
    else if (!in_range(fidelity->texel, 0, 1e300) || fidelity->reflections < -1)
        wrong = "a texel of 0 (auto) or more and reflections of -1 (auto) or more";
    else if (!in_range(fidelity->accuracy, 0, 1))
        wrong = "an accuracy of 0 to 1";
    else if (setup->unfolded && !in_range(setup->unfolded_texel, 1e-300, 1e300))
        wrong = "a texel with files that lay the surface flat";
    else if (!in_range(criterion->film, 0, 1e300))
        wrong = "a criterion with a film of 0 or more";
    else if (setup->cavity == SP_CAVITY_POINT && !isfinite(sp_length(setup->cavity_point)))
        wrong = "a finite point of the cavity";
    else if (!isfinite(sp_length(setup->origin)))
        wrong = "a finite origin";
    if (wrong)
        return sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "evaluator: expected %s", wrong);
    if (criterion->film > 0 && (setup->cavity == SP_CAVITY_NONE || !(setup->gravity > 0)))
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                       "film: found without %s; expected a cavity, which says on which side of a wall it "
                       "runs down, and gravity",
                       setup->gravity > 0 ? "a cavity" : "gravity");
    return check_words(setup, error) && sp_run_is_valid(&setup->run, error) &&
           sp_is_listed(of_setup, "unfolded", setup->unfolded, setup->unfolded_count, error) &&
           check_caps(setup, error) && check_surfaces(setup, error) && check_sweep(setup, error) &&
           sp_geometry_is_resolved(setup, error);
}
