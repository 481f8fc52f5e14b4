/* The walk through a kd-tree along a piece of a path on which every coordinate goes one way only, so that it crosses a
 * plane once. Every plane is taken as thick as a margin, so that rounding never decides which cells are visited.
 *
 * Who includes it defines before
 *   walk: a type with `double margin`, m; `bool rising[3]`, whether a coordinate rises, and `bool still[3]`, whether it
 *     changes by less than the margin;
 *   double ahead(const walk *, int axis, double split, double time): how far ahead the plane lies along the axis, m;
 *   void pass_plane(const walk *, int axis, double split, double from, double to, double *arrival, double *departure):
 *     when the path comes within the margin of the plane and when it has left it, s; before `from` or after `to` where
 *     that is not between them;
 *   void test(const walk *, const sp_corners, uint32_t triangle, sp_ray_search *). */
#ifndef SPRAYPLAN_TRACE_KD_WALK_H
#define SPRAYPLAN_TRACE_KD_WALK_H

#include "trace/kd/kd_tree.h"
#include "trace/ray/search.h"

#include <assert.h>

typedef struct {
    uint32_t node;
    double from, to; /* s, when the path is in it */
} pending;

/* Goes on to one child; puts the other, if the path passes it too, on the stack. */
static inline void step(const walk *w, const sp_kd_node *node, pending *at, pending stack[], int *height)
{
    int axis = (int)(node->size & 3);
    uint32_t left = at->node + 1, right = node->right;
    if (w->still[axis]) {
        double offset = ahead(w, axis, node->split, at->from);
        if (fabs(offset) <= 2 * w->margin)
            stack[(*height)++] = (pending){right, at->from, at->to};
        at->node = offset >= -2 * w->margin ? left : right;
        return;
    }
    double arrival, departure;
    pass_plane(w, axis, node->split, at->from, at->to, &arrival, &departure);
    uint32_t near = w->rising[axis] ? left : right, far = w->rising[axis] ? right : left;
    if (departure < at->from) {
        at->node = far;
    } else {
        if (arrival <= at->to)
            stack[(*height)++] = (pending){far, sp_greater(at->from, arrival), at->to};
        at->node = near;
        at->to = sp_lesser(at->to, departure);
    }
}

/* Tests the triangles of all leaves that the piece passes, until the search is done. */
static void search_leaves(const walk *w, const sp_corners *corners, const sp_kd_tree *tree, double from, double to,
                          sp_ray_search *search)
{
    pending stack[SP_KD_DEPTH + 1], at = {0, from, to};
    int height = 0;
    for (;;) {
        const sp_kd_node *node = &tree->nodes[at.node];
        while ((node->size & 3) != SP_KD_LEAF) {
            step(w, node, &at, stack, &height);
            assert(height <= SP_KD_DEPTH);
            node = &tree->nodes[at.node];
        }
        const uint32_t *references = tree->references + node->right;
        for (uint32_t i = 0; i < node->size / 4; i++)
            test(w, corners[references[i]], references[i], search);
        do {
            if (height == 0 || sp_ray_search_done(search))
                return;
            at = stack[--height];
        } while (at.from > search->limit);
        at.to = sp_lesser(at.to, search->limit);
    }
}

#endif
