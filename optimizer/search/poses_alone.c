#include "search/poses_alone.h"

#include <stdlib.h>

#define NUMBERS_MOST 2e7 /* that may be kept, of 8 bytes */
#define SLOW 10 /* times as long as others poses take that no pattern kernel sums, or whose liquid is followed */

/* Of a mounting point, every pose that its mount allows and that does not stand in a wall there. */
static bool list_site(const sp_search *search, uint32_t site, sp_poses_alone *poses, sp_error *error)
{
    const sp_candidates *candidates = search->candidates;
    sp_vec3 up = sp_evaluator_setup(poses->evaluator)->up;
    uint32_t mount = search->sites->items[site].mount;
    for (uint32_t v = 0; v < candidates->variant_count && !search->port_taken[mount]; v++) {
        size_t axes = sp_candidates_axes(candidates, mount, v)->count, rolls = candidates->variants[v].roll_count;
        for (size_t i = 0; i < axes * rolls; i++) {
            sp_pose pose = {site, v, (uint32_t)(i / rolls), (uint32_t)(i % rolls)};
            sp_nozzle nozzle = sp_pose_nozzle(candidates, search->sites, pose, up);
            sp_error refused = {0};
            if (sp_evaluator_admits(poses->evaluator, &nozzle, &refused))
                poses->poses[poses->count++] = pose;
            else if (refused.kind == SP_ERROR_MEMORY)
                return sp_fail_memory(error);
        }
    }
    return true;
}

bool sp_poses_alone_list(const sp_search *search, const sp_evaluator *evaluator, size_t most, sp_poses_alone *poses,
                         sp_error *error)
{
    size_t all = search->candidates->pose_start[search->sites->count];
    *poses = (sp_poses_alone){.evaluator = evaluator, .patches = sp_evaluator_patches(evaluator)->count};
    double each = search->footprints || search->runoffs ? SLOW : 1;
    if (all > most || 3 * each * (double)(all + 2) * (double)poses->patches > NUMBERS_MOST)
        return true;
    poses->poses = malloc((all + 1) * sizeof *poses->poses);
    poses->alone = calloc(all + 1, sizeof *poses->alone);
    poses->area = malloc((poses->patches + 1) * sizeof *poses->area);
    if (!poses->poses || !poses->alone || !poses->area)
        return sp_fail_memory(error);
    for (uint32_t p = 0; p < poses->patches; p++)
        poses->area[p] = sp_evaluator_counted(evaluator, p);
    bool done = true;
    for (uint32_t site = 0; done && site < search->sites->count; site++)
        done = list_site(search, site, poses, error);
    return done;
}

static bool evaluate(const sp_poses_alone *poses, sp_nozzle *nozzles, size_t count, sp_alone *alone, sp_error *error)
{
    const sp_layout layout = {.count = count, .nozzles = nozzles};
    sp_coverage *coverage = sp_evaluate(poses->evaluator, &layout, error);
    bool done = coverage && sp_alone_create(poses->evaluator, coverage, alone, error);
    sp_coverage_destroy(coverage);
    return done;
}

bool sp_poses_alone_evaluate(const sp_search *search, sp_deadline *deadline, const char *stage, sp_poses_alone *poses,
                             bool *done, sp_error *error)
{
    sp_vec3 up = sp_evaluator_setup(poses->evaluator)->up;
    *done = false;
    if (!evaluate(poses, search->kept, search->kept_count, &poses->alone[poses->count], error))
        return false;
    for (size_t i = 0; i < poses->count; i++) {
        sp_nozzle nozzle = sp_pose_nozzle(search->candidates, search->sites, poses->poses[i], up);
        if (!sp_deadline_goes_on(deadline, stage, 1))
            return true;
        if (!evaluate(poses, &nozzle, 1, &poses->alone[i], error))
            return false;
    }
    *done = true;
    return true;
}

void sp_poses_alone_free(sp_poses_alone *poses)
{
    for (size_t i = 0; poses->alone && i <= poses->count; i++)
        sp_alone_free(&poses->alone[i]);
    free(poses->poses);
    free(poses->alone);
    free(poses->area);
    *poses = (sp_poses_alone){0};
}
