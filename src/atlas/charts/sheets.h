/* Charts while they are made. A sheet is a piece of the surface with vertices of its own: where the sheet is cut, or
 * ends, the two sides of an edge of the mesh have vertices of their own each. */
#ifndef ATLAS_SHEETS_H
#define ATLAS_SHEETS_H

#include <sprayplan/mesh.h>

#define SP_STRAIN_SHARE 0.05 /* of a chart's area that may have more strain than SP_STRAIN_BOUND */

typedef struct {
    size_t triangle_count, vertex_count;
    uint32_t *triangle;    /* [triangle_count], of the mesh */
    uint32_t (*corner)[3]; /* [triangle_count], vertices of the sheet */
    double (*at)[2];       /* [vertex_count], where they lie, m */
    double area;           /* of the surface, m² */
    double strain;         /* the largest of any triangle */
    double kept;           /* m², of what it has of developable surface, whose lengths are not to be touched */
} sp_sheet;

/* By the angle defect, 2π less the angles around a vertex inside of the surface: none but for round-off, none but for
 * the digits of a file, ... */
typedef enum { SP_BEND_EXACT, SP_BEND_NONE, SP_BEND_SMOOTH, SP_BEND_SHARP } sp_bend;

typedef struct {
    const sp_mesh *mesh;
    const uint32_t *twin; /* [3 triangle_count], the half-edge across, or SP_NONE where the surface does not go on */
    double (*shape)[3];   /* [triangle_count], each triangle in its plane: corners (0, 0), (s0, 0), (s1, s2), m */
    float (*weight)[3];   /* [triangle_count], of edge k from corner k to the next: cotangent of the angle across */
    uint8_t *bend;        /* [vertex_count], sp_bend: how far the triangles around each vertex are from lying flat */
    double share;         /* of a sheet's area that may have much strain */
    double square;        /* m, the edge of a square as large as the surface */
    bool coarse;          /* of a mesh that stands for a finer one */
    uint32_t *owner;      /* [triangle_count], the sheet of each triangle, SP_NONE before there is one */
    uint32_t *local;      /* [triangle_count], its number in that sheet */
    sp_sheet *items;      /* [count]; without triangles where a sheet has gone into another */
    size_t count, capacity;
} sp_sheets;

/* Measures the triangles; no sheets yet. mesh and twin are borrowed. */
bool sp_sheets_create(sp_sheets *sheets, const sp_mesh *mesh, const uint32_t *twin, sp_error *error);
/* Accepts what was never created, if it is all zeros. */
void sp_sheets_destroy(sp_sheets *sheets);

/* The length of a half-edge, m. */
double sp_edge_length(const sp_sheets *sheets, uint32_t half_edge);

/* Room for a sheet, its arrays uninitialised; false when memory runs out. */
bool sp_sheet_allocate(sp_sheet *sheet, size_t triangle_count, size_t vertex_count);
void sp_sheet_free(sp_sheet *sheet);
/* Adds a sheet, which then is owned here, and sets owner and local of its triangles. False when memory runs out; then
 * it stays the caller's. */
bool sp_sheets_add(sp_sheets *sheets, const sp_sheet *sheet);

/* Makes one vertex of those that `link` [vertex_count] leads to the same vertex, at the mean of their places. Every
 * link[v] <= v; `link` and `number` [vertex_count] are overwritten. */
void sp_sheet_identify(sp_sheet *sheet, uint32_t *link, uint32_t *number);

/* The vertex that v is linked to in the end. */
static inline uint32_t sp_linked(uint32_t *link, uint32_t v)
{
    while (link[v] != v)
        v = link[v] = link[link[v]];
    return v;
}
static inline void sp_link(uint32_t *link, uint32_t v, uint32_t w)
{
    v = sp_linked(link, v);
    w = sp_linked(link, w);
    link[v > w ? v : w] = v > w ? w : v;
}

/* The half-edge across, where both sides have the same vertices in the same sheet, else SP_NONE. */
static inline uint32_t sp_across(const sp_sheets *sheets, uint32_t half_edge)
{
    uint32_t twin = sheets->twin[half_edge], here = half_edge / 3, there = twin / 3;
    if (twin == SP_NONE || sheets->owner[here] != sheets->owner[there])
        return SP_NONE;
    const sp_sheet *sheet = &sheets->items[sheets->owner[here]];
    const uint32_t *a = sheet->corner[sheets->local[here]], *b = sheet->corner[sheets->local[there]];
    uint32_t i = half_edge % 3, j = twin % 3;
    return a[i] == b[(j + 1) % 3] && a[(i + 1) % 3] == b[j] ? twin : SP_NONE;
}

/* The sheet's own vertex where a half-edge begins. */
static inline uint32_t sp_begin(const sp_sheets *sheets, uint32_t half_edge)
{
    uint32_t triangle = half_edge / 3;
    return sheets->items[sheets->owner[triangle]].corner[sheets->local[triangle]][half_edge % 3];
}

/* The next half-edge around its triangle. */
static inline uint32_t sp_around(uint32_t half_edge)
{
    return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}

/* The boundary half-edge of the sheet that begins where this one ends. */
static inline uint32_t sp_boundary_next(const sp_sheets *sheets, uint32_t half_edge)
{
    uint32_t next = sp_around(half_edge);
    for (uint32_t across; (across = sp_across(sheets, next)) != SP_NONE;)
        next = sp_around(across);
    return next;
}

#endif
