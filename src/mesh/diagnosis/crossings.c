/* Triangles of one shell that run through each other.
 *
 * Either has corners on both sides of the other's plane, and on the line that the planes have in common they share more
 * than round-off: T. Möller, "A Fast Triangle-Triangle Intersection Test" (1997). Triangles that touch, or lie in one
 * plane, do not. */
#include "mesh/box_pairs.h"
#include "mesh/diagnosis/flaw.h"

#include <stdlib.h>

#define ROUND_OFF 1e-9 /* of the mesh's diagonal */

typedef struct {
    const sp_mesh *mesh;
    const uint32_t *shell; /* NULL: one of all */
    double least;          /* m: what is nearer than that is no crossing */
    size_t left;           /* pairs that may be looked at */
    sp_flaw *flaw;
    bool *found; /* [triangle_count] or NULL */
} crossing_search;

static bool has_corner(const sp_mesh *mesh, uint32_t triangle, uint32_t vertex)
{
    const uint32_t *corners = mesh->triangles[triangle];
    return corners[0] == vertex || corners[1] == vertex || corners[2] == vertex;
}

/* Heights of a triangle's corners over the plane of another, 0 where told from none; whether some are on either side.
 */
static bool is_cut(const crossing_search *search, uint32_t plane, uint32_t triangle, double height[3])
{
    const sp_mesh *mesh = search->mesh;
    sp_vec3 normal = sp_triangle_normal(mesh, plane), foot = mesh->vertices[mesh->triangles[plane][0]];
    bool above = false, below = false;
    for (int i = 0; i < 3; i++) {
        uint32_t corner = mesh->triangles[triangle][i];
        double h = sp_dot(normal, sp_sub(mesh->vertices[corner], foot));
        height[i] = fabs(h) <= search->least || has_corner(mesh, plane, corner) ? 0 : h;
        above |= height[i] > 0;
        below |= height[i] < 0;
    }
    return above && below;
}

/* What two planes have in common of a triangle. */
typedef struct {
    double from, to; /* m, along the line */
    sp_vec3 start;   /* where it is at `from` */
} stretch;

static stretch stretch_of(const sp_mesh *mesh, uint32_t triangle, const double height[3], sp_vec3 along)
{
    stretch own = {.from = INFINITY, .to = -INFINITY};
    for (int i = 0; i < 3; i++) {
        int k = (i + 1) % 3;
        if ((height[i] > 0) == (height[k] > 0) && (height[i] < 0) == (height[k] < 0))
            continue;
        sp_vec3 a = mesh->vertices[mesh->triangles[triangle][i]], b = mesh->vertices[mesh->triangles[triangle][k]];
        sp_vec3 point = sp_along(a, height[i] / (height[i] - height[k]), sp_sub(b, a));
        double at = sp_dot(along, point);
        own.start = at < own.from ? point : own.start;
        own.from = fmin(own.from, at);
        own.to = fmax(own.to, at);
    }
    return own;
}

/* A box visitor. */
static bool look_at(void *user, uint32_t a, uint32_t b)
{
    crossing_search *search = user;
    const sp_mesh *mesh = search->mesh;
    double of_a[3], of_b[3];
    search->flaw->more = search->left == 0;
    if (search->flaw->more)
        return false;
    search->left--;
    if ((search->shell && search->shell[a] != search->shell[b]) || !is_cut(search, a, b, of_b) ||
        !is_cut(search, b, a, of_a))
        return true;
    sp_vec3 along = sp_unit(sp_cross(sp_triangle_normal(mesh, a), sp_triangle_normal(mesh, b)));
    stretch own = stretch_of(mesh, a, of_a, along), other = stretch_of(mesh, b, of_b, along);
    if (!(fmin(own.to, other.to) - fmax(own.from, other.from) > search->least))
        return true;
    sp_flaw_add(search->flaw, own.from > other.from ? own.start : other.start);
    if (search->found)
        search->found[a] = search->found[b] = true;
    return true;
}

bool sp_find_crossings(const sp_mesh *mesh, const uint32_t *shell, sp_flaw *flaw, bool *found, sp_error *error)
{
    size_t count = mesh->triangle_count;
    sp_box *boxes = malloc((count + 1) * sizeof *boxes);
    uint32_t *list = malloc((count + 1) * sizeof *list);
    sp_vec3 low, high;
    double diagonal = sp_mesh_box(mesh, &low, &high);
    crossing_search search = {mesh, shell, ROUND_OFF * diagonal, SP_PAIRS_MOST(count), flaw, found};
    bool good = (boxes && list) || sp_fail_memory(error);
    for (uint32_t t = 0; good && t < count; t++) {
        boxes[t] = sp_box_of(mesh, t, 0);
        list[t] = t;
    }
    good = good && (sp_box_pairs(boxes, list, count, look_at, &search, error) || search.flaw->more);
    free(boxes);
    free(list);
    return good;
}
