#include "trace/line/line_packet.h"
#include "trace/line/line_bvh.h"
#include "trace/parabola/parabola_bvh.h"
#include "trace/parabola/parabola_packet.h"

#include "valid_range.h"

#include <omp.h>
#include <stdlib.h>

struct sp_tracer {
    const sp_mesh *mesh;
    sp_accelerator accelerator;
    sp_bvh bvh;
    sp_instructions instructions; /* that walk the bvh */
    sp_kd_tree tree;              /* SP_ACCELERATOR_NONE: only the box around all triangles */
    sp_corners *corners;          /* [triangle_count]: together in memory, as they are read together; not for the bvh */
};

static int thread_count(int threads)
{
    return threads > SP_THREADS ? SP_THREADS : threads > 0 ? threads : omp_get_max_threads();
}

static bool enclose(const sp_mesh *mesh, sp_kd_tree *tree)
{
    sp_kd_box *boxes = sp_kd_boxes(mesh);
    if (boxes)
        sp_kd_enclose((const sp_kd_box *)boxes, mesh->triangle_count, tree);
    free(boxes);
    return boxes != NULL;
}

static bool build(sp_tracer *tracer, int threads)
{
    const sp_mesh *mesh = tracer->mesh;
    if (tracer->accelerator == SP_ACCELERATOR_BVH)
        return sp_bvh_build(mesh, threads, &tracer->bvh);
    tracer->corners = malloc((mesh->triangle_count + 1) * sizeof *tracer->corners);
    if (!tracer->corners)
        return false;
    for (size_t t = 0; t < mesh->triangle_count; t++)
        for (int i = 0; i < 3; i++)
            sp_to_array(mesh->vertices[mesh->triangles[t][i]], tracer->corners[t][i]);
    if (tracer->accelerator == SP_ACCELERATOR_NONE)
        return enclose(mesh, &tracer->tree);
    return tracer->accelerator == SP_ACCELERATOR_NAIVE ? sp_kd_build_naive(mesh, &tracer->tree)
                                                       : sp_kd_build_sah(mesh, &tracer->tree);
}

sp_tracer *sp_tracer_create(const sp_mesh *mesh, sp_accelerator accelerator, int threads, sp_error *error)
{
    if (!mesh || !sp_are_threads(threads, error)) /* its making failed and said so */
        return NULL;
    sp_tracer *tracer = calloc(1, sizeof *tracer);
    if (!tracer)
        return sp_fail_memory(error);
    tracer->mesh = mesh;
    tracer->accelerator = accelerator;
    tracer->instructions = sp_instructions_best();
    if (!build(tracer, thread_count(threads))) {
        sp_tracer_destroy(tracer);
        return sp_fail_memory(error);
    }
    return tracer;
}

void sp_tracer_destroy(sp_tracer *tracer)
{
    if (!tracer)
        return;
    sp_bvh_clear(&tracer->bvh);
    sp_kd_clear(&tracer->tree);
    free(tracer->corners);
    free(tracer);
}

const sp_mesh *sp_tracer_mesh(const sp_tracer *tracer)
{
    return tracer->mesh;
}

size_t sp_tracer_bytes(const sp_tracer *tracer)
{
    if (tracer->accelerator == SP_ACCELERATOR_BVH)
        return sizeof *tracer + tracer->bvh.node_count * sizeof *tracer->bvh.nodes +
               tracer->bvh.block_count * sizeof *tracer->bvh.blocks;
    return sizeof *tracer + tracer->mesh->triangle_count * sizeof *tracer->corners +
           tracer->tree.node_room * sizeof *tracer->tree.nodes +
           tracer->tree.reference_room * sizeof *tracer->tree.references;
}

bool sp_tracer_visit(const sp_tracer *tracer, sp_box_test *test, sp_triangle_visitor *visit, const void *region)
{
    if (tracer->accelerator == SP_ACCELERATOR_BVH)
        return sp_bvh_visit(&tracer->bvh, test, visit, region);
    for (size_t t = 0; t < tracer->mesh->triangle_count; t++)
        if (!visit(region, (uint32_t)t))
            return false;
    return true;
}

size_t sp_tracer_leaves(const sp_tracer *tracer, double (*boxes)[6])
{
    if (tracer->accelerator != SP_ACCELERATOR_BVH)
        return 0;
    if (boxes)
        sp_bvh_leaves(&tracer->bvh, boxes);
    return tracer->bvh.block_count;
}

void sp_tracer_use(sp_tracer *tracer, sp_instructions instructions)
{
    tracer->instructions = instructions;
}

static void search_line(const sp_tracer *tracer, const sp_ray *ray, sp_ray_search *search)
{
    const sp_corners *corners = (const sp_corners *)tracer->corners;
    sp_line line;
    if (!sp_line_start(&line, ray))
        return;
    if (tracer->accelerator == SP_ACCELERATOR_NONE)
        sp_line_search_all(&line, corners, tracer->mesh->triangle_count, search);
    else
        sp_line_search_tree(&line, corners, &tracer->tree, search);
}

static void search_parabola(const sp_tracer *tracer, const sp_ray *ray, const sp_acceleration *acceleration,
                            sp_ray_search *search)
{
    const sp_corners *corners = (const sp_corners *)tracer->corners;
    sp_parabola parabola;
    if (!sp_parabola_start(&parabola, ray, acceleration, tracer->tree.low, tracer->tree.high) ||
        !sp_parabola_limit(&parabola, search))
        return;
    if (tracer->accelerator == SP_ACCELERATOR_NONE)
        sp_parabola_search_all(&parabola, corners, tracer->mesh->triangle_count, search);
    else
        sp_parabola_search_tree(&parabola, corners, &tracer->tree, search);
}

static void trace_line(const sp_tracer *tracer, const sp_ray *ray, sp_ray_search *search)
{
    bool occluded = false;
    sp_bvh_trace_lines(&tracer->bvh, tracer->instructions, ray, NULL, 1, search->any ? NULL : &search->best, &occluded);
    if (occluded)
        search->best.triangle = 0; /* or another */
}

static void trace_parabola(const sp_tracer *tracer, const sp_ray *ray, const sp_acceleration *acceleration,
                           sp_ray_search *search)
{
    const uint32_t only = 0;
    bool occluded = false;
    sp_bvh_trace_parabolas(&tracer->bvh, tracer->instructions, ray, &only, 1, acceleration,
                           search->any ? NULL : &search->best, &occluded);
    if (occluded)
        search->best.triangle = 0; /* or another */
}

static sp_hit trace(const sp_tracer *tracer, const sp_ray *ray, const sp_acceleration *acceleration, bool any)
{
    sp_ray_search search = sp_ray_search_start(ray, any);
    bool is_bvh = tracer->accelerator == SP_ACCELERATOR_BVH;
    if (acceleration->strength != 0 && is_bvh)
        trace_parabola(tracer, ray, acceleration, &search);
    else if (acceleration->strength != 0)
        search_parabola(tracer, ray, acceleration, &search);
    else if (is_bvh)
        trace_line(tracer, ray, &search);
    else
        search_line(tracer, ray, &search);
    return search.best;
}

sp_hit sp_trace_nearest(const sp_tracer *tracer, const sp_ray *ray, sp_vec3 gravity)
{
    sp_acceleration acceleration = sp_acceleration_of(gravity);
    return trace(tracer, ray, &acceleration, false);
}

bool sp_trace_occluded(const sp_tracer *tracer, const sp_ray *ray, sp_vec3 gravity)
{
    sp_acceleration acceleration = sp_acceleration_of(gravity);
    return trace(tracer, ray, &acceleration, true).triangle != SP_NONE;
}

/* Rays that one thread takes at a time: so many that sorting them brings neighbours together. */
enum { CHUNK = 1 << 18, CHUNK_LEAST = 1 << 10, COMMON_ORIGIN_LEAST = 64, COMMON_ORIGIN_SPARSE = 6 };

static size_t chunk_size(size_t count, int threads)
{
    size_t share = threads > 1 ? count / (2 * (size_t)threads) + 1 : count;
    return share < CHUNK_LEAST ? CHUNK_LEAST : share > CHUNK ? CHUNK : share;
}

/* How many rays from the first on have its origin. */
static size_t count_common_origin(const sp_ray *rays, size_t count)
{
    size_t n = 1;
    while (n < count && rays[n].origin.x == rays[0].origin.x && rays[n].origin.y == rays[0].origin.y &&
           rays[n].origin.z == rays[0].origin.z)
        n++;
    return n;
}

/* hits or occluded, whichever is not NULL. */
static void trace_one_by_one(const sp_tracer *tracer, const sp_ray *rays, size_t count,
                             const sp_acceleration *acceleration, sp_hit *hits, bool *occluded)
{
    for (size_t i = 0; i < count; i++) {
        sp_hit hit = trace(tracer, &rays[i], acceleration, !hits);
        if (hits)
            hits[i] = hit;
        else
            occluded[i] = hit.triangle != SP_NONE;
    }
}

/* Lines through the bvh: those of one origin in packets, all others as single rays. With more than COMMON_ORIGIN_SPARSE
 * triangles to a ray, neighbours meet different ones, and each is faster by itself. */
static void trace_lines(const sp_tracer *tracer, const sp_ray *rays, size_t count, sp_common_origin_room *room,
                        sp_hit *hits, bool *occluded)
{
    const sp_bvh *bvh = &tracer->bvh;
    sp_instructions instructions = tracer->instructions;
    size_t single = 0; /* the first not yet traced */
    for (size_t i = 0, n; i <= count; i += n) {
        n = i < count ? count_common_origin(rays + i, count - i) : 1;
        if (i < count && n < COMMON_ORIGIN_LEAST)
            continue;
        bool sparse = n < tracer->mesh->triangle_count / COMMON_ORIGIN_SPARSE;
        sp_bvh_trace_lines(bvh, instructions, rays + single, NULL, i - single, hits ? hits + single : NULL,
                           hits ? NULL : occluded + single);
        single = i;
        if (i < count && (sparse ? sp_common_origin_trace_singly : sp_common_origin_trace)(
                             bvh, instructions, rays + i, n, room, hits ? hits + i : NULL, hits ? NULL : occluded + i))
            single += n;
    }
}

/* Parabolas through the bvh: those of one origin in packets, all others as single rays. */
static void trace_parabolas(const sp_tracer *tracer, const sp_ray *rays, size_t count,
                            const sp_acceleration *acceleration, sp_hit *hits, bool *occluded)
{
    size_t single = 0;
    uint32_t *left = malloc((count + 1) * sizeof *left);
    if (!left) {
        trace_one_by_one(tracer, rays, count, acceleration, hits, occluded);
        return;
    }
    for (size_t i = 0, n; i < count; i += n) {
        n = count_common_origin(rays + i, count - i);
        size_t more = 1;
        left[single] = 0;
        if (n >= COMMON_ORIGIN_LEAST)
            more = sp_parabola_packets_trace(&tracer->bvh, tracer->instructions, rays + i, n, acceleration,
                                             hits ? hits + i : NULL, hits ? NULL : occluded + i, left + single);
        else
            n = 1;
        for (size_t end = single + more; single < end; single++)
            left[single] += (uint32_t)i;
    }
    sp_bvh_trace_parabolas(&tracer->bvh, tracer->instructions, rays, left, single, acceleration, hits, occluded);
    free(left);
}

static void trace_chunk(const sp_tracer *tracer, const sp_ray *rays, size_t count, const sp_acceleration *acceleration,
                        sp_common_origin_room *room, sp_hit *hits, bool *occluded)
{
    if (tracer->accelerator != SP_ACCELERATOR_BVH)
        trace_one_by_one(tracer, rays, count, acceleration, hits, occluded);
    else if (acceleration->strength == 0)
        trace_lines(tracer, rays, count, room, hits, occluded);
    else
        trace_parabolas(tracer, rays, count, acceleration, hits, occluded);
}

static void trace_many(const sp_tracer *tracer, const sp_ray *rays, size_t count, sp_vec3 gravity, int threads,
                       sp_hit *hits, bool *occluded)
{
    sp_acceleration acceleration = sp_acceleration_of(gravity);
    threads = thread_count(threads);
    size_t size = chunk_size(count, threads), chunks = (count + size - 1) / size;
    if (chunks == 1 && count < CHUNK_LEAST) { /* a team, even of one, costs as much as some rays */
        sp_common_origin_room room = {0};
        trace_chunk(tracer, rays, count, &acceleration, &room, hits, occluded);
        sp_common_origin_room_clear(&room);
        return;
    }
#pragma omp parallel num_threads(threads)
    {
        sp_common_origin_room room = {0};
#pragma omp for schedule(dynamic, 1)
        for (size_t c = 0; c < chunks; c++) {
            size_t first = c * size, n = count - first < size ? count - first : size;
            trace_chunk(tracer, rays + first, n, &acceleration, &room, hits ? hits + first : NULL,
                        hits ? NULL : occluded + first);
        }
        sp_common_origin_room_clear(&room);
    }
}

void sp_trace_nearest_many(const sp_tracer *tracer, const sp_ray *rays, size_t count, sp_vec3 gravity, int threads,
                           sp_hit *hits)
{
    trace_many(tracer, rays, count, gravity, threads, hits, NULL);
}

void sp_trace_occluded_many(const sp_tracer *tracer, const sp_ray *rays, size_t count, sp_vec3 gravity, int threads,
                            bool *occluded)
{
    trace_many(tracer, rays, count, gravity, threads, NULL, occluded);
}
