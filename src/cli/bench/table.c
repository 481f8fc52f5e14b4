/* The result as tables for people. */
#include "bench.h"

#include "study_2008.h"

static void print_load(const bench_load *load, size_t triangles)
{
    printf("load                       seconds         bytes  bytes/triangle  most bytes/triangle\n");
    printf("  %-13s %18.4f %13zu %15.1f %20.1f\n\n", "mesh", load->seconds, load->bytes,
           (double)load->bytes / (double)triangles, (double)load->peak_bytes / (double)triangles);
}

static void print_builds(const bench_scaffold *scaffold)
{
    printf("build           threads    seconds         bytes  bytes/triangle\n");
    for (size_t i = 0; i < scaffold->build_count; i++) {
        const bench_build_row *row = &scaffold->builds[i];
        printf("  %-13s %7d %10.4f %13zu %15.1f\n", bench_accelerator_names[row->accelerator], row->threads,
               row->seconds, row->bytes, (double)row->bytes / (double)scaffold->mesh->triangle_count);
    }
}

static bool same_rays(const bench_trace_row *a, const bench_trace_row *b)
{
    return a->query == b->query && a->mode == b->mode && a->sorted == b->sorted && a->trajectory == b->trajectory;
}

static void print_trace(const bench_trace *trace)
{
    for (size_t i = 0; i < trace->count; i++) {
        const bench_trace_row *row = &trace->rows[i];
        if (i == 0 || !same_rays(row, row - 1))
            printf("\n%s, %s, %s%-12s threads      rays      hits   Mrays/s  other triangle     missed\n",
                   bench_trajectory_names[row->trajectory], bench_mode_names[row->mode], bench_query_names[row->query],
                   row->sorted ? ", sorted" : "");
        printf("  %-13s %-18s %4d %9zu %9zu %9.3f %14.4f%% %9.4f%%\n", bench_accelerator_names[row->accelerator],
               row->variant, row->threads, row->rays, row->hits, 1e-6 * row->rays_per_second,
               100 * (double)row->wrong / (double)row->rays, 100 * (double)row->missed / (double)row->rays);
    }
}

static void print_seconds(double here, const double then[STUDY_MESHES])
{
    printf(" %12.6f", here);
    for (int mesh = 0; mesh < STUDY_MESHES; mesh++)
        if (then[mesh] > 0)
            printf(" %12.6f", then[mesh]);
        else
            printf(" %12s", "");
    printf("\n");
}

static void print_study_heading(const char *what)
{
    printf("\n%-32s %12s", what, "this mesh");
    for (int mesh = 0; mesh < STUDY_MESHES; mesh++)
        printf(" %12s", study_meshes[mesh]);
    printf("\n");
}

static void print_study(const bench_result *result)
{
    printf("\nThe work of the 2008 study, seconds: here and, in 2008, on its cube (%d triangles), horse (%d) and "
           "elephant (%d)\n",
           study_triangles[STUDY_CUBE], study_triangles[STUDY_HORSE], study_triangles[STUDY_ELEPHANT]);
    print_study_heading("4.2 building the tree");
    for (size_t i = 0; i < result->scaffold->build_count; i++) {
        const bench_build_row *row = &result->scaffold->builds[i];
        if (row->accelerator >= OWN || row->accelerator == OWN_NONE || row->threads != 1)
            continue;
        printf("  %-30s", bench_accelerator_names[row->accelerator]);
        print_seconds(row->seconds, study_build[row->accelerator]);
    }
    for (int trajectory = 0; trajectory < TRAJECTORIES; trajectory++) {
        print_study_heading(trajectory == TRAJECTORY_LINE ? "4.3 lines, with deposits"
                                                          : "4.4 parabolas, with deposits");
        for (size_t i = 0; i < result->study_count; i++) {
            const bench_study_row *row = &result->study[i];
            if ((int)row->trajectory != trajectory)
                continue;
            printf("  %-8s %5zu jets, %5zu hits ", bench_accelerator_names[row->accelerator], row->rays, row->hits);
            print_seconds(row->seconds, study_jets[trajectory][row->accelerator]);
        }
    }
    print_study_heading("4.5 texture atlas");
    printf("  %-30s", "");
    print_seconds(cli_atlas_seconds(result->atlas), study_atlas);
}

void bench_print_table(const bench_result *result)
{
    printf("%s: %zu triangles\n\n", result->path, result->scaffold->mesh->triangle_count);
    print_load(result->load, result->scaffold->mesh->triangle_count);
    print_builds(result->scaffold);
    print_trace(result->trace);
    print_study(result);
    printf("\n");
    cli_atlas_print(result->atlas);
}
