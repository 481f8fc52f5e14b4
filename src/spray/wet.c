/* The wet sides: lines of sight are cast from every side of every triangle, and two sides that see each other face the
 * same space. What is joined, however indirectly, with what the cavity's point sees is wet. */
#include "state.h"

#include <stdlib.h>

#define LINES 16        /* from each side of each triangle */
#define DIRECTIONS 4096 /* from the cavity's point */
#define BLOCK 4096      /* triangles whose lines are traced before their hits are joined */
/* Of the geometry's diagonal: surfaces nearer than this to each other touch, and a line that starts where its triangle
 * touches another says nothing of the space on either side. */
#define CONTACT 1e-7
#define ON_EDGE 1e-9 /* barycentric: a hit this near to an edge may belong to either neighbour */

/* Instead of a side: */
#define SKY (SIZE_MAX - 1)
#define UNTOLD SIZE_MAX

/* Sides that face the same space, as disjoint sets: side 2t is the front of triangle t, 2t + 1 its back, and the last
 * node is the liquid. */
typedef struct {
    const sp_setup *setup;
    const sp_tracer *tracer;
    double contact; /* m */
    size_t *parent;
    size_t liquid;
} side_flood;

static size_t find_root(side_flood *flood, size_t node)
{
    while (flood->parent[node] != node) {
        flood->parent[node] = flood->parent[flood->parent[node]];
        node = flood->parent[node];
    }
    return node;
}

static void join(side_flood *flood, size_t a, size_t b)
{
    a = find_root(flood, a);
    b = find_root(flood, b);
    if (a < b)
        flood->parent[b] = a;
    else
        flood->parent[a] = b;
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
static sp_ray side_line(const side_flood *flood, size_t side, size_t line)
{
    const sp_mesh *mesh = flood->setup->mesh;
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
    sp_vec3 origin = sp_along(sp_triangle_point(mesh, triangle, u, v), -flood->contact, direction);
    return (sp_ray){.origin = origin, .velocity = direction, .t_min = 0, .t_max = INFINITY, .skip = triangle};
}

static bool same_corners(const sp_mesh *mesh, uint32_t a, uint32_t b)
{
    for (int i = 0; i < 3; i++) {
        bool found = false;
        for (int k = 0; k < 3; k++)
            found =
                found || sp_distance(mesh->vertices[mesh->triangles[a][i]], mesh->vertices[mesh->triangles[b][k]]) == 0;
        if (!found)
            return false;
    }
    return true;
}

/* What a line meets first: a side, SKY, or UNTOLD where the hit does not say. */
typedef struct {
    size_t met;
    double t;
} sighting;

static sighting look(const side_flood *flood, sp_ray line)
{
    const sp_mesh *mesh = flood->setup->mesh;
    sp_hit hit = sp_trace_nearest(flood->tracer, &line, sp_v(0, 0, 0));
    if (line.skip != SP_NONE && hit.t < 2 * flood->contact) {
        if (!same_corners(mesh, line.skip, hit.triangle))
            return (sighting){UNTOLD, hit.t};
        line.t_min = 2 * flood->contact;
        hit = sp_trace_nearest(flood->tracer, &line, sp_v(0, 0, 0));
    }
    if (hit.triangle == SP_NONE)
        return (sighting){SKY, hit.t};
    double facing = sp_dot(sp_triangle_normal(mesh, hit.triangle), line.velocity);
    if (hit.u < ON_EDGE || hit.v < ON_EDGE || 1 - hit.u - hit.v < ON_EDGE || fabs(facing) < ON_EDGE)
        return (sighting){UNTOLD, hit.t};
    return (sighting){2 * (size_t)hit.triangle + (facing > 0), hit.t};
}

/* Whether the triangle met touches another there: where two solids touch, one's wall hides the other's contact face,
 * and round-off chooses which of them is met. */
static bool touches_another(const side_flood *flood, sp_ray line, sighting sighting)
{
    uint32_t triangle = (uint32_t)(sighting.met / 2);
    line.t_min = sighting.t - flood->contact;
    line.t_max = sighting.t + flood->contact;
    line.skip = triangle;
    sp_hit beside = sp_trace_nearest(flood->tracer, &line, sp_v(0, 0, 0));
    return beside.triangle != SP_NONE && !same_corners(flood->setup->mesh, triangle, beside.triangle);
}

/* Whether a line of `node` tells of a connection not known yet. */
static bool is_news(side_flood *flood, size_t node, sighting sighting)
{
    if (sighting.met == SKY)
        return flood->setup->cavity == SP_CAVITY_OUTSIDE;
    return sighting.met != UNTOLD && find_root(flood, node) != find_root(flood, sighting.met);
}

static void join_news(side_flood *flood, size_t node, sp_ray line, sighting sighting)
{
    if (sighting.met == SKY)
        join(flood, node, flood->liquid);
    else if (!touches_another(flood, line, sighting))
        join(flood, node, sighting.met);
}

static bool join_sides(side_flood *flood, sp_error *error)
{
    const sp_setup *setup = flood->setup;
    size_t triangles = setup->mesh->triangle_count;
    sighting *sightings = malloc(2 * LINES * (size_t)BLOCK * sizeof *sightings);
    if (!sightings)
        return sp_fail_memory(error);
    bool done = true;
    for (size_t first = 0; done && first < triangles; first += BLOCK) {
        size_t end = first + BLOCK < triangles ? first + BLOCK : triangles, count = 2 * LINES * (end - first);
#pragma omp parallel for schedule(dynamic, 1024) num_threads(sp_thread_count(setup->run.threads))
        for (size_t i = 0; i < count; i++)
            sightings[i] = look(flood, side_line(flood, 2 * first + i / LINES, i % LINES));
        for (size_t i = 0; i < count; i++) {
            size_t side = 2 * first + i / LINES;
            if (is_news(flood, side, sightings[i]))
                join_news(flood, side, side_line(flood, side, i % LINES), sightings[i]);
        }
        done = sp_evaluator_progress(setup, "wet sides", (double)end / (double)triangles, error);
    }
    free(sightings);
    return done;
}

/* A line that starts on a wall would see, by round-off, what lies on either side. */
static bool starts_on_surface(const side_flood *flood, sp_ray line)
{
    line.origin = sp_along(line.origin, -flood->contact, line.velocity);
    line.t_max = 2 * flood->contact;
    return sp_trace_nearest(flood->tracer, &line, sp_v(0, 0, 0)).triangle != SP_NONE;
}

/* Joins the liquid with what the cavity's point sees. */
static bool join_seen(side_flood *flood, sp_error *error)
{
    sp_vec3 point = flood->setup->cavity_point;
    bool seen = false, touches = false;
    for (int i = 0; i < DIRECTIONS; i++) {
        sp_ray line = {.origin = point,
                       .velocity = sp_sphere_direction(i, DIRECTIONS),
                       .t_min = 0,
                       .t_max = INFINITY,
                       .skip = SP_NONE};
        sighting sighting = look(flood, line);
        touches = touches || starts_on_surface(flood, line);
        if (is_news(flood, flood->liquid, sighting))
            join_news(flood, flood->liquid, line, sighting);
        seen = seen || (sighting.met != SKY && sighting.met != UNTOLD);
    }
    if (seen && !touches)
        return true;
    return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                   "cavity: %s the point (%g m, %g m, %g m); expected a point of the space where the liquid flies",
                   touches ? "a surface goes through" : "no surface is seen from", point.x, point.y, point.z);
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

static bool flood_mesh(const sp_setup *setup, const sp_tracer *tracer, uint8_t *wet, sp_error *error)
{
    size_t sides = 2 * setup->mesh->triangle_count;
    side_flood flood = {.setup = setup,
                        .tracer = tracer,
                        .contact = CONTACT * mesh_diagonal(setup->mesh),
                        .parent = malloc((sides + 1) * sizeof *flood.parent),
                        .liquid = sides};
    if (!flood.parent)
        return sp_fail_memory(error);
    for (size_t i = 0; i <= sides; i++)
        flood.parent[i] = i;
    bool done = (setup->cavity == SP_CAVITY_OUTSIDE || join_seen(&flood, error)) && join_sides(&flood, error);
    size_t liquid = find_root(&flood, flood.liquid);
    for (size_t i = 0; done && i < sides; i++)
        if (find_root(&flood, i) == liquid)
            wet[i / 2] |= (uint8_t)(1u << (i % 2));
    free(flood.parent);
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
    } else if (!flood_mesh(setup, tracer, wet, error)) {
        free(wet);
        return NULL;
    }
    return wet;
}
