#include "reference.h"

#include "falling_film.h"

#include <stdlib.h>

#define FINER 0.5 /* of the evaluator's own cells: how long those are on which film is routed once more */

/* Routes what arrives on finer cells. */
static bool route_film(sp_reference *reference, sp_error *error)
{
    const sp_falling_film *falling_film = reference->truth.falling_film;
    if (!falling_film)
        return true;
    reference->walls = sp_evaluator_resample(&reference->truth, FINER * falling_film->walls->fidelity.texel, error);
    reference->film = reference->walls ? sp_coverage_create(reference->walls, error) : NULL;
    return reference->film &&
           sp_falling_film_find(reference->walls->falling_film, reference->bodies.patterns, reference->film, error);
}

sp_reference *sp_reference_create(const sp_evaluator *evaluator, const sp_layout *layout, sp_trajectory trajectory,
                                  sp_error *error)
{
    if (!evaluator || !layout)
        return NULL;
    sp_reference *reference = calloc(1, sizeof *reference);
    if (!reference)
        return sp_fail_memory(error);
    sp_evaluator *truth = &reference->truth;
    *truth = *evaluator;
    truth->gravity = sp_gravity_for(&evaluator->setup, trajectory);
    truth->fidelity.trajectory = trajectory == SP_TRAJECTORY_AUTO ? SP_TRAJECTORY_PARABOLA : trajectory;
    if (sp_bodies_create(truth, layout, &reference->bodies, error) && sp_bodies_fly(truth, &reference->bodies, error) &&
        route_film(reference, error))
        return reference;
    sp_reference_destroy(reference);
    return NULL;
}

void sp_reference_destroy(sp_reference *reference)
{
    if (!reference)
        return;
    sp_coverage_destroy(reference->film);
    sp_evaluator_destroy(reference->walls);
    sp_bodies_free(&reference->bodies);
    free(reference);
}

double sp_reference_film_cell(const sp_reference *reference)
{
    return reference->walls ? reference->walls->fidelity.texel : 0;
}

/* Whether enough runs down where a point lies. */
static bool is_rinsed(const sp_reference *reference, const sp_point *point)
{
    uint32_t cell = sp_patch_at(reference->walls, point->triangle, point->u, point->v, point->side == SP_SIDE_BACK);
    return cell != SP_NONE && reference->film->deposits.film[cell] >= reference->truth.setup.criterion.film;
}

bool sp_reference_judge(const sp_reference *reference, const sp_point *points, size_t count, bool *covered,
                        sp_error *error)
{
    if (!reference || !points)
        return false;
    if (!sp_judge_sprayed(reference, points, count, covered, error))
        return false;
    for (size_t i = 0; reference->walls && i < count; i++)
        covered[i] = covered[i] || is_rinsed(reference, &points[i]);
    return true;
}

bool sp_points_judge(const sp_evaluator *evaluator, const sp_layout *layout, sp_trajectory trajectory,
                     const sp_point *points, size_t count, bool *covered, sp_error *error)
{
    if (!points)
        return false;
    sp_reference *reference = sp_reference_create(evaluator, layout, trajectory, error);
    bool done = reference && sp_reference_judge(reference, points, count, covered, error);
    sp_reference_destroy(reference);
    return done;
}
