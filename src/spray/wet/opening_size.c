/* How far an opening reaches: from a point of it, directions in its plane are followed until the way across the plane
 * is shut. Lines that lean over from afar step over what parts small openings, and meet corners by chance only. */
#include "spray/wet/opening_size.h"

#include "spray/wet/opening_rim.h"

#define DIRECTIONS 64 /* about a point */
#define PASSES 3      /* each from the middle that the one before found */
#define STEP 0.0625   /* of an opening's width */
#define MOST_STEPS 1024
#define HALVES 10 /* of a step */
#define TURNS 10  /* by which a corner between two directions is narrowed down, each by a third */

typedef struct {
    const sp_flood *flood;
    sp_vec3 from, x, y; /* x and y in the plane */
    sp_vec3 inward;     /* half of the way across the plane that must be clear, m */
    double step;        /* m */
} reach;

bool sp_opening_is_clear(const sp_flood *flood, sp_vec3 from, sp_vec3 to)
{
    sp_ray line = {.origin = from, .velocity = sp_sub(to, from), .t_min = 0, .t_max = 1, .skip = SP_NONE};
    sp_hit hit = sp_trace_nearest(flood->tracer, &line, sp_v(0, 0, 0));
    return hit.triangle == SP_NONE && !(flood->setup->cap_count && sp_caps_block(flood->setup, &line, 1));
}

static bool is_open(const reach *reach, sp_vec3 point)
{
    return sp_opening_is_clear(reach->flood, sp_add(point, reach->inward), sp_sub(point, reach->inward));
}

static sp_vec3 direction_at(const reach *reach, double turn)
{
    return sp_along(sp_scale(reach->x, cos(turn)), sin(turn), reach->y);
}

/* m to the rim; INFINITY where none is met. A wall beside the opening, on the liquid's side, ends it too. */
static double rim_at(const reach *reach, double turn)
{
    sp_vec3 direction = direction_at(reach, turn);
    sp_ray beside = {.origin = sp_add(reach->from, reach->inward),
                     .velocity = direction,
                     .t_min = 0,
                     .t_max = MOST_STEPS * reach->step,
                     .skip = SP_NONE};
    sp_hit hit = sp_trace_nearest(reach->flood->tracer, &beside, sp_v(0, 0, 0));
    double low = 0, high = reach->step, end = hit.triangle == SP_NONE ? INFINITY : hit.t;
    for (int i = 1; high < end && is_open(reach, sp_along(reach->from, high, direction)); i++) {
        if (i == MOST_STEPS)
            return INFINITY;
        low = high;
        high += reach->step;
    }
    for (int half = 0; half < HALVES; half++) {
        double middle = 0.5 * (low + high);
        bool open = middle < end && is_open(reach, sp_along(reach->from, middle, direction));
        low = open ? middle : low;
        high = open ? high : middle;
    }
    return high;
}

/* The farthest that the rim is between two directions. */
static double corner_between(const reach *reach, double low, double high)
{
    double farthest = 0;
    for (int i = 0; i < TURNS; i++) {
        double one = low + (high - low) / 3, other = high - (high - low) / 3;
        double to_one = rim_at(reach, one), to_other = rim_at(reach, other);
        farthest = fmax(farthest, fmax(to_one, to_other));
        low = to_one < to_other ? one : low;
        high = to_one < to_other ? high : other;
    }
    return farthest;
}

/* The rim in all directions: its points and how far they are. False where it is not met everywhere. */
static bool follow(const reach *reach, sp_vec3 rim[DIRECTIONS], double far[DIRECTIONS])
{
    if (!is_open(reach, reach->from))
        return false;
    for (int i = 0; i < DIRECTIONS; i++) {
        double turn = 2 * M_PI * i / DIRECTIONS;
        far[i] = rim_at(reach, turn);
        if (!isfinite(far[i]))
            return false;
        rim[i] = sp_along(reach->from, far[i], direction_at(reach, turn));
    }
    return true;
}

/* From around every direction that is farther than its neighbours. */
static double farthest_corner(const reach *reach, const double far[DIRECTIONS])
{
    double farthest = 0;
    for (int i = 0; i < DIRECTIONS; i++)
        if (far[i] >= far[(i + DIRECTIONS - 1) % DIRECTIONS] && far[i] >= far[(i + 1) % DIRECTIONS])
            farthest =
                fmax(farthest, corner_between(reach, 2 * M_PI * (i - 1) / DIRECTIONS, 2 * M_PI * (i + 1) / DIRECTIONS));
    return farthest;
}

bool sp_opening_size_find(const sp_flood *flood, sp_vec3 through, sp_opening *opening)
{
    sp_vec3 normal = opening->normal, rim[DIRECTIONS];
    double far[DIRECTIONS], width = opening->width;
    reach reach = {.flood = flood, .from = through};
    reach.x = sp_unit(sp_cross(fabs(normal.x) < 0.5 ? sp_v(1, 0, 0) : sp_v(0, 1, 0), normal));
    reach.y = sp_cross(normal, reach.x);
    for (int pass = 0; pass < PASSES; pass++) {
        reach.inward = sp_scale(normal, -SP_OPENING_FLAT * width);
        reach.step = STEP * width;
        if (!follow(&reach, rim, far))
            return false;
        width = sp_rim_width(rim, DIRECTIONS, normal);
        if (pass + 1 < PASSES)
            reach.from = sp_rim_middle(rim, DIRECTIONS);
    }
    opening->place = reach.from;
    opening->width = width;
    opening->radius = farthest_corner(&reach, far);
    return true;
}
