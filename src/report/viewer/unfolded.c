/* unfolded.js does the same the other way round, operation by operation: whatever is changed here is changed there. */
#include "unfolded.h"

#include "packed.h"

#include <stdlib.h>
#include <string.h>

#define FARTHEST 1e6 /* pixels: what is found farther off is no place */

/* The latest place of a vertex, and in which chart that was. */
typedef struct {
    uint32_t chart;
    double uv[2];
} spot;

typedef struct {
    sp_number_model parts, own[2], off[2][64]; /* by the size of x's, of y; x's own is the first */
} models;

typedef struct {
    const sp_mesh *mesh;
    const sp_atlas *atlas;
    const sp_triangle_order *walk;
    sp_coder *coder;
    models *models;
    double *parts;      /* [charts], of a pixel, that corners are encoded in; 0: bits */
    spot *spots;        /* [vertices encoded] */
    double (*uv)[3][2]; /* [triangles encoded], as they are read */
} encoder;

static sp_vec3 place_of(const encoder *t, uint32_t vertex)
{
    return t->mesh->vertices[t->walk->vertex[vertex]];
}

/* How far a place lies along an edge, and off it, both in parts of the edge. */
static void measure(sp_vec3 from, sp_vec3 to, sp_vec3 place, double *along, double *off)
{
    sp_vec3 e = sp_sub(to, from), f = sp_sub(place, from);
    double length2 = e.x * e.x + e.y * e.y + e.z * e.z;
    double x = e.y * f.z - e.z * f.y, y = e.z * f.x - e.x * f.z, z = e.x * f.y - e.y * f.x;
    *along = (e.x * f.x + e.y * f.y + e.z * f.z) / length2;
    *off = sqrt(x * x + y * y + z * z) / length2;
}

/* Where corner i of a triangle lies if it is turned into the page at the edge to its neighbour and strained as that. */
static void turn_in(const encoder *t, uint32_t triangle, uint32_t i, double uv[2])
{
    uint32_t gate = t->walk->gate[triangle], third = (gate % 3 + 2) % 3;
    const uint32_t *v = t->walk->corners[triangle];
    double(*own)[2] = t->uv[triangle], *a = own[(i + 1) % 3], *b = own[(i + 2) % 3], *c = t->uv[gate / 3][third];
    sp_vec3 from = place_of(t, v[(i + 1) % 3]), to = place_of(t, v[(i + 2) % 3]);
    double along, off, other_along, other_off, g[2] = {b[0] - a[0], b[1] - a[1]};
    measure(from, to, place_of(t, v[i]), &along, &off);
    measure(from, to, place_of(t, t->walk->corners[gate / 3][third]), &other_along, &other_off);
    for (int k = 0; k < 2; k++) {
        double across = (a[k] + other_along * g[k] - c[k]) / other_off;
        uv[k] = a[k] + along * g[k] + off * across;
    }
    if (!(fabs(uv[0]) < FARTHEST) || !(fabs(uv[1]) < FARTHEST))
        memcpy(uv, a, 2 * sizeof *uv);
}

/* Where corner i of a triangle is looked for, from where the others are. */
static void expect(const encoder *t, uint32_t triangle, uint32_t i, double uv[2])
{
    if (t->walk->gate[triangle] == SP_NONE)
        memcpy(uv, i ? t->uv[triangle][i - 1] : (double[]){0, 0}, 2 * sizeof *uv);
    else
        turn_in(t, triangle, i, uv);
}

static void encode(const encoder *t, uint32_t triangle, uint32_t i)
{
    uint32_t chart = t->walk->chart[triangle], vertex = t->walk->corners[triangle][i];
    const double *value = t->atlas->uv[t->walk->triangle[triangle]][i];
    double parts = t->parts[chart], *uv = t->uv[triangle][i], expected[2];
    spot *known = &t->spots[vertex];
    bool seen = known->chart == chart;
    if (seen)
        memcpy(expected, known->uv, sizeof expected);
    else
        expect(t, triangle, i, expected);
    int before = 0;
    for (int k = 0; k < 2; k++) {
        double whole = floor(value[k] * parts), near = floor(expected[k] * parts);
        int64_t off = parts > 0 ? (int64_t)(whole - near) : sp_packed_apart(value[k], expected[k]);
        before = sp_code_number(t->coder, seen ? &t->models->own[k] : &t->models->off[k][before], off);
        uv[k] = parts > 0 ? (near + (double)off) / parts : value[k];
    }
    known->chart = chart;
    memcpy(known->uv, uv, sizeof known->uv);
}

static void encode_all(const encoder *t)
{
    const sp_triangle_order *walk = t->walk;
    for (uint32_t i = 0; i < walk->count; i++) {
        uint32_t gate = walk->gate[i], far = walk->far[i];
        if (gate != SP_NONE) {
            memcpy(t->uv[i][(far + 1) % 3], t->uv[gate / 3][(gate % 3 + 1) % 3], sizeof t->uv[i][0]);
            memcpy(t->uv[i][(far + 2) % 3], t->uv[gate / 3][gate % 3], sizeof t->uv[i][0]);
            encode(t, i, far);
            continue;
        }
        for (uint32_t k = 0; k < 3; k++)
            encode(t, i, k);
    }
}

/* The fewest parts that all corners of a chart are whole in, 0 where there are none such; few of one that is not
 * cleaned. */
static void find_parts(const sp_evaluator *evaluator, double *parts)
{
    const sp_setup *setup = sp_evaluator_setup(evaluator);
    const sp_atlas *atlas = sp_evaluator_atlas(evaluator);
    for (size_t c = 0; c < atlas->chart_count; c++)
        parts[c] = SP_UNFOLDED_PARTS;
    for (uint32_t t = 0; t < setup->mesh->triangle_count; t++) {
        double *own = &parts[atlas->chart[t]];
        if (!setup->surfaces[setup->mesh->part[t]].clean || !sp_evaluator_wet(evaluator, t))
            continue;
        if (*own == SP_UNFOLDED_PARTS)
            *own = SP_ATLAS_PARTS;
        for (int k = 0; k < 6 && *own > 0; k++)
            if (fmod(atlas->uv[t][k / 2][k % 2] * SP_ATLAS_PARTS, 1) != 0)
                *own = 0;
    }
}

bool sp_unfolded_encode(const sp_evaluator *evaluator, const sp_triangle_order *walk, sp_coder *coder)
{
    const sp_atlas *atlas = sp_evaluator_atlas(evaluator);
    encoder t = {.mesh = sp_evaluator_setup(evaluator)->mesh,
                 .atlas = atlas,
                 .walk = walk,
                 .coder = coder,
                 .models = calloc(1, sizeof *t.models),
                 .parts = malloc((atlas->chart_count + 1) * sizeof *t.parts),
                 .spots = malloc((walk->vertex_count + 1) * sizeof *t.spots),
                 .uv = malloc((walk->count + 1) * sizeof *t.uv)};
    bool done = t.models && t.parts && t.spots && t.uv;
    if (done) {
        find_parts(evaluator, t.parts);
        for (size_t c = 0; c < atlas->chart_count; c++)
            sp_code_number(coder, &t.models->parts, (int64_t)t.parts[c]);
        for (size_t i = 0; i < walk->vertex_count; i++)
            t.spots[i].chart = SP_NONE;
        encode_all(&t);
    }
    free(t.models);
    free(t.parts);
    free(t.spots);
    free(t.uv);
    return done;
}
