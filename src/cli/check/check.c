/* sprayplan check: what is in a scene and what is wrong with it. */
#include "boxes.h"
#include "cad.h"
#include "flaws.h"
#include "repair.h"
#include "size.h"
#include "../cli.h"

#include <stdarg.h>
#include <stdlib.h>

enum { MAX_WARNINGS = 100, MAX_OPENINGS = 3 };
#define NOTHING 1e-6 /* of a part's area: round-off */
#define FAR_OFF 0.01 /* of a body's volume, for that of its triangles */

typedef struct {
    const cli_scene *opened;
    sp_mesh_diagnosis mesh;
    double *part_area;         /* [part_count], m² */
    sp_part_sides *part_sides; /* [part_count] */
    size_t *part_triangles;
    double *part_volume; /* [part_count], m³, of its triangles; 0 where they are not closed */
    cli_box *part_box;   /* [part_count] */
    size_t size_count;
    cli_size *sizes; /* [size_count], of each geometry file */
    cli_repair repair;
    char warnings[MAX_WARNINGS][320];
    size_t warning_count;
} findings;

__attribute__((format(printf, 2, 3))) static void warn(findings *found, const char *format, ...)
{
    if (found->warning_count == MAX_WARNINGS)
        return;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(found->warnings[found->warning_count++], sizeof *found->warnings, format, arguments);
    va_end(arguments);
}

static const sp_setup *setup_of(const findings *found)
{
    return sp_evaluator_setup(found->opened->evaluator);
}

static bool measure_parts(findings *found, sp_error *error)
{
    const sp_mesh *mesh = setup_of(found)->mesh;
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

/* Boxes in the coordinates of the scene's file. */
static void tell_boxes(findings *found)
{
    const sp_setup *setup = setup_of(found);
    found->mesh.minimum = sp_setup_outside(setup, found->mesh.minimum);
    found->mesh.maximum = sp_setup_outside(setup, found->mesh.maximum);
    cli_flaws_tell(setup, &found->mesh);
    for (size_t i = 0; i < setup->mesh->part_count; i++) {
        found->part_box[i].minimum = sp_setup_outside(setup, found->part_box[i].minimum);
        found->part_box[i].maximum = sp_setup_outside(setup, found->part_box[i].maximum);
    }
}

/* A point of the evaluator's in those coordinates. */
static sp_vec3 told(const findings *found, sp_vec3 point)
{
    return sp_setup_outside(setup_of(found), point);
}

static void warn_of_mesh(findings *found)
{
    const sp_mesh_diagnosis *mesh = &found->mesh;
    if (setup_of(found)->cavity == SP_CAVITY_NONE && mesh->closed_shells)
        warn(found,
             "cavity: found none, and %zu bodies are closed: both sides of their walls take liquid and count "
             "once; name a point of the space where the liquid flies",
             mesh->closed_shells);
    if (mesh->degenerate.count)
        warn(found, "geometry: %zu degenerate triangles are left out", mesh->degenerate.count);
    if (mesh->non_manifold_edges.count)
        warn(found, "geometry: %zu edges belong to three or more triangles", mesh->non_manifold_edges.count);
    if (mesh->flipped_edges.count)
        warn(found, "geometry: at %zu edges neighbours disagree which side is the front", mesh->flipped_edges.count);
    if (mesh->duplicate_triangles.count)
        warn(found, "geometry: %zu triangles are there twice", mesh->duplicate_triangles.count);
    if (mesh->cracks.count)
        warn(found, "geometry: %zu corners on open edges lie within %.2g m of others and are not joined to them",
             mesh->cracks.count, mesh->crack);
    if (mesh->crossings.count)
        warn(found, "geometry: %zu pairs of triangles of one shell run through each other", mesh->crossings.count);
    if (mesh->bits.count)
        warn(found, "geometry: %zu loose bits have next to no area", mesh->bits.count);
}

static bool measure_files(findings *found, sp_error *error)
{
    const sp_mesh *mesh = setup_of(found)->mesh;
    found->sizes = calloc(mesh->part_count + 1, sizeof *found->sizes);
    if (!found->sizes)
        return sp_fail_memory(error);
    for (size_t i = 0; i < mesh->part_count;) {
        uint32_t geometry = mesh->parts[i].geometry;
        cli_box box = found->part_box[i];
        for (; i < mesh->part_count && mesh->parts[i].geometry == geometry; i++)
            box = cli_box_join(box, found->part_box[i]);
        found->sizes[found->size_count++] = cli_size_of(box, sp_scene_file_unit(found->opened->scene, geometry));
    }
    return true;
}

/* A file whose unit is not what the scene says is a thousand times too large or too small, or 25 times. */
static void warn_of_size(findings *found)
{
    for (size_t i = 0; i < found->size_count; i++) {
        char text[sizeof *found->warnings];
        if (found->sizes[i].plausible)
            continue;
        cli_size_ask(&found->sizes[i], i, text, sizeof text);
        warn(found, "%s", text);
    }
}

/* What a CAD file says that cannot be, and bodies that their triangles do not give. */
static void warn_of_cad(findings *found)
{
    const sp_mesh *mesh = setup_of(found)->mesh;
    uint32_t last = mesh->part_count ? mesh->parts[mesh->part_count - 1].geometry : 0;
    for (uint32_t i = 0; i <= last; i++) {
        const sp_cad_account *cad = sp_scene_cad(found->opened->scene, i);
        if (cad && cad->faults)
            warn(found, "geometry: file %lu has %zu faults that may cost it surface, the first: %s", (unsigned long)i,
                 cad->faults, cad->fault);
    }
    for (size_t i = 0; i < mesh->part_count; i++) {
        double body = mesh->parts[i].volume, own = found->part_volume[i];
        if (fabs(body) > 0 && !(fabs(own) > 0))
            warn(found, "part \"%s\": a solid in its file, but its triangles are not closed", mesh->parts[i].name);
        else if (fabs(own - body) > FAR_OFF * fabs(body) && fabs(body) > 0)
            warn(found, "part \"%s\": its triangles enclose %.6g m3, its body %.6g m3; a shorter `chord` may help",
                 mesh->parts[i].name, own, body);
    }
}

static void warn_of_cavity(findings *found)
{
    const sp_setup *setup = setup_of(found);
    sp_vec3 p = told(found, setup->cavity_point), low = found->mesh.minimum, high = found->mesh.maximum;
    if (setup->cavity == SP_CAVITY_POINT &&
        (p.x < low.x || p.y < low.y || p.z < low.z || p.x > high.x || p.y > high.y || p.z > high.z))
        warn(found, "cavity: the point lies outside the geometry's box: what is counted is what faces it from there");
}

static void warn_of_sides(findings *found)
{
    const sp_mesh *mesh = setup_of(found)->mesh;
    for (size_t i = 0; i < mesh->part_count; i++)
        if (found->part_sides[i].both > NOTHING * found->part_area[i])
            warn(found,
                 "part \"%s\": %.4g m2 of closed shells are wet on both sides; a shell may run through itself or be "
                 "there twice",
                 mesh->parts[i].name, found->part_sides[i].both);
}

/* Where the flood got out: harmless through an outlet under which nothing stands, and not where it reaches surface. */
static void warn_of_openings(findings *found)
{
    double outdoors = sp_evaluator_outdoors(found->opened->evaluator);
    size_t count;
    const sp_opening *openings = sp_evaluator_openings(found->opened->evaluator, &count);
    if (!(outdoors > 0))
        return;
    warn(
        found,
        "cavity: %.4g m2 of surface under the sky are seen through openings, and left out; see openings, and shut with "
        "a lid or `caps:` what is shut in use",
        outdoors);
    for (size_t i = 0; i < count; i++) {
        sp_vec3 p = told(found, openings[i].place);
        warn(
            found,
            "cavity: an opening at [%.4g m, %.4g m, %.4g m], about %.2g m wide; a cap for it: {point: [%.4g m, %.4g m, "
            "%.4g m], normal: .., radius: ..}",
            p.x, p.y, p.z, openings[i].width, p.x, p.y, p.z);
    }
}

static void warn_of_hollows(findings *found)
{
    size_t count;
    const sp_hollow *hollows = sp_evaluator_hollows(found->opened->evaluator, &count);
    for (size_t i = 0; i < count && !hollows[i].drains; i++) {
        sp_vec3 p = told(found, hollows[i].place);
        warn(found, "film: what runs down to [%.4g m, %.4g m, %.4g m] stands there: is a drain missing?", p.x, p.y,
             p.z);
    }
}

static bool warn_of_nozzles(findings *found, sp_error *failure)
{
    const sp_layout *layout = sp_scene_layout(found->opened->scene);
    for (size_t i = 0; i < layout->count; i++) {
        sp_error error = {0};
        if (!cli_admits(found->opened, &layout->nozzles[i], &error))
            warn(found, "%s", error.message);
        if (error.kind == SP_ERROR_MEMORY)
            return sp_fail_memory(failure);
    }
    return true;
}

static void print_cavity(const sp_setup *setup)
{
    if (setup->cavity == SP_CAVITY_NONE)
        printf("cavity      none: every triangle counts once and takes liquid from either side\n");
    else if (setup->cavity == SP_CAVITY_OUTSIDE)
        printf("cavity      outside: sides that face the space around the geometry\n");
    else {
        sp_vec3 p = sp_setup_outside(setup, setup->cavity_point);
        printf("cavity      sides that face the space of [%.6g m, %.6g m, %.6g m]\n", p.x, p.y, p.z);
    }
}

static void print_sweep(const sp_evaluator *evaluator)
{
    const sp_sweep *sweep = &sp_evaluator_setup(evaluator)->sweep;
    if (sweep->speed > 0)
        printf("sweep       %.4g m at %.4g m/s, %.4g s, in %zu positions\n", sp_distance(sweep->from, sweep->to),
               sweep->speed, sp_sweep_duration(sweep), sp_evaluator_positions(evaluator));
}

static void print_boxes(const findings *found)
{
    const sp_mesh *mesh = setup_of(found)->mesh;
    printf("\n%-8s %-24s %-36s %s\n", "geometry", "part", "from, m", "to, m");
    for (size_t i = 0; i < mesh->part_count; i++) {
        sp_vec3 low = found->part_box[i].minimum, high = found->part_box[i].maximum;
        char from[64];
        snprintf(from, sizeof from, "%.6g, %.6g, %.6g", low.x, low.y, low.z);
        printf("%-8lu %-24s %-36s %.6g, %.6g, %.6g\n", (unsigned long)mesh->parts[i].geometry, mesh->parts[i].name,
               from, high.x, high.y, high.z);
    }
}

/* Wet, dry, inside another body and touching add up to one side of closed parts and to both sides of sheets. */
static void print_parts(const findings *found)
{
    const sp_setup *setup = setup_of(found);
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

static void print_openings(const findings *found)
{
    size_t count;
    const sp_opening *openings = sp_evaluator_openings(found->opened->evaluator, &count);
    if (count)
        printf("\n%-36s %12s %26s\n", "opening at m", "width m", "share of lines of sight");
    for (size_t i = 0; i < count; i++) {
        sp_vec3 p = told(found, openings[i].place);
        printf("[%10.4f, %10.4f, %10.4f] %12.4g %26.2g\n", p.x, p.y, p.z, openings[i].width, openings[i].share);
    }
}

static void print_hollows(const findings *found)
{
    size_t count;
    const sp_hollow *hollows = sp_evaluator_hollows(found->opened->evaluator, &count);
    if (count)
        printf("\n%-36s %12s  %s\n", "hollow or flat at m", "area m2", "drains");
    for (size_t i = 0; i < count; i++) {
        sp_vec3 p = told(found, hollows[i].place);
        printf("[%10.4f, %10.4f, %10.4f] %12.4g  %s\n", p.x, p.y, p.z, hollows[i].area,
               hollows[i].drains ? "over its rim" : "not at all");
    }
}

static void print_table(const findings *found, const char *output)
{
    const sp_setup *setup = setup_of(found);
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
    cli_cad_print(found->opened->scene, setup_of(found)->mesh);
    print_cavity(setup);
    print_sweep(found->opened->evaluator);
    printf("to clean    %.4f m2 in %zu patches of texels of %.4g m\n\n", patches->total_area, patches->count,
           fidelity->texel);
    print_parts(found);
    print_boxes(found);
    cli_cad_print_volumes(setup_of(found)->mesh, found->part_volume);
    print_openings(found);
    print_hollows(found);
    cli_flaws_print(&found->mesh);
    cli_repair_print(&found->repair);
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
        printf("nothing wrong found\n");
}

static json_t *mesh_json(const findings *found)
{
    const sp_mesh_diagnosis *m = &found->mesh;
    return json_pack(
        "{s:I, s:I, s:f, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:[fff], s:[fff]}", "triangles",
        (json_int_t)setup_of(found)->mesh->triangle_count, "vertices", (json_int_t)setup_of(found)->mesh->vertex_count,
        "area_m2", m->area, "degenerate", (json_int_t)m->degenerate.count, "open_edges",
        (json_int_t)m->open_edges.count, "non_manifold_edges", (json_int_t)m->non_manifold_edges.count, "flipped_edges",
        (json_int_t)m->flipped_edges.count, "duplicate_triangles", (json_int_t)m->duplicate_triangles.count, "shells",
        (json_int_t)m->shells, "closed_shells", (json_int_t)m->closed_shells, "minimum_m", m->minimum.x, m->minimum.y,
        m->minimum.z, "maximum_m", m->maximum.x, m->maximum.y, m->maximum.z);
}

/* null: of a part without triangles. */
static json_t *vector_json(sp_vec3 v)
{
    return isfinite(v.x) ? json_pack("[fff]", v.x, v.y, v.z) : json_null();
}

/* null: of what is not closed, or no body of a CAD file. */
static json_t *volume_json(double volume)
{
    return fabs(volume) > 0 ? json_real(volume) : json_null();
}

static json_t *parts_json(const findings *found)
{
    const sp_setup *setup = setup_of(found);
    json_t *parts = json_array();
    for (size_t i = 0; i < setup->mesh->part_count; i++)
        json_array_append_new(
            parts, json_pack("{s:I, s:s, s:s, s:I, s:f, s:f, s:f, s:f, s:f, s:o, s:o, s:o, s:o}", "geometry",
                             (json_int_t)setup->mesh->parts[i].geometry, "name", setup->mesh->parts[i].name, "role",
                             setup->surfaces[i].clean ? "clean" : "obstacle", "triangles",
                             (json_int_t)found->part_triangles[i], "area_m2", found->part_area[i], "wet_area_m2",
                             found->part_sides[i].wet, "dry_area_m2", found->part_sides[i].dry, "inside_area_m2",
                             found->part_sides[i].inside, "touching_area_m2", found->part_sides[i].touching,
                             "minimum_m", vector_json(found->part_box[i].minimum), "maximum_m",
                             vector_json(found->part_box[i].maximum), "volume_m3", volume_json(found->part_volume[i]),
                             "body_volume_m3", volume_json(setup->mesh->parts[i].volume)));
    return parts;
}

static json_t *openings_json(const findings *found)
{
    size_t count;
    const sp_opening *openings = sp_evaluator_openings(found->opened->evaluator, &count);
    json_t *list = json_array();
    for (size_t i = 0; i < count; i++) {
        sp_vec3 p = told(found, openings[i].place);
        json_array_append_new(list, json_pack("{s:[fff], s:f, s:f}", "place_m", p.x, p.y, p.z, "width_m",
                                              openings[i].width, "share", openings[i].share));
    }
    return list;
}

static json_t *hollows_json(const findings *found)
{
    size_t count;
    const sp_hollow *hollows = sp_evaluator_hollows(found->opened->evaluator, &count);
    json_t *list = json_array();
    for (size_t i = 0; i < count; i++) {
        sp_vec3 p = told(found, hollows[i].place);
        json_array_append_new(list, json_pack("{s:[fff], s:f, s:b}", "place_m", p.x, p.y, p.z, "area_m2",
                                              hollows[i].area, "drains", (int)hollows[i].drains));
    }
    return list;
}

/* A point, "outside" or, where none is named, null. */
static json_t *cavity_json(const sp_setup *setup)
{
    sp_vec3 p = sp_setup_outside(setup, setup->cavity_point);
    if (setup->cavity == SP_CAVITY_POINT)
        return json_pack("[fff]", p.x, p.y, p.z);
    return setup->cavity == SP_CAVITY_OUTSIDE ? json_string("outside") : json_null();
}

static json_t *sizes_json(const findings *found)
{
    json_t *list = json_array();
    for (size_t i = 0; i < found->size_count; i++)
        json_array_append_new(list, cli_size_json(&found->sizes[i]));
    return list;
}

/* null where nothing moves. */
static json_t *sweep_json(const sp_evaluator *evaluator)
{
    const sp_sweep *sweep = &sp_evaluator_setup(evaluator)->sweep;
    if (!(sweep->speed > 0))
        return json_null();
    return json_pack("{s:f, s:f, s:f, s:I}", "travel_m", sp_distance(sweep->from, sweep->to), "speed_m_s", sweep->speed,
                     "duration_s", sp_sweep_duration(sweep), "positions",
                     (json_int_t)sp_evaluator_positions(evaluator));
}

static bool print_json(const findings *found)
{
    json_t *warnings = json_array();
    for (size_t i = 0; i < found->warning_count; i++)
        json_array_append_new(warnings, json_string(found->warnings[i]));
    json_t *object = json_pack(
        "{s:s, s:s, s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:f, s:f, s:I, s:f, s:I, s:o}", "sprayplan",
        SP_VERSION, "command", "check", "scene", sp_scene_path(found->opened->scene), "mesh", mesh_json(found), "flaws",
        cli_flaws_json(&found->mesh), "repair", cli_repair_json(&found->repair), "sizes", sizes_json(found), "cad",
        cli_cad_json(found->opened->scene, setup_of(found)->mesh), "parts", parts_json(found), "cavity_m",
        cavity_json(setup_of(found)), "sweep", sweep_json(found->opened->evaluator), "openings", openings_json(found),
        "hollows", hollows_json(found), "outdoors_m2", sp_evaluator_outdoors(found->opened->evaluator), "clean_area_m2",
        sp_evaluator_patches(found->opened->evaluator)->total_area, "patches",
        (json_int_t)sp_evaluator_patches(found->opened->evaluator)->count, "texel_m",
        sp_evaluator_fidelity(found->opened->evaluator)->texel, "nozzles",
        (json_int_t)sp_scene_layout(found->opened->scene)->count, "warnings", warnings);
    return cli_print_object(object, 17);
}

static bool examine(const cli_options *options, findings *found, sp_error *error)
{
    static const char *const files[] = {"wet.png", NULL};
    if (!cli_output_ready(options, found->opened->scene, files, error) || !measure_parts(found, error) ||
        !measure_files(found, error) || !sp_mesh_diagnose(setup_of(found)->mesh, &found->mesh, error))
        return false;
    tell_boxes(found);
    warn_of_mesh(found);
    warn_of_size(found);
    warn_of_cad(found);
    warn_of_cavity(found);
    warn_of_sides(found);
    warn_of_openings(found);
    warn_of_hollows(found);
    if (!warn_of_nozzles(found, error) || !cli_write_wet(options, found->opened, error) ||
        !cli_repair_write(options, found->opened->scene, &found->repair, error))
        return false;
    cli_progress_end();
    if (options->json)
        return print_json(found) || sp_fail_memory(error);
    if (!options->quiet)
        print_table(found, options->output);
    return true;
}

static int check(const cli_options *options, const cli_scene *opened, cli_clock *clock, sp_error *error)
{
    (void)clock; /* check is not timed */
    findings *found = calloc(1, sizeof *found);
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
