#include "atlas/charts/join.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The two vertices, one in each sheet, where a half-edge of the shared boundary begins. */
static void pair_of(const sp_sheets *sheets, uint32_t half_edge, uint32_t pair[2])
{
    pair[0] = sp_begin(sheets, half_edge);
    pair[1] = sp_begin(sheets, sp_around(sheets->twin[half_edge]));
}

static void last_pair_of(const sp_sheets *sheets, uint32_t half_edge, uint32_t pair[2])
{
    pair[0] = sp_begin(sheets, sp_around(half_edge));
    pair[1] = sp_begin(sheets, sheets->twin[half_edge]);
}

typedef struct {
    double weight, a[2], b[2], cosine, sine;
} moments;

/* First pass (`centre` NULL): sums of places; second: of products about the means, as complex numbers a conj(b). */
static void add_point(moments *m, const moments *centre, const double *a, const double *b, double weight)
{
    if (!centre) {
        m->weight += weight;
        for (int k = 0; k < 2; k++) {
            m->a[k] += weight * a[k];
            m->b[k] += weight * b[k];
        }
        return;
    }
    double ax = a[0] - centre->a[0], ay = a[1] - centre->a[1], bx = b[0] - centre->b[0], by = b[1] - centre->b[1];
    m->cosine += weight * (ax * bx + ay * by);
    m->sine += weight * (ay * bx - ax * by);
}

static moments sum_over(const sp_sheets *sheets, const sp_shared_boundary *shared, const moments *centre)
{
    moments m = {0};
    const sp_sheet *a = &sheets->items[sheets->owner[shared->first / 3]], *b = &sheets->items[shared->other];
    uint32_t h = shared->first, pair[2];
    for (uint32_t i = 0; i < shared->count; i++, h = sp_boundary_next(sheets, h)) {
        double half = 0.5 * sp_edge_length(sheets, h);
        pair_of(sheets, h, pair);
        add_point(&m, centre, a->at[pair[0]], b->at[pair[1]], half);
        last_pair_of(sheets, h, pair);
        add_point(&m, centre, a->at[pair[0]], b->at[pair[1]], half);
    }
    return m;
}

static void place(const sp_fit *fit, const double p[2], double q[2])
{
    double x = p[0] - fit->from[0], y = p[1] - fit->from[1];
    q[0] = fit->cosine * x - fit->sine * y + fit->to[0];
    q[1] = fit->sine * x + fit->cosine * y + fit->to[1];
}

static double squared_gap(const sp_fit *fit, const double a[2], const double b[2])
{
    double q[2];
    place(fit, b, q);
    return (q[0] - a[0]) * (q[0] - a[0]) + (q[1] - a[1]) * (q[1] - a[1]);
}

sp_fit sp_join_fit(const sp_sheets *sheets, const sp_shared_boundary *shared)
{
    moments centre = sum_over(sheets, shared, NULL);
    for (int k = 0; k < 2; k++) {
        centre.a[k] /= centre.weight;
        centre.b[k] /= centre.weight;
    }
    moments turn = sum_over(sheets, shared, &centre);
    double length = hypot(turn.cosine, turn.sine);
    sp_fit fit = {.cosine = length > 0 ? turn.cosine / length : 1, .sine = length > 0 ? turn.sine / length : 0};
    memcpy(fit.from, centre.b, sizeof fit.from);
    memcpy(fit.to, centre.a, sizeof fit.to);
    const sp_sheet *a = &sheets->items[sheets->owner[shared->first / 3]], *b = &sheets->items[shared->other];
    uint32_t h = shared->first, pair[2];
    double sum = 0;
    for (uint32_t i = 0; i < shared->count; i++, h = sp_boundary_next(sheets, h)) {
        double half = 0.5 * sp_edge_length(sheets, h);
        pair_of(sheets, h, pair);
        sum += half * squared_gap(&fit, a->at[pair[0]], b->at[pair[1]]);
        last_pair_of(sheets, h, pair);
        sum += half * squared_gap(&fit, a->at[pair[0]], b->at[pair[1]]);
    }
    fit.gap = sqrt(sum / centre.weight);
    return fit;
}

bool sp_join(const sp_sheets *sheets, const sp_shared_boundary *shared, const sp_fit *fit, sp_sheet *joined)
{
    const sp_sheet *a = &sheets->items[sheets->owner[shared->first / 3]], *b = &sheets->items[shared->other];
    size_t vertices = a->vertex_count + b->vertex_count, triangles = a->triangle_count + b->triangle_count;
    uint32_t *link = malloc((vertices + 1) * sizeof *link), *number = malloc((vertices + 1) * sizeof *number);
    bool good = link && number && sp_sheet_allocate(joined, triangles, vertices);
    if (good) {
        joined->area = a->area + b->area;
        joined->kept = a->kept + b->kept;
        memcpy(joined->triangle, a->triangle, a->triangle_count * sizeof *a->triangle);
        memcpy(joined->triangle + a->triangle_count, b->triangle, b->triangle_count * sizeof *b->triangle);
        memcpy(joined->corner, a->corner, a->triangle_count * sizeof *a->corner);
        memcpy(joined->at, a->at, a->vertex_count * sizeof *a->at);
        for (size_t i = 0; i < b->triangle_count; i++)
            for (int k = 0; k < 3; k++)
                joined->corner[a->triangle_count + i][k] = b->corner[i][k] + (uint32_t)a->vertex_count;
        for (size_t v = 0; v < b->vertex_count; v++)
            place(fit, b->at[v], joined->at[a->vertex_count + v]);
        for (uint32_t v = 0; v < vertices; v++)
            link[v] = v;
        uint32_t h = shared->first, pair[2];
        for (uint32_t i = 0; i < shared->count; i++, h = sp_boundary_next(sheets, h)) {
            pair_of(sheets, h, pair);
            sp_link(link, pair[0], pair[1] + (uint32_t)a->vertex_count);
            last_pair_of(sheets, h, pair);
            sp_link(link, pair[0], pair[1] + (uint32_t)a->vertex_count);
        }
        sp_sheet_identify(joined, link, number);
    }
    free(link);
    free(number);
    return good;
}
