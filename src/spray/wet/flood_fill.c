/* Lines of sight are cast from every free side, and two sides that see each other look into the same space. What is
 * joined, however indirectly, with what the cavity's point sees is wet. The lines come in rounds: a few from every
 * side, then more from those that are not wet yet, until further rounds join nothing. Large faces cast more. */
#include "spray/wet/flood_fill.h"

#include <stdlib.h>

#define DIRECTIONS 4096    /* from the cavity's point */
#define BLOCK 65536        /* lines traced before their hits are looked at */
#define LINES_BY_AREA 4096 /* in a round, besides one for each side */
#define MOST_LINES 1024    /* of a side in a round */
#define ROUNDS_OF_ALL 3
#define MOST_ROUNDS 32
#define SILENT_ROUNDS 2 /* of what is not wet yet, that join nothing: then it ends */
#define START 2.0       /* contacts: lines start so far before their face */
#define ON_EDGE 1e-9    /* barycentric: a hit this near to an edge may belong to either neighbour */

/* Coordinate `axis` of point `index` of the R sequence in four dimensions (Roberts 2018, "The unreasonable
 * effectiveness of quasirandom sequences"): multiples of the powers of 1/g, g^5 = g + 1, in 64-bit fixed point, so that
 * no index is too large. */
static double sequence(uint64_t index, int axis)
{
    static const uint64_t step[4] = {0xdb4f0b9175ae2165, 0xbbe0563303a4615f, 0xa0f2ec75a1fe1575, 0x89e182857d9ed689};
    return (double)((0x8000000000000000u + index * step[axis]) >> 11) * 0x1p-53;
}

sp_ray sp_flood_line(const sp_flood *flood, uint32_t side, uint64_t line)
{
    const sp_mesh *mesh = flood->setup->mesh;
    uint32_t triangle = sp_face_triangle(flood->faces, side / 2);
    uint64_t index = (uint64_t)side * 2 * SP_FLOOD_LINES + line;
    sp_vec3 z = sp_triangle_normal(mesh, triangle);
    if (side % 2)
        z = sp_scale(z, -1);
    sp_vec3 x = sp_unit(sp_cross(fabs(z.x) < 0.5 ? sp_v(1, 0, 0) : sp_v(0, 1, 0), z)), y = sp_cross(z, x);
    double height = 1e-3 + (1 - 1e-3) * sequence(index, 2), turn = 2 * M_PI * sequence(index, 3);
    double radius = sqrt(1 - height * height);
    sp_vec3 direction = sp_scale(z, height);
    direction = sp_along(direction, radius * cos(turn), x);
    direction = sp_along(direction, radius * sin(turn), y);
    sp_vec3 point = sp_face_point(flood->faces, side / 2, sequence(index, 0), sequence(index, 1));
    return (sp_ray){.origin = sp_along(point, START * flood->faces->cuts->contact, z),
                    .velocity = direction,
                    .t_min = 0,
                    .t_max = INFINITY,
                    .skip = triangle};
}

uint32_t sp_flood_met(const sp_flood *flood, const sp_ray *line, const sp_hit *hit)
{
    const sp_faces *faces = flood->faces;
    if (flood->setup->cap_count && sp_caps_block(flood->setup, line, hit->t))
        return SP_AMBIGUOUS;
    if (hit->triangle == SP_NONE)
        return SP_SKY;
    double facing = sp_dot(sp_triangle_normal(flood->setup->mesh, hit->triangle), line->velocity);
    if (hit->u < ON_EDGE || hit->v < ON_EDGE || 1 - hit->u - hit->v < ON_EDGE || fabs(facing) < ON_EDGE)
        return SP_AMBIGUOUS;
    bool near;
    uint32_t side = 2 * sp_face_at(faces, hit->triangle, hit->u, hit->v, &near) + (facing > 0);
    if (near)
        return SP_AMBIGUOUS;
    if (faces->state[side] == SP_FACE_TOUCHING && faces->stands_for[side] != SP_NONE)
        side = faces->stands_for[side];
    return faces->state[side] == SP_FACE_FREE ? side : SP_AMBIGUOUS;
}

static bool note_sight(sp_flood *flood, sp_sight_link sight)
{
    if (flood->sight_count == flood->sight_room) {
        size_t room = 2 * flood->sight_room + BLOCK;
        sp_sight_link *sights = realloc(flood->sights, room * sizeof *sights);
        if (!sights)
            return false;
        flood->sights = sights;
        flood->sight_room = room;
    }
    flood->sights[flood->sight_count++] = sight;
    return true;
}

/* Lines waiting to be traced together. */
typedef struct {
    uint32_t *side; /* [BLOCK] */
    sp_ray *rays;   /* [BLOCK] */
    uint64_t *line; /* [BLOCK] */
    sp_hit *hits;   /* [BLOCK] */
    size_t count;
    size_t joined; /* by all so far */
} line_block;

static bool trace_block(sp_flood *flood, line_block *block)
{
    int threads = sp_thread_count(flood->setup->run.threads);
    uint32_t liquid = (uint32_t)flood->sides;
#pragma omp parallel for schedule(static, 256) num_threads(threads)
    for (size_t i = 0; i < block->count; i++)
        block->rays[i] = sp_flood_line(flood, block->side[i], block->line[i]);
    sp_trace_nearest_many(flood->tracer, block->rays, block->count, sp_v(0, 0, 0), threads, block->hits);
    bool done = true;
    for (size_t i = 0; i < block->count && done; i++) {
        uint32_t met = sp_flood_met(flood, &block->rays[i], &block->hits[i]);
        done = note_sight(flood, (sp_sight_link){block->side[i], met, (uint32_t)block->line[i]});
        if (met == SP_SKY && flood->setup->cavity == SP_CAVITY_OUTSIDE)
            block->joined += sp_set_join(flood->parent, block->side[i], liquid);
        else if (met != SP_SKY && met != SP_AMBIGUOUS)
            block->joined += sp_set_join(flood->parent, block->side[i], met);
    }
    block->count = 0;
    return done;
}

static uint64_t lines_of(const sp_flood *flood, uint32_t side)
{
    return (uint64_t)fmin(1 + floor(LINES_BY_AREA * flood->faces->area[side / 2] / flood->area), MOST_LINES);
}

bool sp_flood_cast(sp_flood *flood, const bool *sides, uint64_t first, uint64_t least, size_t *joined, sp_error *error)
{
    line_block block = {.side = malloc(BLOCK * sizeof *block.side),
                        .rays = malloc(BLOCK * sizeof *block.rays),
                        .line = malloc(BLOCK * sizeof *block.line),
                        .hits = malloc(BLOCK * sizeof *block.hits)};
    bool done = block.side && block.rays && block.line && block.hits;
    for (uint32_t side = 0; side < flood->sides && done; side++) {
        uint64_t lines = sides[side] ? lines_of(flood, side) : 0;
        if (sides[side] && lines < least)
            lines = least;
        for (uint64_t i = 0; i < lines && done; i++) {
            block.side[block.count] = side;
            block.line[block.count++] = first + i;
            if (block.count == BLOCK)
                done = trace_block(flood, &block);
        }
    }
    done = done && trace_block(flood, &block);
    *joined = block.joined;
    free(block.side);
    free(block.rays);
    free(block.line);
    free(block.hits);
    return done || sp_fail_memory(error);
}

/* The sides that cast lines in a round: all free ones, later those that are dry so far. Returns how many. */
static size_t choose_sides(sp_flood *flood, uint64_t round, bool *sides)
{
    size_t chosen = 0;
    uint32_t liquid = sp_set_root(flood->parent, (uint32_t)flood->sides);
    for (uint32_t side = 0; side < flood->sides; side++) {
        sides[side] = flood->faces->state[side] == SP_FACE_FREE &&
                      (round < ROUNDS_OF_ALL || sp_set_root(flood->parent, side) != liquid);
        chosen += sides[side];
    }
    return chosen;
}

static bool cast_rounds(sp_flood *flood, sp_error *error)
{
    bool *sides = malloc(flood->sides + 1), done = true;
    if (!sides)
        return sp_fail_memory(error);
    int silent = 0;
    for (uint64_t round = 0; done && round < MOST_ROUNDS; round++) {
        if (choose_sides(flood, round, sides) == 0 || silent >= SILENT_ROUNDS)
            break;
        size_t joined = 0;
        done = sp_flood_cast(flood, sides, round * MOST_LINES, 1, &joined, error) &&
               sp_evaluator_progress(flood->setup, "wet sides", (double)(round + 1) / MOST_ROUNDS, error);
        silent = joined > 0 || round < ROUNDS_OF_ALL ? 0 : silent + 1;
    }
    free(sides);
    return done;
}

/* A line that starts on a wall would see, by round-off, what lies on either side. */
static bool starts_on_surface(const sp_flood *flood, sp_ray line)
{
    double contact = flood->faces->cuts->contact;
    line.origin = sp_along(line.origin, -contact, line.velocity);
    line.t_max = 2 * contact;
    return sp_trace_nearest(flood->tracer, &line, sp_v(0, 0, 0)).triangle != SP_NONE;
}

/* Whether the middle of a side sees the cavity's point. */
static bool sees_point(const sp_flood *flood, uint32_t side)
{
    uint32_t triangle = sp_face_triangle(flood->faces, side / 2);
    sp_vec3 normal = sp_scale(sp_triangle_normal(flood->setup->mesh, triangle), side % 2 ? -1 : 1);
    sp_vec3 middle = sp_face_point(flood->faces, side / 2, 0.5, 0.5);
    sp_ray line = {
        .origin = sp_along(middle, START * flood->faces->cuts->contact, normal), .t_max = 1, .skip = triangle};
    line.velocity = sp_sub(flood->setup->cavity_point, line.origin);
    return sp_dot(line.velocity, normal) > 0 && !sp_caps_block(flood->setup, &line, 1) &&
           !sp_trace_occluded(flood->tracer, &line, sp_v(0, 0, 0));
}

/* Joins the liquid with the sides that see the cavity's point, however small they look from there. */
static void join_in_view(sp_flood *flood)
{
#pragma omp parallel for schedule(dynamic, 1024) num_threads(sp_thread_count(flood->setup->run.threads))
    for (uint32_t side = 0; side < flood->sides; side++)
        if (flood->faces->state[side] == SP_FACE_FREE)
            flood->in_view[side] = flood->in_view[side] || sees_point(flood, side);
    for (uint32_t side = 0; side < flood->sides; side++)
        if (flood->in_view[side])
            sp_set_join(flood->parent, side, (uint32_t)flood->sides);
}

/* Joins the liquid with what the cavity's point sees. */
static bool join_seen(sp_flood *flood, sp_error *error)
{
    sp_vec3 point = flood->setup->cavity_point;
    bool seen = false, touches = false;
    for (int i = 0; i < DIRECTIONS; i++) {
        sp_ray line = sp_sphere_sight(point, i, DIRECTIONS);
        sp_hit hit = sp_trace_nearest(flood->tracer, &line, sp_v(0, 0, 0));
        uint32_t met = sp_flood_met(flood, &line, &hit);
        touches = touches || starts_on_surface(flood, line);
        if (met == SP_SKY || met == SP_AMBIGUOUS)
            continue;
        seen = true;
        flood->seen[met]++;
        flood->in_view[met] = true;
        sp_set_join(flood->parent, met, (uint32_t)flood->sides);
    }
    if (seen && !touches) {
        join_in_view(flood);
        return true;
    }
    sp_vec3 outside = sp_setup_outside(flood->setup, point);
    return sp_fail(
        error, SP_ERROR_INPUT, NULL, 0, 0,
        "cavity: %s the point (%.12g m, %.12g m, %.12g m); expected a point of the space where the liquid flies",
        touches ? "a surface goes through" : "no surface is seen from", outside.x, outside.y, outside.z);
}

bool sp_flood_faces(const sp_setup *setup, const sp_tracer *tracer, const sp_faces *faces, const sp_shells *shells,
                    sp_flooded *found, sp_error *error)
{
    sp_flood flood = {.setup = setup, .tracer = tracer, .faces = faces, .shells = shells, .sides = 2 * faces->count};
    flood.parent = malloc((flood.sides + 1) * sizeof *flood.parent);
    flood.seen = calloc(flood.sides + 1, sizeof *flood.seen);
    flood.in_view = calloc(flood.sides + 1, sizeof *flood.in_view);
    bool done = flood.parent && flood.seen && flood.in_view;
    if (!done)
        sp_fail_memory(error);
    for (uint32_t i = 0; done && i <= flood.sides; i++) {
        flood.parent[i] = i;
        flood.area += i < flood.sides && faces->state[i] == SP_FACE_FREE ? faces->area[i / 2] : 0;
    }
    done = done && (setup->cavity == SP_CAVITY_OUTSIDE || join_seen(&flood, error)) && cast_rounds(&flood, error);
    if (done) {
        uint32_t root = sp_set_root(flood.parent, (uint32_t)flood.sides);
        for (uint32_t side = 0; side < flood.sides; side++)
            found->liquid[side] = faces->state[side] == SP_FACE_FREE && sp_set_root(flood.parent, side) == root;
        done =
            setup->cavity == SP_CAVITY_OUTSIDE || sp_flood_keep_indoors(&flood, found->liquid, &found->outdoors, error);
        if (done && setup->cavity == SP_CAVITY_POINT)
            done = sp_flood_openings(&flood, found, error);
    }
    free(flood.parent);
    free(flood.seen);
    free(flood.in_view);
    free(flood.sights);
    return done;
}
