/* surface.js does the same the other way round, operation by operation: whatever is changed here is changed there. */
#include "unfolded.h"

#include "mesh/grow.h"
#include "packed.h"

#include <stdlib.h>
#include <string.h>

#define FARTHEST 1e6 /* pixels: what is found farther off is no place */

/* The latest place of a vertex in a chart. */
typedef struct {
    uint32_t chart, next;
    double uv[2];
} corner;

typedef struct {
    const sp_mesh *mesh;
    const sp_atlas *atlas;
    sp_unfolded *out;
    uint32_t *first; /* [vertices], of the corners at each, SP_NONE: none */
    corner *corners;
    size_t count, room;
    bool *told; /* [triangles] */
} teller;

static corner *find(const teller *t, uint32_t chart, uint32_t vertex)
{
    for (uint32_t i = t->first[vertex]; i != SP_NONE; i = t->corners[i].next)
        if (t->corners[i].chart == chart)
            return &t->corners[i];
    return NULL;
}

static bool remember(teller *t, uint32_t chart, uint32_t vertex, const double uv[2])
{
    corner *known = find(t, chart, vertex);
    if (!known) {
        if (!sp_grow(&t->corners, &t->room, t->count + 1, sizeof *t->corners))
            return false;
        known = &t->corners[t->count];
        known->chart = chart;
        known->next = t->first[vertex];
        t->first[vertex] = (uint32_t)t->count++;
    }
    memcpy(known->uv, uv, sizeof known->uv);
    return true;
}

/* Where the corner opposite to the edge from a to b lies if the triangle keeps its shape. */
static void turn_in(const sp_mesh *mesh, const uint32_t vertex[3], const double a[2], const double b[2], double uv[2])
{
    sp_vec3 from = mesh->vertices[vertex[0]];
    sp_vec3 e = sp_sub(mesh->vertices[vertex[1]], from), f = sp_sub(mesh->vertices[vertex[2]], from);
    double length2 = e.x * e.x + e.y * e.y + e.z * e.z, along = (e.x * f.x + e.y * f.y + e.z * f.z) / length2;
    double x = e.y * f.z - e.z * f.y, y = e.z * f.x - e.x * f.z, z = e.x * f.y - e.y * f.x;
    double across = sqrt(x * x + y * y + z * z) / length2, gx = b[0] - a[0], gy = b[1] - a[1];
    uv[0] = a[0] + along * gx - across * gy;
    uv[1] = a[1] + along * gy + across * gx;
    if (!(fabs(uv[0]) < FARTHEST) || !(fabs(uv[1]) < FARTHEST))
        memcpy(uv, a, 2 * sizeof *uv);
}

/* Where corner i is looked for; `last`: the corner told before. */
static void expect(const teller *t, uint32_t triangle, int i, const double last[2], double uv[2])
{
    const uint32_t *v = t->mesh->triangles[triangle];
    uint32_t chart = t->atlas->chart[triangle], a = v[(i + 1) % 3], b = v[(i + 2) % 3];
    const corner *own = find(t, chart, v[i]), *from = find(t, chart, a), *to = find(t, chart, b);
    if (own)
        memcpy(uv, own->uv, sizeof own->uv);
    else if (from && to)
        turn_in(t->mesh, (uint32_t[]){a, b, v[i]}, from->uv, to->uv, uv);
    else
        memcpy(uv, last, 2 * sizeof *uv);
}

static bool tell(teller *t, uint32_t triangle)
{
    sp_unfolded *out = t->out;
    uint32_t chart = t->atlas->chart[triangle];
    double last[2] = {0, 0};
    t->told[triangle] = true;
    for (int i = 0; i < 3; i++) {
        double expected[2], uv[2];
        expect(t, triangle, i, last, expected);
        for (int k = 0; k < 2; k++) {
            double parts = SP_UNFOLDED_PARTS, value = t->atlas->uv[triangle][i][k];
            uv[k] = out->rounded[chart] ? floor(value * parts) / parts : value;
            out->apart[out->count++] = out->rounded[chart]
                                           ? (int64_t)(uv[k] * parts) - (int64_t)floor(expected[k] * parts)
                                           : sp_packed_apart(uv[k], expected[k]);
        }
        if (!remember(t, chart, t->mesh->triangles[triangle][i], uv))
            return false;
        memcpy(last, uv, sizeof last);
    }
    return true;
}

static int known_corners(const teller *t, uint32_t triangle)
{
    int known = 0;
    for (int i = 0; i < 3; i++)
        known += find(t, t->atlas->chart[triangle], t->mesh->triangles[triangle][i]) != NULL;
    return known;
}

/* Of what is not told yet all where `least` is 0. *any where something was. */
static bool sweep(teller *t, bool down, int least, bool *any)
{
    size_t count = t->mesh->triangle_count;
    *any = false;
    for (size_t i = 0; i < count; i++) {
        uint32_t triangle = (uint32_t)(down ? count - 1 - i : i);
        if (t->told[triangle] || known_corners(t, triangle) < least)
            continue;
        *any = true;
        if (!tell(t, triangle))
            return false;
    }
    return true;
}

static bool tell_all(teller *t)
{
    size_t count = t->mesh->triangle_count;
    uint32_t first = 0;
    for (int sweeps = 0;; sweeps++) {
        bool any;
        if (!sweep(t, sweeps % 2, sweeps < SP_UNFOLDED_SWEEPS ? 2 : 0, &any))
            return false;
        while (first < count && t->told[first])
            first++;
        if (first == count)
            return true;
        if (!any && !tell(t, first))
            return false;
    }
}

static void find_rounded(const sp_evaluator *evaluator, uint8_t *rounded)
{
    const sp_setup *setup = sp_evaluator_setup(evaluator);
    const sp_atlas *atlas = sp_evaluator_atlas(evaluator);
    memset(rounded, 1, atlas->chart_count);
    for (uint32_t t = 0; t < setup->mesh->triangle_count; t++)
        if (setup->surfaces[setup->mesh->part[t]].clean && sp_evaluator_wet(evaluator, t))
            rounded[atlas->chart[t]] = 0;
}

bool sp_unfolded_create(sp_unfolded *unfolded, const sp_evaluator *evaluator)
{
    const sp_mesh *mesh = sp_evaluator_setup(evaluator)->mesh;
    const sp_atlas *atlas = sp_evaluator_atlas(evaluator);
    *unfolded = (sp_unfolded){.rounded = malloc(atlas->chart_count + 1),
                              .apart = malloc((6 * mesh->triangle_count + 1) * sizeof *unfolded->apart)};
    teller t = {.mesh = mesh,
                .atlas = atlas,
                .out = unfolded,
                .first = malloc((mesh->vertex_count + 1) * sizeof *t.first),
                .told = calloc(mesh->triangle_count + 1, sizeof *t.told)};
    bool done = unfolded->rounded && unfolded->apart && t.first && t.told;
    if (done) {
        memset(t.first, 0xff, mesh->vertex_count * sizeof *t.first);
        find_rounded(evaluator, unfolded->rounded);
        done = tell_all(&t);
    }
    free(t.first);
    free(t.corners);
    free(t.told);
    return done;
}

void sp_unfolded_free(sp_unfolded *unfolded)
{
    free(unfolded->rounded);
    free(unfolded->apart);
    *unfolded = (sp_unfolded){0};
}
