/* What a walk of parabolas has still to look at. For the kernels, which are compiled once for each set of instructions.
 */
#ifndef TRACE_PENDING_H
#define TRACE_PENDING_H

#include "trace/bvh/bvh.h"
#include "trace/bvh/wide.h"

typedef struct {
    uint32_t child;
    float from, to; /* ways between which some flight may be in its box */
} pending;

/* Puts the children onto the stack, the nearest on top; returns how many. */
static inline int push_children(const sp_bvh_node *node, uint32_t mask, wide from, wide to, pending *stack)
{
    float first[8], last[8];
    int count = 0;
    wide_store(first, from);
    wide_store(last, to);
    for (; mask; mask &= mask - 1) {
        int i = __builtin_ctz(mask), place = count++;
        pending item = {node->child[i], first[i], last[i]};
        for (; place > 0 && stack[place - 1].from < item.from; place--)
            stack[place] = stack[place - 1];
        stack[place] = item;
    }
    return count;
}

#endif
