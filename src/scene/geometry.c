/* geometry: files, transforms, parts, surfaces. */
#include "scene/state.h"

#include <assert.h>
#include <fnmatch.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define FAR 4.0 /* diagonals, from which geometry is moved to a local origin */

typedef struct {
    double unit;
    sp_transform transform;
    bool obstacle, moves;
    double restitution, rebound;
    sp_cad_kind cad;
    sp_cad_options cut; /* of a CAD file */
} piece;

static bool read_kind(const sp_reader *reader, const sp_yaml *node, sp_cad_kind *cad)
{
    static const char *const others[] = {".obj", ".stl", ".ply"};
    const sp_yaml *file = sp_yaml_get(node, "file");
    const char *name = sp_read_text(reader, file, "file", "the path of a file");
    if (!name)
        return false;
    *cad = sp_cad_kind_of(name);
    const char *dot = strrchr(name, '.');
    bool known = *cad != SP_CAD_NONE;
    for (size_t i = 0; dot && i < sizeof others / sizeof *others; i++)
        known |= strcasecmp(dot, others[i]) == 0;
    return known || sp_read_fail(reader, file, "file",
                                 "a file that ends in .obj, .stl, .ply, .step, .stp, .iges, .igs, .brep or .brp");
}

static bool read_unit(const sp_reader *reader, const sp_yaml *node, double *unit)
{
    const sp_yaml *child = sp_yaml_get(node, "unit");
    char why[200] = "";
    assert(*unit == 1 && strcmp(sp_key_of(&sp_block_geometry, "unit")->standard, "m") == 0);
    if (!child)
        return true;
    const char *text = sp_read_text(reader, child, "unit", "a unit of length such as mm");
    if (!text)
        return false;
    if (sp_units_factor(reader->units, text, &sp_length_unit, unit, why, sizeof why))
        return true;
    return sp_read_fail(reader, child, "unit", "a unit of length such as mm (%s)", why);
}

/* The keys that a file has because it is a CAD file, or may not have. */
static bool read_cad(const sp_scene *scene, const sp_reader *reader, const sp_yaml *node, piece *p)
{
    const sp_fields in = {reader, &sp_block_geometry, node};
    static const char *const keys[] = {"chord", "angle"};
    const sp_yaml *unit = sp_yaml_get(node, "unit");
    double texel = scene->setup.fidelity.texel;
    for (int k = 0; p->cad == SP_CAD_NONE && k < 2; k++)
        if (sp_yaml_get(node, keys[k]))
            return sp_read_message(reader, sp_yaml_get(node, keys[k]), keys[k],
                                   "found beside a file of triangles, expected beside STEP, IGES and BREP only");
    if ((p->cad == SP_CAD_STEP || p->cad == SP_CAD_IGES) && unit)
        return sp_read_message(reader, unit, "unit",
                               "found beside a STEP or IGES file, which knows its own, expected beside others only");
    p->cut.chord_most = texel / (10 * p->transform.scale);
    p->cut.run = scene->run;
    return sp_read_quantity(&in, "chord", &p->cut.chord) && sp_read_quantity(&in, "angle", &p->cut.angle);
}

static bool read_rotation(const sp_reader *reader, const sp_yaml *node, sp_transform *transform)
{
    const sp_yaml *rotate = sp_yaml_get(node, "rotate");
    const sp_fields in = {reader, &sp_block_rotate, rotate};
    sp_vec3 axis = {0, 0, 1};
    double angle = 0;
    if (!rotate)
        return true;
    if (!sp_read_block(&in, "rotate") || !sp_read_axis(&in, "axis", &axis) || !sp_read_quantity(&in, "angle", &angle))
        return false;
    sp_transform_rotation(transform, axis, angle);
    return true;
}

static bool read_piece(sp_scene *scene, const sp_reader *reader, const sp_yaml *node, piece *p)
{
    const sp_fields in = {reader, &sp_block_geometry, node};
    int role = 0;
    *p = (piece){.unit = 1, .transform = sp_transform_default(), .rebound = 1, .cut = sp_cad_options_default()};
    if (!sp_read_block(&in, "geometry") || !read_kind(reader, node, &p->cad) || !read_unit(reader, node, &p->unit) ||
        !sp_read_quantity(&in, "scale", &p->transform.scale) || !sp_read_choice(&in, "role", &role) ||
        !sp_read_vector(&in, "translate", &p->transform.translate) || !read_rotation(reader, node, &p->transform) ||
        !sp_read_quantity(&in, "restitution", &p->restitution) || !sp_read_quantity(&in, "rebound", &p->rebound) ||
        !sp_scene_read_sweep(scene, reader, node, &p->moves) || !read_cad(scene, reader, node, p))
        return false;
    p->obstacle = role == 1;
    const sp_yaml *parts = sp_yaml_get(node, "clean_parts");
    if (parts && p->obstacle)
        return sp_read_message(reader, parts, "clean_parts",
                               "found beside role: obstacle, expected with role: clean only");
    return true;
}

/* The file's own texture coordinates, once it has been read as a mesh. */
static bool read_unfolding(sp_scene *scene, const sp_reader *reader, const sp_yaml *node, const piece *p, size_t index)
{
    const sp_yaml *file = sp_yaml_get(node, "file");
    const char *dot = strrchr(file->text, '.');
    if (!scene->reuse)
        return true;
    if (!dot || strcasecmp(dot, ".obj") != 0)
        return sp_read_fail(reader, file, "file", "an OBJ file, as simulate has atlas: reuse");
    char *path = sp_scene_file(scene->directory, sp_scene_place_of_files(scene), reader, file, "file");
    if (path)
        scene->unfolded[index] = sp_unfolding_read(path, p->unit * p->transform.scale, reader->error);
    free(path);
    return scene->unfolded[index] != NULL;
}

static sp_mesh *load_piece(const sp_scene *scene, const sp_reader *reader, const sp_yaml *node, const piece *p,
                           sp_cad_account *account)
{
    char *path =
        sp_scene_file(scene->directory, sp_scene_place_of_files(scene), reader, sp_yaml_get(node, "file"), "file");
    sp_mesh *mesh = NULL;
    if (path && p->cad != SP_CAD_NONE)
        mesh = sp_cad_load(path, p->unit, &p->cut, account, reader->error);
    else if (path)
        mesh = sp_mesh_load(path, p->unit, reader->error);
    free(path);
    return mesh;
}

/* Marks the parts of geometry `index` that a name or glob takes. */
static bool clean_part(sp_scene *scene, const sp_reader *reader, const sp_yaml *node, uint32_t index)
{
    const char *pattern = sp_read_text(reader, node, "clean_parts", "the name of a part, or a glob such as baffle*");
    bool found = false;
    char names[240] = "";
    if (!pattern)
        return false;
    for (size_t i = 0; i < scene->mesh->part_count; i++) {
        const sp_part *part = &scene->mesh->parts[i];
        if (part->geometry != index)
            continue;
        size_t used = strlen(names);
        snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "", part->name);
        if (strcmp(pattern, part->name) == 0 || fnmatch(pattern, part->name, 0) == 0)
            scene->surfaces[i].clean = found = true;
    }
    return found ||
           sp_read_fail(reader, node, "clean_parts", "a name or glob that fits a part of this file: %s", names);
}

static bool set_surfaces(sp_scene *scene, const sp_reader *reader, const sp_yaml *node, uint32_t index, const piece *p)
{
    const sp_yaml *parts = sp_yaml_get(node, "clean_parts");
    for (size_t i = 0; i < scene->mesh->part_count; i++)
        if (scene->mesh->parts[i].geometry == index)
            scene->surfaces[i] = (sp_surface){!p->obstacle && !parts, p->restitution, p->rebound, p->moves};
    if (!parts)
        return true;
    if (!sp_read_is_list(reader, parts, "clean_parts", "part names"))
        return false;
    for (const sp_yaml *child = parts->first; child; child = child->next)
        if (!clean_part(scene, reader, child, index))
            return false;
    return true;
}

/* One axis of the local origin: the box's middle to the nearest multiple of a power of two no less than its diagonal,
 * which subtracts from the box's coordinates without rounding. Near by nothing is gained. */
static double origin_along(double low, double high, double diagonal)
{
    int power;
    double middle = 0.5 * (low + high), part = frexp(diagonal, &power);
    double unit = ldexp(part > 0.5 ? 1 : 0.5, power);
    return diagonal > 0 && fabs(middle) >= FAR * diagonal ? unit * nearbyint(middle / unit) : 0;
}

/* What was read before the geometry, about the local origin. */
static void move_points(sp_scene *scene, sp_vec3 origin)
{
    scene->setup.origin = origin;
    scene->setup.cavity_point = sp_sub(scene->setup.cavity_point, origin);
    for (size_t i = 0; i < scene->setup.cap_count; i++)
        scene->caps[i].point = sp_sub(scene->caps[i].point, origin);
    for (size_t i = 0; i < scene->layout->count; i++)
        scene->layout->nozzles[i].position = sp_sub(scene->layout->nozzles[i].position, origin);
}

/* Far from (0, 0, 0) the meshes are moved to a local origin, before their coordinates are rounded there. */
static sp_mesh *join_near(sp_scene *scene, const sp_mesh *const *meshes, sp_transform *transforms, size_t count,
                          sp_error *error)
{
    sp_vec3 low, high;
    sp_mesh *mesh = sp_mesh_join(meshes, transforms, count, error);
    double diagonal = mesh ? sp_mesh_box(mesh, &low, &high) : 0;
    if (!(diagonal > 0))
        return mesh;
    sp_vec3 origin = sp_v(origin_along(low.x, high.x, diagonal), origin_along(low.y, high.y, diagonal),
                          origin_along(low.z, high.z, diagonal));
    if (!(sp_length(origin) > 0))
        return mesh;
    sp_mesh_destroy(mesh);
    move_points(scene, origin);
    for (size_t i = 0; i < count; i++)
        transforms[i].translate = sp_sub(transforms[i].translate, origin);
    return sp_mesh_join(meshes, transforms, count, error);
}

static bool join_pieces(sp_scene *scene, const sp_reader *reader, const sp_yaml *list, const sp_mesh *const *meshes,
                        const piece *pieces)
{
    sp_error problem = {0};
    sp_transform *transforms = malloc(list->count * sizeof *transforms);
    if (!transforms)
        return sp_fail_memory(reader->error);
    for (size_t i = 0; i < list->count; i++)
        transforms[i] = pieces[i].transform;
    scene->mesh = join_near(scene, meshes, transforms, list->count, &problem);
    free(transforms);
    if (problem.kind == SP_ERROR_MEMORY)
        return sp_fail_memory(reader->error);
    if (!scene->mesh)
        return sp_read_message(reader, list, "geometry", "%s", problem.message);
    if (scene->mesh->triangle_count == 0)
        return sp_read_message(reader, list, "geometry",
                               "found no triangle that has an area in its place, expected some: is a unit wrong?");
    scene->surfaces = calloc(scene->mesh->part_count, sizeof *scene->surfaces);
    return scene->surfaces || sp_fail_memory(reader->error);
}

/* Programs that read STEP and IGES files show them in mm, whatever unit these are in, as OpenCASCADE does. */
static sp_transform from_file(const piece *p)
{
    sp_transform transform = p->transform;
    transform.scale *= p->cad == SP_CAD_STEP || p->cad == SP_CAD_IGES ? 1e-3 : p->unit;
    return transform;
}

/* What came of all CAD files together. */
static void sum_cads(sp_scene *scene)
{
    sp_cad_account *all = &scene->setup.cad;
    for (size_t i = 0; i < scene->cad_count; i++) {
        const sp_cad_account *one = &scene->cads[i];
        if (!all->faults)
            memcpy(all->fault, one->fault, sizeof all->fault);
        all->chord = fmax(all->chord, one->chord);
        all->angle = fmax(all->angle, one->angle);
        all->sewing = fmax(all->sewing, one->sewing);
        all->triangles += one->triangles;
        all->mended += one->mended;
        all->sewn += one->sewn;
        all->faults += one->faults;
    }
}

static void settle_unfolded(sp_scene *scene)
{
    sp_setup *setup = &scene->setup;
    if (!scene->reuse)
        return;
    setup->unfolded = (const sp_unfolding *const *)scene->unfolded;
    setup->unfolded_count = scene->cad_count;
    if (!(setup->fidelity.texel > 0))
        setup->fidelity.texel = sp_unfolding_texel(setup->unfolded, setup->unfolded_count, scene->mesh);
    setup->unfolded_texel = setup->fidelity.texel;
}

static bool read_pieces(sp_scene *scene, const sp_reader *reader, const sp_yaml *list, sp_mesh **meshes, piece *pieces)
{
    size_t count = 0;
    for (const sp_yaml *node = list->first; node; node = node->next, count++)
        if (!read_piece(scene, reader, node, &pieces[count]) ||
            !(meshes[count] = load_piece(scene, reader, node, &pieces[count], &scene->cads[count])) ||
            !read_unfolding(scene, reader, node, &pieces[count], count))
            return false;
    if (!join_pieces(scene, reader, list, (const sp_mesh *const *)meshes, pieces))
        return false;
    scene->setup.file = from_file(&pieces[0]);
    uint32_t index = 0;
    for (const sp_yaml *node = list->first; node; node = node->next, index++)
        if (!set_surfaces(scene, reader, node, index, &pieces[index]))
            return false;
    for (size_t i = 0; i < count; i++)
        scene->file_units[i] = pieces[i].cad == SP_CAD_STEP || pieces[i].cad == SP_CAD_IGES ? 0 : pieces[i].unit;
    sum_cads(scene);
    settle_unfolded(scene);
    return sp_scene_settle_dose(scene, reader);
}

bool sp_scene_read_geometry(sp_scene *scene, const sp_reader *reader)
{
    const sp_yaml *list = sp_yaml_get(scene->tree, "geometry");
    if (list->kind != SP_YAML_LIST || list->count == 0 || list->count > SP_MAX_ITEMS)
        return sp_read_fail(reader, list, "geometry", "a list of 1 to %d files", SP_MAX_ITEMS);
    sp_mesh **meshes = calloc(list->count, sizeof *meshes);
    piece *pieces = calloc(list->count, sizeof *pieces);
    scene->cads = calloc(list->count, sizeof *scene->cads);
    scene->file_units = calloc(list->count, sizeof *scene->file_units);
    scene->unfolded = scene->reuse ? calloc(list->count, sizeof(sp_unfolding *)) : NULL;
    scene->cad_count = list->count;
    bool room = meshes && pieces && scene->cads && scene->file_units && (scene->unfolded || !scene->reuse);
    bool good = room ? read_pieces(scene, reader, list, meshes, pieces) : sp_fail_memory(reader->error) != NULL;
    for (size_t i = 0; meshes && i < list->count; i++)
        sp_mesh_destroy(meshes[i]);
    free(meshes);
    free(pieces);
    return good;
}
