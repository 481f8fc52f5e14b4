/* Disjoint sets of numbers, each a tree by `parent`; a root is its own parent, and the least of its set. */
#ifndef MESH_DISJOINT_SETS_H
#define MESH_DISJOINT_SETS_H

#include <assert.h>
#include <stdbool.h>
#include <stdint.h>

/* Halves the path on the way. */
static inline uint32_t sp_set_root(uint32_t *parent, uint32_t node)
{
    while (parent[node] != node) {
        assert(parent[node] < node);
        parent[node] = parent[parent[node]];
        node = parent[node];
    }
    return node;
}

/* False where they were one already. */
static inline bool sp_set_join(uint32_t *parent, uint32_t a, uint32_t b)
{
    a = sp_set_root(parent, a);
    b = sp_set_root(parent, b);
    if (a < b)
        parent[b] = a;
    else
        parent[a] = b;
    return a != b;
}

#endif
