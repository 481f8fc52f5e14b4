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

/* Where the fast walk begins: at time 0 if it can, else where the line comes near the box. False where it never does.
 */
static bool choose_start(const sp_bvh *bvh, const sp_line *line, const sp_search *search, double origin[3],
                         double *start)
{
    double farthest = 0;
    *start = 0;
    for (int axis = 0; axis < 3; axis++) {
        origin[axis] = (line->origin[axis] - bvh->centre[axis]) * bvh->scale;
        farthest = sp_greater(farthest, fabs(origin[axis]));
    }
    if (search->t_min >= 0 && farthest <= NEAR_ENOUGH)
        return true;
    *start = search->t_min;
    if (!enter(line, bvh->low, bvh->high, 0x1p-6 / bvh->scale, start, search->limit))
        return false;
    for (int axis = 0; axis < 3; axis++)
        origin[axis] = (line->origin[axis] - bvh->centre[axis] + *start * line->velocity[axis]) * bvh->scale;
    return true;
}

static float clamp_way(double way)
{
    return (float)sp_lesser(sp_greater(way, 0), LONGEST);
}

/* Makes the line ready for the fast walk. False where it cannot take it. */
static bool prepare(const sp_bvh *bvh, const sp_line *line, const sp_search *search, const double origin[3],
                    sp_bvh_line *ray)
{
    double reach = 0;
    ray->rate = fabs(line->velocity[line->z]) * bvh->scale;
    if (!(ray->rate > 1e-280 && ray->rate < 1e280 && fabs(ray->start) < 1e280))
        return false;
    ray->x = line->x;
    ray->y = line->y;
    ray->z = line->z;
    ray->sign = line->velocity[line->z] > 0 ? 1 : -1;
    ray->shear_x = (float)line->shear_x;
    ray->shear_y = (float)line->shear_y;
    for (int axis = 0; axis < 3; axis++) {
        double direction = line->velocity[axis] * fabs(line->inverse_z);
        bool rises = direction > 0;
        ray->origin[axis] = (float)origin[axis];
        reach = sp_greater(reach, fabs(origin[axis]) + 1);
        ray->inverse[axis] = fabs(direction) > 0x1p-60 ? (float)(1 / direction) : rises ? 0x1p60f : -0x1p60f;
        ray->near[axis] = (uint32_t)(8 * axis + (rises ? 0 : 24));
    }
    ray->blur = 13 * 0x1p-24f * (float)reach;
    double first = (search->t_min - ray->start) * ray->rate, last = (search->limit - ray->start) * ray->rate;
    ray->first = clamp_way(first - SP_BVH_PAD);
    ray->last = clamp_way(last + SP_BVH_PAD);
    ray->surely_first = clamp_way(first + 4 * SP_BVH_PAD);
    ray->surely_last = clamp_way(last - 4 * SP_BVH_PAD);
    return reach <= NEAR_ENOUGH + 1;
}

void sp_line_search_bvh(const sp_line *line, const sp_bvh *bvh, sp_instructions instructions, sp_search *search)
{
    sp_bvh_flight flight = {.bvh = bvh, .line = line, .search = search};
    double origin[3], farthest = 0;
    if (bvh->node_count == 0)
        return;
    for (int axis = 0; axis < 3; axis++)
        farthest = sp_greater(farthest, fabs(line->origin[axis] - bvh->centre[axis]) * bvh->scale);
    if (!(farthest <= FAR)) {
        walk(bvh, line, search);
        return;
    }
    if (!choose_start(bvh, line, search, origin, &flight.ray.start))
        return;
    if (!prepare(bvh, line, search, origin, &flight.ray)) {
        walk(bvh, line, search);
        return;
    }
    static void (*const kernels[])(sp_bvh_flight *) = {sp_bvh_line_portable, sp_bvh_line_avx2, sp_bvh_line_avx512};
    kernels[instructions](&flight);
}
