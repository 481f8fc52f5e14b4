/* Kd-trees over the triangles of a mesh (the study's chapter 3.2.2), and how they are built. */
#ifndef SPRAYPLAN_TRACE_KD_TREE_H
#define SPRAYPLAN_TRACE_KD_TREE_H

#include <sprayplan/mesh.h>

/* An inner node's left child follows it. */
typedef struct {
    double split;   /* m, of an inner node */
    uint32_t right; /* of an inner node; of a leaf, where its triangles begin in `references` */
    uint32_t size;  /* 4 times the number of triangles of a leaf, plus the split axis or SP_KD_LEAF */
} sp_kd_node;

enum {
    SP_KD_LEAF = 3,
    SP_KD_DEPTH = 64,       /* no node is deeper */
    SP_KD_DUPLICATION = 32, /* no more references than this times the number of triangles */
};

typedef struct {
    sp_kd_node *nodes;
    size_t node_count, node_room;
    uint32_t *references; /* the triangles of the leaves */
    size_t reference_count, reference_room;
    double low[3], high[3]; /* box around all triangles, m */
} sp_kd_tree;

/* Box of a triangle: low, high. */
typedef double sp_kd_box[2][3];
/* [triangle_count]; NULL when memory runs out. */
sp_kd_box *sp_kd_boxes(const sp_mesh *mesh);
/* Sets tree->low and tree->high. */
void sp_kd_enclose(const sp_kd_box *boxes, size_t count, sp_kd_tree *tree);
/* How deep a tree over so many triangles may grow: 8 + 1.3 log2 n (Havran, "Heuristic Ray Shooting Algorithms", 2000).
 */
int sp_kd_depth(size_t triangle_count);
/* Both false when memory, or the numbers for references, run out. */
bool sp_kd_add_inner(sp_kd_tree *tree, double split, uint32_t axis, uint32_t *node);
/* Room for a leaf's triangles, to be filled by the caller; NULL as above. */
uint32_t *sp_kd_add_leaf(sp_kd_tree *tree, size_t count);

/* The two ways to build, each into a tree of zeros. False when memory runs out. */
bool sp_kd_build_sah(const sp_mesh *mesh, sp_kd_tree *tree);
bool sp_kd_build_naive(const sp_mesh *mesh, sp_kd_tree *tree);
void sp_kd_clear(sp_kd_tree *tree);

#endif
