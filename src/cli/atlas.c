/* sprayplan atlas: a mesh's texture atlas, its figures and pictures. */
#include "atlas.h"

#include <stdlib.h>
#include <string.h>

enum { PAGE_EDGE = 4096 };

/* Before charts are made, which may take long too. */
static bool check_texels(const sp_mesh *mesh, double texel, sp_error *error)
{
    sp_vec3 low, high;
    double area = sp_mesh_area(mesh), texels = area / texel / texel, diagonal = sp_mesh_box(mesh, &low, &high);
    if (texel > diagonal)
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                       "found a texel of %g m on a surface with a diagonal of %.4g m, expected no more than that, or "
                       "another unit of the file's coordinates, as --unit mm",
                       texel, diagonal);
    return texels <= SP_ATLAS_TEXELS_MOST ||
           sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                   "found %.3g texels of %g m on a surface of %.4g m2, expected at most %g of them, or another unit of "
                   "the file's coordinates, as --unit mm",
                   texels, texel, area, SP_ATLAS_TEXELS_MOST);
}

/* On which a piece that is as long as an edge of the mesh still fits a page: no other is longer. */
static double default_texel(const sp_mesh *mesh)
{
    double longest = 0;
    for (size_t t = 0; t < mesh->triangle_count; t++)
        for (int i = 0; i < 3; i++)
            longest = fmax(longest, sp_distance(mesh->vertices[mesh->triangles[t][i]],
                                                mesh->vertices[mesh->triangles[t][(i + 1) % 3]]));
    return fmax(sqrt(sp_mesh_area(mesh) / (1 << 20)), longest / (PAGE_EDGE - 2));
}

static void begin(cli_atlas_work *work, sp_mesh *mesh)
{
    work->mesh = mesh;
    cli_meter_start();
    cli_clock_start(&work->clock);
}

/* The figures are not the atlas's own work. */
static bool end(const cli_options *options, cli_atlas_work *work, const char *stage, sp_error *error)
{
    cli_clock_stage(&work->clock, stage);
    work->peak_bytes = cli_meter_peak();
    cli_progress_stage(options, "figures");
    return work->atlas && sp_atlas_measure(work->atlas, work->mesh, &work->figures, error);
}

bool cli_atlas_build(const cli_options *options, cli_atlas_work *work, sp_mesh *mesh, double texel, sp_packing packing,
                     sp_error *error)
{
    if (!mesh)
        return false;
    cli_progress_stage(options, "charts");
    begin(work, mesh);
    if (!(texel > 0))
        texel = default_texel(mesh);
    if (!check_texels(mesh, texel, error))
        return false;
    work->charts = sp_charts_create(mesh, (PAGE_EDGE - 2) * texel, error);
    cli_clock_stage(&work->clock, "charts");
    if (!work->charts)
        return false;
    cli_progress_stage(options, "texels");
    sp_atlas_options how = {.texel = texel, .page_edge = PAGE_EDGE, .packing = packing};
    work->atlas = sp_atlas_create(mesh, work->charts, &how, error);
    return end(options, work, "texels", error);
}

bool cli_atlas_reuse(const cli_options *options, cli_atlas_work *work, sp_mesh *mesh, sp_error *error)
{
    if (!mesh)
        return false;
    cli_progress_stage(options, "reuse");
    begin(work, mesh);
    sp_unfolding *file = sp_unfolding_read(options->inputs[0], options->unit, error);
    const sp_unfolding *files[] = {file};
    work->atlas = file ? sp_atlas_of_files(mesh, files, 1, options->texel, error) : NULL;
    sp_unfolding_destroy(file);
    return end(options, work, "reuse", error);
}

void cli_atlas_clear(cli_atlas_work *work)
{
    sp_atlas_destroy(work->atlas);
    sp_charts_destroy(work->charts);
}

static bool write_pages(const sp_atlas *atlas, sp_output *output, const char *stem, sp_error *error)
{
    for (size_t page = 0; page < atlas->page_count; page++) {
        char name[512];
        size_t size;
        snprintf(name, sizeof name, "%s-page_%zu.png", stem, page);
        uint8_t *pixels = sp_report_charts(atlas, page, error);
        uint8_t *png =
            pixels ? sp_image_encode_png(pixels, (int)atlas->page_edge, (int)atlas->page_edge, 3, &size, error) : NULL;
        bool good = png && sp_output_bytes(output, name, png, size, error);
        free(png);
        free(pixels);
        if (!good)
            return false;
    }
    return true;
}

static bool write_files(const cli_atlas_work *work, const cli_options *options, char **written, sp_error *error)
{
    const char *slash = strrchr(options->output, '/');
    const char *name = slash ? slash + 1 : options->output;
    const char *dot = strrchr(name, '.');
    char *directory = cli_folder_of(options->output);
    char *stem = strndup(name, (size_t)(dot - name));
    if (!directory || !stem) {
        free(directory);
        free(stem);
        return sp_fail_memory(error);
    }
    cli_progress_stage(options, "files");
    sp_output *output = cli_output_open(options, directory, NULL, 0, error);
    char *obj = output ? sp_atlas_obj(work->atlas, work->mesh, error) : NULL;
    bool good = obj && sp_output_text(output, name, obj, error) && write_pages(work->atlas, output, stem, error);
    if (good)
        good = cli_commit(output, directory, written, error);
    else
        sp_output_discard(output);
    free(obj);
    free(stem);
    free(directory);
    return good;
}

double cli_atlas_seconds(const cli_atlas_work *work)
{
    const cli_clock *clock = &work->clock;
    double sum = 0;
    for (size_t i = 0; i < clock->count; i++)
        sum += clock->stages[i].seconds;
    return sum;
}

json_t *cli_atlas_json(const cli_atlas_work *work)
{
    const sp_atlas_figures *f = &work->figures;
    json_t *stages = json_array();
    for (size_t i = 0; i < work->clock.count; i++)
        json_array_append_new(stages, json_pack("{s:s, s:f}", "name", work->clock.stages[i].name, "seconds",
                                                work->clock.stages[i].seconds));
    return json_pack(
        "{s:s, s:s, s:I, s:I, s:I, s:f, s:f, s:f, s:f, s:f, s:I, s:I, s:I, s:I, s:f, s:f, s:o, s:I, s:f, s:I, s:f}",
        "sprayplan", SP_VERSION, "command", "atlas", "triangles", (json_int_t)f->triangles, "charts",
        (json_int_t)f->charts, "charts_le4", (json_int_t)f->charts_le4, "seam_over_sqrt_area", f->seam_over_sqrt_area,
        "strain_mean", f->strain_mean, "strain95", f->strain95, "strain_max", f->strain_max, "utilisation",
        f->utilisation, "pages", (json_int_t)f->pages, "texels", (json_int_t)f->texels, "shared_texels",
        (json_int_t)f->shared_texels, "overlaps", (json_int_t)f->overlaps, "area_error", f->area_error, "seconds",
        cli_atlas_seconds(work), "stages", stages, "peak_bytes", (json_int_t)work->peak_bytes, "texel_m",
        work->atlas->texel, "page_texels", (json_int_t)work->atlas->page_edge, "uv_scale_m",
        work->atlas->texel * work->atlas->page_edge);
}

static bool print_json(const cli_atlas_work *work)
{
    json_t *object = cli_atlas_json(work);
    return cli_print_object(object, 17);
}

void cli_atlas_print(const cli_atlas_work *work)
{
    const sp_atlas_figures *f = &work->figures;
    printf("triangles        %zu\ncharts           %zu (%zu with at most 4 triangles)\n", f->triangles, f->charts,
           f->charts_le4);
    printf("pages            %zu of %u x %u texels of %.4g m\n", f->pages, work->atlas->page_edge,
           work->atlas->page_edge, work->atlas->texel);
    printf("texels           %zu, shared %zu, overlaps %zu\n", f->texels, f->shared_texels, f->overlaps);
    printf("seams            %.3g x square root of the area\n", f->seam_over_sqrt_area);
    printf("strain           mean %.3g, 95th percentile %.3g, max %.3g\n", f->strain_mean, f->strain95, f->strain_max);
    printf("utilisation      %.3f\narea error       %.3g\nseconds          %.3f\npeak memory      %.1f MB\n",
           f->utilisation, f->area_error, cli_atlas_seconds(work), 1e-6 * (double)work->peak_bytes);
}

static void plan(const cli_options *options)
{
    static const char *stages[6] = {"mesh"};
    size_t count = 1;
    if (options->reuse) {
        stages[count++] = "reuse";
    } else {
        stages[count++] = "charts";
        stages[count++] = "texels";
    }
    stages[count++] = "figures";
    if (options->output)
        stages[count++] = "files";
    cli_progress_plan(stages, 0, 0, 1);
}

/* What makes atlases does not know of files. */
static int fail(sp_error *error, const char *path)
{
    if (error->kind == SP_ERROR_INPUT && !*error->file)
        snprintf(error->file, sizeof error->file, "%s", cli_input_name(path));
    return cli_fail(error);
}

int cli_atlas(const cli_options *options)
{
    sp_error error = {0};
    cli_atlas_work work = {0};
    char *written = NULL;
    if (options->output && !cli_names_obj(options->output)) {
        fprintf(stderr, "sprayplan: atlas: -o: found \"%s\", expected a file name ending in .obj\n", options->output);
        return EXIT_USAGE;
    }
    plan(options);
    cli_progress_stage(options, "mesh");
    sp_mesh *mesh = cli_load_mesh(options, &error);
    bool good = (options->reuse ? cli_atlas_reuse(options, &work, mesh, &error)
                                : cli_atlas_build(options, &work, mesh, options->texel, options->packing, &error)) &&
                (!options->output || write_files(&work, options, &written, &error));
    cli_progress_end();
    if (good && options->json)
        good = print_json(&work) || sp_fail_memory(&error);
    else if (good && !options->quiet)
        cli_atlas_print(&work);
    if (good && written)
        cli_say_written(options, written);
    free(written);
    cli_atlas_clear(&work);
    sp_mesh_destroy(mesh);
    return good ? EXIT_DONE : fail(&error, options->inputs[0]);
}
