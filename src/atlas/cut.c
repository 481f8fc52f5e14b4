/* Triangles are glued along a breadth-first tree, which makes a disc; then every cut that ends inside the region is
 * closed from its loose end. What is left are the cuts without which the region were no disc. */
#include "atlas/cut.h"

#include <stdlib.h>

bool sp_cutter_create(sp_cutter *cutter, const sp_mesh *mesh)
{
    cutter->glued = malloc(3 * mesh->triangle_count + 1);
    cutter->degree = malloc((mesh->vertex_count + 1) * sizeof *cutter->degree);
    cutter->incident = malloc((mesh->vertex_count + 1) * sizeof *cutter->incident);
    cutter->waiting = malloc((mesh->triangle_count + 1) * sizeof *cutter->waiting);
    if (cutter->glued && cutter->degree && cutter->incident && cutter->waiting)
        return true;
    sp_cutter_destroy(cutter);
    return false;
}

void sp_cutter_destroy(sp_cutter *cutter)
{
    free(cutter->glued);
    free(cutter->degree);
    free(cutter->incident);
    free(cutter->waiting);
    *cutter = (sp_cutter){0};
}

typedef struct {
    sp_cutter *cutter;
    const sp_sheets *sheets;
    const uint32_t *region;
    uint32_t of; /* the region */
} piece;

static uint32_t vertex_at(const piece *p, uint32_t half_edge)
{
    return p->sheets->mesh->triangles[half_edge / 3][half_edge % 3];
}

/* The half-edge across inside the region, or SP_NONE. */
static uint32_t inside(const piece *p, uint32_t half_edge)
{
    uint32_t twin = p->sheets->twin[half_edge];
    return twin != SP_NONE && p->region[twin / 3] == p->of ? twin : SP_NONE;
}

static void glue(const piece *p, uint32_t half_edge)
{
    p->cutter->glued[half_edge] = p->cutter->glued[p->sheets->twin[half_edge]] = 1;
}

/* Lists the connected triangles in cutter->waiting, numbers them in sheets->local and glues them along a tree. */
static size_t grow_tree(const piece *p, uint32_t seed)
{
    uint32_t *list = p->cutter->waiting;
    size_t count = 0;
    list[count++] = seed;
    p->sheets->local[seed] = 0;
    for (size_t i = 0; i < count; i++) {
        for (uint32_t h = 3 * list[i]; h < 3 * list[i] + 3; h++)
            p->cutter->glued[h] = 0;
        for (uint32_t h = 3 * list[i]; h < 3 * list[i] + 3; h++) {
            uint32_t twin = inside(p, h);
            uint32_t known = twin == SP_NONE ? 0 : p->sheets->local[twin / 3];
            if (twin == SP_NONE || (known < count && list[known] == twin / 3))
                continue;
            p->sheets->local[twin / 3] = (uint32_t)count;
            list[count++] = twin / 3;
        }
    }
    return count;
}

/* Glues each triangle but the first to the one through which it was found. */
static void glue_tree(const piece *p, size_t count)
{
    const uint32_t *list = p->cutter->waiting, *local = p->sheets->local;
    for (size_t i = 1; i < count; i++) {
        uint32_t parent = SP_NONE;
        for (uint32_t h = 3 * list[i]; h < 3 * list[i] + 3; h++) {
            uint32_t twin = inside(p, h);
            if (twin != SP_NONE && local[twin / 3] < i && (parent == SP_NONE || local[twin / 3] < local[parent / 3]))
                parent = twin;
        }
        glue(p, parent);
    }
}

static void count_edge(const piece *p, uint32_t half_edge)
{
    for (int end = 0; end < 2; end++) {
        uint32_t v = vertex_at(p, end ? sp_around(half_edge) : half_edge);
        p->cutter->degree[v]++;
        p->cutter->incident[v] ^= half_edge; /* of a single edge that is its number */
    }
}

static void count_cuts(const piece *p, size_t count)
{
    const uint32_t *list = p->cutter->waiting;
    for (size_t i = 0; i < 3 * count; i++) {
        uint32_t v = p->sheets->mesh->triangles[list[i / 3]][i % 3];
        p->cutter->degree[v] = p->cutter->incident[v] = 0;
    }
    for (size_t i = 0; i < 3 * count; i++) {
        uint32_t h = 3 * list[i / 3] + (uint32_t)(i % 3), twin = inside(p, h);
        if (twin == SP_NONE || (!p->cutter->glued[h] && h < twin))
            count_edge(p, h);
    }
}

/* Closes cuts from their loose ends. A closed surface keeps one cut edge. */
static void close_loose_ends(const piece *p, size_t count)
{
    uint32_t *degree = p->cutter->degree;
    for (size_t i = 0; i < 3 * count; i++) {
        uint32_t v = p->sheets->mesh->triangles[p->cutter->waiting[i / 3]][i % 3];
        while (degree[v] == 1) {
            uint32_t edge = p->cutter->incident[v], from = vertex_at(p, edge), to = vertex_at(p, sp_around(edge));
            uint32_t other = from == v ? to : from;
            if (degree[other] == 1)
                break;
            glue(p, edge);
            degree[v]--;
            degree[other]--;
            p->cutter->incident[v] ^= edge;
            p->cutter->incident[other] ^= edge;
            v = other;
        }
    }
}

/* Gives the corners around one vertex that hang together the number `vertex`. */
static void number_fan(const uint8_t *glued, const sp_sheets *sheets, sp_sheet *sheet, uint32_t first, uint32_t vertex)
{
    for (uint32_t h = first;;) { /* anticlockwise */
        sheet->corner[sheets->local[h / 3]][h % 3] = vertex;
        uint32_t into = sp_around(sp_around(h));
        h = glued[into] ? sheets->twin[into] : SP_NONE;
        if (h == first)
            return;
        if (h == SP_NONE)
            break;
    }
    for (uint32_t h = first; glued[h];) { /* clockwise */
        h = sp_around(sheets->twin[h]);
        sheet->corner[sheets->local[h / 3]][h % 3] = vertex;
    }
}

bool sp_cut_out(const uint8_t *glued, const sp_sheets *sheets, const uint32_t *list, size_t count, sp_sheet *sheet)
{
    if (!sp_sheet_allocate(sheet, count, 3 * count))
        return false;
    for (size_t i = 0; i < count; i++) {
        uint32_t t = list[i];
        sheets->local[t] = (uint32_t)i;
        sheet->triangle[i] = t;
        sheet->area += 0.5 * sheets->shape[t][0] * sheets->shape[t][2];
        for (int k = 0; k < 3; k++)
            sheet->corner[i][k] = SP_NONE;
    }
    sheet->vertex_count = 0;
    for (size_t i = 0; i < 3 * count; i++)
        if (sheet->corner[i / 3][i % 3] == SP_NONE)
            number_fan(glued, sheets, sheet, 3 * list[i / 3] + (uint32_t)(i % 3), (uint32_t)sheet->vertex_count++);
    double(*at)[2] = realloc(sheet->at, (sheet->vertex_count + 1) * sizeof *at);
    if (at)
        sheet->at = at;
    return true;
}

bool sp_cut_open(sp_cutter *cutter, const sp_sheets *sheets, const uint32_t *region, uint32_t seed, sp_sheet *sheet)
{
    piece p = {cutter, sheets, region, region[seed]};
    size_t count = grow_tree(&p, seed);
    glue_tree(&p, count);
    count_cuts(&p, count);
    close_loose_ends(&p, count);
    return sp_cut_out(cutter->glued, sheets, cutter->waiting, count, sheet);
}
