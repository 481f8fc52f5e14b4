/* Lines through the hierarchy one after another, where there are too few to wait for each other. Included once by each
 * file that is compiled for a set of instructions, with SP_KERNEL(name) naming its functions. */
#include "trace/line/line_prepare.h"
#include "trace/line/line_step.h"

/* Visits all that the line passes, the near before the far. */
static inline void walk_single(const sp_line_queue *queue, sp_line_flight *flight)
{
    const sp_bvh *bvh = queue->bvh;
    const sp_bvh_line *ray = &flight->ray;
    uint32_t child = 0;
    int height = 0;
    for (;;) {
        if (child & SP_BVH_LEAF) {
            const sp_bvh_block *block = &bvh->blocks[child - SP_BVH_LEAF];
            test_block(block, ray, &flight->found);
            if (flight->found.maybe) {
                take_found(queue, flight, block);
                if (!queue->hits && flight->triangle != SP_NONE)
                    return;
                if (flight->triangle != SP_NONE) /* most often it stays the best */
                    sp_bvh_prefetch_corners(bvh, flight->triangle);
            }
        } else {
            const sp_bvh_node *node = &bvh->nodes[child];
            wide enters, leaves;
            enter_children(node, ray, &enters, &leaves);
            height += wide_pack(node->child, enters, leaves, children_order(node, ray), flight->child + height,
                                flight->way + height);
        }
        do
            if (height-- == 0)
                return;
        while (flight->way[height] > ray->last);
        child = flight->child[height];
        if (height > 0)
            sp_bvh_prefetch(bvh, flight->child[height - 1]);
    }
}

void SP_KERNEL(sp_bvh_lines_single)(sp_line_queue *queue)
{
    sp_line_flight flight;
    while (queue->next < queue->count) {
        if (make_ready(queue, 1, &flight.ray) == 0)
            continue;
        flight.triangle = SP_NONE;
        flight.low = INFINITY;
        flight.in_doubt = false;
        walk_single(queue, &flight);
        uint32_t number = flight.ray.number;
        if (!queue->hits)
            queue->occluded[number] = flight.triangle != SP_NONE;
        else if (flight.triangle == SP_NONE)
            queue->hits[number] = (sp_hit){INFINITY, 0, 0, SP_NONE};
        else
            queue->hits[number] = sp_bvh_line_ask(queue->bvh, &queue->rays[number], flight.triangle);
    }
}
