/* Space is halved again and again, and with it the boxes, until few are left; these are compared one by one. What lies
 * in both halves is compared in both, but visited only in the half that holds the low corner of what the two boxes have
 * in common. */
#include "mesh/box_pairs.h"

#include <stdlib.h>

#define FEW 24         /* boxes that are compared one by one */
#define MOST_HALVES 60 /* how often space is halved */

typedef struct {
    const sp_box *boxes;
    sp_box_visitor *visit;
    void *user;
    bool stopped, failed; /* failed: memory ran out */
} pair_search;

sp_box sp_box_of(const sp_mesh *mesh, uint32_t triangle, double margin)
{
    sp_box box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (int i = 0; i < 3; i++) {
        sp_vec3 p = mesh->vertices[mesh->triangles[triangle][i]];
        double at[3] = {p.x, p.y, p.z};
        for (int k = 0; k < 3; k++) {
            box.low[k] = fmin(box.low[k], at[k] - margin);
            box.high[k] = fmax(box.high[k], at[k] + margin);
        }
    }
    return box;
}

sp_box sp_box_around(sp_vec3 p, double radius)
{
    return (sp_box){{p.x - radius, p.y - radius, p.z - radius}, {p.x + radius, p.y + radius, p.z + radius}};
}

bool sp_boxes_overlap(const sp_box *a, const sp_box *b)
{
    for (int k = 0; k < 3; k++)
        if (a->low[k] > b->high[k] || b->low[k] > a->high[k])
            return false;
    return true;
}

static void compare(pair_search *search, const sp_box *space, uint32_t a, uint32_t b)
{
    const sp_box *p = &search->boxes[a], *q = &search->boxes[b];
    if (!sp_boxes_overlap(p, q))
        return;
    for (int k = 0; k < 3; k++) {
        double low = fmax(p->low[k], q->low[k]);
        if (low < space->low[k] || low >= space->high[k])
            return;
    }
    search->stopped = search->stopped || !search->visit(search->user, a, b);
}

static void search_space(pair_search *search, const sp_box *space, const uint32_t *list, size_t count, int depth);

/* False where halving along this axis leaves too much in both halves: where each kept 1/sqrt(2) of all again and again,
 * all pairs would be compared as often as without any halving. */
static bool halve(pair_search *search, const sp_box *space, const uint32_t *list, size_t count, int depth, int axis)
{
    double middle = 0.5 * (space->low[axis] + space->high[axis]);
    sp_box half[2] = {*space, *space};
    half[0].high[axis] = half[1].low[axis] = middle;
    uint32_t *part[2] = {malloc((count + 1) * sizeof **part), malloc((count + 1) * sizeof **part)};
    size_t counts[2] = {0, 0};
    for (size_t i = 0; part[0] && part[1] && i < count; i++) {
        const sp_box *box = &search->boxes[list[i]];
        if (box->low[axis] <= middle)
            part[0][counts[0]++] = list[i];
        if (box->high[axis] >= middle)
            part[1][counts[1]++] = list[i];
    }
    bool worth = part[0] && part[1] && 5 * (counts[0] + counts[1]) < 7 * count;
    if (!part[0] || !part[1])
        search->failed = true;
    for (int k = 0; k < 2 && worth; k++)
        search_space(search, &half[k], part[k], counts[k], depth + 1);
    free(part[0]);
    free(part[1]);
    return worth;
}

/* The longest first. */
static void order_axes(const sp_box *space, int order[3])
{
    for (int i = 0; i < 3; i++)
        order[i] = i;
    for (int i = 0; i < 2; i++)
        for (int k = i + 1; k < 3; k++) {
            double a = space->high[order[i]] - space->low[order[i]], b = space->high[order[k]] - space->low[order[k]];
            if (b > a) {
                int swap = order[i];
                order[i] = order[k];
                order[k] = swap;
            }
        }
}

static void search_space(pair_search *search, const sp_box *space, const uint32_t *list, size_t count, int depth)
{
    int order[3];
    bool halved = false;
    order_axes(space, order);
    for (int i = 0; count > FEW && depth < MOST_HALVES && !halved && i < 3 && !search->failed; i++)
        halved = halve(search, space, list, count, depth, order[i]);
    for (size_t i = 0; !halved && i < count; i++)
        for (size_t k = 0; k < i && !search->failed && !search->stopped; k++)
            compare(search, space, list[i], list[k]);
}

bool sp_box_pairs(const sp_box *boxes, const uint32_t *list, size_t count, sp_box_visitor *visit, void *user,
                  sp_error *error)
{
    pair_search search = {boxes, visit, user, false, false};
    sp_box space = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) {
            space.low[k] = fmin(space.low[k], boxes[list[i]].low[k]);
            space.high[k] = fmax(space.high[k], boxes[list[i]].high[k]);
        }
    for (int k = 0; k < 3; k++) /* low corners lie below it */
        space.high[k] = nextafter(space.high[k], INFINITY);
    search_space(&search, &space, list, count, 0);
    if (search.failed)
        return sp_fail_memory(error);
    return !search.stopped;
}
