#include "mesh/self_crossing.h"

#include "mesh/box_pairs.h"
#include "mesh/predicate.h"

#include <stdlib.h>

#define TOUCH 1e-6 /* of the extent */

typedef struct {
    const double (*points)[2];
    size_t count;
    double touch;
    bool tangled;
} outline;

/* Whether the points lie on either side of the line from a to b, and not just beside it. */
static bool parts(const outline *o, const double a[2], const double b[2], const double p[2], const double q[2])
{
    double of_p = sp_orientation(a, b, p), of_q = sp_orientation(a, b, q);
    double least = o->touch * hypot(b[0] - a[0], b[1] - a[1]);
    return fmin(of_p, of_q) < -least && fmax(of_p, of_q) > least;
}

static bool look_at_edges(void *user, uint32_t first, uint32_t second)
{
    outline *o = user;
    const double *a = o->points[first], *b = o->points[(first + 1) % o->count];
    const double *c = o->points[second], *d = o->points[(second + 1) % o->count];
    o->tangled = parts(o, a, b, c, d) && parts(o, c, d, a, b);
    return !o->tangled;
}

static double extent_of(const sp_box *boxes, size_t count)
{
    double extent = 0;
    for (int k = 0; k < 2; k++) {
        double low = INFINITY, high = -INFINITY;
        for (size_t i = 0; i < count; i++) {
            low = fmin(low, boxes[i].low[k]);
            high = fmax(high, boxes[i].high[k]);
        }
        extent = fmax(extent, high - low);
    }
    return extent;
}

bool sp_find_self_crossing(const double (*points)[2], size_t count, bool *tangled, sp_error *error)
{
    sp_box *boxes = malloc(count * sizeof *boxes);
    uint32_t *list = malloc(count * sizeof *list);
    outline o = {points, count, 0, false};
    bool good = (boxes && list) || sp_fail_memory(error);
    for (size_t i = 0; good && i < count; i++) {
        const double *from = points[i], *to = points[(i + 1) % count];
        list[i] = (uint32_t)i;
        boxes[i] =
            (sp_box){{fmin(from[0], to[0]), fmin(from[1], to[1]), 0}, {fmax(from[0], to[0]), fmax(from[1], to[1]), 0}};
    }
    if (good) {
        o.touch = TOUCH * extent_of(boxes, count);
        good = sp_box_pairs(boxes, list, count, look_at_edges, &o, error) || o.tangled;
    }
    *tangled = o.tangled;
    free(boxes);
    free(list);
    return good;
}
