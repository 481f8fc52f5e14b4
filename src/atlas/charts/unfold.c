/* Isometric unfolding: study 2008, 3.3.2.1. Each vertex goes to the mean of the places that the triangles at it which
 * are laid but for that vertex give it. */
#include "atlas/charts/unfold.h"

#include <math.h>
#include <stdlib.h>

typedef struct {
    double sum[2], weight;
} mean;

/* Where corner `k` of triangle `t` lies when the edge across is laid: along the edge and up from it (study's equations
 * 3.24 to 3.26). Longer edges, which give the direction better, weigh more. */
static void add_prediction(const sp_sheets *sheets, const sp_sheet *sheet, uint32_t t, uint32_t k, mean *m)
{
    const double *shape = sheets->shape[t], rest[3][2] = {{0, 0}, {shape[0], 0}, {shape[1], shape[2]}};
    uint32_t i = (k + 1) % 3, j = (k + 2) % 3;
    const uint32_t *corner = sheet->corner[sheets->local[t]];
    const double *p = sheet->at[corner[i]], *q = sheet->at[corner[j]];
    double ex = rest[j][0] - rest[i][0], ey = rest[j][1] - rest[i][1], length = hypot(ex, ey);
    double sx = rest[k][0] - rest[i][0], sy = rest[k][1] - rest[i][1];
    double along = (ex * sx + ey * sy) / length, height = shape[0] * shape[2] / length;
    double x = q[0] - p[0], y = q[1] - p[1], laid = hypot(x, y);
    if (!(laid > 0) || !(length > 0))
        return;
    m->sum[0] += length * length * (p[0] + (along * x - height * y) / laid);
    m->sum[1] += length * length * (p[1] + (along * y + height * x) / laid);
    m->weight += length * length;
}

typedef struct {
    sp_sheets *sheets;
    sp_sheet *sheet;
    uint8_t *laid;   /* [vertex_count] */
    uint8_t *queued; /* [triangle_count] */
    uint32_t *queue; /* [triangle_count], by local number */
    size_t count;
} layout;

static bool is_laid(const layout *l, uint32_t t, uint32_t but)
{
    const uint32_t *corner = l->sheet->corner[l->sheets->local[t]];
    return l->laid[corner[(but + 1) % 3]] && l->laid[corner[(but + 2) % 3]];
}

/* Adds what the triangle with corner h at the vertex says; returns the next half-edge from that vertex. */
static void add_corner(const layout *l, uint32_t h, mean *m)
{
    if (is_laid(l, h / 3, h % 3))
        add_prediction(l->sheets, l->sheet, h / 3, h % 3, m);
}

static void lay_vertex(const layout *l, uint32_t first)
{
    mean m = {0};
    uint32_t h = first;
    do { /* anticlockwise */
        add_corner(l, h, &m);
        h = sp_across(l->sheets, sp_around(sp_around(h)));
    } while (h != SP_NONE && h != first);
    for (uint32_t back = first; h == SP_NONE && (back = sp_across(l->sheets, back)) != SP_NONE;) { /* clockwise */
        back = sp_around(back);
        add_corner(l, back, &m);
    }
    uint32_t vertex = sp_begin(l->sheets, first);
    for (int k = 0; k < 2; k++)
        l->sheet->at[vertex][k] = m.weight > 0 ? m.sum[k] / m.weight : 0;
    l->laid[vertex] = 1;
}

static void queue_neighbours(layout *l, uint32_t t)
{
    for (uint32_t h = 3 * t; h < 3 * t + 3; h++) {
        uint32_t twin = sp_across(l->sheets, h);
        if (twin == SP_NONE || l->queued[l->sheets->local[twin / 3]])
            continue;
        l->queued[l->sheets->local[twin / 3]] = 1;
        l->queue[l->count++] = twin / 3;
    }
}

static void lay_all(layout *l)
{
    uint32_t seed = l->sheet->triangle[0];
    const double *shape = l->sheets->shape[seed], rest[3][2] = {{0, 0}, {shape[0], 0}, {shape[1], shape[2]}};
    for (int i = 0; i < 3; i++) {
        uint32_t vertex = l->sheet->corner[0][i];
        l->laid[vertex] = 1;
        for (int k = 0; k < 2; k++)
            l->sheet->at[vertex][k] = rest[i][k];
    }
    l->queued[0] = 1;
    l->queue[l->count++] = seed;
    for (size_t i = 0; i < l->count; i++) {
        uint32_t t = l->queue[i], local = l->sheets->local[t];
        for (uint32_t k = 0; k < 3; k++)
            if (!l->laid[l->sheet->corner[local][k]])
                lay_vertex(l, 3 * t + k);
        queue_neighbours(l, t);
    }
}

bool sp_unfold(sp_sheets *sheets, uint32_t number)
{
    sp_sheet *sheet = &sheets->items[number];
    layout l = {.sheets = sheets, .sheet = sheet};
    l.laid = calloc(sheet->vertex_count + 1, 1);
    l.queued = calloc(sheet->triangle_count + 1, 1);
    l.queue = malloc((sheet->triangle_count + 1) * sizeof *l.queue);
    bool good = l.laid && l.queued && l.queue;
    if (good)
        lay_all(&l);
    free(l.laid);
    free(l.queued);
    free(l.queue);
    return good;
}
