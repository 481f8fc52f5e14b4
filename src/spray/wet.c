/* The wet sides: lines of sight are cast from every side of every triangle, and two sides that see each other face the
 * same space. What is joined, however indirectly, with what the cavity's point sees is wet. */
#include "state.h"

#include <stdlib.h>

#define LINES 16        /* from each side of each triangle */
#define DIRECTIONS 4096 /* from the cavity's point */
#define BLOCK 4096      /* triangles whose lines are traced at once */
/* Of the geometry's diagonal: surfaces nearer than this to each other touch, and a line that starts where its triangle
 * touches another says nothing of the space on either side. */
#define CONTACT 1e-7
#define ON_EDGE 1e-9 /* barycentric: a hit this near to an edge may belong to either neighbour */

/* Sides that face the same space, as disjoint sets: side 2t is the front of triangle t, 2t + 1 its back, and the last
 * node is the liquid. */
typedef struct {
    size_t *parent;
    size_t liquid;
} space_sets;

static size_t find_root(space_sets *sets, size_t node)
{
    while (sets->parent[node] != node) {
        sets->parent[node] = sets->parent[sets->parent[node]];
        node = sets->parent[node];
    }
    return node;
}

static void join(space_sets *sets, size_t a, size_t b)
{
    a = find_root(sets, a);
    b = find_root(sets, b);
    if (a < b)
        sets->parent[b] = a;
    else
        sets->parent[a] = b;
}

/* Coordinate `axis` of point `index` of the R sequence in four dimensions (Roberts 2018, "The unreasonable
 * effectiveness of quasirandom sequences"): multiples of the powers of 1/g, g^5 = g + 1, in 64-bit fixed point, so that
 * no index is too large. */
static double sequence(uint64_t index, int axis)
{
    static const uint64_t step[4] = {0xdb4f0b9175ae2165, 0xbbe0563303a4615f, 0xa0f2ec75a1fe1575, 0x89e182857d9ed689};
    return (double)((0x8000000000000000u + index * step[axis]) >> 11) * 0x1p-53;
}

/* A line from inside a triangle into the space that its side faces. It starts a little way back, so that a surface that
 * touches the triangle there is met rather than missed by round-off. */
static sp_ray side_line(const sp_mesh *mesh, size_t side, unsigned line, double contact)
{
    uint32_t triangle = (uint32_t)(side / 2);
    uint64_t index = (uint64_t)side * LINES + line;
    double root = sqrt(sequence(index, 0)), share = sequence(index, 1);
    /* Kept off the edges, where the neighbours' planes are within round-off. */
    double u = 0.05 + 0.85 * root * (1 - share), v = 0.05 + 0.85 * root * share;

    sp_vec3 z = sp_triangle_normal(mesh, triangle);
    if (side % 2)
        z = sp_scale(z, -1);
    sp_vec3 x = sp_unit(sp_cross(fabs(z.x) < 0.5 ? sp_v(1, 0, 0) : sp_v(0, 1, 0), z)), y = sp_cross(z, x);
    double height = 1e-3 + (1 - 1e-3) * sequence(index, 2), turn = 2 * M_PI * sequence(index, 3);
    double radius = sqrt(1 - height * height);
    sp_vec3 direction = sp_scale(z, height);
    direction = sp_along(direction, radius * cos(turn), x);
    direction = sp_along(direction, radius * sin(turn), y);
    sp_vec3 origin = sp_along(sp_triangle_point(mesh, triangle, u, v), -contact, direction);
    return (sp_ray){.origin = origin, .velocity = direction, .t_min = 0, .t_max = INFINITY, .skip = triangle};
}

/* The side that a line meets, or SIZE_MAX where the hit does not say. */
static size_t side_met(const sp_mesh *mesh, const sp_ray *line, const sp_hit *hit)
{
    if (hit->u < ON_EDGE || hit->v < ON_EDGE || 1 - hit->u - hit->v < ON_EDGE)
        return SIZE_MAX;
    double facing = sp_dot(sp_triangle_normal(mesh, hit->triangle), line->velocity);
    if (fabs(facing) < 1e-9)
        return SIZE_MAX;
    return 2 * (size_t)hit->triangle + (facing > 0);
}

static void join_hits(const sp_setup *setup, space_sets *sets, size_t first_side, size_t count, const sp_ray *lines,
                      const sp_hit *hits, double contact)
{
    for (size_t i = 0; i < count; i++) {
        size_t side = first_side + i / LINES;
        if (hits[i].triangle == SP_NONE) {
            if (setup->cavity == SP_CAVITY_OUTSIDE)
                join(sets, side, sets->liquid);
            continue;
        }
        size_t met = hits[i].t < 2 * contact ? SIZE_MAX : side_met(setup->mesh, &lines[i], &hits[i]);
        if (met != SIZE_MAX)
            join(sets, side, met);
    }
}

static bool join_sides(const sp_setup *setup, const sp_tracer *tracer, space_sets *sets, double contact,
                       sp_error *error)
{
    const sp_mesh *mesh = setup->mesh;
    size_t most = 2 * LINES * (size_t)BLOCK;
    sp_ray *lines = malloc(most * sizeof *lines);
    sp_hit *hits = malloc(most * sizeof *hits);
    bool done = lines && hits;
    if (!done)
        sp_fail_memory(error);
    for (size_t first = 0; done && first < mesh->triangle_count; first += BLOCK) {
        size_t triangles = mesh->triangle_count - first < BLOCK ? mesh->triangle_count - first : BLOCK;
        size_t count = 2 * LINES * triangles;
#pragma omp parallel for num_threads(sp_thread_count(setup->run.threads))
        for (size_t i = 0; i < count; i++)
            lines[i] = side_line(mesh, 2 * first + i / LINES, i % LINES, contact);
        sp_trace_nearest_many(tracer, lines, count, sp_v(0, 0, 0), setup->run.threads, hits);
        join_hits(setup, sets, 2 * first, count, lines, hits, contact);
        done = sp_evaluator_progress(setup, "wet sides", (double)(first + triangles) / (double)mesh->triangle_count,
                                     error);
    }
    free(lines);
    free(hits);
    return done;
}

/* Joins the liquid with what the cavity's point sees. */
static bool join_seen(const sp_setup *setup, const sp_tracer *tracer, space_sets *sets, sp_error *error)
{
    sp_vec3 point = setup->cavity_point;
    bool seen = false;
    for (int i = 0; i < DIRECTIONS; i++) {
        sp_ray line = {.origin = point,
                       .velocity = sp_sphere_direction(i, DIRECTIONS),
                       .t_min = 0,
                       .t_max = INFINITY,
                       .skip = SP_NONE};
        sp_hit hit = sp_trace_nearest(tracer, &line, sp_v(0, 0, 0));
        size_t met = hit.triangle == SP_NONE ? SIZE_MAX : side_met(setup->mesh, &line, &hit);
        if (met == SIZE_MAX)
            continue;
        join(sets, met, sets->liquid);
        seen = true;
    }
    return seen ||
           sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                   "cavity: no surface is seen from the point (%g m, %g m, %g m); expected a point of the space "
                   "where the liquid flies",
                   point.x, point.y, point.z);
}

static double mesh_diagonal(const sp_mesh *mesh)
{
    sp_vec3 low = sp_v(INFINITY, INFINITY, INFINITY), high = sp_scale(low, -1);
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        for (int corner = 0; corner < 3; corner++) {
            sp_vec3 p = mesh->vertices[mesh->triangles[i][corner]];
            low = sp_v(fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z));
            high = sp_v(fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z));
        }
    }
    return mesh->triangle_count ? sp_distance(low, high) : 0;
}

static bool flood(const sp_setup *setup, const sp_tracer *tracer, uint8_t *wet, sp_error *error)
{
    size_t sides = 2 * setup->mesh->triangle_count;
    space_sets sets = {.parent = malloc((sides + 1) * sizeof *sets.parent), .liquid = sides};
    if (!sets.parent)
        return sp_fail_memory(error);
    for (size_t i = 0; i <= sides; i++)
        sets.parent[i] = i;
    bool done = (setup->cavity == SP_CAVITY_OUTSIDE || join_seen(setup, tracer, &sets, error)) &&
                join_sides(setup, tracer, &sets, CONTACT * mesh_diagonal(setup->mesh), error);
    size_t liquid = find_root(&sets, sets.liquid);
    for (size_t i = 0; done && i < sides; i++)
        if (find_root(&sets, i) == liquid)
            wet[i / 2] |= (uint8_t)(1u << (i % 2));
    free(sets.parent);
    return done;
}

uint8_t *sp_wet_sides(const sp_setup *setup, const sp_tracer *tracer, sp_error *error)
{
    size_t count = setup->mesh->triangle_count;
    uint8_t *wet = calloc(count ? count : 1, 1);
    if (!wet)
        return sp_fail_memory(error);
    if (setup->cavity == SP_CAVITY_NONE) {
        for (size_t i = 0; i < count; i++)
            wet[i] = 3;
    } else if (!flood(setup, tracer, wet, error)) {
        free(wet);
        return NULL;
    }
    return wet;
}
