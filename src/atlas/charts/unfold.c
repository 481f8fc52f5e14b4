/* Isometric unfolding: study 2008, 3.3.2.1. Each vertex goes to the mean of the places that laid triangles around it
 * give it across an edge. Which way that edge lies says how the triangle beside it has been turned; or, as in the
 * study's equations 3.24 to 3.26, where its ends lie. The former is exact for any number of developable triangles,
 * while by ends round-off grows by a factor with every row; the latter evens out better what is curved. */
#include "atlas/charts/unfold.h"

#include "atlas/charts/judge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ALIKE 1e-9 /* shares that differ by less may do so by round-off */

typedef struct {
    double x, y; /* a vector, or a turn of (1, 0) to it */
} turn;

static turn turned_by(turn a, turn b)
{
    return (turn){a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
}

/* A turn without length; (0, 0) for nothing. */
static turn unit(turn t)
{
    double length = hypot(t.x, t.y);
    return length > 0 ? (turn){t.x / length, t.y / length} : (turn){0, 0};
}

typedef struct {
    sp_sheets *sheets;
    sp_sheet *sheet;
    uint8_t *laid;   /* [vertex_count] */
    uint8_t *queued; /* [triangle_count] */
    uint32_t *queue; /* [triangle_count], by local number */
    turn *turns;     /* [triangle_count], of its own shape to where it lies; (0, 0) before it is laid */
    size_t count;
    bool by_ends;
} layout;

/* A half-edge in its triangle's own shape, m. */
static turn edge_of(const layout *l, uint32_t half_edge)
{
    const double *shape = l->sheets->shape[half_edge / 3];
    if (half_edge % 3 == 0)
        return (turn){shape[0], 0};
    return half_edge % 3 == 1 ? (turn){shape[1] - shape[0], shape[2]} : (turn){-shape[1], -shape[2]};
}

/* How the triangle of a half-edge is turned, by what lies across; (0, 0) where that does not say. */
static turn turn_across(const layout *l, uint32_t half_edge)
{
    turn here = edge_of(l, half_edge), back = {here.x, -here.y};
    if (l->by_ends) {
        const double *p = l->sheet->at[sp_begin(l->sheets, half_edge)];
        const double *q = l->sheet->at[sp_begin(l->sheets, sp_around(half_edge))];
        return unit(turned_by((turn){q[0] - p[0], q[1] - p[1]}, back));
    }
    uint32_t across = sp_across(l->sheets, half_edge);
    if (across == SP_NONE)
        return (turn){0, 0};
    turn there = edge_of(l, across);
    return unit(turned_by(l->turns[l->sheets->local[across / 3]], turned_by((turn){-there.x, -there.y}, back)));
}

typedef struct {
    double sum[2], weight;
} mean;

/* Where the corner at which half-edge h begins lies by its triangle, whose other corners are laid. Longer edges, which
 * give the direction better, weigh more. */
static void add_corner(const layout *l, uint32_t h, mean *m)
{
    uint32_t next = sp_around(h), last = sp_around(next), from = sp_begin(l->sheets, next);
    if (!l->laid[from] || !l->laid[sp_begin(l->sheets, last)])
        return;
    turn t = turn_across(l, next), edge = edge_of(l, h), away = turned_by(t, (turn){-edge.x, -edge.y});
    if (t.x == 0 && t.y == 0)
        return;
    turn base = edge_of(l, next);
    double weight = base.x * base.x + base.y * base.y;
    m->sum[0] += weight * (l->sheet->at[from][0] + away.x);
    m->sum[1] += weight * (l->sheet->at[from][1] + away.y);
    m->weight += weight;
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

/* Turns a triangle as those beside it that are laid have it, in the mean. */
static void turn_triangle(const layout *l, uint32_t t)
{
    turn sum = {0, 0};
    for (uint32_t h = 3 * t; h < 3 * t + 3; h++) {
        turn one = turn_across(l, h), edge = edge_of(l, h);
        double weight = edge.x * edge.x + edge.y * edge.y;
        sum.x += weight * one.x;
        sum.y += weight * one.y;
    }
    l->turns[l->sheets->local[t]] = unit(sum);
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

static void begin(layout *l)
{
    uint32_t seed = l->sheet->triangle[0];
    const double *shape = l->sheets->shape[seed], rest[3][2] = {{0, 0}, {shape[0], 0}, {shape[1], shape[2]}};
    memset(l->laid, 0, l->sheet->vertex_count);
    memset(l->queued, 0, l->sheet->triangle_count);
    memset(l->turns, 0, l->sheet->triangle_count * sizeof *l->turns);
    for (int i = 0; i < 3; i++) {
        uint32_t vertex = l->sheet->corner[0][i];
        l->laid[vertex] = 1;
        memcpy(l->sheet->at[vertex], rest[i], sizeof rest[i]);
    }
    l->turns[0] = (turn){1, 0};
    l->queued[0] = 1;
    l->queue[0] = seed;
    l->count = 1;
}

static void lay_all(layout *l, bool by_ends)
{
    l->by_ends = by_ends;
    begin(l);
    for (size_t i = 0; i < l->count; i++) {
        uint32_t t = l->queue[i], local = l->sheets->local[t];
        for (uint32_t k = 0; k < 3; k++)
            if (!l->laid[l->sheet->corner[local][k]])
                lay_vertex(l, 3 * t + k);
        if (!by_ends && i > 0)
            turn_triangle(l, t);
        queue_neighbours(l, t);
    }
}

/* Where there is much strain anywhere it is laid both ways, and stays as there is less of it. */
static bool lay_better(layout *l)
{
    lay_all(l, false);
    sp_strain by_turns = sp_measure_strain(l->sheets, l->sheet);
    if (by_turns.share <= ALIKE && !by_turns.flipped)
        return true;
    size_t bytes = l->sheet->vertex_count * sizeof *l->sheet->at;
    double(*at)[2] = malloc(bytes + 1);
    if (!at)
        return false;
    memcpy(at, l->sheet->at, bytes);
    lay_all(l, true);
    if (by_turns.share < sp_measure_strain(l->sheets, l->sheet).share + ALIKE)
        memcpy(l->sheet->at, at, bytes);
    free(at);
    return true;
}

bool sp_unfold(sp_sheets *sheets, uint32_t number)
{
    sp_sheet *sheet = &sheets->items[number];
    layout l = {.sheets = sheets, .sheet = sheet};
    l.laid = malloc(sheet->vertex_count + 1);
    l.queued = malloc(sheet->triangle_count + 1);
    l.queue = malloc((sheet->triangle_count + 1) * sizeof *l.queue);
    l.turns = malloc((sheet->triangle_count + 1) * sizeof *l.turns);
    bool good = l.laid && l.queued && l.queue && l.turns && lay_better(&l);
    free(l.laid);
    free(l.queued);
    free(l.queue);
    free(l.turns);
    return good;
}
