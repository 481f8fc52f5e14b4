/* Flights against triangles, watertight.
 *
 * A triangle is cut by the vertical plane of the flight, and what is left is a segment in which the flight is a
 * parabola. On which side of the plane a corner lies is decided once for each corner; where an edge crosses the plane,
 * from the corner on the one side to the corner on the other, whichever triangle asks, and whether that crossing lies
 * below or above the flight, by the same operations on the same numbers. So the segments of a closed surface join to
 * closed polygons without gaps, the flight and a polygon cross wherever a corner of it below the flight is followed by
 * one above, and both triangles at a corner agree about it: nothing slips between them, however the decisions
 * themselves were rounded. In detail:
 *   - A segment with one end below and one above is crossed once. Its root is written so that it has no cancellation
 *     and cannot but lie on the segment.
 *   - With both ends below (the side on which the flight is convex) it is never crossed.
 *   - With both ends above it is crossed twice or not at all; if that is rounded the wrong way the flight was touching.
 *   - A corner exactly in the plane is taken to be on either side in turn, so that edges in the plane belong to all
 *     their triangles, and a flight within a wall's plane still meets the floor that ends there.
 * What could leak, and why it does not: a root rejected because rounding puts it just outside the triangle at the one
 * and the other side of an edge (no root is ever tested against an edge: the signs at the ends have decided before it
 * is computed); a coefficient rounded until a root is no longer real (one sign change needs no discriminant); a corner
 * that its triangles see in different places (products are taken of single corners, never of a triangle's differences);
 * a box or a filter that leaves out what is hit (they are widened by proven bounds, and tests/trace/parabola_bounds.c
 * holds them against this test).
 * Towards the vertical the plane's direction and the times at which points are passed become mere rounding, but depths
 * do not: the time is then found from the depth. When the flight is within 2^-42 of its reach of one vertical line, it
 * is taken to be on it, and the decision is the line's. */
#include "trace/ray/parabola.h"
#include "trace/ray/barycentric.h"

static inline double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void cross(const double a[3], const double b[3], double product[3])
{
    product[0] = a[1] * b[2] - a[2] * b[1];
    product[1] = a[2] * b[0] - a[0] * b[2];
    product[2] = a[0] * b[1] - a[1] * b[0];
}

sp_acceleration sp_acceleration_of(sp_vec3 gravity)
{
    sp_acceleration acceleration = {.strength = 0};
    sp_to_array(gravity, acceleration.vector);
    if (gravity.x == 0 && gravity.y == 0 && gravity.z == 0)
        return acceleration;
    /* by its largest component, as the square of a weak one would be nothing */
    double largest = sp_greater(sp_greater(fabs(gravity.x), fabs(gravity.y)), fabs(gravity.z));
    for (int k = 0; k < 3; k++)
        acceleration.down[k] = acceleration.vector[k] / largest;
    double length = sqrt(dot(acceleration.down, acceleration.down));
    for (int k = 0; k < 3; k++)
        acceleration.down[k] /= length;
    acceleration.strength = largest * length;
    return acceleration;
}

/* Two horizontal directions, along axes where gravity is. */
static void set_vertical(sp_parabola *p)
{
    int least = fabs(p->down[0]) <= fabs(p->down[1]) ? 0 : 1;
    least = fabs(p->down[2]) < fabs(p->down[least]) ? 2 : least;
    double axis[3] = {least == 0, least == 1, least == 2};
    p->vertical = true;
    cross(p->down, axis, p->beside);
    cross(p->beside, p->down, p->ahead);
}

bool sp_parabola_start(sp_parabola *p, const sp_ray *ray, const sp_acceleration *acceleration, const double low[3],
                       const double high[3])
{
    sp_to_array(ray->origin, p->origin);
    sp_to_array(ray->velocity, p->velocity);
    double horizontal[3];
    p->acceleration = acceleration->strength;
    p->fall = dot(p->velocity, acceleration->down);
    for (int k = 0; k < 3; k++) {
        p->gravity[k] = acceleration->vector[k];
        p->down[k] = acceleration->down[k];
        horizontal[k] = p->velocity[k] - p->fall * p->down[k];
    }
    /* Once more: what rounding left of the fall in it would be seen as way ahead over all of the depth. */
    double rest = dot(horizontal, p->down);
    for (int k = 0; k < 3; k++)
        horizontal[k] -= rest * p->down[k];
    p->across = dot(horizontal, horizontal);
    p->speed = fabs(p->velocity[0]) + fabs(p->velocity[1]) + fabs(p->velocity[2]);
    p->farthest = 0;
    for (int axis = 0; axis < 3; axis++)
        p->farthest =
            sp_greater(p->farthest, sp_greater(fabs(low[axis] - p->origin[axis]), fabs(high[axis] - p->origin[axis])));
    /* Where it is again as deep as the box reaches, it has gone at most
     * 2 across √(fall² + 4 acceleration farthest) / acceleration. */
    double strength = 0x1p-43 * p->acceleration * p->farthest;
    if (p->across < 1e-280 ||
        p->across * (p->fall * p->fall + 4 * p->acceleration * p->farthest) <= strength * strength) {
        set_vertical(p);
    } else {
        p->vertical = false;
        cross(p->down, horizontal, p->beside);
        double inverse = 1 / p->across;
        for (int k = 0; k < 3; k++)
            p->ahead[k] = horizontal[k] * inverse;
    }
    return isfinite(p->across + p->speed + p->acceleration + p->farthest);
}

bool sp_parabola_limit(const sp_parabola *p, sp_ray_search *search)
{
    double reach = 2 * p->farthest; /* along gravity and across it; a space diagonal has at most √3 */
    double longest = (fabs(p->fall) + sqrt(p->fall * p->fall + 2 * p->acceleration * reach)) / p->acceleration;
    if (p->across > 0x1p-40 * p->speed * p->speed) /* else it is mostly rounding */
        longest = sp_lesser(longest, reach / sqrt(p->across));
    longest = sp_lesser(1.01 * longest, 1e100);
    search->t_min = sp_greater(search->t_min, -longest);
    search->limit = sp_lesser(search->limit, longest);
    return search->t_min <= search->limit &&
           isfinite(sp_parabola_summed(p, search->t_min) + sp_parabola_summed(p, search->limit));
}

/* A triangle as the flight sees it: its three products for each corner. */
typedef struct {
    double beside[3], time[3], depth[3];
} view;

static inline view look(const sp_parabola *p, const sp_corners corners)
{
    view v;
    for (int i = 0; i < 3; i++) {
        double way[3];
        for (int k = 0; k < 3; k++)
            way[k] = corners[i][k] - p->origin[k];
        v.beside[i] = dot(p->beside, way);
        v.time[i] = dot(p->ahead, way);
        v.depth[i] = dot(p->down, way);
    }
    return v;
}

/* What a point of the flight's plane lies below the flight, m. */
static inline double below_flight(const sp_parabola *p, double time, double depth)
{
    return depth - time * (p->fall + 0.5 * p->acceleration * time);
}

/* Where an edge crosses the flight's plane. */
typedef struct {
    double time, depth;
    double below; /* m, depth below the flight at that time */
    double share; /* how far along the edge from its negative corner, 0 to 1 */
} crossing;

static inline crossing cross_edge(const sp_parabola *p, const view *v, int negative, int positive)
{
    crossing c = {.share = v->beside[negative] / (v->beside[negative] - v->beside[positive])};
    c.time = v->time[negative] + c.share * (v->time[positive] - v->time[negative]);
    c.depth = v->depth[negative] + c.share * (v->depth[positive] - v->depth[negative]);
    c.below = below_flight(p, c.time, c.depth);
    return c;
}

/* When the flight comes to a point of it: told by the depth where it is steep, else by the way ahead. */
static inline double arrival(const sp_parabola *p, double time, double depth)
{
    double speed = p->fall + p->acceleration * time, rest = below_flight(p, time, depth), square = speed * speed,
           roots[2];
    if (square <= p->across)
        return time;
    if (p->acceleration * fabs(rest) <= 0x1p-26 * square) /* Newton's step leaves 2^-27 of itself undone */
        return time + rest / speed;
    return sp_quadratic_roots(p->acceleration, p->fall, -depth, roots) ? roots[speed > 0] : -p->fall / p->acceleration;
}

/* The segment between two crossings. */
typedef struct {
    const sp_parabola *flight;
    crossing ends[2];
    int corner[3]; /* lone one, and the other end of either edge */
    bool negative; /* the lone corner is */
    uint32_t triangle;
} segment;

/* Takes the point at that share of the way from the first end to the second, if it is wanted. */
static bool offer(const segment *s, double share, sp_ray_search *search)
{
    const crossing *a = &s->ends[0], *b = &s->ends[1];
    double t = arrival(s->flight, a->time + share * (b->time - a->time), a->depth + share * (b->depth - a->depth));
    if (!sp_ray_search_wants(search, t, s->triangle))
        return false;
    double weights[3];
    weights[s->corner[1]] = (1 - share) * (s->negative ? a->share : 1 - a->share);
    weights[s->corner[2]] = share * (s->negative ? b->share : 1 - b->share);
    weights[s->corner[0]] =
        (1 - share) * (s->negative ? 1 - a->share : a->share) + share * (s->negative ? 1 - b->share : b->share);
    sp_ray_search_take(search, t, weights[1], weights[2], s->triangle);
    return true;
}

/* From an end above the flight to one below it. With μ the share of the way, A and B what they are above and below,
 * and k = acceleration/2 (their times' difference)², the segment at μ is (A + B + k) μ - k μ² - A below the flight.
 * It crosses it at 2 A / (A + B + k + √(slope²)), with the slope √((k - A)² + B² + 2 B (k + A)) there: sums of what
 * is not negative. */
static void cross_once(const segment *s, int upper, sp_ray_search *search)
{
    const crossing *a = &s->ends[upper], *b = &s->ends[1 - upper];
    double above = -a->below, below = b->below, step = b->time - a->time;
    double k = 0.5 * s->flight->acceleration * step * step;
    double slope = sqrt((k - above) * (k - above) + below * below + 2 * below * (k + above));
    double share = 2 * above / (k + below + above + slope), inverse = 1 / slope;
    /* Where the ends are far out, they are so much above and below that digits were lost: once more, from nearby. */
    double rest = below_flight(s->flight, a->time + share * step, a->depth + share * (b->depth - a->depth));
    if (2 * k * fabs(rest) < slope * slope)
        share -= rest * inverse;
    share = sp_lesser(sp_greater(share, 0), 1);
    offer(s, upper ? 1 - share : share, search);
}

/* Between two ends above the flight: it comes nearest where it is as steep as the segment, and what the segment is
 * below it there tells how long before and after it crosses. */
static void cross_twice(const segment *s, sp_ray_search *search)
{
    const sp_parabola *p = s->flight;
    const crossing *a = &s->ends[0], *b = &s->ends[1];
    double step = b->time - a->time, rise = b->depth - a->depth;
    double middle = (rise / step - p->fall) / p->acceleration, share = (middle - a->time) / step;
    if (!(share > 0 && share < 1))
        return;
    double below = below_flight(p, middle, a->depth + share * rise);
    if (!(below >= 0))
        return;
    double way = sqrt(2 * below / p->acceleration) / step; /* of the sign of step: less of it is sooner */
    if (!offer(s, sp_lesser(sp_greater(share - way, 0), 1), search))
        offer(s, sp_lesser(sp_greater(share + way, 0), 1), search);
}

static void cross_segment(const segment *s, sp_ray_search *search)
{
    bool first = s->ends[0].below >= 0, second = s->ends[1].below >= 0;
    if (first != second)
        cross_once(s, first, search);
    else if (!first)
        cross_twice(s, search);
}

/* `positive`: bit i for corner i. */
static void cut(const sp_parabola *p, const view *v, unsigned positive, uint32_t triangle, sp_ray_search *search)
{
    static const int lone[8] = {0, 0, 1, 2, 2, 1, 0, 0};
    if (positive == 0 || positive == 7)
        return;
    int k = lone[positive];
    segment s = {
        .flight = p, .corner = {k, (k + 1) % 3, (k + 2) % 3}, .negative = !(positive >> k & 1), .triangle = triangle};
    for (int i = 0; i < 2; i++) {
        int other = s.corner[1 + i];
        s.ends[i] = cross_edge(p, v, s.negative ? k : other, s.negative ? other : k);
    }
    cross_segment(&s, search);
}

/* Of a flight that is a vertical line, up and down again. */
static void pierce(const sp_parabola *p, const view *v, uint32_t triangle, sp_ray_search *search)
{
    double weights[3], roots[2];
    if (!sp_barycentric(v->time, v->beside, weights))
        return;
    double sum = weights[0] + weights[1] + weights[2];
    double depth = (weights[0] * v->depth[0] + weights[1] * v->depth[1] + weights[2] * v->depth[2]) / sum;
    if (!sp_quadratic_roots(p->acceleration, p->fall, -depth, roots))
        return;
    for (int i = 0; i < 2; i++)
        if (sp_ray_search_wants(search, roots[i], triangle)) {
            sp_ray_search_take(search, roots[i], weights[1] / sum, weights[2] / sum, triangle);
            return;
        }
}

void sp_parabola_test(const sp_parabola *p, const sp_corners corners, uint32_t triangle, sp_ray_search *search)
{
    if (triangle == search->skip)
        return;
    view v = look(p, corners);
    if (p->vertical) {
        pierce(p, &v, triangle, search);
        return;
    }
    unsigned positive = 0, within = 0;
    for (int i = 0; i < 3; i++) {
        positive |= (unsigned)(v.beside[i] > 0) << i;
        within |= (unsigned)(v.beside[i] == 0) << i;
    }
    cut(p, &v, positive, triangle, search);
    if (within)
        cut(p, &v, positive | within, triangle, search);
}

void sp_parabola_search_all(const sp_parabola *parabola, const sp_corners *corners, size_t count, sp_ray_search *search)
{
    for (size_t t = 0; t < count && !sp_ray_search_done(search); t++)
        sp_parabola_test(parabola, corners[t], (uint32_t)t, search);
}
