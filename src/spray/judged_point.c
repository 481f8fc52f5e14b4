#include "judged_point.h"

/* Of the way from the nearest point towards the middle of the polygon that holds it: off the edges, where a line of
 * sight would have to choose between neighbouring triangles. */
#define INWARDS 1e-4
/* Of the edge of a square of the piece's area: polygons whose distances differ by less are equally near, and the first
 * has the point. A centroid on the edge of two would else fall to either by round-off. */
#define TIE 1e-9

/* The point of triangle abc nearest to p: the foot of the perpendicular where that lies inside, else the nearest of its
 * feet on the three edges. */
static sp_vec3 nearest_in_triangle(sp_vec3 p, sp_vec3 a, sp_vec3 b, sp_vec3 c)
{
    const sp_vec3 corner[3] = {a, b, c};
    sp_vec3 normal = sp_cross(sp_sub(b, a), sp_sub(c, a)), nearest = a;
    double area2 = sp_dot(normal, normal), least = INFINITY;
    bool inside = area2 > 0;
    for (int i = 0; inside && i < 3; i++)
        inside = sp_dot(sp_cross(sp_sub(corner[(i + 1) % 3], corner[i]), sp_sub(p, corner[i])), normal) >= 0;
    if (inside)
        return sp_along(p, -sp_dot(sp_sub(p, a), normal) / area2, normal);
    for (int i = 0; i < 3; i++) {
        sp_vec3 from = corner[i], edge = sp_sub(corner[(i + 1) % 3], from), offset = sp_sub(p, from);
        double length2 = sp_dot(edge, edge), share = length2 > 0 ? sp_dot(offset, edge) / length2 : 0;
        sp_vec3 foot = sp_along(from, fmin(fmax(share, 0), 1), edge);
        sp_vec3 way = sp_sub(foot, p);
        double distance2 = sp_dot(way, way);
        if (distance2 < least) {
            least = distance2;
            nearest = foot;
        }
    }
    return nearest;
}

static double corner_area(sp_vec3 a, sp_vec3 b, sp_vec3 c)
{
    return 0.5 * sp_length(sp_cross(sp_sub(b, a), sp_sub(c, a)));
}

/* Area times centroid of a convex polygon; its area in *area. */
static sp_vec3 polygon_moment(const sp_vec3 *polygon, int corners, double *area)
{
    sp_vec3 moment = sp_v(0, 0, 0);
    *area = 0;
    for (int i = 2; i < corners; i++) {
        double part = corner_area(polygon[0], polygon[i - 1], polygon[i]);
        moment = sp_along(moment, part / 3, sp_add(polygon[0], sp_add(polygon[i - 1], polygon[i])));
        *area += part;
    }
    return moment;
}

void sp_judged_point_add(sp_judged_point *middle, const sp_vec3 *polygon, int corners)
{
    double area;
    middle->moment = sp_add(middle->moment, polygon_moment(polygon, corners, &area));
    middle->area += area;
}

sp_vec3 sp_judged_point_centroid(const sp_judged_point *middle)
{
    return sp_scale(middle->moment, 1 / middle->area);
}

void sp_judged_point_look(sp_judged_point *middle, const sp_vec3 *polygon, int corners, uint32_t triangle)
{
    double area = 0, tie = TIE * sqrt(middle->area);
    sp_vec3 moment = {0}, centroid = sp_judged_point_centroid(middle);
    for (int i = 2; i < corners; i++) {
        sp_vec3 point = nearest_in_triangle(centroid, polygon[0], polygon[i - 1], polygon[i]);
        double distance = sp_distance(point, centroid);
        if (middle->found && !(distance < middle->least - tie))
            continue;
        if (!(area > 0))
            moment = polygon_moment(polygon, corners, &area);
        if (!(area > 0))
            return;
        middle->found = true;
        middle->least = distance;
        middle->point = sp_along(point, INWARDS, sp_sub(sp_scale(moment, 1 / area), point));
        middle->triangle = triangle;
    }
}
