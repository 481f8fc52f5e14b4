/* What was found, for people. */
#include "cad.h"
#include "findings.h"
#include "openings.h"
#include "../amounts.h"

enum { AREA_DECIMALS = 4, AREA_DIGITS = 3 };

/* m², with the digits that tell `whole`, of which it is a part or which it is. */
static void area_text(double area, double whole, char text[CLI_AMOUNT])
{
    cli_amount_text(area, whole, AREA_DECIMALS, AREA_DIGITS, text);
}

static void print_cavity(const cli_findings *found)
{
    const sp_setup *setup = cli_findings_setup(found);
    if (setup->cavity == SP_CAVITY_NONE)
        printf("cavity      none: every triangle counts once and takes liquid from either side\n");
    else if (setup->cavity == SP_CAVITY_OUTSIDE)
        printf("cavity      outside: sides that face the space around the geometry\n");
    else {
        char point[CLI_POINT];
        cli_point_text(cli_findings_outside(found, setup->cavity_point), cli_findings_step(found), " m", point);
        printf("cavity      sides that face the space of [%s]\n", point);
    }
}

/* A cap that parts the vessel, where it should have shut an opening, shows here alone. */
static void print_caps(const cli_findings *found)
{
    size_t count = cli_findings_setup(found)->cap_count;
    char beyond[CLI_AMOUNT];
    area_text(found->beyond_caps, found->mesh.area, beyond);
    if (count)
        printf("caps        %zu; beyond %s %s m2 that liquid would reach else\n", count, count == 1 ? "it" : "them",
               beyond);
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

/* A column of m², with the digits that tell the whole mesh, or a part so small that these tell nothing of it. */
static void print_part_area(const cli_findings *found, size_t part, int width, double area)
{
    char text[CLI_AMOUNT];
    cli_amount_text(area, found->part_area[part], sp_told_decimals(found->mesh.area, AREA_DECIMALS, AREA_DIGITS), 1,
                    text);
    printf(" %*s", width, text);
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
        printf("%-8lu %-24s %-9s %10zu", (unsigned long)mesh->parts[i].geometry, mesh->parts[i].name,
               setup->surfaces[i].clean ? "clean" : "obstacle", found->part_triangles[i]);
        print_part_area(found, i, 12, found->part_area[i]);
        print_part_area(found, i, 12, sides->wet);
        print_part_area(found, i, 10, sides->dry);
        print_part_area(found, i, 10, sides->inside);
        print_part_area(found, i, 10, sides->touching);
        printf("\n");
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
        cli_point_text(cli_findings_outside(found, hollows[i].place), cli_findings_step(found), "", place);
        snprintf(bracketed, sizeof bracketed, "[%s]", place);
        printf("%-36s %12.4g  %s\n", bracketed, hollows[i].area, hollows[i].drains ? "over its rim" : "not at all");
    }
}

static void print_nozzles(const sp_layout *layout, const sp_fluid *liquid)
{
    if (layout->count)
        printf("\n%-16s %-20s %12s %11s %10s\n", "nozzle", "type", "flow L/min", "speed m/s", "angle deg");
    for (size_t i = 0; i < layout->count; i++) {
        const sp_nozzle *nozzle = &layout->nozzles[i];
        double l_min = 6e4 * sp_nozzle_flow(nozzle, liquid);
        char flow[CLI_AMOUNT];
        cli_amount_text(l_min, l_min, 3, 3, flow);
        printf("%-16s %-20s %12s %11.3f %10.2f\n", nozzle->name, nozzle->type->name, flow,
               sp_nozzle_speed(nozzle, liquid), sp_nozzle_cone(nozzle) * 180 / M_PI);
    }
}

void cli_findings_print(const cli_findings *found, const char *output)
{
    const sp_setup *setup = cli_findings_setup(found);
    const sp_mesh *mesh = setup->mesh;
    const sp_fidelity *fidelity = sp_evaluator_fidelity(found->opened->evaluator);
    const sp_patches *patches = sp_evaluator_patches(found->opened->evaluator);
    char whole[CLI_AMOUNT], clean[CLI_AMOUNT];
    area_text(found->mesh.area, found->mesh.area, whole);
    area_text(patches->total_area, patches->total_area, clean);
    printf("triangles   %zu (%s m2), %zu vertices, box %.4g x %.4g x %.4g m\n", mesh->triangle_count, whole,
           mesh->vertex_count, found->mesh.maximum.x - found->mesh.minimum.x,
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
    printf("to clean    %s m2 in %zu patches of texels of %.4g m\n\n", clean, patches->count, fidelity->texel);
    print_parts(found);
    print_boxes(found);
    cli_cad_print_volumes(cli_findings_setup(found)->mesh, found->part_volume);
    bool open = cli_openings_print(found->opened->evaluator);
    print_hollows(found);
    bool flawed = cli_flaws_print(&found->mesh);
    cli_repair_print(&found->repair, setup);
    print_nozzles(sp_scene_layout(found->opened->scene), &setup->liquid);
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
