/* What was found, as one JSON object. */
#include "cad.h"
#include "findings.h"
#include "openings.h"

static json_t *mesh_json(const cli_findings *found)
{
    const sp_mesh_diagnosis *m = &found->mesh;
    return json_pack("{s:I, s:I, s:f, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:[fff], s:[fff]}", "triangles",
                     (json_int_t)cli_findings_setup(found)->mesh->triangle_count, "vertices",
                     (json_int_t)cli_findings_setup(found)->mesh->vertex_count, "area_m2", m->area, "tangled_polygons",
                     (json_int_t)cli_findings_setup(found)->mesh->tangled, "degenerate",
                     (json_int_t)m->degenerate.count, "open_edges", (json_int_t)m->open_edges.count,
                     "non_manifold_edges", (json_int_t)m->non_manifold_edges.count, "flipped_edges",
                     (json_int_t)m->flipped_edges.count, "duplicate_triangles",
                     (json_int_t)m->duplicate_triangles.count, "shells", (json_int_t)m->shells, "closed_shells",
                     (json_int_t)m->closed_shells, "minimum_m", m->minimum.x, m->minimum.y, m->minimum.z, "maximum_m",
                     m->maximum.x, m->maximum.y, m->maximum.z);
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

static json_t *parts_json(const cli_findings *found)
{
    const sp_setup *setup = cli_findings_setup(found);
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

static json_t *hollows_json(const cli_findings *found)
{
    size_t count;
    const sp_hollow *hollows = sp_evaluator_hollows(found->opened->evaluator, &count);
    json_t *list = json_array();
    for (size_t i = 0; i < count; i++) {
        sp_vec3 p = cli_findings_outside(found, hollows[i].place);
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

static json_t *sizes_json(const cli_findings *found)
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

bool cli_findings_print_json(const cli_findings *found)
{
    json_t *warnings = json_array();
    for (size_t i = 0; i < found->warning_count; i++)
        json_array_append_new(warnings, json_string(found->warnings[i]));
    json_t *object = json_pack(
        "{s:s, s:s, s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:I, s:o, s:f, s:f, s:f, s:I, s:f, s:I, s:o}",
        "sprayplan", SP_VERSION, "command", "check", "scene", sp_scene_path(found->opened->scene), "mesh",
        mesh_json(found), "flaws", cli_flaws_json(&found->mesh), "repair",
        cli_repair_json(&found->repair, cli_findings_setup(found)), "sizes", sizes_json(found), "cad",
        cli_cad_json(found->opened->scene, cli_findings_setup(found)->mesh), "parts", parts_json(found), "cavity_m",
        cavity_json(cli_findings_setup(found)), "sweep", sweep_json(found->opened->evaluator), "openings",
        cli_openings_json(found->opened->evaluator), "more_openings",
        (json_int_t)sp_evaluator_more_openings(found->opened->evaluator), "hollows", hollows_json(found), "outdoors_m2",
        sp_evaluator_outdoors(found->opened->evaluator), "beyond_caps_m2", found->beyond_caps, "clean_area_m2",
        sp_evaluator_patches(found->opened->evaluator)->total_area, "patches",
        (json_int_t)sp_evaluator_patches(found->opened->evaluator)->count, "texel_m",
        sp_evaluator_fidelity(found->opened->evaluator)->texel, "nozzles",
        (json_int_t)sp_scene_layout(found->opened->scene)->count, "warnings", warnings);
    return cli_print_object(object, 17);
}
