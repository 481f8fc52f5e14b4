#include "spray/wet/arrays.h"

#include "mesh/grow.h"

#include <stdlib.h>
#include <string.h>

/* Children that are still to be written. */
typedef struct {
    uint32_t *items;
    size_t count, room;
} stack;

static bool push(stack *open, uint32_t child)
{
    if (!sp_grow(&open->items, &open->room, open->count + 1, sizeof *open->items))
        return false;
    open->items[open->count++] = child;
    return true;
}

static bool list_triangle(const sp_wet *wet, size_t triangle_count, uint32_t triangle, stack *open,
                          sp_wet_arrays *arrays, size_t room[2])
{
    bool done = push(open, wet->cuts.root[triangle]);
    while (done && open->count) {
        uint32_t child = open->items[--open->count];
        const bool *liquid = &wet->flooded.liquid[2 * (triangle_count + (child & ~SP_CELL))];
        if (!sp_grow(&arrays->nodes, &room[0], arrays->node_count + 1, 1))
            return false;
        arrays->nodes[arrays->node_count++] =
            child & SP_CELL ? (uint8_t)(liquid[0] | liquid[1] << 1) : (uint8_t)SP_WET_CUT;
        if (child & SP_CELL)
            continue;
        const sp_cut *cut = &wet->cuts.cuts[child];
        if (!sp_grow(&arrays->cuts, &room[1], arrays->cut_count + 1, sizeof *arrays->cuts))
            return false;
        memcpy(arrays->cuts[arrays->cut_count++], (double[]){cut->a, cut->b, cut->c}, sizeof *arrays->cuts);
        done = push(open, cut->child[1]) && push(open, cut->child[0]);
    }
    return done;
}

bool sp_wet_arrays_create(const sp_wet *wet, size_t triangle_count, sp_wet_arrays *arrays, sp_error *error)
{
    *arrays = (sp_wet_arrays){.sides = malloc(triangle_count + 1)};
    stack open = {0};
    size_t room[2] = {0, 0};
    bool done = arrays->sides != NULL;
    for (uint32_t t = 0; done && t < triangle_count; t++) {
        arrays->sides[t] = (uint8_t)(wet->sides[t] | wet->whole[t] << 2);
        if (wet->sides[t] != wet->whole[t])
            done = list_triangle(wet, triangle_count, t, &open, arrays, room);
    }
    free(open.items);
    return done || sp_fail_memory(error);
}

void sp_wet_arrays_free(sp_wet_arrays *arrays)
{
    free(arrays->sides);
    free(arrays->nodes);
    free(arrays->cuts);
    *arrays = (sp_wet_arrays){0};
}

/* The wet sides while they are made. */
typedef struct {
    sp_wet *wet;
    size_t triangle_count, node, cut;
    const sp_wet_arrays *arrays;
} making;

/* The node in hand as a child: a cell, or a cut whose children are set when their turn comes. SP_NONE where there is
 * none. */
static uint32_t take_node(making *m, uint32_t triangle)
{
    sp_cuts *cuts = &m->wet->cuts;
    if (m->node == m->arrays->node_count)
        return SP_NONE;
    uint8_t node = m->arrays->nodes[m->node++];
    if (node < SP_WET_CUT) {
        bool *liquid = &m->wet->flooded.liquid[2 * (m->triangle_count + cuts->cell_count)];
        liquid[0] = node & 1;
        liquid[1] = node >> 1;
        cuts->cell_triangle[cuts->cell_count] = triangle;
        return (uint32_t)cuts->cell_count++ | SP_CELL;
    }
    if (node > SP_WET_CUT || m->cut == m->arrays->cut_count)
        return SP_NONE;
    const double *line = m->arrays->cuts[m->cut++];
    cuts->cuts[cuts->cut_count] = (sp_cut){line[0], line[1], line[2], {SP_NONE, SP_NONE}};
    return (uint32_t)cuts->cut_count++;
}

/* `open`: the cuts, each twice, that want a child, the next last. */
static bool make_triangle(making *m, uint32_t triangle, stack *open)
{
    sp_cuts *cuts = &m->wet->cuts;
    uint32_t *child = &cuts->root[triangle];
    for (;;) {
        uint32_t made = *child = take_node(m, triangle);
        if (made == SP_NONE || (!(made & SP_CELL) && (!push(open, made) || !push(open, made))))
            return false;
        if (!open->count)
            return true;
        uint32_t *wanting = cuts->cuts[open->items[--open->count]].child;
        child = &wanting[wanting[0] != SP_NONE];
    }
}

static bool make_room(const sp_mesh *mesh, const sp_wet_arrays *arrays, sp_wet *wet)
{
    size_t triangles = mesh->triangle_count, cells = arrays->node_count;
    sp_cuts *cuts = &wet->cuts;
    wet->sides = malloc(triangles + 1);
    wet->whole = malloc(triangles + 1);
    wet->flooded.liquid = calloc(2 * (triangles + cells) + 1, sizeof *wet->flooded.liquid);
    cuts->root = malloc((triangles + 1) * sizeof *cuts->root);
    cuts->cuts = malloc((arrays->cut_count + 1) * sizeof *cuts->cuts);
    cuts->cell_triangle = malloc((cells + 1) * sizeof *cuts->cell_triangle);
    wet->faces.mesh = mesh;
    wet->faces.cuts = cuts;
    return wet->sides && wet->whole && wet->flooded.liquid && cuts->root && cuts->cuts && cuts->cell_triangle;
}

sp_wet *sp_wet_restore(const sp_mesh *mesh, const sp_wet_arrays *arrays, sp_error *error)
{
    sp_wet *wet = calloc(1, sizeof *wet);
    making m = {wet, mesh->triangle_count, 0, 0, arrays};
    stack open = {0};
    bool room = wet && make_room(mesh, arrays, wet), done = room;
    for (uint32_t t = 0; done && t < mesh->triangle_count; t++) {
        wet->sides[t] = arrays->sides[t] & 3;
        wet->whole[t] = arrays->sides[t] >> 2 & 3;
        wet->cuts.root[t] = SP_NONE;
        for (unsigned side = 0; side < 2; side++)
            wet->flooded.liquid[2 * t + side] = wet->whole[t] >> side & 1;
        done = wet->sides[t] == wet->whole[t] || make_triangle(&m, t, &open);
    }
    free(open.items);
    if (done && m.node == arrays->node_count && m.cut == arrays->cut_count)
        return wet;
    sp_wet_destroy(wet);
    return room ? sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "wet sides: cuts do not belong together"),
           NULL : sp_fail_memory(error);
}
