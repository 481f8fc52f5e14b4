/* What is wrong with a mesh as a surface. */
#include "mesh/diagnosis/flaw.h"

#include <stdlib.h>

static bool diagnose_surface(const sp_mesh *mesh, sp_mesh_diagnosis *diagnosis, sp_error *error)
{
    sp_half_edges edges = {0};
    uint32_t *shell = malloc((mesh->triangle_count + 1) * sizeof *shell);
    bool *closed = malloc(mesh->triangle_count + 1);
    bool good = (shell && closed) || sp_fail_memory(error);
    good = good && sp_half_edges_create(mesh, &edges, error);
    if (good)
        sp_diagnose_edges(mesh, &edges, diagnosis, shell, closed);
    good = good && sp_diagnose_cracks(mesh, &edges, diagnosis, error);
    sp_half_edges_destroy(&edges);
    good = good && sp_diagnose_shells(mesh, shell, closed, diagnosis, error) &&
           sp_find_crossings(mesh, shell, &diagnosis->crossings, NULL, error);
    free(shell);
    free(closed);
    return good;
}

bool sp_mesh_diagnose(const sp_mesh *mesh, sp_mesh_diagnosis *diagnosis, sp_error *error)
{
    *diagnosis = (sp_mesh_diagnosis){0};
    if (!mesh)
        return false;
    diagnosis->crack = SP_CRACK * sp_mesh_box(mesh, &diagnosis->minimum, &diagnosis->maximum);
    diagnosis->area = sp_mesh_area(mesh);
    return diagnose_surface(mesh, diagnosis, error) && sp_diagnose_triangles(mesh, diagnosis, error);
}
