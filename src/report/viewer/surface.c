#include "surface.h"

#include "mesh/grow.h"

#include <stdlib.h>

#define FULL 65535.0

/* One side of a triangle, and where it comes in the order of parts, pages and layers. */
typedef struct {
    uint64_t order;
    uint32_t triangle;
} drawn_side;

static int by_order(const void *left, const void *right)
{
    const drawn_side *a = left, *b = right;
    if (a->order != b->order)
        return a->order < b->order ? -1 : 1;
    return (a->triangle > b->triangle) - (a->triangle < b->triangle);
}

/* Page 0 stands for what needs no cleaning. */
static uint64_t order_of(uint32_t part, uint32_t page, int layer, const sp_atlas *atlas)
{
    return ((uint64_t)part * (atlas->page_count + 1) + (page == SP_NONE ? 0 : (uint64_t)page + 1)) * 2 +
           (uint64_t)layer;
}

static sp_drawn_range range_of(uint64_t order, const sp_atlas *atlas)
{
    uint64_t page = order / 2 % (atlas->page_count + 1);
    return (sp_drawn_range){.part = (uint32_t)(order / 2 / (atlas->page_count + 1)),
                            .page = page ? (uint32_t)page - 1 : SP_NONE,
                            .layer = (int)(order % 2)};
}

/* The sides that are drawn, sorted, and how many (*count is 0 before); of what takes liquid from either side as one,
 * the front stands for both. */
static drawn_side *list_sides(const sp_layers *layers, size_t *count, sp_error *error)
{
    const sp_mesh *mesh = sp_evaluator_setup(layers->evaluator)->mesh;
    const sp_atlas *atlas = sp_evaluator_atlas(layers->evaluator);
    drawn_side *sides = malloc((2 * mesh->triangle_count + 1) * sizeof *sides);
    if (!sides)
        return sp_fail_memory(error);
    for (uint32_t t = 0; t < mesh->triangle_count; ++t)
        for (int layer = 0; layer < (layers->two_sided ? 1 : 2); ++layer) {
            if (!sp_layers_wet(layers, t, layer))
                continue;
            uint32_t page = sp_layers_clean(layers, t, layer) ? atlas->chart_page[atlas->chart[t]] : SP_NONE;
            sides[(*count)++] = (drawn_side){order_of(mesh->part[t], page, layer, atlas), t};
        }
    qsort(sides, *count, sizeof *sides, by_order);
    return sides;
}

/* Vertices of the drawing by the vertex of the mesh that they are at: a chain of those that differ in the texture. */
typedef struct {
    sp_drawn_surface *surface;
    const sp_evaluator *evaluator;
    size_t room;
    uint32_t *first; /* [vertex_count of the mesh], SP_NONE: none yet */
    uint32_t *next;  /* [room] */
} vertices;

static uint16_t in_parts(double value, double low, double high)
{
    return high > low ? (uint16_t)lrint(FULL * fmin(fmax((value - low) / (high - low), 0), 1)) : 0;
}

static bool make_room(vertices *v)
{
    size_t room = v->room ? 2 * v->room : 1024;
    for (int k = 0; k < SP_DRAWN_NUMBERS; ++k)
        if (!sp_reallocate(&v->surface->numbers[k], room, sizeof(uint16_t)))
            return false;
    if (!sp_reallocate(&v->next, room, sizeof *v->next))
        return false;
    v->room = room;
    return true;
}

/* The number of the vertex at a corner of a triangle, made where there is none; SP_NONE when memory runs out. */
static uint32_t vertex_at(vertices *v, uint32_t triangle, int corner)
{
    const sp_atlas *atlas = sp_evaluator_atlas(v->evaluator);
    const sp_mesh *mesh = sp_evaluator_setup(v->evaluator)->mesh;
    sp_drawn_surface *s = v->surface;
    uint32_t at = mesh->triangles[triangle][corner];
    uint16_t spot[2] = {in_parts(atlas->uv[triangle][corner][0], 0, atlas->page_edge),
                        in_parts(atlas->uv[triangle][corner][1], 0, atlas->page_edge)};
    for (uint32_t i = v->first[at]; i != SP_NONE; i = v->next[i])
        if (s->numbers[SP_DRAWN_U][i] == spot[0] && s->numbers[SP_DRAWN_V][i] == spot[1])
            return i;
    if (s->vertex_count == SP_NONE || (s->vertex_count == v->room && !make_room(v)))
        return SP_NONE;
    uint32_t made = (uint32_t)s->vertex_count++;
    sp_vec3 p = mesh->vertices[at];
    s->numbers[SP_DRAWN_X][made] = in_parts(p.x, s->low.x, s->high.x);
    s->numbers[SP_DRAWN_Y][made] = in_parts(p.y, s->low.y, s->high.y);
    s->numbers[SP_DRAWN_Z][made] = in_parts(p.z, s->low.z, s->high.z);
    s->numbers[SP_DRAWN_U][made] = spot[0];
    s->numbers[SP_DRAWN_V][made] = spot[1];
    v->next[made] = v->first[at];
    v->first[at] = made;
    return made;
}

static void box_of(sp_drawn_surface *surface, const sp_mesh *mesh, const drawn_side *sides, size_t count)
{
    surface->low = sp_v(INFINITY, INFINITY, INFINITY);
    surface->high = sp_v(-INFINITY, -INFINITY, -INFINITY);
    for (size_t i = 0; i < count; ++i)
        for (int k = 0; k < 3; ++k) {
            sp_vec3 p = mesh->vertices[mesh->triangles[sides[i].triangle][k]];
            surface->low = sp_v(fmin(surface->low.x, p.x), fmin(surface->low.y, p.y), fmin(surface->low.z, p.z));
            surface->high = sp_v(fmax(surface->high.x, p.x), fmax(surface->high.y, p.y), fmax(surface->high.z, p.z));
        }
    if (count == 0)
        surface->low = surface->high = sp_v(0, 0, 0);
}

static bool fill(vertices *v, const drawn_side *sides, size_t count)
{
    sp_drawn_surface *s = v->surface;
    size_t ranges = 0;
    for (size_t i = 0; i < count; ++i) {
        if (i == 0 || sides[i].order != sides[i - 1].order) {
            s->range_count++;
            if (!sp_grow(&s->ranges, &ranges, s->range_count, sizeof *s->ranges))
                return false;
            s->ranges[s->range_count - 1] = range_of(sides[i].order, sp_evaluator_atlas(v->evaluator));
            s->ranges[s->range_count - 1].first = i;
        }
        s->ranges[s->range_count - 1].count++;
        for (int k = 0; k < 3; ++k) {
            uint32_t vertex = vertex_at(v, sides[i].triangle, sides[i].order % 2 ? 2 - k : k);
            if (vertex == SP_NONE)
                return false;
            s->corners[i][k] = vertex;
        }
    }
    s->triangle_count = count;
    return true;
}

bool sp_drawn_surface_create(sp_drawn_surface *surface, const sp_layers *layers, sp_error *error)
{
    *surface = (sp_drawn_surface){0};
    const sp_mesh *mesh = sp_evaluator_setup(layers->evaluator)->mesh;
    size_t count = 0;
    drawn_side *sides = list_sides(layers, &count, error);
    if (!sides)
        return false;
    box_of(surface, mesh, sides, count);
    surface->corners = malloc((count + 1) * sizeof *surface->corners);
    vertices v = {surface, layers->evaluator, 0, malloc((mesh->vertex_count + 1) * sizeof(uint32_t)), NULL};
    if (v.first)
        memset(v.first, 0xff, (mesh->vertex_count + 1) * sizeof *v.first);
    bool done = surface->corners && v.first && fill(&v, sides, count);
    free(v.first);
    free(v.next);
    free(sides);
    if (!done)
        sp_drawn_surface_free(surface);
    return done || sp_fail_memory(error);
}

void sp_drawn_surface_free(sp_drawn_surface *surface)
{
    for (int k = 0; k < SP_DRAWN_NUMBERS; ++k)
        free(surface->numbers[k]);
    free(surface->corners);
    free(surface->ranges);
    *surface = (sp_drawn_surface){0};
}
