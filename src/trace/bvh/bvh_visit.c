#include "trace/bvh/bvh.h"

#include <assert.h>

static bool visit_block(const sp_bvh_block *block, sp_triangle_visitor *visit, const void *region)
{
    for (int i = 0; i < SP_BVH_WIDTH && block->triangle[i] != SP_NONE; i++)
        if (!visit(region, block->triangle[i]))
            return false;
    return true;
}

bool sp_bvh_visit(const sp_bvh *bvh, sp_box_test *test, sp_triangle_visitor *visit, const void *region)
{
    uint32_t stack[SP_BVH_STACK];
    int height = 0;
    if (bvh->node_count > 0)
        stack[height++] = 0;
    while (height > 0) {
        uint32_t at = stack[--height];
        if (at & SP_BVH_LEAF) {
            if (!visit_block(&bvh->blocks[at - SP_BVH_LEAF], visit, region))
                return false;
            continue;
        }
        const sp_bvh_node *node = &bvh->nodes[at];
        for (uint32_t i = 0; i < node->count; i++) {
            double low[3], high[3];
            assert(height < SP_BVH_STACK);
            sp_bvh_child_box(bvh, node, i, low, high);
            if (test(region, low, high))
                stack[height++] = node->child[i];
        }
    }
    return true;
}

void sp_bvh_leaves(const sp_bvh *bvh, double (*boxes)[6])
{
    for (size_t n = 0; n < bvh->node_count; n++) {
        const sp_bvh_node *node = &bvh->nodes[n];
        for (uint32_t i = 0; i < node->count; i++)
            if (node->child[i] & SP_BVH_LEAF) {
                double *box = boxes[node->child[i] - SP_BVH_LEAF];
                sp_bvh_child_box(bvh, node, i, &box[0], &box[3]);
            }
    }
}
