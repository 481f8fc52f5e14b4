/* Builds every accelerator, several times, in turn. */
#include "bench.h"

#include <stdlib.h>

const char *const bench_accelerator_names[ACCELERATORS] = {"bvh",  "sah",         "naive",
                                                           "none", "embree-fast", "embree-robust"};
enum { MOST_BUILDS = 9 };
static const double ENOUGH = 1.0; /* s of building after which there is no further round */

/* One accelerator at one number of threads. */
typedef struct {
    int accelerator, threads;
    double seconds[MOST_BUILDS];
    size_t bytes;
} contestant;

static const struct {
    bool parallel;
    sp_accelerator value;
} own[OWN] = {
    [OWN_BVH] = {true, SP_ACCELERATOR_BVH},
    [OWN_SAH] = {false, SP_ACCELERATOR_SAH},
    [OWN_NAIVE] = {false, SP_ACCELERATOR_NAIVE},
    [OWN_NONE] = {false, SP_ACCELERATOR_NONE},
};

static bool copy_vertices(bench_scaffold *scaffold)
{
    const sp_mesh *mesh = scaffold->mesh;
    scaffold->vertices = malloc((3 * mesh->vertex_count + 1) * sizeof *scaffold->vertices);
    for (size_t i = 0; scaffold->vertices && i < mesh->vertex_count; i++) {
        scaffold->vertices[3 * i] = (float)mesh->vertices[i].x;
        scaffold->vertices[3 * i + 1] = (float)mesh->vertices[i].y;
        scaffold->vertices[3 * i + 2] = (float)mesh->vertices[i].z;
    }
    return scaffold->vertices != NULL;
}

/* Replaces what the scaffold holds of this accelerator; the time that it took. */
static bool build(bench_scaffold *scaffold, contestant *who, size_t round, sp_error *error)
{
    const sp_mesh *mesh = scaffold->mesh;
    int at = who->accelerator;
    if (at < OWN) {
        sp_tracer_destroy(scaffold->tracers[at]);
        double start = bench_now();
        scaffold->tracers[at] = sp_tracer_create(mesh, own[at].value, who->threads, error);
        who->seconds[round] = bench_now() - start;
        if (!scaffold->tracers[at])
            return false;
        who->bytes = sp_tracer_bytes(scaffold->tracers[at]);
        return true;
    }
    const bench_embree *embree = scaffold->embree;
    if (scaffold->scenes[at])
        embree->scene_destroy(scaffold->scenes[at]);
    scaffold->scenes[at] =
        embree->scene_create(scaffold->vertices, mesh->vertex_count, (const uint32_t(*)[3])mesh->triangles,
                             mesh->triangle_count, at == EMBREE_ROBUST, who->threads, &who->seconds[round]);
    if (!scaffold->scenes[at])
        return sp_fail(error, SP_ERROR_MEMORY, NULL, 0, 0, "Embree cannot build this mesh");
    who->bytes = embree->scene_bytes(scaffold->scenes[at]);
    return true;
}

static size_t list(const bench_scaffold *scaffold, int threads, contestant all[2 * ACCELERATORS])
{
    size_t count = 0;
    for (int at = 0; at < ACCELERATORS; at++) {
        if (at >= OWN && !scaffold->embree)
            continue;
        all[count++] = (contestant){.accelerator = at, .threads = 1};
        if (threads > 1 && (at >= OWN || own[at].parallel))
            all[count++] = (contestant){.accelerator = at, .threads = threads};
    }
    return count;
}

bool bench_scaffold_create(bench_scaffold *scaffold, const sp_mesh *mesh, int threads, const sp_run *run,
                           sp_error *error)
{
    contestant all[2 * ACCELERATORS];
    *scaffold = (bench_scaffold){.mesh = mesh, .embree = bench_embree_load()};
    size_t count = list(scaffold, threads, all), rounds = 0;
    double start = bench_now();
    scaffold->builds = malloc(count * sizeof *scaffold->builds);
    bool good = (copy_vertices(scaffold) && scaffold->builds) || sp_fail_memory(error);
    while (good && rounds < MOST_BUILDS && (rounds == 0 || bench_now() - start < ENOUGH)) {
        for (size_t i = 0; good && i < count; i++) {
            good = build(scaffold, &all[i], rounds, error) &&
                   (run->progress(run->user, "build", (double)i / (double)count) ||
                    sp_fail(error, SP_ERROR_INTERRUPTED, NULL, 0, 0, "interrupted"));
        }
        rounds++;
    }
    for (size_t i = 0; good && i < count; i++)
        scaffold->builds[scaffold->build_count++] =
            (bench_build_row){all[i].accelerator, all[i].threads, bench_median(all[i].seconds, rounds), all[i].bytes};
    return good;
}

void bench_scaffold_clear(bench_scaffold *scaffold)
{
    for (int at = 0; at < OWN; at++)
        sp_tracer_destroy(scaffold->tracers[at]);
    for (int at = OWN; at < ACCELERATORS; at++)
        if (scaffold->scenes[at])
            scaffold->embree->scene_destroy(scaffold->scenes[at]);
    free(scaffold->vertices);
    free(scaffold->builds);
}
