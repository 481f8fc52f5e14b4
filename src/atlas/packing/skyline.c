/* Skyline packing of bounding boxes, largest diagonal first: study 2008, 3.3.2.2, after Lévy, Petitjean, Ray and
 * Maillot, "Least squares conformal maps" (2002), on as many pages as it takes. */
#include "atlas/packing/skyline.h"

#include "mesh/key_sort.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PAGE_STEP 64u /* page edges are multiples of this, but for the limit */

/* A stretch of constant height of what is already taken. */
typedef struct {
    uint32_t x, width, height;
} step;

/* One page: its steps from left to right, which cover its whole width. A rectangle takes one texel more than its size
 * to the right and above, and the page is one texel larger: that is the gap. */
typedef struct {
    step *steps;
    size_t count, capacity;
} skyline;

typedef struct {
    skyline *pages;
    size_t count;
    uint32_t edge; /* of a page, with the gap */
} pages;

static void free_pages(pages *p)
{
    for (size_t i = 0; i < p->count; i++)
        free(p->pages[i].steps);
    free(p->pages);
    *p = (pages){0};
}

static bool add_page(pages *p)
{
    skyline *grown = realloc(p->pages, (p->count + 1) * sizeof *grown);
    if (!grown)
        return false;
    p->pages = grown;
    step *steps = malloc(16 * sizeof *steps);
    if (!steps)
        return false;
    steps[0] = (step){0, p->edge, 0};
    p->pages[p->count++] = (skyline){steps, 1, 16};
    return true;
}

/* Finds the lowest, then leftmost place for a rectangle; returns the step where it begins, or SIZE_MAX. */
static size_t find_place(const skyline *line, uint32_t edge, uint32_t width, uint32_t height, uint32_t *y)
{
    size_t best = SIZE_MAX;
    for (size_t i = 0; i < line->count && line->steps[i].x + width <= edge; i++) {
        uint32_t top = 0;
        for (size_t j = i; j < line->count && line->steps[j].x < line->steps[i].x + width; j++)
            top = line->steps[j].height > top ? line->steps[j].height : top;
        if (top + height <= edge && (best == SIZE_MAX || top < *y)) {
            best = i;
            *y = top;
        }
    }
    return best;
}

#ifndef NDEBUG
/* Steps lie side by side over the whole width. */
static bool is_whole(const skyline *line, uint32_t edge)
{
    uint32_t x = 0;
    for (size_t i = 0; i < line->count; i++) {
        if (line->steps[i].x != x || !line->steps[i].width)
            return false;
        x += line->steps[i].width;
    }
    return x == edge && line->count <= line->capacity;
}
#endif

/* Raises the skyline to `top` over `width` from the beginning of step `at`. */
static bool raise(skyline *line, size_t at, uint32_t width, uint32_t top)
{
    if (line->count == line->capacity) {
        step *grown = realloc(line->steps, 2 * line->capacity * sizeof *grown);
        if (!grown)
            return false;
        line->steps = grown;
        line->capacity *= 2;
    }
    uint32_t x = line->steps[at].x, end = x + width;
    memmove(line->steps + at + 1, line->steps + at, (line->count - at) * sizeof *line->steps);
    line->count++;
    line->steps[at] = (step){x, width, top};
    size_t covered = at + 1; /* steps wholly under the new one go, the last may lose its left part */
    while (covered < line->count && line->steps[covered].x + line->steps[covered].width <= end)
        covered++;
    if (covered < line->count) {
        line->steps[covered].width -= end - line->steps[covered].x;
        line->steps[covered].x = end;
    }
    memmove(line->steps + at + 1, line->steps + covered, (line->count - covered) * sizeof *line->steps);
    line->count -= covered - at - 1;
    if (at > 0 && line->steps[at - 1].height == top) {
        line->steps[at - 1].width += width;
        memmove(line->steps + at, line->steps + at + 1, (line->count - at - 1) * sizeof *line->steps);
        line->count--;
    }
    return true;
}

static bool place(pages *p, sp_rectangle *r)
{
    uint32_t y = 0;
    for (size_t page = 0;; page++) {
        if (page == p->count && !add_page(p))
            return false;
        skyline *line = &p->pages[page];
        assert(is_whole(line, p->edge));
        size_t at = find_place(line, p->edge, r->width + 1, r->height + 1, &y);
        if (at == SIZE_MAX)
            continue;
        r->page = (uint32_t)page;
        r->x = line->steps[at].x;
        r->y = y;
        assert(r->x + r->width < p->edge && r->y + r->height < p->edge);
        return raise(line, at, r->width + 1, y + r->height + 1);
    }
}

/* Largest diagonal first; among equals the lower number. */
static uint32_t *packing_order(const sp_rectangle *rectangles, size_t count)
{
    uint32_t *order = malloc((count + !count) * sizeof *order);
    uint64_t *keys = malloc((count + !count) * sizeof *keys);
    for (size_t i = 0; keys && i < count; i++) {
        uint64_t w = rectangles[i].width, h = rectangles[i].height;
        keys[i] = ~(w * w + h * h);
    }
    if (!order || !keys || !sp_order_by_key(keys, count, order)) {
        free(order);
        order = NULL;
    }
    free(keys);
    return order;
}

/* The smallest page that could hold everything on `page_count` pages. */
static uint32_t least_edge(const sp_rectangle *rectangles, size_t count, uint32_t limit, size_t *page_count)
{
    double area = 0;
    uint32_t widest = 1;
    for (size_t i = 0; i < count; i++) {
        assert(rectangles[i].width <= limit && rectangles[i].height <= limit); /* or no page would do */
        area += (rectangles[i].width + 1.0) * (rectangles[i].height + 1.0);
        uint32_t side = rectangles[i].width > rectangles[i].height ? rectangles[i].width : rectangles[i].height;
        widest = side > widest ? side : widest;
    }
    double most = (limit + 1.0) * (limit + 1.0);
    *page_count = area > most ? (size_t)ceil(area / most) : 1;
    double edge = fmax(widest, sqrt(area / (double)*page_count) - 1);
    uint32_t steps = (uint32_t)ceil(edge / PAGE_STEP);
    return steps > limit / PAGE_STEP ? limit : steps * PAGE_STEP;
}

bool sp_skyline(sp_rectangle *rectangles, size_t count, uint32_t limit, uint32_t *page_edge, size_t *page_count,
                sp_error *error)
{
    uint32_t *order = packing_order(rectangles, count);
    if (!order) {
        sp_fail_memory(error);
        return false;
    }
    size_t wanted;
    uint32_t edge = least_edge(rectangles, count, limit, &wanted);
    for (;;) {
        pages p = {.edge = edge + 1};
        bool memory = true;
        for (size_t i = 0; i < count && memory && (p.count <= wanted || edge == limit); i++)
            memory = place(&p, &rectangles[order[i]]);
        size_t used = p.count;
        free_pages(&p);
        if (!memory) {
            free(order);
            sp_fail_memory(error);
            return false;
        }
        if (used <= wanted || edge == limit) {
            *page_edge = edge;
            *page_count = used ? used : 1;
            break;
        }
        edge = limit - edge > PAGE_STEP ? edge + PAGE_STEP : limit;
    }
    free(order);
    return true;
}
