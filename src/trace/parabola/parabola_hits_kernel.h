/* The test of parabola.c, many flights at once. Included once by each file that is compiled for a set of instructions,
 * with SP_KERNEL(name) naming its functions.
 *
 * A compiler sees vectors in these loops, and every operation is the one of parabola.c in the same order, so that the
 * bits are. What is rare (a flight that is almost vertical, a corner in its plane, a triangle crossed twice, an arrival
 * that takes a square root) is left to parabola.c itself. */
#include "trace/parabola/parabola_hits.h"

typedef struct {
    double corner[3][3][SP_PARABOLA_HITS]; /* [corner][axis] */
    double origin[3][SP_PARABOLA_HITS], velocity[3][SP_PARABOLA_HITS];
    double t_min[SP_PARABOLA_HITS], t_max[SP_PARABOLA_HITS];
    double beside[3][SP_PARABOLA_HITS], time[3][SP_PARABOLA_HITS], depth[3][SP_PARABOLA_HITS]; /* [corner] */
    double fall[SP_PARABOLA_HITS], across[SP_PARABOLA_HITS];
    double t[SP_PARABOLA_HITS], u[SP_PARABOLA_HITS], v[SP_PARABOLA_HITS];
    int64_t usual[SP_PARABOLA_HITS], plain[SP_PARABOLA_HITS]; /* the flight is; and so is its hit */
} hit_lanes;

static void gather(const sp_parabola_pairs *pairs, hit_lanes *h, int lanes)
{
    for (int i = 0; i < lanes; i++) { /* idle lanes repeat the first */
        int from = i < pairs->count ? i : 0;
        const sp_ray *ray = &pairs->rays[pairs->ray[from]];
        const uint32_t *vertices = pairs->bvh->mesh->triangles[pairs->triangle[from]];
        h->origin[0][i] = ray->origin.x;
        h->origin[1][i] = ray->origin.y;
        h->origin[2][i] = ray->origin.z;
        h->velocity[0][i] = ray->velocity.x;
        h->velocity[1][i] = ray->velocity.y;
        h->velocity[2][i] = ray->velocity.z;
        h->t_min[i] = ray->t_min;
        h->t_max[i] = ray->t_max;
        for (int corner = 0; corner < 3; corner++) {
            const sp_vec3 *vertex = &pairs->bvh->mesh->vertices[vertices[corner]];
            h->corner[corner][0][i] = vertex->x;
            h->corner[corner][1][i] = vertex->y;
            h->corner[corner][2][i] = vertex->z;
        }
    }
}

/* sp_parabola_start and look. */
static inline void look_at_corners(const sp_parabola_pairs *pairs, hit_lanes *h, int lanes)
{
    const double *down = pairs->acceleration->down, *low = pairs->bvh->low, *high = pairs->bvh->high;
    double d0 = down[0], d1 = down[1], d2 = down[2], acceleration = pairs->acceleration->strength;
    double low0 = low[0], low1 = low[1], low2 = low[2], high0 = high[0], high1 = high[1], high2 = high[2];
    for (int i = 0; i < lanes; i++) {
        double o0 = h->origin[0][i], o1 = h->origin[1][i], o2 = h->origin[2][i];
        double v0 = h->velocity[0][i], v1 = h->velocity[1][i], v2 = h->velocity[2][i];
        double fall = v0 * d0 + v1 * d1 + v2 * d2;
        double h0 = v0 - fall * d0, h1 = v1 - fall * d1, h2 = v2 - fall * d2;
        double left = h0 * d0 + h1 * d1 + h2 * d2;
        h0 -= left * d0;
        h1 -= left * d1;
        h2 -= left * d2;
        double across = h0 * h0 + h1 * h1 + h2 * h2, speed = fabs(v0) + fabs(v1) + fabs(v2);
        double farthest = sp_greater(fabs(low0 - o0), fabs(high0 - o0));
        farthest = sp_greater(farthest, sp_greater(fabs(low1 - o1), fabs(high1 - o1)));
        farthest = sp_greater(farthest, sp_greater(fabs(low2 - o2), fabs(high2 - o2)));
        double strength = 0x1p-43 * acceleration * farthest, inverse = 1 / across;
        int64_t usual = across >= 1e-280,
                slanted = across * (fall * fall + 4 * acceleration * farthest) > strength * strength;
        int64_t finite = across + speed + acceleration + farthest <= DBL_MAX;
        double b0 = d1 * h2 - d2 * h1, b1 = d2 * h0 - d0 * h2, b2 = d0 * h1 - d1 * h0;
        double a0 = h0 * inverse, a1 = h1 * inverse, a2 = h2 * inverse;
        for (int k = 0; k < 3; k++) {
            double w0 = h->corner[k][0][i] - o0, w1 = h->corner[k][1][i] - o1, w2 = h->corner[k][2][i] - o2;
            h->beside[k][i] = b0 * w0 + b1 * w1 + b2 * w2;
            h->time[k][i] = a0 * w0 + a1 * w1 + a2 * w2;
            h->depth[k][i] = d0 * w0 + d1 * w1 + d2 * w2;
        }
        h->fall[i] = fall;
        h->across[i] = across;
        h->usual[i] = usual & slanted & finite;
    }
}

/* Where an edge crosses the plane of the flight, and how far below the flight. */
typedef struct {
    double time, depth, below;
} edge_crossing;

/* The share of the way from b to c after which the flight crosses, c being the upper one where `upper` says so. */
static inline double share_between(int64_t upper, edge_crossing b, edge_crossing c, double fall, double acceleration)
{
    double above = upper ? -c.below : -b.below, below = upper ? b.below : c.below;
    double upper_time = upper ? c.time : b.time, lower_time = upper ? b.time : c.time;
    double upper_depth = upper ? c.depth : b.depth, lower_depth = upper ? b.depth : c.depth;
    double step = lower_time - upper_time, k = 0.5 * acceleration * step * step;
    double slope = sqrt((k - above) * (k - above) + below * below + 2 * below * (k + above));
    double share = 2 * above / (k + below + above + slope), inverse = 1 / slope;
    double time = upper_time + share * step, depth = upper_depth + share * (lower_depth - upper_depth);
    double rest = depth - time * (fall + 0.5 * acceleration * time), better = share - rest * inverse;
    share = 2 * k * fabs(rest) < slope * slope ? better : share;
    share = sp_lesser(sp_greater(share, 0), 1);
    return upper ? 1 - share : share;
}

/* cut, cross_once and offer. The lone corner is a, the others b and c in the triangle's order. */
static inline void cross_lanes(const sp_parabola_pairs *pairs, hit_lanes *h, int lanes)
{
    double acceleration = pairs->acceleration->strength;
    for (int i = 0; i < lanes; i++) {
        double beside0 = h->beside[0][i], beside1 = h->beside[1][i], beside2 = h->beside[2][i];
        double time0 = h->time[0][i], time1 = h->time[1][i], time2 = h->time[2][i];
        double depth0 = h->depth[0][i], depth1 = h->depth[1][i], depth2 = h->depth[2][i];
        double fall = h->fall[i], across = h->across[i];
        int64_t positive0 = beside0 > 0, positive1 = beside1 > 0, positive2 = beside2 > 0;
        int64_t first_lone = positive1 == positive2, second_lone = positive0 == positive2;
        double beside_a = first_lone ? beside0 : second_lone ? beside1 : beside2;
        double beside_b = first_lone ? beside1 : second_lone ? beside2 : beside0;
        double beside_c = first_lone ? beside2 : second_lone ? beside0 : beside1;
        double time_a = first_lone ? time0 : second_lone ? time1 : time2;
        double time_b = first_lone ? time1 : second_lone ? time2 : time0;
        double time_c = first_lone ? time2 : second_lone ? time0 : time1;
        double depth_a = first_lone ? depth0 : second_lone ? depth1 : depth2;
        double depth_b = first_lone ? depth1 : second_lone ? depth2 : depth0;
        double depth_c = first_lone ? depth2 : second_lone ? depth0 : depth1;
        int64_t negative = !(beside_a > 0);
        int64_t plain = (positive0 != positive1) | (positive1 != positive2);
        plain &= (beside0 != 0) & (beside1 != 0) & (beside2 != 0);

        double from_b = negative ? beside_a : beside_b, to_b = negative ? beside_b : beside_a;
        double from_c = negative ? beside_a : beside_c, to_c = negative ? beside_c : beside_a;
        double share_b = from_b / (from_b - to_b), share_c = from_c / (from_c - to_c);
        double start = negative ? time_a : time_b, end = negative ? time_b : time_a;
        double cross_time_b = start + share_b * (end - start);
        start = negative ? time_a : time_c, end = negative ? time_c : time_a;
        double cross_time_c = start + share_c * (end - start);
        start = negative ? depth_a : depth_b, end = negative ? depth_b : depth_a;
        double cross_depth_b = start + share_b * (end - start);
        start = negative ? depth_a : depth_c, end = negative ? depth_c : depth_a;
        double cross_depth_c = start + share_c * (end - start);
        double below_b = cross_depth_b - cross_time_b * (fall + 0.5 * acceleration * cross_time_b);
        double below_c = cross_depth_c - cross_time_c * (fall + 0.5 * acceleration * cross_time_c);
        int64_t upper = below_b >= 0; /* c is */
        plain &= upper != (below_c >= 0);

        edge_crossing at_b = {cross_time_b, cross_depth_b, below_b}, at_c = {cross_time_c, cross_depth_c, below_c};
        double share = share_between(upper, at_b, at_c, fall, acceleration);
        double time = cross_time_b + share * (cross_time_c - cross_time_b);
        double depth = cross_depth_b + share * (cross_depth_c - cross_depth_b);
        double speed = fall + acceleration * time, square = speed * speed;
        double rest = depth - time * (fall + 0.5 * acceleration * time);
        double newton = time + rest / speed;
        int64_t flat = square <= across, near = acceleration * fabs(rest) <= 0x1p-26 * square;
        double t = flat ? time : newton;
        plain &= (flat | near) & (t > h->t_min[i]) & (t < h->t_max[i]);

        double of_b = negative ? share_b : 1 - share_b, of_c = negative ? share_c : 1 - share_c;
        double rest_b = negative ? 1 - share_b : share_b, rest_c = negative ? 1 - share_c : share_c;
        double weight_b = (1 - share) * of_b, weight_c = share * of_c;
        double weight_a = (1 - share) * rest_b + share * rest_c;
        h->t[i] = t;
        h->u[i] = first_lone ? weight_b : second_lone ? weight_a : weight_c;
        h->v[i] = first_lone ? weight_c : second_lone ? weight_b : weight_a;
        h->plain[i] = plain & h->usual[i];
    }
}

/* For fewer than this, one at a time is sooner. */
enum { TOGETHER = 4 };

void SP_KERNEL(sp_parabola_hits)(const sp_parabola_pairs *pairs, sp_hit *hits)
{
    hit_lanes h;
    for (int i = 0; i < pairs->count && pairs->count < TOGETHER; i++)
        hits[pairs->ray[i]] =
            sp_parabola_ask(pairs->bvh, pairs->acceleration, &pairs->rays[pairs->ray[i]], pairs->triangle[i], SP_NONE);
    if (pairs->count < TOGETHER)
        return;
    int lanes = (pairs->count + 7) / 8 * 8;
    gather(pairs, &h, lanes);
    look_at_corners(pairs, &h, lanes);
    cross_lanes(pairs, &h, lanes);
    for (int i = 0; i < pairs->count; i++) {
        uint32_t ray = pairs->ray[i], triangle = pairs->triangle[i];
        if (h.plain[i])
            hits[ray] = (sp_hit){h.t[i], h.u[i], h.v[i], triangle};
        else
            hits[ray] = sp_parabola_ask(pairs->bvh, pairs->acceleration, &pairs->rays[ray], triangle, SP_NONE);
    }
}
