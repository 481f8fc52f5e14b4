/* Building kd-trees: cells are split by planes that a chooser names. */
#include "trace/kd_tree.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

static bool add_node(kd_tree *tree, kd_node node)
{
    if (tree->node_count == tree->node_capacity) {
        size_t capacity = tree->node_capacity ? 2 * tree->node_capacity : 64;
        kd_node *nodes = realloc(tree->nodes, capacity * sizeof *nodes);
        if (!nodes)
            return false;
        tree->nodes = nodes;
        tree->node_capacity = capacity;
    }
    tree->nodes[tree->node_count++] = node;
    return true;
}

static bool add_leaf(kd_tree *tree, const kd_cell *cell)
{
    if (tree->ref_count + cell->count > SP_NONE)
        return false;
    while (tree->ref_count + cell->count > tree->ref_capacity) {
        size_t capacity = tree->ref_capacity ? 2 * tree->ref_capacity : 256;
        uint32_t *refs = realloc(tree->refs, capacity * sizeof *refs);
        if (!refs)
            return false;
        tree->refs = refs;
        tree->ref_capacity = capacity;
    }
    kd_node leaf = {.axis = KD_LEAF, .right = (uint32_t)cell->count, .first = (uint32_t)tree->ref_count};
    if (cell->count)
        memcpy(tree->refs + tree->ref_count, cell->triangles, cell->count * sizeof *tree->refs);
    tree->ref_count += cell->count;
    return add_node(tree, leaf);
}

static kd_box *triangle_boxes(const sp_mesh *mesh)
{
    kd_box *boxes = malloc((mesh->triangle_count + 1) * sizeof *boxes);
    for (size_t t = 0; boxes && t < mesh->triangle_count; t++)
        for (int axis = 0; axis < 3; axis++) {
            boxes[t][0][axis] = DBL_MAX;
            boxes[t][1][axis] = -DBL_MAX;
            for (int i = 0; i < 3; i++) {
                sp_vec3 p = mesh->vertices[mesh->triangles[t][i]];
                double x = axis == 0 ? p.x : axis == 1 ? p.y : p.z;
                boxes[t][0][axis] = fmin(boxes[t][0][axis], x);
                boxes[t][1][axis] = fmax(boxes[t][1][axis], x);
            }
        }
    return boxes;
}

static bool whole_mesh(const sp_mesh *mesh, const kd_box *boxes, kd_tree *tree, kd_cell *cell)
{
    *cell = (kd_cell){.count = mesh->triangle_count,
                      .triangles = malloc((mesh->triangle_count + 1) * sizeof *cell->triangles)};
    for (int axis = 0; axis < 3; axis++) {
        double low = DBL_MAX, high = -DBL_MAX;
        for (size_t t = 0; t < mesh->triangle_count; t++) {
            low = fmin(low, boxes[t][0][axis]);
            high = fmax(high, boxes[t][1][axis]);
        }
        cell->low[axis] = tree->low[axis] = low;
        cell->high[axis] = tree->high[axis] = high;
    }
    for (size_t t = 0; cell->triangles && t < mesh->triangle_count; t++)
        cell->triangles[t] = (uint32_t)t;
    return cell->triangles != NULL;
}

/* A triangle within the plane goes left; one that only touches it goes to its own side: the walk widens every plane by more
 * than round-off. */
static bool split_cell(const kd_box *boxes, const kd_cell *cell, kd_plane plane, kd_cell *left, kd_cell *right)
{
    *left = *right = *cell;
    left->high[plane.axis] = right->low[plane.axis] = plane.position;
    left->count = right->count = 0;
    left->triangles = malloc((cell->count + 1) * sizeof *left->triangles);
    right->triangles = malloc((cell->count + 1) * sizeof *right->triangles);
    if (!left->triangles || !right->triangles)
        return false;
    for (size_t i = 0; i < cell->count; i++) {
        uint32_t t = cell->triangles[i];
        double low = boxes[t][0][plane.axis], high = boxes[t][1][plane.axis];
        if (low < plane.position || high <= plane.position)
            left->triangles[left->count++] = t;
        if (high > plane.position)
            right->triangles[right->count++] = t;
    }
    return true;
}

/* Takes over the cell's triangles. */
static bool build_node(const kd_box *boxes, kd_choose *choose, kd_cell *cell, int depth, kd_tree *tree)
{
    kd_plane plane = {.axis = KD_LEAF};
    kd_cell left = {0}, right = {0};
    bool good = depth == 0 || choose(boxes, cell, &plane);
    if (good && plane.axis == KD_LEAF)
        good = add_leaf(tree, cell);
    else if (good)
        good = split_cell(boxes, cell, plane, &left, &right);
    free(cell->triangles);
    cell->triangles = NULL;
    if (good && plane.axis != KD_LEAF) {
        size_t here = tree->node_count;
        good = add_node(tree, (kd_node){.split = plane.position, .axis = plane.axis}) &&
               build_node(boxes, choose, &left, depth - 1, tree);
        if (good) {
            tree->nodes[here].right = (uint32_t)tree->node_count;
            good = build_node(boxes, choose, &right, depth - 1, tree);
        }
    }
    free(left.triangles);
    free(right.triangles);
    return good;
}

bool kd_tree_build(const sp_mesh *mesh, kd_choose *choose, kd_tree *tree)
{
    *tree = (kd_tree){0};
    kd_box *boxes = triangle_boxes(mesh);
    kd_cell cell;
    int depth = (int)(8 + 1.3 * log2((double)mesh->triangle_count + 1));
    bool good = boxes && whole_mesh(mesh, boxes, tree, &cell) &&
                build_node(boxes, choose, &cell, depth < KD_DEPTH ? depth : KD_DEPTH, tree);
    free(boxes);
    if (!good)
        kd_tree_free(tree);
    return good;
}

static bool choose_none(const kd_box *boxes, const kd_cell *cell, kd_plane *plane)
{
    (void)boxes;
    (void)cell;
    plane->axis = KD_LEAF;
    return true;
}

bool kd_tree_leaf(const sp_mesh *mesh, kd_tree *tree) { return kd_tree_build(mesh, choose_none, tree); }

void kd_tree_free(kd_tree *tree)
{
    free(tree->nodes);
    free(tree->refs);
    *tree = (kd_tree){0};
}
