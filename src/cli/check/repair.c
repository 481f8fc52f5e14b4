#include "repair.h"

#include "flaws.h"

#include <stdlib.h>
#include <string.h>

/* What of the scene's mesh one geometry file gave, with the triangles that have no area. */
typedef struct {
    size_t first_part, parts, first_triangle, triangles;
    uint32_t first_vertex, vertices;
} range;

/* Parts, triangles and vertices of a file follow each other. */
static range range_of(const sp_mesh *mesh, uint32_t geometry)
{
    range r = {0};
    while (mesh->parts[r.first_part].geometry != geometry)
        r.first_part++;
    while (r.first_part + r.parts < mesh->part_count && mesh->parts[r.first_part + r.parts].geometry == geometry)
        r.parts++;
    while (r.first_triangle < mesh->source_triangle_count && mesh->source_part[r.first_triangle] < r.first_part)
        r.first_triangle++;
    uint32_t low = SP_NONE, high = 0;
    for (size_t t = r.first_triangle; t < mesh->source_triangle_count && mesh->source_part[t] < r.first_part + r.parts;
         t++, r.triangles++)
        for (int k = 0; k < 3; k++) {
            uint32_t v = mesh->source_triangles[t][k];
            low = v < low ? v : low;
            high = v > high ? v : high;
        }
    r.first_vertex = low;
    r.vertices = r.triangles ? high - low + 1 : 0;
    return r;
}

/* In the coordinates of the scene's file. */
static sp_mesh *piece_of(const sp_setup *setup, uint32_t geometry, sp_error *error)
{
    const sp_mesh *mesh = setup->mesh;
    range r = range_of(mesh, geometry);
    sp_vec3 *vertices = malloc((r.vertices + 1) * sizeof *vertices);
    uint32_t(*triangles)[3] = malloc((r.triangles + 1) * sizeof *triangles);
    uint32_t *part = malloc((r.triangles + 1) * sizeof *part);
    const char **names = malloc((r.parts + 1) * sizeof *names);
    sp_mesh *piece = NULL;
    if (vertices && triangles && part && names) {
        for (size_t i = 0; i < r.vertices; i++)
            vertices[i] = sp_setup_outside(setup, mesh->vertices[r.first_vertex + i]);
        for (size_t i = 0; i < r.parts; i++)
            names[i] = mesh->parts[r.first_part + i].name;
        for (size_t t = 0; t < r.triangles; t++) {
            for (int k = 0; k < 3; k++)
                triangles[t][k] = mesh->source_triangles[r.first_triangle + t][k] - r.first_vertex;
            part[t] = mesh->source_part[r.first_triangle + t] - (uint32_t)r.first_part;
        }
        piece = sp_mesh_create(vertices, r.vertices, (const uint32_t(*)[3])triangles, r.triangles, part, names, r.parts,
                               error);
    } else {
        sp_fail_memory(error);
    }
    free(vertices);
    free(triangles);
    free(part);
    free(names);
    return piece;
}

/* OUT.obj, of several OUT-0.obj and so on. */
static char *path_of(const char *out, size_t index, size_t count)
{
    size_t size = strlen(out) + 32;
    char *path = malloc(size);
    if (path && count > 1)
        snprintf(path, size, "%.*s-%zu.obj", (int)(strlen(out) - strlen(".obj")), out, index);
    else if (path)
        strcpy(path, out);
    return path;
}

static bool write_piece(const sp_setup *setup, uint32_t geometry, sp_output *output, cli_mended *file, sp_error *error)
{
    const char *slash = strrchr(file->path, '/');
    const char *target = sp_output_path(output, slash ? slash + 1 : file->path, error);
    sp_mesh *piece = target ? piece_of(setup, geometry, error) : NULL;
    sp_mesh *mended = piece ? sp_mesh_repair(piece, &file->account, error) : NULL;
    bool good = mended && sp_mesh_write_obj(mended, target, error);
    sp_mesh_destroy(mended);
    sp_mesh_destroy(piece);
    return good;
}

bool cli_repair_write(const cli_options *options, const sp_scene *scene, cli_repair *repair, sp_error *error)
{
    const sp_setup *setup = sp_scene_setup(scene);
    if (!options->repair)
        return true;
    repair->count = setup->mesh->parts[setup->mesh->part_count - 1].geometry + 1;
    repair->files = calloc(repair->count, sizeof *repair->files);
    char *folder = cli_folder_of(options->repair);
    bool good = (repair->files && folder) || sp_fail_memory(error);
    sp_output *output = good ? cli_output_open(options, folder, &scene, 1, error) : NULL;
    good = output != NULL;
    for (uint32_t i = 0; good && i < repair->count; i++) {
        repair->files[i].path = path_of(options->repair, i, repair->count);
        good = repair->files[i].path ? write_piece(setup, i, output, &repair->files[i], error)
                                     : sp_fail_memory(error) != NULL;
    }
    free(folder);
    if (good)
        return sp_output_commit(output, error);
    sp_output_discard(output);
    return false;
}

void cli_repair_clear(cli_repair *repair)
{
    for (size_t i = 0; repair->files && i < repair->count; i++)
        free(repair->files[i].path);
    free(repair->files);
    *repair = (cli_repair){0};
}

static void print_count(size_t count, const char *what, bool *any)
{
    if (!count)
        return;
    printf("%s %zu %s", *any ? "," : "", count, what);
    *any = true;
}

void cli_repair_print(const cli_repair *repair)
{
    for (size_t i = 0; i < repair->count; i++) {
        const sp_repair_account *a = &repair->files[i].account;
        bool any = false;
        printf("\n%s:", repair->files[i].path);
        print_count(a->joined, "corners at cracks joined", &any);
        print_count(a->split, "triangles split at others' corners", &any);
        print_count(a->turned, "triangles turned over", &any);
        print_count(a->filled, "missing triangles put in", &any);
        print_count(a->copies, "copies taken out", &any);
        print_count(a->dropped, "triangles without area dropped", &any);
        printf("%s; area %.6g -> %.6g m2, closed shells %zu of %zu -> %zu of %zu\n", any ? "" : " nothing to mend",
               a->before.area, a->after.area, a->before.closed_shells, a->before.shells, a->after.closed_shells,
               a->after.shells);
        cli_flaws_print_change(&a->before, &a->after);
        printf("in m and in its place: instead of geometry %zu, without unit, scale, rotate, translate, chord, angle\n",
               i);
    }
}

json_t *cli_repair_json(const cli_repair *repair)
{
    json_t *list = repair->count ? json_array() : json_null();
    for (size_t i = 0; i < repair->count; i++) {
        const sp_repair_account *a = &repair->files[i].account;
        json_array_append_new(
            list, json_pack("{s:I, s:s, s:I, s:I, s:I, s:I, s:I, s:I, s:[ff], s:[II], s:[II], s:o, s:o}", "geometry",
                            (json_int_t)i, "file", repair->files[i].path, "joined_corners", (json_int_t)a->joined,
                            "split_triangles", (json_int_t)a->split, "turned_triangles", (json_int_t)a->turned,
                            "filled_triangles", (json_int_t)a->filled, "copies", (json_int_t)a->copies,
                            "dropped_triangles", (json_int_t)a->dropped, "area_m2", a->before.area, a->after.area,
                            "shells", (json_int_t)a->before.shells, (json_int_t)a->after.shells, "closed_shells",
                            (json_int_t)a->before.closed_shells, (json_int_t)a->after.closed_shells, "flaws_before",
                            cli_flaws_json(&a->before), "flaws_after", cli_flaws_json(&a->after)));
    }
    return list;
}
