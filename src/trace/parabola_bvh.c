/* Parabolas through the wide hierarchy, in pieces between the times at which they turn along an axis. */
#include "trace/parabola.h"

#include "trace/bvh.h"

typedef struct {
    uint32_t child;
    double from, to; /* s */
} pending;

static void test_block(const sp_parabola *flight, const sp_bvh *bvh, const sp_bvh_block *block, sp_search *search)
{
    for (int i = 0; i < SP_BVH_WIDTH && block->triangle[i] != SP_NONE; i++) {
        sp_corners corners;
        sp_bvh_corners(bvh, block->triangle[i], corners);
        sp_parabola_test(flight, (const double(*)[3])corners, block->triangle[i], search);
    }
}

static void search_piece(const sp_parabola *flight, const sp_bvh *bvh, double from, double to, sp_search *search)
{
    pending stack[SP_BVH_STACK] = {{0, from, to}};
    int height = 1;
    double margin = sp_parabola_margin(flight, sp_greater(fabs(from), fabs(to)));
    while (height > 0 && !sp_search_done(search)) {
        pending at = stack[--height];
        if (at.from > search->limit)
            continue;
        if (at.child & SP_BVH_LEAF) {
            test_block(flight, bvh, &bvh->blocks[at.child - SP_BVH_LEAF], search);
            continue;
        }
        const sp_bvh_node *node = &bvh->nodes[at.child];
        for (uint32_t i = 0; i < node->count; i++) {
            double low[3], high[3];
            pending child = {node->child[i], at.from, at.to};
            bool passes = true;
            sp_bvh_child_box(bvh, node, i, low, high);
            for (int axis = 0; passes && axis < 3; axis++)
                passes = sp_parabola_cut(flight, axis, low[axis] - margin, high[axis] + margin, &child.from, &child.to);
            if (passes)
                stack[height++] = child;
        }
    }
}

void sp_parabola_search_bvh(const sp_parabola *p, const sp_bvh *bvh, sp_search *search)
{
    double from = p->first;
    while (bvh->node_count && from <= sp_lesser(p->last, search->limit) && !sp_search_done(search)) {
        double to = sp_parabola_turn(p, from);
        search_piece(p, bvh, from, sp_lesser(to, search->limit), search);
        if (to == p->last)
            return;
        from = to;
    }
}
