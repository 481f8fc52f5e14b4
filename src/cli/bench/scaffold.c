/* Builds every accelerator, several times, in turn. */
#include "bench.h"

#include <stdlib.h>

const char *const bench_accelerator_names[ACCELERATORS] = {"bvh",  "sah",         "naive",
                                                           "none", "embree-fast", "embree-robust"};
enum { LEAST_BUILDS = 3, MOST_BUILDS = 9 };
static const double ENOUGH = 0.3; /* s of building one accelerator after which that is not built again */

/* One accelerator at one number of threads. */
typedef struct {
    int accelerator, threads;
    double seconds[MOST_BUILDS];
    size_t rounds, bytes;
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
static bool build(bench_scaffold *scaffold, contestant *who, sp_error *error)
{
    const sp_mesh *mesh = scaffold->mesh;
    int at = who->accelerator;
    if (at < OWN) {
        sp_tracer_destroy(scaffold->tracers[at]);
        double start = sp_now();
        scaffold->tracers[at] = sp_tracer_create(mesh, own[at].value, who->threads, error);
        who->seconds[who->rounds++] = sp_now() - start;
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
                             mesh->triangle_count, at == EMBREE_ROBUST, who->threads, &who->seconds[who->rounds++]);
    if (!scaffold->scenes[at])
        return sp_fail(error, SP_ERROR_MEMORY, NULL, 0, 0, "Embree cannot build this mesh");
    who->bytes = embree->scene_bytes(scaffold->scenes[at]);
    return true;
}

static size_t list(const bench_scaffold *scaffold, int threads, contestant all[ACCELERATORS])
{
    size_t count = 0;
    for (int at = 0; at < ACCELERATORS; at++)
        if (at < OWN ? threads == 1 || own[at].parallel : scaffold->embree != NULL)
            all[count++] = (contestant){.accelerator = at, .threads = threads};
    return count;
}

/* What is compared is built three times at least; the kd-trees of a large mesh take too long for that. */
static bool wants_more(const contestant *who)
{
    double sum = 0;
    for (size_t i = 0; i < who->rounds; i++)
        sum += who->seconds[i];
    bool is_tree = who->accelerator == OWN_SAH || who->accelerator == OWN_NAIVE;
    return who->rounds < (is_tree ? 1 : LEAST_BUILDS) || (who->rounds < MOST_BUILDS && sum < ENOUGH);
}

/* Builds in turn what can be built by so many threads. */
static bool build_all(bench_scaffold *scaffold, int threads, const sp_run *run, sp_error *error)
{
    contestant all[ACCELERATORS];
    size_t count = list(scaffold, threads, all);
    for (bool going = true; going;) {
        going = false;
        for (size_t i = 0; i < count; i++) {
            if (!wants_more(&all[i]))
                continue;
            if (!build(scaffold, &all[i], error))
                return false;
            if (!run->progress(run->user, "build", (double)i / (double)count))
                return sp_fail(error, SP_ERROR_INTERRUPTED, NULL, 0, 0, "interrupted");
            going = true;
        }
    }
    for (size_t i = 0; i < count; i++)
        scaffold->builds[scaffold->build_count++] = (bench_build_row){
            all[i].accelerator, all[i].threads, bench_median(all[i].seconds, all[i].rounds), all[i].bytes};
    return true;
}

/* One thread first: once Embree has had more, a device for one thread builds with more, too. */
bool bench_scaffold_create(bench_scaffold *scaffold, const sp_mesh *mesh, int threads, const sp_run *run,
                           sp_error *error)
{
    *scaffold = (bench_scaffold){.mesh = mesh, .embree = bench_embree_load()};
    scaffold->builds = malloc(2 * ACCELERATORS * sizeof *scaffold->builds);
    if (!scaffold->builds || !copy_vertices(scaffold))
        return sp_fail_memory(error);
    return build_all(scaffold, 1, run, error) && (threads == 1 || build_all(scaffold, threads, run, error));
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
