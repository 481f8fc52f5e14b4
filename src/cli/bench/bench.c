/* sprayplan bench: what every accelerator takes to build and to trace on one mesh, and what the atlas takes. */
#include "bench.h"

#include <errno.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

enum { DEFAULT_RAYS = 1 << 18, MOST_RAYS = 1 << 28 };

static bool wrong(const char *option, const char *found, const char *expected)
{
    fprintf(stderr, "sprayplan: bench: %s: found \"%s\", expected %s\n", option, found, expected);
    return false;
}

static bool read_count(const char *text, size_t *count)
{
    char *end;
    errno = 0;
    long value = text[0] >= '0' && text[0] <= '9' ? strtol(text, &end, 10) : 0;
    if (value < 1 || value > MOST_RAYS || errno || *end)
        return wrong("--rays", text, "a whole number from 1 to 268435456");
    *count = (size_t)value;
    return true;
}

/* Sets chosen[] where the text names it; all of them where nothing is asked for. */
static bool choose(const char *text, const char *const *names, int count, bool *chosen)
{
    bool found = false;
    for (int i = 0; i < count; i++)
        found |= chosen[i] = !text || !strcmp(text, names[i]);
    return found;
}

static bool read_wish(const cli_options *options, bench_wish *wish)
{
    *wish =
        (bench_wish){.rays = DEFAULT_RAYS, .threads = options->threads > 0 ? options->threads : omp_get_max_threads()};
    if (options->rays && !read_count(options->rays, &wish->rays))
        return false;
    if (!choose(options->mode, bench_mode_names, MODES, wish->modes))
        return wrong("--mode", options->mode, "cone, grid, incoherent or surface");
    if (!choose(options->trajectory, bench_trajectory_names, TRAJECTORIES, wish->trajectories))
        return wrong("--trajectory", options->trajectory, "line or parabola");
    return true;
}

static sp_mesh *load_mesh(const cli_options *options, bench_load *load, sp_error *error)
{
    cli_meter_start();
    double start = sp_now();
    sp_mesh *mesh = cli_load_mesh(options, error);
    *load = (bench_load){.seconds = sp_now() - start, .peak_bytes = cli_meter_peak()};
    if (mesh)
        load->bytes = mesh->vertex_count * sizeof *mesh->vertices +
                      mesh->triangle_count * (sizeof *mesh->triangles + sizeof *mesh->part + sizeof *mesh->source) +
                      mesh->source_triangle_count * (sizeof *mesh->source_triangles + sizeof *mesh->source_part);
    return mesh;
}

static bool measure(const cli_options *options, const bench_wish *wish, const bench_load *load, sp_mesh *mesh,
                    sp_error *error)
{
    sp_run run = cli_run(options);
    static const char *stages[MODES + 3] = {"build"};
    size_t stage_count = 1;
    for (int i = 0; i < MODES; i++)
        if (wish->modes[i])
            stages[stage_count++] = bench_mode_names[i];
    stages[stage_count] = "study";
    cli_progress_plan(stages, 0, 0, 1);
    bench_scaffold scaffold;
    bench_stage stage = {0};
    bench_trace trace = {0};
    bench_study_row study[STUDY_ROWS];
    size_t study_count = 0;
    cli_atlas_work atlas = {0};
    bool good = bench_scaffold_create(&scaffold, mesh, wish->threads, &run, error);
    if (good && !scaffold.embree)
        fprintf(stderr, "sprayplan: bench: no sprayplan-embree.so beside the program: Embree is left out\n");
    good = good && bench_stage_create(&stage, scaffold.tracers[OWN_BVH], error) &&
           bench_trace_all(&scaffold, &stage, wish, &run, &trace, error) &&
           cli_atlas_build(options, &atlas, mesh, 0, SP_PACKING_PIXELS, error) &&
           bench_study(&scaffold, &stage, atlas.atlas, &run, study, &study_count, error);
    bench_result result = {cli_input_name(options->inputs[0]), load, &scaffold, &trace, study, study_count, &atlas};
    cli_progress_end();
    if (good && options->json)
        good = bench_print_json(&result) || sp_fail_memory(error);
    else if (good)
        bench_print_table(&result);
    cli_atlas_clear(&atlas);
    bench_trace_clear(&trace);
    bench_stage_clear(&stage);
    bench_scaffold_clear(&scaffold);
    return good;
}

int cli_bench(const cli_options *options)
{
    sp_error error = {0};
    bench_wish wish;
    if (!read_wish(options, &wish))
        return EXIT_USAGE;
    bench_load loading;
    sp_mesh *mesh = load_mesh(options, &loading, &error);
    bool good = mesh && measure(options, &wish, &loading, mesh, &error);
    sp_mesh_destroy(mesh);
    return good ? EXIT_DONE : cli_fail(&error);
}
