/* Triangles that are there twice, and those that have no area. */
#include "mesh/diagnosis/flaw.h"
#include "mesh/duplicates.h"

#include <stdlib.h>

static bool find_duplicates(const sp_mesh *mesh, sp_flaw *flaw, sp_error *error)
{
    size_t count = mesh->triangle_count;
    uint32_t *order = calloc(count + 1, sizeof *order);
    bool good = (order || sp_fail_memory(error)) && sp_sort_duplicates(mesh, order, error);
    for (size_t i = 1; good && i < count; i++)
        if (sp_are_duplicates(mesh, order[i - 1], order[i]))
            sp_flaw_add(flaw, sp_judged_point_of(mesh, mesh->triangles[order[i]]));
    free(order);
    return good;
}

static void find_degenerate(const sp_mesh *mesh, sp_flaw *flaw)
{
    size_t kept = 0;
    for (size_t s = 0; s < mesh->source_triangle_count; s++)
        if (kept < mesh->triangle_count && mesh->source[kept] == s)
            kept++;
        else
            sp_flaw_add(flaw, sp_judged_point_of(mesh, mesh->source_triangles[s]));
}

bool sp_diagnose_triangles(const sp_mesh *mesh, sp_mesh_diagnosis *diagnosis, sp_error *error)
{
    find_degenerate(mesh, &diagnosis->degenerate);
    return find_duplicates(mesh, &diagnosis->duplicate_triangles, error);
}
