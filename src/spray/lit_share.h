/* Which share of a patch the jets of one nozzle light up, where its spray ends within the patch. */
#ifndef SPRAY_LIT_SHARE_H
#define SPRAY_LIT_SHARE_H

#include "edges.h"
#include "spray/state/state.h"

#define SP_LIT_EDGE 8 /* a texel's cells along either edge; bit y * SP_LIT_EDGE + x of a mask is a cell */

typedef struct {
    uint64_t *own;  /* [patches], cells whose middle lies on the patch */
    uint64_t *hit;  /* [patches], cells that jets have hit */
    uint32_t *jets; /* [patches], how many did */
} sp_lit;

bool sp_lit_create(const sp_evaluator *evaluator, sp_lit *lit, sp_error *error);
void sp_lit_free(sp_lit *lit);
/* Forgets all jets. */
void sp_lit_clear(const sp_evaluator *evaluator, sp_lit *lit);
/* The cell of the point (1-u-v, u, v) of a triangle. */
unsigned sp_lit_cell(const sp_evaluator *evaluator, uint32_t triangle, double u, double v);
static inline void sp_lit_add(sp_lit *lit, uint32_t patch, unsigned cell)
{
    lit->hit[patch] |= (uint64_t)1 << cell;
    lit->jets[patch]++;
}
/* The share of a patch that is lit, above 0 and at most 1. Where a patch beside it is lit all over, it is as many jets
 * per area as there; else what cells were hit tells, those on the rim counting half. Where jets are too few for either,
 * all of it. */
double sp_lit_share(const sp_evaluator *evaluator, const sp_lit *lit, uint32_t patch);
/* Its cells, in blocks that are as large as so few jets tell apart, as samples. */
sp_edge_samples sp_lit_samples(const sp_lit *lit, uint32_t patch);

#endif
