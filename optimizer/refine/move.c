#include "refine/move.h"

#include "candidates/ranges.h"

#define PULLS 4    /* tries to bring a move within its limit */
#define PULL 0.995 /* of the limit, of each */

/* Along the surface, no farther than refinement may move a nozzle: moves are asked for in two directions, each within
 * that, and what both come to may be more, as may the way round a bend. */
static bool move_along_surface(const sp_search *search, const sp_placed *placed, sp_vec3 position, sp_site *site)
{
    const sp_place_options *options = search->options;
    double limit = sp_move_limit(options, &options->mounts[placed->site.mount]);
    sp_vec3 from = placed->origin.position;
    for (int i = 0; i < PULLS; i++) {
        *site = placed->site;
        if (!sp_site_project(search->coarse, options, site, position))
            return false;
        double away = sp_distance(site->position, from);
        if (away <= limit)
            return true;
        position = sp_along(from, PULL * limit / away, sp_sub(site->position, from));
    }
    return false;
}

/* Puts *site where a nozzle moved to `position` would be mounted; false, and *site as it was, where it must not be
 * there. */
static bool move_site(const sp_search *search, const sp_placed *placed, sp_vec3 position, sp_site *site)
{
    const sp_place_options *options = search->options;
    sp_site there = placed->site;
    if (options->mounts[placed->site.mount].kind == SP_MOUNT_SURFACE) {
        if (!move_along_surface(search, placed, position, &there))
            return false;
    } else {
        there.position = sp_setup_told(sp_evaluator_setup(search->coarse), position);
    }
    if (!sp_site_allowed(search->coarse, options, &there))
        return false;
    *site = there;
    return true;
}

void sp_placed_move(const sp_search *search, sp_placed *placed, const sp_pose_parameters *parameters,
                    const double *values)
{
    sp_site site = placed->site;
    if (!parameters->count)
        return;
    sp_nozzle nozzle = sp_pose_parameters_nozzle(parameters, values);
    if (sp_distance(nozzle.position, placed->nozzle.position) > 0 &&
        move_site(search, placed, nozzle.position, &site)) {
        sp_nozzle there = sp_pose_parameters_nozzle_at(parameters, values, &site);
        double turn = sp_dot(there.axis, placed->origin.axis);
        /* a curved surface may turn the axis more than refinement is allowed to */
        if (turn < cos(parameters->axis_limit) - 1e-9)
            site = placed->site;
    }
    placed->nozzle = sp_pose_parameters_nozzle_at(parameters, values, &site);
    placed->site = site;
    placed->flow = sp_nozzle_flow(&placed->nozzle, &sp_evaluator_setup(search->coarse)->liquid);
}
