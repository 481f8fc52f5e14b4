#include "refine/move.h"

/* Where a nozzle moved to `position` would be mounted; false where it must not be there. */
static bool moved_site(const sp_search *search, const sp_placed *placed, sp_vec3 position, sp_site *site)
{
    const sp_place_options *options = search->options;
    const sp_mount *mount = &options->mounts[placed->site.mount];
    *site = placed->site;
    site->position = sp_setup_told(sp_evaluator_setup(search->coarse), position);
    if (mount->kind == SP_MOUNT_SURFACE) {
        double limit = options->refine.position < 0 ? 0.5 * mount->spacing : options->refine.position;
        *site = placed->site;
        if (!sp_site_project(search->coarse, options, site, position) ||
            sp_distance(site->position, placed->origin.position) > limit)
            return false;
    }
    return sp_site_allowed(search->coarse, options, site);
}

void sp_placed_move(const sp_search *search, sp_placed *placed, const sp_pose_parameters *parameters,
                    const double *values)
{
    sp_site site = placed->site;
    if (!parameters->count)
        return;
    sp_nozzle nozzle = sp_pose_parameters_nozzle(parameters, values);
    if (sp_distance(nozzle.position, placed->nozzle.position) > 0 &&
        moved_site(search, placed, nozzle.position, &site)) {
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
