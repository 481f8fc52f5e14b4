#include "mesh/distance.h"

/* Ericson, Real-Time Collision Detection, 5.1.5: by the Voronoi region of the triangle's corners, edges and face. */
sp_vec3 sp_triangle_nearest(const sp_mesh *mesh, uint32_t triangle, sp_vec3 point)
{
    const uint32_t *corner = mesh->triangles[triangle];
    sp_vec3 a = mesh->vertices[corner[0]], b = mesh->vertices[corner[1]], c = mesh->vertices[corner[2]];
    sp_vec3 ab = sp_sub(b, a), ac = sp_sub(c, a), ap = sp_sub(point, a);
    double d1 = sp_dot(ab, ap), d2 = sp_dot(ac, ap);
    if (d1 <= 0 && d2 <= 0)
        return a;
    sp_vec3 bp = sp_sub(point, b);
    double d3 = sp_dot(ab, bp), d4 = sp_dot(ac, bp);
    if (d3 >= 0 && d4 <= d3)
        return b;
    double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0)
        return sp_along(a, d1 / (d1 - d3), ab);
    sp_vec3 cp = sp_sub(point, c);
    double d5 = sp_dot(ab, cp), d6 = sp_dot(ac, cp);
    if (d6 >= 0 && d5 <= d6)
        return c;
    double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0)
        return sp_along(a, d2 / (d2 - d6), ac);
    double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
        return sp_along(b, (d4 - d3) / ((d4 - d3) + (d5 - d6)), sp_sub(c, b));
    double scale = 1 / (va + vb + vc);
    return sp_along(sp_along(a, vb * scale, ab), vc * scale, ac);
}

/* How far p lies outside the interval that three coordinates span. Comparisons, which compile to a few instructions
 * where fmin and fmax are calls. */
static inline double outside(double a, double b, double c, double p)
{
    double low = a < b ? a : b, high = a < b ? b : a;
    low = c < low ? c : low;
    high = c > high ? c : high;
    return p < low ? low - p : p > high ? p - high : 0;
}

/* Comparisons along one axis at a time: most that are not within, along one axis are not. */
bool sp_triangle_may_be_within(const sp_mesh *mesh, uint32_t triangle, sp_vec3 p, double distance2)
{
    const uint32_t *corner = mesh->triangles[triangle];
    sp_vec3 a = mesh->vertices[corner[0]], b = mesh->vertices[corner[1]], c = mesh->vertices[corner[2]];
    double x = outside(a.x, b.x, c.x, p.x);
    if (x * x > distance2)
        return false;
    double y = outside(a.y, b.y, c.y, p.y), z = outside(a.z, b.z, c.z, p.z);
    return x * x + y * y + z * z <= distance2;
}

/* Squared. Ericson, 5.1.9, for ways and edges that have a length. */
static double between_ways(sp_vec3 a, sp_vec3 b, sp_vec3 c, sp_vec3 d)
{
    sp_vec3 ab = sp_sub(b, a), cd = sp_sub(d, c), ca = sp_sub(a, c);
    double e = sp_dot(ab, ab), f = sp_dot(cd, cd), g = sp_dot(ab, cd), h = sp_dot(ab, ca), i = sp_dot(cd, ca);
    double parallel = e * f - g * g, s = parallel > 0 ? fmin(1, fmax(0, (g * i - h * f) / parallel)) : 0;
    double t = (g * s + i) / f;
    if (t < 0 || t > 1) {
        t = fmin(1, fmax(0, t));
        s = fmin(1, fmax(0, (g * t - h) / e));
    }
    sp_vec3 apart = sp_sub(sp_along(a, s, ab), sp_along(c, t, cd));
    return sp_dot(apart, apart);
}

static bool way_meets(sp_vec3 from, sp_vec3 to, sp_vec3 a, sp_vec3 b, sp_vec3 c)
{
    sp_vec3 way = sp_sub(to, from), normal = sp_cross(sp_sub(b, a), sp_sub(c, a));
    double start = sp_dot(sp_sub(from, a), normal), fall = -sp_dot(way, normal);
    if (fall == 0 || !(start / fall >= 0 && start / fall <= 1))
        return false;
    sp_vec3 p = sp_along(from, start / fall, way);
    const sp_vec3 corner[3] = {a, b, c};
    for (int k = 0; k < 3; k++)
        if (sp_dot(sp_cross(sp_sub(corner[(k + 1) % 3], corner[k]), sp_sub(p, corner[k])), normal) < 0)
            return false;
    return true;
}

double sp_triangle_way2(const sp_mesh *mesh, uint32_t triangle, sp_vec3 from, sp_vec3 to)
{
    sp_vec3 corner[3], at_start = sp_sub(sp_triangle_nearest(mesh, triangle, from), from),
                       at_end = sp_sub(sp_triangle_nearest(mesh, triangle, to), to);
    for (int k = 0; k < 3; k++)
        corner[k] = mesh->vertices[mesh->triangles[triangle][k]];
    if (way_meets(from, to, corner[0], corner[1], corner[2]))
        return 0;
    double least = fmin(sp_dot(at_start, at_start), sp_dot(at_end, at_end));
    for (int k = 0; k < 3; k++)
        least = fmin(least, between_ways(from, to, corner[k], corner[(k + 1) % 3]));
    return least;
}
