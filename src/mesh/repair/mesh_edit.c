#include "mesh/repair/mesh_edit.h"

#include "mesh/disjoint_sets.h"
#include "mesh/grow.h"

#include <float.h>

static void find_shells(const sp_mesh *mesh, const sp_half_edges *edges, uint32_t *shell)
{
    size_t of_edge;
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        shell[t] = t;
    for (size_t i = 0; i < 3 * mesh->triangle_count; i += of_edge) {
        of_edge = sp_half_edges_of_edge(mesh, edges, i);
        for (size_t k = 1; k < of_edge; k++)
            sp_set_join(shell, edges->order[i + k] / 3, edges->order[i] / 3);
    }
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        shell[t] = sp_set_root(shell, t);
}

bool sp_mesh_edit_open(sp_mesh_edit *edit, const sp_mesh *mesh, sp_error *error)
{
    size_t count = mesh->triangle_count, room = count + 1;
    *edit = (sp_mesh_edit){.mesh = mesh, .count = count, .room = room, .part_room = room};
    edit->shell = malloc(room * sizeof *edit->shell);
    edit->triangles = malloc(room * sizeof *edit->triangles);
    edit->part = malloc(room * sizeof *edit->part);
    if (!edit->shell || !edit->triangles || !edit->part || !sp_half_edges_create(mesh, &edit->edges, error)) {
        sp_mesh_edit_close(edit);
        return sp_fail_memory(error);
    }
    memcpy(edit->triangles, mesh->triangles, count * sizeof *edit->triangles);
    memcpy(edit->part, mesh->part, count * sizeof *edit->part);
    find_shells(mesh, &edit->edges, edit->shell);
    return true;
}

void sp_mesh_edit_close(sp_mesh_edit *edit)
{
    sp_half_edges_destroy(&edit->edges);
    free(edit->shell);
    free(edit->triangles);
    free(edit->part);
    *edit = (sp_mesh_edit){0};
}

bool sp_mesh_edit_add(sp_mesh_edit *edit, uint32_t a, uint32_t b, uint32_t c, uint32_t part, sp_error *error)
{
    if (!sp_grow(&edit->triangles, &edit->room, edit->count + 1, sizeof *edit->triangles) ||
        !sp_grow(&edit->part, &edit->part_room, edit->count + 1, sizeof *edit->part))
        return sp_fail_memory(error);
    edit->triangles[edit->count][0] = a;
    edit->triangles[edit->count][1] = b;
    edit->triangles[edit->count][2] = c;
    edit->part[edit->count++] = part;
    return true;
}

/* Gives the mesh the parts' other properties. */
static sp_mesh *with_parts(sp_mesh *made, const sp_mesh *from)
{
    for (size_t i = 0; made && i < from->part_count; i++) {
        made->parts[i].geometry = from->parts[i].geometry;
        made->parts[i].volume = from->parts[i].volume;
    }
    return made;
}

sp_mesh *sp_mesh_edit_mesh(const sp_mesh_edit *edit, sp_error *error)
{
    const sp_mesh *mesh = edit->mesh;
    uint32_t(*kept)[3] = malloc((edit->count + 1) * sizeof *kept);
    uint32_t *part = malloc((edit->count + 1) * sizeof *part);
    const char **names = calloc(mesh->part_count + 1, sizeof *names);
    sp_mesh *made = NULL;
    if (kept && part && names) {
        size_t count = 0;
        for (size_t i = 0; i < mesh->part_count; i++)
            names[i] = mesh->parts[i].name;
        for (size_t t = 0; t < edit->count; t++)
            if (edit->triangles[t][0] != SP_NONE) {
                memcpy(kept[count], edit->triangles[t], sizeof *kept);
                part[count++] = edit->part[t];
            }
        made = with_parts(sp_mesh_create(mesh->vertices, mesh->vertex_count, (const uint32_t(*)[3])kept, count, part,
                                         names, mesh->part_count, error),
                          mesh);
    } else {
        sp_fail_memory(error);
    }
    free(kept);
    free(part);
    free(names);
    return made;
}

sp_vec3 sp_corners_area(const sp_mesh *mesh, const uint32_t corners[3])
{
    sp_vec3 a = mesh->vertices[corners[0]];
    return sp_cross(sp_sub(mesh->vertices[corners[1]], a), sp_sub(mesh->vertices[corners[2]], a));
}

bool sp_keeps_its_side(const sp_mesh *mesh, sp_vec3 area_before, const uint32_t corners[3])
{
    double longest = 0;
    for (int k = 0; k < 3; k++)
        longest = fmax(longest, sp_distance(mesh->vertices[corners[k]], mesh->vertices[corners[(k + 1) % 3]]));
    sp_vec3 area = sp_corners_area(mesh, corners);
    return sp_length(area) > 64 * DBL_EPSILON * longest * longest && sp_dot(sp_unit(area), sp_unit(area_before)) > 0.5;
}
