/* What was found, for people. */
#include "cad.h"
#include "findings.h"
#include "openings.h"

static void print_cavity(const cli_findings *found)
{
    const sp_setup *setup = cli_findings_setup(found);
    if (setup->cavity == SP_CAVITY_NONE)
        printf("cavity      none: every triangle counts once and takes liquid from either side\n");
    else if (setup->cavity == SP_CAVITY_OUTSIDE)
        printf("cavity      outside: sides that face the space around the geometry\n");
    else {
        char point[CLI_POINT];
        cli_point_text(cli_findings_told(found, setup->cavity_point), cli_findings_step(found), " m", point);
        printf("cavity      sides that face the space of [%s]\n", point);
    }
}

/* A cap that parts the vessel, where it should have shut an opening, shows here alone. */
static void print_caps(const cli_findings *found)
{
    size_t count = cli_findings_setup(found)->cap_count;
    if (count)
        printf("caps        %zu; beyond %s %.4f m2 that liquid would reach else\n", count, count == 1 ? "it" : "them",
               found->beyond_caps);
}

static void print_sweep(const sp_evaluator *evaluator)
{
    const sp_sweep *sweep = &sp_evaluator_setup(evaluator)->sweep;
    if (sweep->speed > 0)
        printf("sweep       %.4g m at %.4g m/s, %.4g s, in %zu positions\n", sp_distance(sweep->from, sweep->to),
               sweep->speed, sp_sweep_duration(sweep), sp_evaluator_positions(evaluator));
}

static void print_boxes(const cli_findings *found)
{
    const sp_mesh *mesh = cli_findings_setup(found)->mesh;
    printf("\n%-8s %-24s %-36s %s\n", "geometry", "part", "from, m", "to, m");
    for (size_t i = 0; i < mesh->part_count; i++) {
        const cli_box *box = &found->part_box[i];
        char from[CLI_POINT], to[CLI_POINT];
        cli_point_text(box->minimum, cli_box_step(*box), "", from);
        cli_point_text(box->maximum, cli_box_step(*box), "", to);
        printf("%-8lu %-24s %-36s %s\n", (unsigned long)mesh->parts[i].geometry, mesh->parts[i].name, from, to);
    }
}

/* Wet, dry, inside another body and touching add up to one side of closed parts and to both sides of sheets. */
static void print_parts(const cli_findings *found)
{
    const sp_setup *setup = cli_findings_setup(found);
    const sp_mesh *mesh = setup->mesh;
    printf("%-8s %-24s %-9s %10s %12s %12s %10s %10s %10s\n", "geometry", "part", "role", "triangles", "area m2",
           "wet m2", "dry m2", "inside m2", "touch m2");
    for (size_t i = 0; i < mesh->part_count; i++) {
        const sp_part_sides *sides = &found->part_sides[i];
        printf("%-8lu %-24s %-9s %10zu %12.4f %12.4f %10.4f %10.4f %10.4f\n", (unsigned long)mesh->parts[i].geometry,
               mesh->parts[i].name, setup->surfaces[i].clean ? "clean" : "obstacle", found->part_triangles[i],
               found->part_area[i], sides->wet, sides->dry, sides->inside, sides->touching);
    }
}

static void print_hollows(const cli_findings *found)
{
    size_t count;
    const sp_hollow *hollows = sp_evaluator_hollows(found->opened->evaluator, &count);
    if (count)
        printf("\n%-36s %12s  %s\n", "hollow or flat at m", "area m2", "drains");
    for (size_t i = 0; i < count; i++) {
        char place[CLI_POINT], bracketed[CLI_POINT + 2];
        cli_point_text(cli_findings_told(found, hollows[i].place), cli_findings_step(found), "", place);
        snprintf(bracketed, sizeof bracketed, "[%s]", place);
        printf("%-36s %12.4g  %s\n", bracketed, hollows[i].area, hollows[i].drains ? "over its rim" : "not at all");
    }
}

void cli_findings_print(const cli_findings *found, const char *output)
{
    const sp_setup *setup = cli_findings_setup(found);
    const sp_mesh *mesh = setup->mesh;
    const sp_fidelity *fidelity = sp_evaluator_fidelity(found->opened->evaluator);
    const sp_patches *patches = sp_evaluator_patches(found->opened->evaluator);
    printf("triangles   %zu (%.4f m2), %zu vertices, box %.4g x %.4g x %.4g m\n", mesh->triangle_count,
           found->mesh.area, mesh->vertex_count, found->mesh.maximum.x - found->mesh.minimum.x,
           found->mesh.maximum.y - found->mesh.minimum.y, found->mesh.maximum.z - found->mesh.minimum.z);
    printf("shells      %zu, %zu closed; %zu open edges, %zu non-manifold, %zu flipped; %zu degenerate, %zu double "
           "triangles\n",
           found->mesh.shells, found->mesh.closed_shells, found->mesh.open_edges.count,
           found->mesh.non_manifold_edges.count, found->mesh.flipped_edges.count, found->mesh.degenerate.count,
           found->mesh.duplicate_triangles.count);
    cli_cad_print(found->opened->scene, cli_findings_setup(found)->mesh);
    print_cavity(found);
    print_caps(found);
    print_sweep(found->opened->evaluator);
    printf("to clean    %.4f m2 in %zu patches of texels of %.4g m\n\n", patches->total_area, patches->count,
           fidelity->texel);
    print_parts(found);
    print_boxes(found);
    cli_cad_print_volumes(cli_findings_setup(found)->mesh, found->part_volume);
    bool open = cli_openings_print(found->opened->evaluator);
    print_hollows(found);
    bool flawed = cli_flaws_print(&found->mesh);
    cli_repair_print(&found->repair, setup);
    const sp_layout *layout = sp_scene_layout(found->opened->scene);
    if (layout->count)
        printf("\n%-16s %-20s %12s %11s %10s\n", "nozzle", "type", "flow L/min", "speed m/s", "angle deg");
    for (size_t i = 0; i < layout->count; i++)
        printf("%-16s %-20s %12.3f %11.3f %10.2f\n", layout->nozzles[i].name, layout->nozzles[i].type->name,
               6e4 * sp_nozzle_flow(&layout->nozzles[i], &setup->liquid),
               sp_nozzle_speed(&layout->nozzles[i], &setup->liquid), sp_nozzle_angle(&layout->nozzles[i]) * 180 / M_PI);
    printf("\n");
    if (output)
        printf("%s/wet.png: blue is cleaned and counted, orange wet but an obstacle, grey dry; above cut open, below "
               "whole\n",
               output);
    for (size_t i = 0; i < found->warning_count; i++)
        printf("warning: %s\n", found->warnings[i]);
    if (!found->warning_count)
        printf("nothing wrong found%s\n", open || flawed ? " besides what is listed above" : "");
}
