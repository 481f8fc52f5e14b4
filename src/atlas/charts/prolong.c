#include "atlas/charts/prolong.h"

#include "atlas/charts/cut.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MOST_AROUND 12 /* triangles that go over at once */
#define MOST_MOVES 1   /* of one triangle */

/* Where a coarse triangle has been laid, as a map from space: turned and moved, but not stretched. */
typedef struct {
    sp_vec3 across, up, from;
    double to[2];
} laying;

typedef struct {
    const sp_coarse *coarse;
    const sp_sheets *rough;
    sp_sheets *fine;
    laying *layings;  /* [coarse triangle_count] */
    uint32_t *anchor; /* [fine triangle_count], the coarse triangle that says where it lies */
    uint8_t *glued;   /* [3 fine triangle_count] */
    uint32_t *queue;  /* [fine triangle_count] */
    uint8_t *ends;    /* [fine vertex_count], edges at a vertex that are not glued */
    uint8_t *moved;   /* [fine triangle_count], how often a triangle has changed sheets */
} carrying;

static laying laying_of(const carrying *c, uint32_t triangle)
{
    const sp_sheets *rough = c->rough;
    const sp_sheet *sheet = &rough->items[rough->owner[triangle]];
    const uint32_t *local = sheet->corner[rough->local[triangle]], *corner = rough->mesh->triangles[triangle];
    const sp_vec3 *at = rough->mesh->vertices;
    const double *shape = rough->shape[triangle];
    sp_vec3 x = sp_scale(sp_sub(at[corner[1]], at[corner[0]]), 1 / shape[0]);
    sp_vec3 y = sp_scale(sp_along(sp_sub(at[corner[2]], at[corner[0]]), -shape[1], x), 1 / shape[2]);
    double rest[3][2] = {{0, 0}, {shape[0], 0}, {shape[1], shape[2]}}, cosine = 0, sine = 0;
    double middle[2] = {(shape[0] + shape[1]) / 3, shape[2] / 3};
    laying l = {.from = sp_scale(sp_add(sp_add(at[corner[0]], at[corner[1]]), at[corner[2]]), 1.0 / 3)};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++)
            l.to[k] += sheet->at[local[i]][k] / 3;
    for (int i = 0; i < 3; i++) {
        double u = rest[i][0] - middle[0], v = rest[i][1] - middle[1];
        double p = sheet->at[local[i]][0] - l.to[0], q = sheet->at[local[i]][1] - l.to[1];
        cosine += u * p + v * q;
        sine += u * q - v * p;
    }
    double length = hypot(cosine, sine);
    cosine = length > 0 ? cosine / length : 1;
    sine = length > 0 ? sine / length : 0;
    l.across = sp_along(sp_scale(x, cosine), -sine, y);
    l.up = sp_along(sp_scale(x, sine), cosine, y);
    return l;
}

/* The vertex in the rough sheet that a corner of a fine triangle belongs to. */
static uint32_t rough_vertex(const carrying *c, uint32_t triangle, uint32_t vertex)
{
    uint32_t parent = c->coarse->parent[triangle], of = c->coarse->vertex[vertex];
    const uint32_t *corner = c->coarse->mesh.triangles[parent];
    uint32_t k = corner[0] == of ? 0 : corner[1] == of ? 1 : 2;
    return c->rough->items[c->rough->owner[parent]].corner[c->rough->local[parent]][k];
}

/* Edges are whole where both sides have the same two vertices in the same rough sheet. What belongs to a coarse vertex
 * or triangle hangs together, so the fine sheet can be shrunk to the rough one and has its form. */
static void glue(const carrying *c)
{
    const sp_mesh *mesh = c->fine->mesh;
    for (uint32_t h = 0; h < 3 * mesh->triangle_count; h++) {
        uint32_t twin = c->fine->twin[h], here = h / 3, there = twin / 3;
        c->glued[h] = 0;
        if (twin == SP_NONE || c->fine->owner[here] != c->fine->owner[there])
            continue;
        if (c->anchor[here] == c->anchor[there]) {
            c->glued[h] = 1;
            continue;
        }
        uint32_t from = mesh->triangles[here][h % 3], to = mesh->triangles[here][(h % 3 + 1) % 3];
        c->glued[h] = rough_vertex(c, here, from) == rough_vertex(c, there, from) &&
                      rough_vertex(c, here, to) == rough_vertex(c, there, to);
    }
}

/* Counts how often each vertex is an end of an edge that is not glued; more than there is room for stay at the most. */
static void count_ends(const carrying *c)
{
    const sp_mesh *mesh = c->fine->mesh;
    memset(c->ends, 0, mesh->vertex_count);
    for (uint32_t h = 0; h < 3 * mesh->triangle_count; h++) {
        if (c->glued[h] || (c->fine->twin[h] != SP_NONE && c->fine->twin[h] < h))
            continue;
        for (uint32_t end = 0; end < 2; end++) {
            uint8_t *ends = &c->ends[mesh->triangles[h / 3][(h % 3 + end) % 3]];
            *ends = *ends < UINT8_MAX ? *ends + 1 : UINT8_MAX;
        }
    }
}

static void add_ends(const carrying *c, uint32_t vertex, int by)
{
    if (c->ends[vertex] < UINT8_MAX)
        c->ends[vertex] = (uint8_t)(c->ends[vertex] + by);
}

static uint32_t vertex_of(const carrying *c, uint32_t half_edge)
{
    return c->fine->mesh->triangles[half_edge / 3][half_edge % 3];
}

/* Half-edges out of a vertex on a border of two sheets, that bound one of them there: the triangles of that sheet
 * around the vertex are those of `out`, anticlockwise. */
typedef struct {
    uint32_t out[MOST_AROUND];
    int count;
} fan;

/* Lists the triangles around the vertex where a half-edge not glued begins, up to the next such edge. */
static bool list_fan(const carrying *c, uint32_t half_edge, fan *f)
{
    f->count = 0;
    for (uint32_t h = half_edge;; h = c->fine->twin[sp_around(sp_around(h))]) {
        if (f->count == MOST_AROUND)
            return false;
        f->out[f->count++] = h;
        if (!c->glued[sp_around(sp_around(h))])
            return c->fine->twin[sp_around(sp_around(h))] != SP_NONE;
    }
}

/* Whether the border becomes shorter when it runs around the other end of the fan, and that end is free of borders. */
static bool is_shorter(const carrying *c, const fan *f)
{
    double before =
        sp_edge_length(c->fine, f->out[0]) + sp_edge_length(c->fine, sp_around(sp_around(f->out[f->count - 1])));
    double after = 0;
    for (int i = 0; i < f->count; i++) {
        after += sp_edge_length(c->fine, sp_around(f->out[i]));
        if (c->moved[f->out[i] / 3] == MOST_MOVES || !c->glued[sp_around(f->out[i])] ||
            (i > 0 && c->ends[vertex_of(c, sp_around(f->out[i]))] > 0))
            return false;
    }
    return after < before * (1 - 1e-6);
}

static void set_glued(const carrying *c, uint32_t half_edge, uint8_t glued)
{
    c->glued[half_edge] = c->glued[c->fine->twin[half_edge]] = glued;
}

/* Gives the fan to the sheet around it. */
static void give_away(const carrying *c, const fan *f)
{
    uint32_t across = c->fine->twin[f->out[0]] / 3, vertex = vertex_of(c, f->out[0]);
    for (int i = 0; i < f->count; i++) {
        uint32_t t = f->out[i] / 3;
        c->moved[t]++;
        c->fine->owner[t] = c->fine->owner[across];
        c->anchor[t] = c->anchor[across];
        set_glued(c, sp_around(f->out[i]), 0);
        if (i > 0)
            add_ends(c, vertex_of(c, sp_around(f->out[i])), 2);
    }
    set_glued(c, f->out[0], 1);
    set_glued(c, sp_around(sp_around(f->out[f->count - 1])), 1);
    c->ends[vertex] = 0;
}

/* Moves the border past the vertex where a half-edge of it begins, if that is shorter; the vertices that it then runs
 * through are listed in `next`, -1 where it stays. */
static bool push(const carrying *c, uint32_t half_edge, fan *f)
{
    uint32_t twin = c->fine->twin[half_edge];
    if (c->ends[vertex_of(c, half_edge)] != 2 || twin == SP_NONE || !list_fan(c, half_edge, f))
        return false;
    uint32_t last = c->fine->twin[sp_around(sp_around(f->out[f->count - 1]))];
    uint32_t owner = c->fine->owner[half_edge / 3], other = c->fine->owner[twin / 3];
    if (owner == other || c->fine->owner[last / 3] != other || !is_shorter(c, f))
        return false;
    give_away(c, f);
    return true;
}

/* Makes borders shorter where they can move past a vertex, and sheets keep their form. */
static void straighten(const carrying *c)
{
    size_t all = c->fine->mesh->triangle_count, moves = 0;
    memset(c->moved, 0, all);
    count_ends(c);
    int rounds = 1 + (int)(0.5 * sqrt((double)all / (double)c->rough->mesh->triangle_count));
    for (int round = 0; round < rounds; round++) {
        size_t before = moves;
        for (uint32_t h = 0; h < 3 * all; h++) {
            fan f;
            if (!c->glued[h] && push(c, h, &f))
                moves++;
        }
        if (moves == before)
            return;
    }
}

/* Each vertex goes to the mean of where the triangles at it would have it. */
static bool lay(const carrying *c, sp_sheet *sheet)
{
    double *weight = calloc(sheet->vertex_count + 1, sizeof *weight);
    if (!weight)
        return false;
    memset(sheet->at, 0, sheet->vertex_count * sizeof *sheet->at);
    for (size_t i = 0; i < sheet->triangle_count; i++) {
        uint32_t t = sheet->triangle[i];
        const laying *l = &c->layings[c->anchor[t]];
        double area = c->fine->shape[t][0] * c->fine->shape[t][2];
        for (int k = 0; k < 3; k++) {
            sp_vec3 away = sp_sub(c->fine->mesh->vertices[c->fine->mesh->triangles[t][k]], l->from);
            uint32_t v = sheet->corner[i][k];
            sheet->at[v][0] += area * (l->to[0] + sp_dot(l->across, away));
            sheet->at[v][1] += area * (l->to[1] + sp_dot(l->up, away));
            weight[v] += area;
        }
    }
    for (size_t v = 0; v < sheet->vertex_count; v++)
        for (int k = 0; k < 2; k++)
            sheet->at[v][k] /= weight[v];
    free(weight);
    return true;
}

/* Lists the triangles by sheet in `queue`; start[i] is where those of sheet i begin. */
static void list_by_sheet(const carrying *c, size_t *start)
{
    size_t sheets = c->rough->count;
    memset(start, 0, (sheets + 2) * sizeof *start);
    for (size_t t = 0; t < c->fine->mesh->triangle_count; t++)
        start[c->fine->owner[t] + 2]++;
    for (size_t i = 2; i <= sheets; i++)
        start[i] += start[i - 1];
    for (uint32_t t = 0; t < c->fine->mesh->triangle_count; t++)
        c->queue[start[c->fine->owner[t] + 1]++] = t;
}

static bool carry(const carrying *c)
{
    size_t *start = malloc((c->rough->count + 2) * sizeof *start);
    if (!start)
        return false;
    list_by_sheet(c, start);
    bool good = true;
    for (size_t i = 0; good && i < c->rough->count; i++) {
        sp_sheet sheet;
        size_t count = start[i + 1] - start[i];
        if (count == 0)
            continue;
        good = sp_cut_out(c->glued, c->fine, c->queue + start[i], count, &sheet);
        if (good && !(lay(c, &sheet) && sp_sheets_add(c->fine, &sheet))) {
            sp_sheet_free(&sheet);
            good = false;
        }
    }
    free(start);
    return good;
}

bool sp_prolong_sheets(const sp_coarse *coarse, const sp_sheets *rough, sp_sheets *fine)
{
    size_t count = fine->mesh->triangle_count;
    carrying c = {.coarse = coarse, .rough = rough, .fine = fine};
    c.layings = malloc((rough->mesh->triangle_count + 1) * sizeof *c.layings);
    c.anchor = malloc((count + 1) * sizeof *c.anchor);
    c.glued = malloc(3 * count + 1);
    c.queue = malloc((count + 1) * sizeof *c.queue);
    c.ends = malloc(fine->mesh->vertex_count + 1);
    c.moved = malloc(count + 1);
    bool good = c.layings && c.anchor && c.glued && c.queue && c.ends && c.moved;
    if (good) {
        for (uint32_t t = 0; t < rough->mesh->triangle_count; t++)
            c.layings[t] = laying_of(&c, t);
        for (size_t t = 0; t < count; t++) {
            c.anchor[t] = coarse->parent[t];
            fine->owner[t] = rough->owner[c.anchor[t]];
        }
        glue(&c);
        straighten(&c);
        good = carry(&c);
    }
    free(c.layings);
    free(c.anchor);
    free(c.glued);
    free(c.queue);
    free(c.ends);
    free(c.moved);
    return good;
}
