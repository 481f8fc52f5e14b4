#include "surface.h"

#include "mesh/grow.h"

#include <stdlib.h>
#include <string.h>

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

/* Vertices of the drawing by the vertex of the mesh that they are at: a chain of those that differ in the texture or
 * the part, the latest first. */
typedef struct {
    sp_drawn_surface *surface;
    const sp_evaluator *evaluator;
    size_t room;
    size_t part_first; /* vertex, of the part that is being drawn */
    uint32_t *first;   /* [vertex_count of the mesh], SP_NONE: none yet */
    uint32_t *next;    /* [room] */
} vertices;

static bool make_room(vertices *v)
{
    size_t room = v->room ? 2 * v->room : 1024;
    if (!sp_reallocate(&v->surface->vertices, room, sizeof *v->surface->vertices) ||
        !sp_reallocate(&v->next, room, sizeof *v->next))
        return false;
    v->room = room;
    return true;
}

/* The number of the vertex at a corner of a triangle, made where there is none; SP_NONE when memory runs out. */
static uint32_t vertex_at(vertices *v, uint32_t triangle, int corner)
{
    const sp_atlas *atlas = sp_evaluator_atlas(v->evaluator);
    sp_drawn_surface *s = v->surface;
    uint32_t at = sp_evaluator_setup(v->evaluator)->mesh->triangles[triangle][corner];
    const double *place = atlas->uv[triangle][corner];
    sp_drawn_vertex made = {at, {(float)(place[0] / atlas->page_edge), (float)(place[1] / atlas->page_edge)}};
    for (uint32_t i = v->first[at]; i != SP_NONE && i >= v->part_first; i = v->next[i])
        if (memcmp(s->vertices[i].uv, made.uv, sizeof made.uv) == 0)
            return i;
    if (s->vertex_count == SP_NONE || (s->vertex_count == v->room && !make_room(v)))
        return SP_NONE;
    uint32_t number = (uint32_t)s->vertex_count++;
    s->vertices[number] = made;
    v->next[number] = v->first[at];
    v->first[at] = number;
    return number;
}

/* Opens the range of a side that is not of the range before it. */
static bool begin_range(vertices *v, size_t *room, const drawn_side *sides, size_t i)
{
    sp_drawn_surface *s = v->surface;
    if (i > 0 && sides[i].order == sides[i - 1].order)
        return true;
    if (!sp_grow(&s->ranges, room, s->range_count + 1, sizeof *s->ranges))
        return false;
    sp_drawn_range range = range_of(sides[i].order, sp_evaluator_atlas(v->evaluator));
    if (s->range_count == 0 || s->ranges[s->range_count - 1].part != range.part)
        v->part_first = s->vertex_count;
    range.first = i;
    range.vertex_first = v->part_first;
    s->ranges[s->range_count++] = range;
    return true;
}

static bool fill(vertices *v, const drawn_side *sides, size_t count)
{
    sp_drawn_surface *s = v->surface;
    size_t room = 0;
    for (size_t i = 0; i < count; ++i) {
        if (!begin_range(v, &room, sides, i))
            return false;
        s->ranges[s->range_count - 1].count++;
        s->triangles[i] = sides[i].triangle;
        for (int k = 0; k < 3; ++k) {
            s->corners[i][k] = vertex_at(v, sides[i].triangle, sides[i].order % 2 ? 2 - k : k);
            if (s->corners[i][k] == SP_NONE)
                return false;
        }
        s->ranges[s->range_count - 1].vertex_end = s->vertex_count;
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
    surface->corners = malloc((count + 1) * sizeof *surface->corners);
    surface->triangles = malloc((count + 1) * sizeof *surface->triangles);
    vertices v = {surface, layers->evaluator, 0, 0, malloc((mesh->vertex_count + 1) * sizeof(uint32_t)), NULL};
    if (v.first)
        memset(v.first, 0xff, (mesh->vertex_count + 1) * sizeof *v.first);
    bool done = surface->corners && surface->triangles && v.first && fill(&v, sides, count);
    free(v.first);
    free(v.next);
    free(sides);
    if (!done)
        sp_drawn_surface_free(surface);
    return done || sp_fail_memory(error);
}

void sp_drawn_surface_free(sp_drawn_surface *surface)
{
    free(surface->vertices);
    free(surface->corners);
    free(surface->triangles);
    free(surface->ranges);
    *surface = (sp_drawn_surface){0};
}
