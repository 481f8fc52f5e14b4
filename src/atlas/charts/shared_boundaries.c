#include "atlas/charts/shared_boundaries.h"

#include <math.h>
#include <stdlib.h>

bool sp_shared_boundaries_create(sp_shared_boundaries *boundaries, const sp_mesh *mesh)
{
    *boundaries = (sp_shared_boundaries){0};
    boundaries->seen = calloc(3 * mesh->triangle_count + 1, 1);
    return boundaries->seen;
}

void sp_shared_boundaries_destroy(sp_shared_boundaries *boundaries)
{
    free(boundaries->items);
    free(boundaries->loop);
    free(boundaries->seen);
    *boundaries = (sp_shared_boundaries){0};
}

/* The sheet across a boundary half-edge, SP_NONE where there is none or it is the same. */
static uint32_t neighbour(const sp_sheets *sheets, uint32_t half_edge)
{
    uint32_t twin = sheets->twin[half_edge];
    if (twin == SP_NONE || sheets->owner[twin / 3] == sheets->owner[half_edge / 3])
        return SP_NONE;
    return sheets->owner[twin / 3];
}

/* True where two half-edges that follow each other also do so from the other side. */
static bool unbroken(const sp_sheets *sheets, uint32_t before, uint32_t after, sp_bend most)
{
    if (sheets->bend[sheets->mesh->triangles[after / 3][after % 3]] > most)
        return false;
    uint32_t other = neighbour(sheets, before);
    return other != SP_NONE && other == neighbour(sheets, after) &&
           sp_boundary_next(sheets, sheets->twin[after]) == sheets->twin[before];
}

static bool add_shared(sp_shared_boundaries *boundaries, sp_shared_boundary shared)
{
    if (boundaries->count == boundaries->capacity) {
        size_t capacity = boundaries->capacity ? 2 * boundaries->capacity : 32;
        sp_shared_boundary *items = realloc(boundaries->items, capacity * sizeof *items);
        if (!items)
            return false;
        boundaries->items = items;
        boundaries->capacity = capacity;
    }
    boundaries->items[boundaries->count++] = shared;
    return true;
}

/* Lists the boundary through `first` in boundaries->loop; returns its length, 0 when memory runs out. */
static size_t walk(sp_shared_boundaries *boundaries, const sp_sheets *sheets, uint32_t first)
{
    size_t count = 0;
    uint32_t h = first;
    do {
        if (count == boundaries->loop_capacity) {
            size_t capacity = boundaries->loop_capacity ? 2 * boundaries->loop_capacity : 256;
            uint32_t *loop = realloc(boundaries->loop, capacity * sizeof *loop);
            if (!loop)
                return 0;
            boundaries->loop = loop;
            boundaries->loop_capacity = capacity;
        }
        boundaries->seen[h] = 1;
        boundaries->loop[count++] = h;
        boundaries->perimeter += sp_edge_length(sheets, h);
        h = sp_boundary_next(sheets, h);
    } while (h != first);
    return count;
}

/* Where a shared boundary begins; for a boundary that is shared all around, at its lowest half-edge. */
static size_t first_break(const sp_shared_boundaries *boundaries, const sp_sheets *sheets, size_t count)
{
    size_t lowest = 0;
    for (size_t i = 0; i < count; i++) {
        if (!unbroken(sheets, boundaries->loop[(i + count - 1) % count], boundaries->loop[i], boundaries->most))
            return i;
        lowest = boundaries->loop[i] < boundaries->loop[lowest] ? i : lowest;
    }
    return lowest;
}

static bool split_loop(sp_shared_boundaries *boundaries, const sp_sheets *sheets, size_t count)
{
    size_t start = first_break(boundaries, sheets, count);
    sp_shared_boundary shared = {.other = SP_NONE};
    for (size_t i = 0; i < count; i++) {
        uint32_t h = boundaries->loop[(start + i) % count];
        bool goes_on = i > 0 && unbroken(sheets, boundaries->loop[(start + i - 1) % count], h, boundaries->most);
        if (!goes_on && shared.other != SP_NONE && !add_shared(boundaries, shared))
            return false;
        if (!goes_on)
            shared = (sp_shared_boundary){.other = neighbour(sheets, h), .first = h};
        shared.count++;
        shared.length += sp_edge_length(sheets, h);
    }
    return shared.other == SP_NONE || add_shared(boundaries, shared);
}

/* By neighbour, then the longest first, lengths that are equal but for round-off by number. */
static int by_neighbour(const void *a, const void *b)
{
    const sp_shared_boundary *p = a, *q = b;
    if (p->other != q->other)
        return p->other < q->other ? -1 : 1;
    if (fabs(p->length - q->length) > 1e-9 * (p->length + q->length))
        return p->length > q->length ? -1 : 1;
    return (p->first > q->first) - (p->first < q->first);
}

bool sp_shared_boundaries_find(sp_shared_boundaries *boundaries, const sp_sheets *sheets, uint32_t number, sp_bend most)
{
    boundaries->most = most;
    const sp_sheet *sheet = &sheets->items[number];
    boundaries->count = 0;
    boundaries->perimeter = 0;
    bool good = true;
    for (size_t i = 0; good && i < 3 * sheet->triangle_count; i++) {
        uint32_t h = 3 * sheet->triangle[i / 3] + (uint32_t)(i % 3);
        if (boundaries->seen[h] || sp_across(sheets, h) != SP_NONE)
            continue;
        size_t count = walk(boundaries, sheets, h);
        good = count && split_loop(boundaries, sheets, count);
    }
    for (size_t i = 0; i < 3 * sheet->triangle_count; i++)
        boundaries->seen[3 * sheet->triangle[i / 3] + i % 3] = 0;
    if (good && boundaries->count > 1) /* none at all have no array either, which qsort must not be given */
        qsort(boundaries->items, boundaries->count, sizeof *boundaries->items, by_neighbour);
    size_t kept = 0;
    for (size_t i = 0; good && i < boundaries->count; i++)
        if (i == 0 || boundaries->items[i].other != boundaries->items[kept - 1].other)
            boundaries->items[kept++] = boundaries->items[i];
    boundaries->count = kept;
    return good;
}
