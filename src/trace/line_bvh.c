#include "trace/line_bvh.h"

/* Lines that come from farther away, in the hierarchy's space, than single precision is good for. */
#define NEAR_ENOUGH 7.0
#define FAR 0x1p15
/* No way within the box is longer, for an origin that is near enough. */
#define LONGEST 16.0

/* A walk in double precision, for whatever the fast one does not take. */
typedef struct {
    uint32_t node;
    double from; /* s */
} pending;

/* When the line enters the box widened by `margin`, no sooner than `from`; false where it does not before `to`. */
static bool enter(const sp_line *line, const double low[3], const double high[3], double margin, double *from,
                  double to)
{
    for (int axis = 0; axis < 3; axis++) {
        double speed = line->velocity[axis], a = low[axis] - margin - line->origin[axis],
               b = high[axis] + margin - line->origin[axis];
        if (speed == 0 && (a > 0 || b < 0))
            return false;
        if (speed != 0) {
            *from = sp_greater(*from, (speed > 0 ? a : b) / speed);
            to = sp_lesser(to, (speed > 0 ? b : a) / speed);
        }
    }
    return *from <= to;
}

static void test_block(const sp_bvh *bvh, const sp_line *line, const sp_bvh_block *block, sp_search *search)
{
    for (int i = 0; i < SP_BVH_WIDTH && block->triangle[i] != SP_NONE; i++) {
        sp_corners corners;
        sp_bvh_corners(bvh, block->triangle[i], corners);
        sp_line_test(line, (const double(*)[3])corners, block->triangle[i], search);
    }
}

static void walk(const sp_bvh *bvh, const sp_line *line, sp_search *search)
{
    pending stack[SP_BVH_STACK];
    int height = 1;
    double farthest = 0;
    stack[0] = (pending){0, search->t_min};
    for (int axis = 0; axis < 3; axis++)
        farthest = sp_greater(farthest, sp_greater(fabs(bvh->low[axis] - line->origin[axis]),
                                                   fabs(bvh->high[axis] - line->origin[axis])));
    while (height > 0 && !sp_search_done(search)) {
        pending at = stack[--height];
        if (at.from > search->limit)
            continue;
        if (at.node & SP_BVH_LEAF) {
            test_block(bvh, line, &bvh->blocks[at.node - SP_BVH_LEAF], search);
            continue;
        }
        const sp_bvh_node *node = &bvh->nodes[at.node];
        for (uint32_t i = 0; i < node->count; i++) {
            double low[3], high[3], from = at.from;
            sp_bvh_child_box(bvh, node, i, low, high);
            if (enter(line, low, high, SP_LINE_MARGIN * farthest, &from, search->limit))
                stack[height++] = (pending){node->child[i], from};
        }
    }
}

static float clamp_way(double way)
{
    return (float)sp_lesser(sp_greater(way, 0), LONGEST);
}

/* Makes the line ready for the fast walk from `origin` (in the hierarchy's space) at time ray->start on. False where
 * single precision does not suffice. */
static bool prepare(const sp_bvh *bvh, const sp_ray *asked, const double origin[3], sp_bvh_line *ray)
{
    double velocity[3], reach = 0;
    uint32_t falls = 0;
    int z = 0;
    sp_to_array(asked->velocity, velocity);
    for (int axis = 1; axis < 3; axis++)
        if (fabs(velocity[axis]) > fabs(velocity[z]))
            z = axis;
    double along = fabs(velocity[z]), slowness = 1 / along;
    ray->rate = along * bvh->scale;
    ray->x = (z + 1) % 3;
    ray->y = (z + 2) % 3;
    ray->z = z;
    ray->sign = velocity[z] > 0 ? 1 : -1;
    for (int axis = 0; axis < 3; axis++) {
        float direction = (float)(velocity[axis] * slowness);
        bool rises = direction > 0;
        ray->direction[axis] = direction;
        ray->origin[axis] = (float)origin[axis];
        ray->inverse[axis] = fabsf(direction) > 0x1p-60f ? 1 / direction : rises ? 0x1p60f : -0x1p60f;
        ray->near[axis] = (uint32_t)(8 * axis + (rises ? 0 : 24));
        reach = sp_greater(reach, fabs(origin[axis]));
        falls |= (uint32_t)!rises << axis;
    }
    ray->diagonal = falls & 1 ? (~falls & 6) | 1 : falls & 6;
    ray->blur = 13 * 0x1p-24f * (float)(reach + 1);
    double first = (asked->t_min - ray->start) * ray->rate, last = (asked->t_max - ray->start) * ray->rate;
    ray->first = clamp_way(first - SP_BVH_PAD);
    ray->last = clamp_way(last + SP_BVH_PAD);
    ray->surely_first = clamp_way(first + 4 * SP_BVH_PAD);
    ray->surely_last = clamp_way(last - 4 * SP_BVH_PAD);
    return reach <= NEAR_ENOUGH && ray->rate > 1e-280 && ray->rate < 1e280 && along > 1e-280 && along < 1e280 &&
           fabs(ray->start) < 1e280 && isfinite(velocity[0] + velocity[1] + velocity[2]);
}

/* For a line from afar, or that begins before time 0: the fast walk begins where it comes near the box. False where the
 * search is over. */
static bool begin_late(const sp_bvh *bvh, const sp_ray *ray, sp_bvh_flight *flight)
{
    sp_line line;
    double origin[3], farthest = 0, start = ray->t_min;
    if (!sp_line_start(&line, ray))
        return false;
    for (int axis = 0; axis < 3; axis++)
        farthest = sp_greater(farthest, fabs(line.origin[axis] - bvh->centre[axis]) * bvh->scale);
    if (!enter(&line, bvh->low, bvh->high, 0x1p-6 / bvh->scale + SP_LINE_MARGIN * farthest / bvh->scale, &start,
               flight->search.limit))
        return false;
    for (int axis = 0; axis < 3; axis++)
        origin[axis] = (line.origin[axis] - bvh->centre[axis] + start * line.velocity[axis]) * bvh->scale;
    flight->ray.start = start;
    if (farthest <= FAR && prepare(bvh, ray, origin, &flight->ray))
        return true;
    walk(bvh, &line, &flight->search);
    return false;
}

/* Makes a flight ready; false where the search is over already. */
static bool begin(const sp_bvh *bvh, const sp_ray *ray, bool any, sp_bvh_flight *flight)
{
    double origin[3];
    flight->search = sp_search_start(ray, any);
    flight->asked = ray;
    flight->line_ready = flight->ending = false;
    flight->height = 1;
    flight->child[0] = 0;
    flight->way[0] = 0;
    flight->triangle = SP_NONE;
    flight->low = INFINITY;
    if (bvh->node_count == 0)
        return false;
    sp_to_array(ray->origin, origin);
    for (int axis = 0; axis < 3; axis++)
        origin[axis] = (origin[axis] - bvh->centre[axis]) * bvh->scale;
    flight->ray.start = 0;
    return (ray->t_min >= 0 && prepare(bvh, ray, origin, &flight->ray)) || begin_late(bvh, ray, flight);
}

static void ask(const sp_bvh *bvh, sp_bvh_flight *flight, uint32_t triangle)
{
    sp_corners corners;
    if (!flight->line_ready)
        sp_line_start(&flight->line, flight->asked);
    flight->line_ready = true;
    sp_bvh_corners(bvh, triangle, corners);
    sp_line_test(&flight->line, (const double(*)[3])corners, triangle, &flight->search);
}

void sp_bvh_flight_settle(const sp_bvh *bvh, sp_bvh_flight *flight, uint32_t triangle)
{
    const sp_search *search = &flight->search;
    ask(bvh, flight, triangle);
    if (flight->triangle != SP_NONE)
        ask(bvh, flight, flight->triangle);
    if (search->best.triangle == SP_NONE)
        return;
    float way = (float)((search->limit - flight->ray.start) * flight->ray.rate);
    flight->triangle = search->best.triangle;
    flight->low = way - SP_BVH_PAD;
    flight->ray.last = sp_lesser(flight->ray.last, way + SP_BVH_PAD);
}

static void answer(const sp_bvh_stream *stream, size_t ray, const sp_hit *hit)
{
    if (stream->hits)
        stream->hits[ray] = *hit;
    else
        stream->occluded[ray] = hit->triangle != SP_NONE;
}

void sp_bvh_stream_end(const sp_bvh_stream *stream, sp_bvh_flight *flight)
{
    if (flight->triangle != SP_NONE && stream->hits)
        ask(stream->bvh, flight, flight->triangle);
    else if (flight->triangle != SP_NONE)
        flight->search.best.triangle = flight->triangle;
    answer(stream, flight->number, &flight->search.best);
}

bool sp_bvh_stream_begin(sp_bvh_stream *stream, sp_bvh_flight *flight)
{
    while (stream->next < stream->count) {
        flight->number = stream->next++;
        if (begin(stream->bvh, &stream->rays[flight->number], !stream->hits, flight))
            return true;
        answer(stream, flight->number, &flight->search.best);
    }
    return false;
}

void sp_bvh_trace_lines(const sp_bvh *bvh, sp_instructions instructions, const sp_ray *rays, size_t count, sp_hit *hits,
                        bool *occluded)
{
    static void (*const kernels[])(sp_bvh_stream *, sp_bvh_flight *) = {sp_bvh_lines_portable, sp_bvh_lines_avx2,
                                                                        sp_bvh_lines_avx512};
    sp_bvh_stream stream = {.bvh = bvh, .rays = rays, .count = count, .hits = hits, .occluded = occluded};
    sp_bvh_flight flights[SP_BVH_FLIGHTS];
    kernels[instructions](&stream, flights);
}
