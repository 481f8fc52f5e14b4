/* A kd-tree over the triangles of a mesh: the study's two ways of building one. */
#ifndef TRACE_KD_TREE_H
#define TRACE_KD_TREE_H

#include <sprayplan/trace.h>

/* An inner node's left child follows it; a leaf lists triangles. */
typedef struct {
    double split;   /* m; inner nodes */
    uint32_t axis;  /* 0, 1, 2; KD_LEAF for a leaf */
    uint32_t right; /* inner nodes: the right child; leaves: how many triangles */
    uint32_t first; /* leaves: index into refs */
} kd_node;

enum { KD_LEAF = 3, KD_DEPTH = 60 };

typedef struct {
    kd_node *nodes;
    size_t node_count, node_capacity;
    uint32_t *refs; /* triangles of the leaves */
    size_t ref_count, ref_capacity;
    double low[3], high[3]; /* box around the mesh, m */
} kd_tree;

/* The whole mesh as one leaf; what the two builders begin with, and all there is without a tree. */
bool kd_tree_leaf(const sp_mesh *mesh, kd_tree *tree);
/* kd_naive.c, kd_sah.c. False when memory runs out. */
bool kd_tree_naive(const sp_mesh *mesh, kd_tree *tree);
bool kd_tree_sah(const sp_mesh *mesh, kd_tree *tree);
void kd_tree_free(kd_tree *tree);

/* A box and the triangles that reach into it, while building. */
typedef struct {
    double low[3], high[3];
    size_t count;
    uint32_t *triangles; /* malloc'd */
} kd_cell;

/* The plane that a builder chooses for a cell; axis KD_LEAF for none. */
typedef struct {
    double position;
    uint32_t axis;
} kd_plane;

/* boxes: [triangle_count], the box of each triangle, low then high. */
typedef double kd_box[2][3];
/* Sets *plane; false when memory runs out. */
typedef bool kd_choose(const kd_box *boxes, const kd_cell *cell, kd_plane *plane);
/* Splits by `choose` until it chooses none or the depth is spent (8 + 1.3 log2 n, Havran 2000). */
bool kd_tree_build(const sp_mesh *mesh, kd_choose *choose, kd_tree *tree);

#endif
