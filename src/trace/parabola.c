#include "trace/parabola.h"

#include <float.h>

/* Rounding of positions, relative to the lengths that they are summed from: some operations' worth. */
static const double rounding = 32 * DBL_EPSILON;

static inline double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Sets first and last. Within the box the way along gravity is at most `reach`, so that pull t²/2 ≤ reach + along |t|,
 * and so is the way across gravity, so that across |t| ≤ reach. */
static void bound_time(sp_parabola *p, const sp_ray *ray)
{
    double reach = 2 * p->farthest; /* a space diagonal has at most √3 */
    double along = fabs(dot(p->velocity, p->gravity)) / p->pull;
    double across = sqrt(sp_greater(0, p->speed * p->speed - along * along));
    double longest = (along + sqrt(along * along + 2 * p->pull * reach)) / p->pull;
    if (across > 0x1p-20 * p->speed) /* else it is mostly rounding */
        longest = sp_lesser(longest, 2 * reach / across);
    longest = sp_lesser(1.01 * longest, 1e100);
    p->first = sp_greater(ray->t_min, -longest);
    p->last = sp_lesser(nextafter(ray->t_max, -INFINITY), longest);
}

bool sp_parabola_start(sp_parabola *p, const sp_ray *ray, sp_vec3 gravity, const double low[3], const double high[3])
{
    sp_to_array(ray->origin, p->origin);
    sp_to_array(ray->velocity, p->velocity);
    sp_to_array(gravity, p->gravity);
    p->speed = sqrt(dot(p->velocity, p->velocity));
    p->pull = sqrt(dot(p->gravity, p->gravity));
    p->farthest = 0;
    for (int axis = 0; axis < 3; axis++)
        p->farthest =
            sp_greater(p->farthest, sp_greater(fabs(low[axis] - p->origin[axis]), fabs(high[axis] - p->origin[axis])));
    bound_time(p, ray);
    return p->first <= p->last && isfinite(sp_parabola_summed(p, p->first) + sp_parabola_summed(p, p->last));
}

/* A flight and the plane of a triangle. */
typedef struct {
    const sp_parabola *flight;
    const double (*corners)[3];
    double edge[2][3];       /* from the first corner to the second and third, m */
    double normal[3];        /* twice the area long, m² */
    double pull, speed, way; /* pull/2 t² + speed t + way = 0 in the plane */
} crossing;

static inline crossing cross_plane(const sp_parabola *p, const sp_corners corners)
{
    crossing c = {.flight = p, .corners = corners};
    double origin[3]; /* from the first corner */
    for (int k = 0; k < 3; k++) {
        origin[k] = p->origin[k] - corners[0][k];
        c.edge[0][k] = corners[1][k] - corners[0][k];
        c.edge[1][k] = corners[2][k] - corners[0][k];
    }
    c.normal[0] = c.edge[0][1] * c.edge[1][2] - c.edge[0][2] * c.edge[1][1];
    c.normal[1] = c.edge[0][2] * c.edge[1][0] - c.edge[0][0] * c.edge[1][2];
    c.normal[2] = c.edge[0][0] * c.edge[1][1] - c.edge[0][1] * c.edge[1][0];
    c.pull = dot(c.normal, p->gravity);
    c.speed = dot(c.normal, p->velocity);
    c.way = dot(c.normal, origin);
    return c;
}

/* How far rounding may move the plane and the flight against each other near the triangle at time t, m: the normal's
 * own error counts the more the thinner the triangle. */
static double uncertainty(const crossing *c, double t)
{
    double longest = sp_greater(dot(c->edge[0], c->edge[0]), dot(c->edge[1], c->edge[1]));
    double normal_error = longest * sqrt(longest) / sqrt(dot(c->normal, c->normal));
    return rounding * (sp_parabola_summed(c->flight, t) + normal_error);
}

/* Whether a flight whose roots are not real still touches the plane but for rounding; then at *t. */
static bool touches(const crossing *c, double *t)
{
    *t = -c->speed / c->pull;
    if (!isfinite(*t))
        return false;
    double beyond = (c->way + 0.5 * c->speed * *t) / sqrt(dot(c->normal, c->normal));
    return fabs(beyond) <= uncertainty(c, *t);
}

/* Where the segment between two points of the plane is nearest to the origin, 0 at a, 1 at b; the square of that
 * distance. */
static double nearest_on_segment(const double a[2], const double b[2], double *square)
{
    double along[2] = {b[0] - a[0], b[1] - a[1]};
    double length = along[0] * along[0] + along[1] * along[1];
    double share = length > 0 ? -(a[0] * along[0] + a[1] * along[1]) / length : 0;
    share = sp_lesser(sp_greater(share, 0), 1);
    double x = a[0] + share * along[0], y = a[1] + share * along[1];
    *square = x * x + y * y;
    return share;
}

/* Whether a point outside the triangle is no farther from it than rounding may have moved it in its plane: a flight
 * that crosses the plane at a flat angle is in it at a time that is the less certain. So nothing slips between two
 * triangles. `corner` holds the corners as seen from the point, projected. Sets the weights of the rim's nearest point.
 */
static bool is_at_rim(const crossing *c, const double corner[3][2], double t, double weight[3])
{
    double speed[3];
    for (int k = 0; k < 3; k++)
        speed[k] = c->flight->velocity[k] + t * c->flight->gravity[k];
    double flatness = sqrt(dot(speed, speed) * dot(c->normal, c->normal)) / fabs(dot(speed, c->normal));
    double blur = sp_lesser(uncertainty(c, t) * flatness, SP_PARABOLA_GRAZING * sp_parabola_summed(c->flight, t));
    double least = INFINITY;
    for (int i = 0; i < 3; i++) {
        double square, share = nearest_on_segment(corner[i], corner[(i + 1) % 3], &square);
        if (square >= least)
            continue;
        least = square;
        weight[i] = 1 - share;
        weight[(i + 1) % 3] = share;
        weight[(i + 2) % 3] = 0;
    }
    return least <= blur * blur;
}

/* Whether a point with that share of corner i lies so far beyond the opposite edge that it cannot be at the rim. */
static bool is_far_outside(const crossing *c, int i, double share, double t)
{
    double edge[3], most = SP_PARABOLA_GRAZING * sp_parabola_summed(c->flight, t);
    for (int k = 0; k < 3; k++)
        edge[k] = c->corners[(i + 2) % 3][k] - c->corners[(i + 1) % 3][k];
    return share * share * dot(c->normal, c->normal) > most * most * dot(edge, edge);
}

/* Whether the flight is in the triangle at time t, when it is in its plane, edges included. Sets the weights of the
 * second and third corner. */
static bool is_inside(const crossing *c, double t, double weights[2])
{
    const double *n = c->normal;
    int z = fabs(n[0]) > fabs(n[1]) ? 0 : 1;
    z = fabs(n[2]) > fabs(n[z]) ? 2 : z;
    double corner[3][2], weight[3];
    for (int k = 0; k < 2; k++) {
        int axis = (z + 1 + k) % 3;
        double way = t * (c->flight->velocity[axis] + 0.5 * t * c->flight->gravity[axis]);
        for (int i = 0; i < 3; i++)
            corner[i][k] = c->corners[i][axis] - c->flight->origin[axis] - way;
    }
    bool outside = false;
    for (int i = 0; i < 3; i++) {
        const double *a = corner[(i + 1) % 3], *b = corner[(i + 2) % 3];
        weight[i] = (a[0] * b[1] - a[1] * b[0]) / n[z];
        if (weight[i] < 0 && is_far_outside(c, i, weight[i], t))
            return false;
        outside |= !(weight[i] >= 0);
    }
    if (outside && !is_at_rim(c, (const double(*)[2])corner, t, weight))
        return false;
    double sum = weight[0] + weight[1] + weight[2];
    weights[0] = weight[1] / sum;
    weights[1] = weight[2] / sum;
    return sum > 0;
}

static inline void test(const sp_parabola *p, const sp_corners corners, uint32_t triangle, sp_search *search)
{
    crossing c = cross_plane(p, corners);
    double roots[2], weights[2];
    if (!sp_quadratic_roots(c.pull, c.speed, c.way, roots)) {
        if (!touches(&c, &roots[0]))
            return;
        roots[1] = roots[0];
    }
    for (int i = 0; i < 2; i++) {
        if (!sp_search_wants(search, roots[i], triangle) || !is_inside(&c, roots[i], weights))
            continue;
        if (triangle != search->skip)
            sp_search_take(search, roots[i], weights[0], weights[1], triangle);
        return;
    }
}

void sp_parabola_test(const sp_parabola *parabola, const sp_corners corners, uint32_t triangle, sp_search *search)
{
    test(parabola, corners, triangle, search);
}

void sp_parabola_search_all(const sp_parabola *parabola, const sp_corners *corners, size_t count, sp_search *search)
{
    for (size_t t = 0; t < count && !sp_search_done(search); t++)
        test(parabola, corners[t], (uint32_t)t, search);
}

void sp_parabola_search_some(const sp_parabola *parabola, const sp_corners *corners, const uint32_t *references,
                             size_t count, sp_search *search)
{
    for (size_t i = 0; i < count; i++)
        test(parabola, corners[references[i]], references[i], search);
}
