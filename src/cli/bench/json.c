/* The result as JSON. */
#include "bench.h"

#include "study_2008.h"

static json_t *builds(const bench_scaffold *scaffold)
{
    json_t *array = json_array();
    for (size_t i = 0; i < scaffold->build_count; i++) {
        const bench_build_row *row = &scaffold->builds[i];
        json_array_append_new(array, json_pack("{s:s, s:i, s:f, s:I}", "accelerator",
                                               bench_accelerator_names[row->accelerator], "threads", row->threads,
                                               "seconds", row->seconds, "bytes", (json_int_t)row->bytes));
    }
    return array;
}

static json_t *traces(const bench_trace *trace)
{
    json_t *array = json_array();
    for (size_t i = 0; i < trace->count; i++) {
        const bench_trace_row *row = &trace->rows[i];
        double rays = (double)row->rays;
        json_array_append_new(
            array, json_pack("{s:s, s:s, s:s, s:s, s:b, s:s, s:i, s:I, s:I, s:f, s:f, s:f, s:f}", "accelerator",
                             bench_accelerator_names[row->accelerator], "variant", row->variant, "query",
                             bench_query_names[row->query], "mode", bench_mode_names[row->mode], "sorted", row->sorted,
                             "trajectory", bench_trajectory_names[row->trajectory], "threads", row->threads, "rays",
                             (json_int_t)row->rays, "hits", (json_int_t)row->hits, "mrays_per_second",
                             1e-6 * row->rays_per_second, "sort_seconds", row->sort_seconds, "wrong_share",
                             (double)row->wrong / rays, "missed_share", (double)row->missed / rays));
    }
    return array;
}

static json_t *figures_2008(const double seconds[STUDY_MESHES])
{
    json_t *object = json_object();
    for (int mesh = 0; mesh < STUDY_MESHES; mesh++)
        if (seconds[mesh] > 0)
            json_object_set_new(object, study_meshes[mesh], json_real(seconds[mesh]));
    return object;
}

/* Table 4.2. */
static json_t *study_builds(const bench_scaffold *scaffold)
{
    json_t *array = json_array();
    for (size_t i = 0; i < scaffold->build_count; i++) {
        const bench_build_row *row = &scaffold->builds[i];
        if (row->accelerator < OWN && row->accelerator != OWN_NONE && row->threads == 1)
            json_array_append_new(array, json_pack("{s:s, s:f, s:o}", "accelerator",
                                                   bench_accelerator_names[row->accelerator], "seconds", row->seconds,
                                                   "seconds_2008", figures_2008(study_build[row->accelerator])));
    }
    return array;
}

/* Tables 4.3 and 4.4. */
static json_t *study_rows(const bench_result *result, bench_trajectory trajectory)
{
    json_t *array = json_array();
    for (size_t i = 0; i < result->study_count; i++) {
        const bench_study_row *row = &result->study[i];
        if (row->trajectory == trajectory)
            json_array_append_new(
                array, json_pack("{s:s, s:I, s:I, s:f, s:o}", "accelerator", bench_accelerator_names[row->accelerator],
                                 "rays", (json_int_t)row->rays, "hits", (json_int_t)row->hits, "seconds", row->seconds,
                                 "seconds_2008", figures_2008(study_jets[trajectory][row->accelerator])));
    }
    return array;
}

bool bench_print_json(const bench_result *result)
{
    json_t *atlas = cli_atlas_json(result->atlas);
    json_t *study = json_pack("{s:o, s:o, s:o, s:o}", "table_4_2", study_builds(result->scaffold), "table_4_3",
                              study_rows(result, TRAJECTORY_LINE), "table_4_4", study_rows(result, TRAJECTORY_PARABOLA),
                              "table_4_5",
                              json_pack("{s:f, s:o}", "seconds", cli_atlas_seconds(result->atlas), "seconds_2008",
                                        figures_2008(study_atlas)));
    json_t *object =
        json_pack("{s:s, s:s, s:s, s:I, s:o, s:o, s:o, s:o, s:o}", "sprayplan", SP_VERSION, "command", "bench", "mesh",
                  result->path, "triangles", (json_int_t)result->scaffold->mesh->triangle_count, "load",
                  json_pack("{s:f, s:I, s:I}", "seconds", result->load->seconds, "bytes",
                            (json_int_t)result->load->bytes, "peak_bytes", (json_int_t)result->load->peak_bytes),
                  "build", builds(result->scaffold), "trace", traces(result->trace), "atlas", atlas, "study", study);
    if (object && result->scaffold->embree)
        json_object_set_new(object, "embree", json_string(result->scaffold->embree->version));
    return cli_print_object(object, 6);
}
