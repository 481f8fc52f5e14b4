#include "trace/kd/kd_tree.h"

#include <assert.h>
#include <stdlib.h>

sp_kd_box *sp_kd_boxes(const sp_mesh *mesh)
{
    sp_kd_box *boxes = malloc((mesh->triangle_count + 1) * sizeof *boxes);
    for (size_t t = 0; boxes && t < mesh->triangle_count; t++) {
        const uint32_t *corners = mesh->triangles[t];
        sp_vec3 a = mesh->vertices[corners[0]], b = mesh->vertices[corners[1]], c = mesh->vertices[corners[2]];
        boxes[t][0][0] = fmin(a.x, fmin(b.x, c.x));
        boxes[t][0][1] = fmin(a.y, fmin(b.y, c.y));
        boxes[t][0][2] = fmin(a.z, fmin(b.z, c.z));
        boxes[t][1][0] = fmax(a.x, fmax(b.x, c.x));
        boxes[t][1][1] = fmax(a.y, fmax(b.y, c.y));
        boxes[t][1][2] = fmax(a.z, fmax(b.z, c.z));
    }
    return boxes;
}

void sp_kd_enclose(const sp_kd_box *boxes, size_t count, sp_kd_tree *tree)
{
    for (int axis = 0; axis < 3; axis++) {
        tree->low[axis] = count ? boxes[0][0][axis] : 0;
        tree->high[axis] = count ? boxes[0][1][axis] : 0;
        for (size_t t = 1; t < count; t++) {
            tree->low[axis] = fmin(tree->low[axis], boxes[t][0][axis]);
            tree->high[axis] = fmax(tree->high[axis], boxes[t][1][axis]);
        }
    }
}

int sp_kd_depth(size_t triangle_count)
{
    int depth = (int)(8 + 1.3 * log2((double)triangle_count + 1));
    return depth < SP_KD_DEPTH ? depth : SP_KD_DEPTH;
}

/* Room for `count` more items of `size` bytes. */
static bool make_room(void **items, size_t *room, size_t used, size_t count, size_t size)
{
    if (count <= *room - used)
        return true;
    size_t more = 2 * *room > used + count ? 2 * *room : used + count + 64;
    void *larger = more < SP_NONE ? realloc(*items, more * size) : NULL;
    if (!larger)
        return false;
    *items = larger;
    *room = more;
    return true;
}

static bool add_node(sp_kd_tree *tree, sp_kd_node node)
{
    void *items = tree->nodes;
    bool good = make_room(&items, &tree->node_room, tree->node_count, 1, sizeof node);
    tree->nodes = items;
    if (good)
        tree->nodes[tree->node_count++] = node;
    return good;
}

bool sp_kd_add_inner(sp_kd_tree *tree, double split, uint32_t axis, uint32_t *node)
{
    assert(axis < SP_KD_LEAF && !isnan(split));
    *node = (uint32_t)tree->node_count;
    return add_node(tree, (sp_kd_node){split, 0, axis});
}

uint32_t *sp_kd_add_leaf(sp_kd_tree *tree, size_t count)
{
    size_t first = tree->reference_count;
    void *items = tree->references;
    /* One more, so that an empty leaf has a place too. */
    bool good =
        count < SP_NONE / 4 && make_room(&items, &tree->reference_room, first, count + 1, sizeof *tree->references);
    tree->references = items;
    if (!good || !add_node(tree, (sp_kd_node){0, (uint32_t)first, (uint32_t)(4 * count) + SP_KD_LEAF}))
        return NULL;
    tree->reference_count += count;
    assert(tree->reference_count <= tree->reference_room);
    return tree->references + first;
}

void sp_kd_clear(sp_kd_tree *tree)
{
    free(tree->nodes);
    free(tree->references);
    *tree = (sp_kd_tree){0};
}
