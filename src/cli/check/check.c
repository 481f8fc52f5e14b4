/* sprayplan check: what is in a scene and what is wrong with it. */
#include "findings.h"

#include <stdlib.h>

static bool measure_parts(cli_findings *found, sp_error *error)
{
    const sp_mesh *mesh = cli_findings_setup(found)->mesh;
    found->part_area = calloc(mesh->part_count, sizeof *found->part_area);
    found->part_sides = calloc(mesh->part_count, sizeof *found->part_sides);
    found->part_triangles = calloc(mesh->part_count, sizeof *found->part_triangles);
    found->part_box = cli_part_boxes(mesh);
    found->part_volume = calloc(mesh->part_count, sizeof *found->part_volume);
    if (!found->part_area || !found->part_sides || !found->part_triangles || !found->part_box || !found->part_volume)
        return sp_fail_memory(error);
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        found->part_area[mesh->part[i]] += sp_triangle_area(mesh, (uint32_t)i);
        found->part_triangles[mesh->part[i]]++;
    }
    sp_evaluator_part_sides(found->opened->evaluator, found->part_sides);
    return sp_mesh_volumes(mesh, found->part_volume, error);
}

/* Inside out is what is turned round in view of the cavity, a room around it not; without one nothing is turned, and
 * what the mesh alone shows is reported. */
static void judge_shells(cli_findings *found)
{
    sp_geometry_account account = sp_evaluator_account(found->opened->evaluator);
    if (account.sides_known)
        found->mesh.inside_out = account.turned;
}

/* Boxes in the coordinates of the scene's file. */
static void move_boxes_outside(cli_findings *found)
{
    const sp_setup *setup = cli_findings_setup(found);
    found->mesh.minimum = sp_setup_outside(setup, found->mesh.minimum);
    found->mesh.maximum = sp_setup_outside(setup, found->mesh.maximum);
    cli_flaws_outside(setup, &found->mesh);
    for (size_t i = 0; i < setup->mesh->part_count; i++) {
        found->part_box[i].minimum = sp_setup_outside(setup, found->part_box[i].minimum);
        found->part_box[i].maximum = sp_setup_outside(setup, found->part_box[i].maximum);
    }
}

static bool examine(const cli_options *options, cli_findings *found, sp_error *error)
{
    static const char *const files[] = {"wet.png", NULL};
    if (!cli_output_ready(options, found->opened->scene, files, error) || !measure_parts(found, error) ||
        !(found->sizes = cli_sizes_of(found->opened->scene, found->part_box, &found->size_count, error)) ||
        !sp_evaluator_beyond_caps(found->opened->evaluator, &found->beyond_caps, error) ||
        !sp_mesh_diagnose(cli_findings_setup(found)->mesh, &found->mesh, error))
        return false;
    judge_shells(found);
    move_boxes_outside(found);
    if (!cli_findings_warn(found, error) || !cli_write_wet(options, found->opened, error) ||
        !cli_repair_write(options, found->opened->scene, &found->repair, error))
        return false;
    cli_progress_end();
    if (options->json)
        return cli_findings_print_json(found) || sp_fail_memory(error);
    if (!options->quiet)
        cli_findings_print(found, options->output);
    return true;
}

static int check(const cli_options *options, const cli_scene *opened, cli_clock *clock, sp_error *error)
{
    (void)clock; /* check is not timed */
    cli_findings *found = calloc(1, sizeof *found);
    if (!found) {
        sp_fail_memory(error);
        return cli_fail_in(opened, error);
    }
    found->opened = opened;
    cli_progress_stage(options, "check");
    bool good = examine(options, found, error);
    free(found->part_area);
    free(found->part_sides);
    free(found->part_triangles);
    free(found->part_volume);
    free(found->part_box);
    free(found->sizes);
    cli_repair_clear(&found->repair);
    free(found);
    return good ? EXIT_DONE : cli_fail_in(opened, error);
}

int cli_check(const cli_options *options)
{
    static const char *const stages[] = {"geometry", "accelerator|wet sides|atlas", "check", NULL};
    cli_progress_plan(stages, 0, 0, 1);
    return cli_with_scene(options, false, check);
}
