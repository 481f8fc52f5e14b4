/* The wide bounding volume hierarchy: eight children a node, eight triangles a leaf, shared by lines and parabolas.
 *
 * It lives in a space of its own in which single precision is enough to leave out what is far away: a point p (m) is at
 * (p - centre) scale there, every coordinate of the mesh within -1..1. Boxes are rounded outwards and then widened by
 * SP_BVH_PAD, corners are rounded to the nearest. Whatever decides an answer is computed from the mesh, in double. */
#ifndef SPRAYPLAN_TRACE_BVH_H
#define SPRAYPLAN_TRACE_BVH_H

#include "trace/ray/search.h"
#include "trace/ray/visit.h"

#include <string.h>

enum {
    SP_BVH_WIDTH = 8,
    SP_BVH_STACK = 288, /* what a walk depth first ever has pending: 7 a level and the root */
};
#define SP_BVH_LEAF 0x80000000u
#define SP_BVH_PAD 0x1p-18f

/* Child i spans origin + low step to origin + high step. Children in use come first; the others' boxes are inside out.
 */
typedef struct {
    float origin[3], step[3];
    uint8_t low[3][SP_BVH_WIDTH], high[3][SP_BVH_WIDTH];
    uint32_t child[SP_BVH_WIDTH]; /* a node's number, or a block's with SP_BVH_LEAF */
    uint32_t count;               /* children in use */
    /* The children from far to near, three bits each from the lowest on, for lines that rise along x: [1] where they
     * fall along y, [2] along z, [3] along both. For lines that fall along x, the other way round. */
    uint32_t order[4];
    uint32_t unused; /* a node is two lines of the cache */
} sp_bvh_node;

/* A leaf. Slots in use come first; the others have corners that are no numbers. */
typedef struct {
    float corner[3][3][SP_BVH_WIDTH]; /* [corner][axis][slot] */
    uint32_t triangle[SP_BVH_WIDTH];  /* its number in the mesh, SP_NONE in slots not in use */
} sp_bvh_block;

typedef struct {
    const sp_mesh *mesh;
    double centre[3], scale; /* m, 1/m; scale is a power of two */
    double low[3], high[3];  /* the box around all triangles, m */
    sp_bvh_node *nodes;      /* [node_count], on lines of the cache; nodes[0] is the root; none without triangles */
    sp_bvh_block *blocks;    /* [block_count], likewise */
    size_t node_count, block_count;
} sp_bvh;

/* Builds by the surface area heuristic. The tree is the same whatever the number of threads. False when memory or the
 * numbers for nodes run out. */
bool sp_bvh_build(const sp_mesh *mesh, int threads, sp_bvh *bvh);
void sp_bvh_clear(sp_bvh *bvh);

/* sp_tracer_visit. */
bool sp_bvh_visit(const sp_bvh *bvh, sp_box_test *test, sp_triangle_visitor *visit, const void *region);

/* sp_tracer_leaves. */
void sp_bvh_leaves(const sp_bvh *bvh, double (*boxes)[6]);

/* The corners of a triangle, m. */
static inline void sp_bvh_corners(const sp_bvh *bvh, uint32_t triangle, sp_corners corners)
{
    const uint32_t *vertex = bvh->mesh->triangles[triangle];
    for (int i = 0; i < 3; i++)
        sp_to_array(bvh->mesh->vertices[vertex[i]], corners[i]);
}

/* A child's box as a walk in double precision sees it, m. */
static inline void sp_bvh_child_box(const sp_bvh *bvh, const sp_bvh_node *node, uint32_t child, double low[3],
                                    double high[3])
{
    for (int axis = 0; axis < 3; axis++) {
        double origin = node->origin[axis], step = node->step[axis];
        low[axis] = bvh->centre[axis] + (origin + node->low[axis][child] * step) / bvh->scale;
        high[axis] = bvh->centre[axis] + (origin + node->high[axis][child] * step) / bvh->scale;
    }
}

/* Prefetches a node or block. */
static inline void sp_bvh_prefetch(const sp_bvh *bvh, uint32_t child)
{
    if (child & SP_BVH_LEAF) {
        const char *block = (const char *)&bvh->blocks[child - SP_BVH_LEAF];
        for (size_t line = 0; line < sizeof(sp_bvh_block); line += 64)
            __builtin_prefetch(block + line);
    } else {
        const char *node = (const char *)&bvh->nodes[child];
        __builtin_prefetch(node);
        __builtin_prefetch(node + 64);
    }
}

/* Prefetches a triangle's corners. */
static inline void sp_bvh_prefetch_corners(const sp_bvh *bvh, uint32_t triangle)
{
    const sp_mesh *mesh = bvh->mesh;
    for (int i = 0; i < 3; i++)
        __builtin_prefetch(&mesh->vertices[mesh->triangles[triangle][i]]);
}

/* The power of two above a positive number, and its inverse. */
static inline double sp_bvh_power_above(double a, double *inverse)
{
    uint64_t bits;
    double power;
    memcpy(&bits, &a, sizeof bits);
    bits = (bits & 0x7FF0000000000000u) + 0x0010000000000000u;
    memcpy(&power, &bits, sizeof power);
    bits = 0x7FE0000000000000u - bits;
    memcpy(inverse, &bits, sizeof bits);
    return power;
}

#endif
