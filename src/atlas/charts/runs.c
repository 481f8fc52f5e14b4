#include "atlas/charts/runs.h"

#include <math.h>
#include <stdlib.h>

bool sp_runs_create(sp_runs *runs, const sp_mesh *mesh)
{
    *runs = (sp_runs){0};
    runs->seen = calloc(3 * mesh->triangle_count + 1, 1);
    return runs->seen;
}

void sp_runs_destroy(sp_runs *runs)
{
    free(runs->items);
    free(runs->loop);
    free(runs->seen);
    *runs = (sp_runs){0};
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

static bool add_run(sp_runs *runs, sp_run run)
{
    if (runs->count == runs->capacity) {
        size_t capacity = runs->capacity ? 2 * runs->capacity : 32;
        sp_run *items = realloc(runs->items, capacity * sizeof *items);
        if (!items)
            return false;
        runs->items = items;
        runs->capacity = capacity;
    }
    runs->items[runs->count++] = run;
    return true;
}

/* Lists the boundary through `first` in runs->loop; returns its length, 0 when memory runs out. */
static size_t walk(sp_runs *runs, const sp_sheets *sheets, uint32_t first)
{
    size_t count = 0;
    uint32_t h = first;
    do {
        if (count == runs->loop_capacity) {
            size_t capacity = runs->loop_capacity ? 2 * runs->loop_capacity : 256;
            uint32_t *loop = realloc(runs->loop, capacity * sizeof *loop);
            if (!loop)
                return 0;
            runs->loop = loop;
            runs->loop_capacity = capacity;
        }
        runs->seen[h] = 1;
        runs->loop[count++] = h;
        runs->perimeter += sp_edge_length(sheets, h);
        h = sp_boundary_next(sheets, h);
    } while (h != first);
    return count;
}

/* Where a run begins; for a boundary that is one run all around, at its lowest half-edge. */
static size_t first_break(const sp_runs *runs, const sp_sheets *sheets, size_t count)
{
    size_t lowest = 0;
    for (size_t i = 0; i < count; i++) {
        if (!unbroken(sheets, runs->loop[(i + count - 1) % count], runs->loop[i], runs->most))
            return i;
        lowest = runs->loop[i] < runs->loop[lowest] ? i : lowest;
    }
    return lowest;
}

static bool split_loop(sp_runs *runs, const sp_sheets *sheets, size_t count)
{
    size_t start = first_break(runs, sheets, count);
    sp_run run = {.other = SP_NONE};
    for (size_t i = 0; i < count; i++) {
        uint32_t h = runs->loop[(start + i) % count];
        bool goes_on = i > 0 && unbroken(sheets, runs->loop[(start + i - 1) % count], h, runs->most);
        if (!goes_on && run.other != SP_NONE && !add_run(runs, run))
            return false;
        if (!goes_on)
            run = (sp_run){.other = neighbour(sheets, h), .first = h};
        run.count++;
        run.length += sp_edge_length(sheets, h);
    }
    return run.other == SP_NONE || add_run(runs, run);
}

/* By neighbour, then the longest first, lengths that are equal but for round-off by number. */
static int by_neighbour(const void *a, const void *b)
{
    const sp_run *p = a, *q = b;
    if (p->other != q->other)
        return p->other < q->other ? -1 : 1;
    if (fabs(p->length - q->length) > 1e-9 * (p->length + q->length))
        return p->length > q->length ? -1 : 1;
    return (p->first > q->first) - (p->first < q->first);
}

bool sp_runs_find(sp_runs *runs, const sp_sheets *sheets, uint32_t number, sp_bend most)
{
    runs->most = most;
    const sp_sheet *sheet = &sheets->items[number];
    runs->count = 0;
    runs->perimeter = 0;
    bool good = true;
    for (size_t i = 0; good && i < 3 * sheet->triangle_count; i++) {
        uint32_t h = 3 * sheet->triangle[i / 3] + (uint32_t)(i % 3);
        if (runs->seen[h] || sp_across(sheets, h) != SP_NONE)
            continue;
        size_t count = walk(runs, sheets, h);
        good = count && split_loop(runs, sheets, count);
    }
    for (size_t i = 0; i < 3 * sheet->triangle_count; i++)
        runs->seen[3 * sheet->triangle[i / 3] + i % 3] = 0;
    if (good && runs->count > 1) /* none at all have no array either, which qsort must not be given */
        qsort(runs->items, runs->count, sizeof *runs->items, by_neighbour);
    size_t kept = 0;
    for (size_t i = 0; good && i < runs->count; i++)
        if (i == 0 || runs->items[i].other != runs->items[kept - 1].other)
            runs->items[kept++] = runs->items[i];
    runs->count = kept;
    return good;
}
