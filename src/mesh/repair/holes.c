/* Triangles that are missing: three open edges, of more than one triangle, run round a triangle, and the surface beside
 * it goes on into its plane. Wider openings are ports, rims and lids as often as holes, and stay; so do ends of pipes,
 * from which all their walls turn away. */
#include "mesh/repair/mesh_edit.h"

#include <stdlib.h>

#define SEVERAL (SP_NONE - 1)
#define WIDEST 0.25 /* of the area of the shell around it: else it is a mouth */
/* Cosines between a triangle's and a neighbour's normal. */
#define FOLDED (-0.5)
#define GOES_ON 0.866 /* one is enough */
#define BENDS 0.5     /* and so are two */

typedef struct {
    sp_mesh_edit *edit;
    uint32_t *next; /* [vertices]: the only open half edge that begins there, SEVERAL or SP_NONE */
    double *area;   /* [triangles], m²: of the shell whose least triangle it is */
} filling;

static void prepare(filling *f)
{
    const sp_mesh *mesh = f->edit->mesh;
    for (size_t v = 0; v < mesh->vertex_count; v++)
        f->next[v] = SP_NONE;
    for (uint32_t h = 0; h < 3 * mesh->triangle_count; h++) {
        uint32_t *next = &f->next[sp_half_edge_from(mesh, h)];
        if (f->edit->edges.kind[h] == SP_EDGE_OPEN)
            *next = *next == SP_NONE ? h : SEVERAL;
    }
    for (size_t t = 0; t < mesh->triangle_count; t++)
        f->area[t] = 0;
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        f->area[f->edit->shell[t]] += sp_triangle_area(mesh, t);
}

/* The three half edges around a hole, the lowest first. */
static bool is_around(const filling *f, uint32_t first, uint32_t around[3])
{
    const sp_mesh *mesh = f->edit->mesh;
    around[0] = first;
    for (int k = 0; k < 3; k++) {
        uint32_t following = f->next[sp_half_edge_to(mesh, around[k])];
        if (following >= SEVERAL || (k == 2) != (following == first) || following < first)
            return false;
        around[(k + 1) % 3] = following;
    }
    return around[0] / 3 != around[1] / 3 || around[1] / 3 != around[2] / 3;
}

static bool fits(const filling *f, const uint32_t around[3], const uint32_t corners[3])
{
    const sp_mesh *mesh = f->edit->mesh;
    sp_vec3 area = sp_corners_area(mesh, corners), normal = sp_unit(area);
    if (!sp_keeps_its_side(mesh, area, corners) ||
        0.5 * sp_length(area) > WIDEST * f->area[f->edit->shell[around[0] / 3]])
        return false;
    int bending = 0;
    bool goes_on = false;
    for (int k = 0; k < 3; k++) {
        double cosine = sp_dot(normal, sp_triangle_normal(mesh, around[k] / 3));
        if (cosine < FOLDED)
            return false;
        bending += cosine > BENDS;
        goes_on |= cosine > GOES_ON;
    }
    return goes_on || bending >= 2;
}

/* Into the account, the largest first. */
static void note(const sp_mesh_edit *edit, const uint32_t corners[3])
{
    const sp_vec3 *v = edit->mesh->vertices;
    sp_filling *fillings = edit->account->fillings;
    sp_filling own = {sp_scale(sp_add(sp_add(v[corners[0]], v[corners[1]]), v[corners[2]]), 1.0 / 3),
                      0.5 * sp_length(sp_corners_area(edit->mesh, corners))};
    size_t at = 0;
    edit->account->filled_area += own.area;
    while (at < SP_PLACES && fillings[at].area > 0)
        at++;
    for (; at > 0 && fillings[at - 1].area < own.area; at--)
        if (at < SP_PLACES)
            fillings[at] = fillings[at - 1];
    if (at < SP_PLACES)
        fillings[at] = own;
}

bool sp_fill_holes(sp_mesh_edit *edit, bool careful, size_t *done, sp_error *error)
{
    (void)careful;
    const sp_mesh *mesh = edit->mesh;
    filling f = {edit, malloc((mesh->vertex_count + 1) * sizeof *f.next),
                 malloc((mesh->triangle_count + 1) * sizeof *f.area)};
    bool good = (f.next && f.area) || sp_fail_memory(error);
    *done = 0;
    if (good)
        prepare(&f);
    for (uint32_t h = 0; good && h < 3 * mesh->triangle_count; h++) {
        uint32_t around[3];
        if (edit->edges.kind[h] != SP_EDGE_OPEN || !is_around(&f, h, around))
            continue;
        uint32_t corners[3];
        for (int k = 0; k < 3; k++)
            corners[k] = sp_half_edge_from(mesh, around[2 - k]);
        if (!fits(&f, around, corners))
            continue;
        uint32_t part = mesh->part[around[1] / 3] == mesh->part[around[2] / 3] ? around[1] / 3 : around[0] / 3;
        good = sp_mesh_edit_add(edit, corners[0], corners[1], corners[2], mesh->part[part], error);
        note(edit, corners);
        ++*done;
    }
    free(f.next);
    free(f.area);
    return good;
}
