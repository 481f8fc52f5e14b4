#include "repair.h"

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

static void measure_parts(const sp_mesh *mesh, double *area)
{
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        area[mesh->part[t]] += sp_triangle_area(mesh, t);
}

/* With what is to be cleaned preferred. */
static sp_mesh *mend(const sp_setup *setup, const sp_mesh *piece, cli_mended *file, sp_error *error)
{
    sp_mesh *mended = NULL;
    bool *clean = malloc(piece->part_count + 1);
    file->first_part = range_of(setup->mesh, file->geometry).first_part;
    file->part_count = piece->part_count;
    file->part_area = calloc(2 * piece->part_count + 1, sizeof *file->part_area);
    if (clean && file->part_area) {
        for (size_t i = 0; i < piece->part_count; i++)
            clean[i] = setup->surfaces[file->first_part + i].clean;
        mended = sp_mesh_repair(piece, clean, &file->account, error);
    } else {
        sp_fail_memory(error);
    }
    if (mended) {
        measure_parts(piece, file->part_area);
        measure_parts(mended, file->part_area + piece->part_count);
    }
    free(clean);
    return mended;
}

static bool write_piece(const sp_setup *setup, sp_output *output, cli_mended *file, sp_error *error)
{
    const char *slash = strrchr(file->path, '/');
    const char *target = sp_output_path(output, slash ? slash + 1 : file->path, error);
    sp_mesh *piece = target ? piece_of(setup, file->geometry, error) : NULL;
    sp_mesh *mended = piece ? mend(setup, piece, file, error) : NULL;
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
        repair->files[i].geometry = i;
        repair->files[i].path = path_of(options->repair, i, repair->count);
        good = repair->files[i].path ? write_piece(setup, output, &repair->files[i], error)
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
    for (size_t i = 0; repair->files && i < repair->count; i++) {
        free(repair->files[i].path);
        free(repair->files[i].part_area);
    }
    free(repair->files);
    *repair = (cli_repair){0};
}
