/* Which of the search's patches a place of the surface lies in. */
#ifndef OPTIMIZER_PATCH_AT_H
#define OPTIMIZER_PATCH_AT_H

#include <sprayplan/evaluator.h>

/* The patch of `evaluator` at a point (1-u-v, u, v) of a triangle's side; SP_NONE where that is not counted. */
uint32_t sp_patch_of(const sp_evaluator *evaluator, uint32_t triangle, double u, double v, bool back);
/* The coarse patch in which a fine one lies. */
uint32_t sp_coarse_patch(const sp_evaluator *fine, const sp_evaluator *coarse, size_t patch);

#endif
