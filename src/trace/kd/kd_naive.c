/* The naive kd-tree: every cell is halved across its longest side until few triangles are left (study, 3.2.2.1). */
#include "trace/kd/kd_tree.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

enum { FEW = 6 };

typedef struct {
    double low[3], high[3];
    uint32_t *triangles;
    size_t count;
    double duplication; /* how many times more references its children's children may hold than it does */
} cell;

typedef struct {
    const sp_kd_box *boxes;
    sp_kd_tree *tree;
} builder;

static bool make_leaf(const builder *b, const cell *c)
{
    uint32_t *references = sp_kd_add_leaf(b->tree, c->count);
    if (references && c->count)
        memcpy(references, c->triangles, c->count * sizeof *references);
    return references != NULL;
}

static int longest_side(const cell *c)
{
    int longest = 0;
    for (int axis = 1; axis < 3; axis++)
        if (c->high[axis] - c->low[axis] > c->high[longest] - c->low[longest])
            longest = axis;
    return longest;
}

/* What touches the plane goes to both sides. */
static bool divide(const builder *b, const cell *c, int axis, double split, cell *left, cell *right)
{
    *left = *right = *c;
    left->high[axis] = right->low[axis] = split;
    left->count = right->count = 0;
    left->triangles = malloc(c->count * sizeof *left->triangles);
    right->triangles = malloc(c->count * sizeof *right->triangles);
    if (!left->triangles || !right->triangles)
        return false;
    for (size_t i = 0; i < c->count; i++) {
        uint32_t t = c->triangles[i];
        if (b->boxes[t][0][axis] <= split)
            left->triangles[left->count++] = t;
        if (b->boxes[t][1][axis] >= split)
            right->triangles[right->count++] = t;
    }
    assert(left->count + right->count >= c->count);
    left->duplication = right->duplication = c->duplication * (double)c->count / (double)(left->count + right->count);
    return true;
}

/* Frees the cell's triangles. */
static bool build(const builder *b, cell *c, int depth)
{
    int axis = longest_side(c);
    double split = 0.5 * (c->low[axis] + c->high[axis]);
    cell left = {0}, right = {0};
    bool inner = depth > 0 && c->count > FEW && split > c->low[axis] && split < c->high[axis];
    bool good = !inner || divide(b, c, axis, split, &left, &right);
    inner = inner && left.duplication >= 1;
    uint32_t node = 0;
    good = good && (inner ? sp_kd_add_inner(b->tree, split, (uint32_t)axis, &node) : make_leaf(b, c));
    free(c->triangles);
    c->triangles = NULL;
    if (good && inner) {
        good = build(b, &left, depth - 1);
        b->tree->nodes[node].right = (uint32_t)b->tree->node_count;
        assert(b->tree->nodes[node].right > node + 1);
        good = good && build(b, &right, depth - 1);
    }
    free(left.triangles);
    free(right.triangles);
    return good;
}

bool sp_kd_build_naive(const sp_mesh *mesh, sp_kd_tree *tree)
{
    size_t count = mesh->triangle_count;
    sp_kd_box *boxes = sp_kd_boxes(mesh);
    cell root = {
        .triangles = malloc((count + 1) * sizeof *root.triangles), .count = count, .duplication = SP_KD_DUPLICATION};
    bool good = boxes && root.triangles;
    if (good) {
        sp_kd_enclose((const sp_kd_box *)boxes, count, tree);
        memcpy(root.low, tree->low, sizeof root.low);
        memcpy(root.high, tree->high, sizeof root.high);
        for (size_t t = 0; t < count; t++)
            root.triangles[t] = (uint32_t)t;
        builder b = {(const sp_kd_box *)boxes, tree};
        good = build(&b, &root, sp_kd_depth(count));
    }
    free(root.triangles);
    free(boxes);
    return good;
}
