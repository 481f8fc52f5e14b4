/* Triangles are glued along a breadth-first tree, which makes a disc; then every cut that ends inside the region is
 * closed from its loose end. What is left are the cuts without which the region were no disc. */
#include "atlas/charts/cut.h"

#include <stdlib.h>
#include <string.h>

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

/* Lists the triangles without an owner that hang together with `seed` where it is glued, and gives them one. */
static size_t list_part(const sp_cutter *cutter, const sp_sheets *sheets, uint32_t seed, uint32_t owner)
{
    uint32_t *list = cutter->waiting;
    size_t count = 0;
    sheets->owner[seed] = owner;
    list[count++] = seed;
    for (size_t i = 0; i < count; i++)
        for (uint32_t h = 3 * list[i]; h < 3 * list[i] + 3; h++) {
            uint32_t other = cutter->glued[h] ? sheets->twin[h] / 3 : SP_NONE;
            if (other == SP_NONE || sheets->owner[other] != SP_NONE)
                continue;
            sheets->owner[other] = owner;
            list[count++] = other;
        }
    return count;
}

/* Adds a sheet of the part of `whole` with triangle `seed`. */
static bool take_part(const sp_cutter *cutter, sp_sheets *sheets, const sp_sheet *whole, uint32_t seed)
{
    size_t count = list_part(cutter, sheets, seed, (uint32_t)sheets->count);
    uint32_t *before = malloc((count + 1) * sizeof *before); /* its triangles' numbers in the whole */
    sp_sheet part = {0};
    bool good = before;
    for (size_t i = 0; good && i < count; i++)
        before[i] = sheets->local[cutter->waiting[i]];
    good = good && sp_cut_out(cutter->glued, sheets, cutter->waiting, count, &part);
    for (size_t i = 0; good && i < count; i++)
        for (int k = 0; k < 3; k++)
            memcpy(part.at[part.corner[i][k]], whole->at[whole->corner[before[i]][k]], sizeof *part.at);
    free(before);
    if (good && sp_sheets_add(sheets, &part))
        return true;
    sp_sheet_free(&part);
    return false;
}

bool sp_cut_apart(sp_cutter *cutter, sp_sheets *sheets, uint32_t number, const uint32_t *region)
{
    sp_sheet whole = sheets->items[number];
    for (size_t i = 0; i < 3 * whole.triangle_count; i++) {
        uint32_t h = 3 * whole.triangle[i / 3] + (uint32_t)(i % 3), across = sp_across(sheets, h);
        cutter->glued[h] = across != SP_NONE && region[h / 3] == region[across / 3];
    }
    for (size_t i = 0; i < whole.triangle_count; i++)
        sheets->owner[whole.triangle[i]] = SP_NONE;
    bool good = true;
    for (size_t i = 0; good && i < whole.triangle_count; i++)
        if (sheets->owner[whole.triangle[i]] == SP_NONE)
            good = take_part(cutter, sheets, &whole, whole.triangle[i]);
    sheets->items[number] = (sp_sheet){0};
    sp_sheet_free(&whole);
    return good;
}

static bool is_sharp(const sp_sheets *sheets, uint32_t half_edge)
{
    return sheets->bend[sheets->mesh->triangles[half_edge / 3][half_edge % 3]] == SP_BEND_SHARP;
}

/* Goes along the boundary through `first` with a stack of its half-edges: one that is the other lip of the last on the
 * stack closes it. */
static bool close_along(const sp_sheets *sheets, uint32_t first, uint8_t *seen, uint32_t *stack, uint32_t *link)
{
    size_t depth = 0, length = 0;
    uint32_t h = first;
    do {
        length++;
        h = sp_boundary_next(sheets, h);
    } while (h != first);
    bool closed = false;
    do {
        seen[3 * (size_t)sheets->local[h / 3] + h % 3] = 1;
        if (depth > 0 && sheets->twin[stack[depth - 1]] == h && length > 4 && !is_sharp(sheets, h)) {
            uint32_t a = sp_begin(sheets, stack[--depth]), b = sp_begin(sheets, sp_around(h));
            sp_link(link, a, b);
            length -= 2;
            closed = true;
        } else {
            stack[depth++] = h;
        }
        h = sp_boundary_next(sheets, h);
    } while (h != first);
    for (size_t bottom = 0; bottom + 4 < depth && sheets->twin[stack[depth - 1]] == stack[bottom]; bottom++) {
        if (is_sharp(sheets, stack[bottom]))
            break;
        sp_link(link, sp_begin(sheets, stack[--depth]), sp_begin(sheets, sp_around(stack[bottom])));
        closed = true;
    }
    return closed;
}

bool sp_close_ends(sp_sheets *sheets, uint32_t number, bool *closed)
{
    sp_sheet *sheet = &sheets->items[number];
    size_t corners = 3 * sheet->triangle_count;
    uint8_t *seen = calloc(corners + 1, 1);
    uint32_t *stack = malloc((corners + 1) * sizeof *stack);
    uint32_t *link = malloc((sheet->vertex_count + 1) * sizeof *link);
    bool good = seen && stack && link;
    *closed = false;
    for (uint32_t v = 0; good && v < sheet->vertex_count; v++)
        link[v] = v;
    for (size_t i = 0; good && i < corners; i++) {
        uint32_t h = 3 * sheet->triangle[i / 3] + (uint32_t)(i % 3);
        if (!seen[i] && sp_across(sheets, h) == SP_NONE)
            *closed |= close_along(sheets, h, seen, stack, link);
    }
    if (good && *closed)
        sp_sheet_identify(sheet, link, stack);
    free(seen);
    free(stack);
    free(link);
    return good;
}
