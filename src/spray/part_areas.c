/* Whose surface a patch is: texels as long as parts are wide lie across several. */
#include "spray/state/state.h"

/* Pieces of one patch on their way to who asks. */
typedef struct {
    uint32_t part; /* of the fragment in hand */
    sp_part_visitor *visit;
    void *user;
} piece_walk;

static void visit_piece(void *user, const sp_vec3 *polygon, int corners, double area)
{
    const piece_walk *walk = user;
    (void)polygon;
    (void)corners;
    walk->visit(walk->user, walk->part, area);
}

/* The part that all fragments of a texel are of; SP_NONE where they are of several. */
static uint32_t only_part(const sp_evaluator *evaluator, uint32_t texel)
{
    const sp_fragments *fragments = &evaluator->fragments;
    const uint32_t *part = evaluator->setup.mesh->part;
    uint32_t first = part[fragments->items[fragments->start[texel]].triangle];
    for (uint32_t f = fragments->start[texel] + 1; f < fragments->start[texel + 1]; f++)
        if (part[fragments->items[f].triangle] != first)
            return SP_NONE;
    return first;
}

void sp_evaluator_part_areas(const sp_evaluator *evaluator, uint32_t patch, sp_part_visitor *visit, void *user)
{
    const sp_fragments *fragments = &evaluator->fragments;
    const sp_setup *setup = &evaluator->setup;
    uint32_t texel = evaluator->patches.texel[patch], only = only_part(evaluator, texel);
    if (only != SP_NONE) {
        visit(user, only, sp_evaluator_counted(evaluator, patch));
        return;
    }
    piece_walk walk = {.visit = visit, .user = user};
    for (uint32_t f = fragments->start[texel]; f < fragments->start[texel + 1]; f++) {
        walk.part = setup->mesh->part[fragments->items[f].triangle];
        if (setup->surfaces[walk.part].clean)
            sp_counted_pieces(evaluator, texel, &fragments->items[f], evaluator->patches.side[patch] == SP_SIDE_BACK,
                              visit_piece, &walk);
    }
}
