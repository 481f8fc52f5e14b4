/* Shells that are drawn inside out, and bits that something left. */
#include "mesh/diagnosis/flaw.h"

#include <stdlib.h>

#define BIT 1e-4                /* of the mesh's area */
#define TESTS_MOST 1000000000ul /* of triangles against shells that enclose with their backs */

/* A closed shell that encloses with its back. What encloses it is counted along a line that no drawing uses. */
typedef struct {
    uint32_t shell;
    sp_vec3 at;  /* its widest triangle's middle, along the line z */
    int winding; /* of all other closed shells around it */
} hollow;

typedef struct {
    double area, volume; /* m², m³ */
    uint32_t widest;     /* triangle */
} size_of_shell;

static sp_vec3 turned(sp_vec3 p)
{
    const sp_vec3 z = sp_unit(sp_v(0.5310872941, 0.6180339887, 0.5797115327));
    const sp_vec3 x = sp_unit(sp_cross(z, sp_v(0.3, -0.9, 0.1))), y = sp_cross(z, x);
    return sp_v(sp_dot(p, x), sp_dot(p, y), sp_dot(p, z));
}

static size_of_shell *measure(const sp_mesh *mesh, const uint32_t *shell, sp_vec3 middle)
{
    size_of_shell *sizes = calloc(mesh->triangle_count + 1, sizeof *sizes);
    for (uint32_t t = 0; sizes && t < mesh->triangle_count; t++) {
        const uint32_t *corner = mesh->triangles[t];
        sp_vec3 a = sp_sub(mesh->vertices[corner[0]], middle), b = sp_sub(mesh->vertices[corner[1]], middle),
                c = sp_sub(mesh->vertices[corner[2]], middle);
        size_of_shell *own = &sizes[shell[t]];
        double area = sp_triangle_area(mesh, t);
        if (own->area == 0 || area > sp_triangle_area(mesh, own->widest))
            own->widest = t;
        own->area += area;
        own->volume += sp_dot(a, sp_cross(b, c)) / 6;
    }
    return sizes;
}

static int by_x(const void *left, const void *right)
{
    const hollow *p = left, *q = right;
    if (p->at.x < q->at.x || p->at.x > q->at.x)
        return p->at.x < q->at.x ? -1 : 1;
    return p->shell < q->shell ? -1 : p->shell > q->shell;
}

/* Twice the area of a, b, c as seen along z. */
static double seen_area(sp_vec3 a, sp_vec3 b, sp_vec3 c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/* 1 or -1 where the line upwards from a point leaves or enters through a triangle. */
static int passes(const sp_vec3 corner[3], sp_vec3 from)
{
    double whole = seen_area(corner[0], corner[1], corner[2]), share[3], z = 0;
    for (int i = 0; i < 3; i++) {
        share[i] = seen_area(corner[(i + 1) % 3], corner[(i + 2) % 3], from) / whole;
        if (!(share[i] >= 0))
            return 0;
        z += share[i] * corner[i].z;
    }
    return z > from.z ? (whole > 0 ? 1 : -1) : 0;
}

static size_t first_after(const hollow *hollows, size_t count, double x)
{
    size_t low = 0, high = count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (hollows[middle].at.x < x)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* False where there was too much to do. */
static bool wind(const sp_mesh *mesh, const uint32_t *shell, const bool *closed, hollow *hollows, size_t count)
{
    size_t left = TESTS_MOST;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        sp_vec3 corner[3];
        if (!closed[shell[t]])
            continue;
        for (int k = 0; k < 3; k++)
            corner[k] = turned(mesh->vertices[mesh->triangles[t][k]]);
        double from = fmin(fmin(corner[0].x, corner[1].x), corner[2].x);
        double to = fmax(fmax(corner[0].x, corner[1].x), corner[2].x);
        for (size_t i = first_after(hollows, count, from); i < count && hollows[i].at.x <= to; i++) {
            if (left-- == 0)
                return false;
            hollows[i].winding += hollows[i].shell == shell[t] ? 0 : passes(corner, hollows[i].at);
        }
    }
    return true;
}

static bool find_inside_out(const sp_mesh *mesh, const uint32_t *shell, const bool *closed, const size_of_shell *sizes,
                            sp_flaw *flaw, sp_error *error)
{
    size_t count = 0;
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        count += shell[t] == t && closed[t] && sizes[t].volume < 0;
    hollow *hollows = malloc((count + 1) * sizeof *hollows);
    if (!hollows)
        return sp_fail_memory(error);
    count = 0;
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        if (shell[t] == t && closed[t] && sizes[t].volume < 0)
            hollows[count++] = (hollow){t, turned(sp_judged_point_of(mesh, mesh->triangles[sizes[t].widest])), 0};
    qsort(hollows, count, sizeof *hollows, by_x);
    flaw->more = count && !wind(mesh, shell, closed, hollows, count);
    for (size_t i = 0; !flaw->more && i < count; i++)
        if (hollows[i].winding <= 0)
            sp_flaw_add(flaw, sp_judged_point_of(mesh, mesh->triangles[sizes[hollows[i].shell].widest]));
    free(hollows);
    return true;
}

bool sp_diagnose_shells(const sp_mesh *mesh, const uint32_t *shell, const bool *closed, sp_mesh_diagnosis *diagnosis,
                        sp_error *error)
{
    sp_vec3 middle = sp_scale(sp_add(diagnosis->minimum, diagnosis->maximum), 0.5);
    size_of_shell *sizes = measure(mesh, shell, middle);
    if (!sizes)
        return sp_fail_memory(error);
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        if (shell[t] == t && !closed[t] && sizes[t].area < BIT * diagnosis->area)
            sp_flaw_add(&diagnosis->bits, sp_judged_point_of(mesh, mesh->triangles[sizes[t].widest]));
    bool good = find_inside_out(mesh, shell, closed, sizes, &diagnosis->inside_out, error);
    free(sizes);
    return good;
}
