/* Parabolas through kd-trees. A flight is taken in pieces between the times at which it turns along an axis; within a
 * piece every coordinate goes one way only, so that it crosses a plane once, as a line does. */
#include "trace/ray/parabola.h"

typedef struct {
    const sp_parabola *flight;
    double margin;     /* m */
    double inverse[3]; /* 1 / velocity, for axes without gravity */
    double slack[3];   /* s, the time that the margin takes, likewise */
    bool rising[3];
    bool still[3]; /* moves less than the margin along this axis */
} walk;

/* When the coordinate has that value, on a piece on which it is `rising` or falls: from speed² = velocity² + 2 gravity
 * way, without cancellation. */
static double time_at(const sp_parabola *p, int axis, double value, bool rising)
{
    double v = p->velocity[axis], g = p->gravity[axis], way = value - p->origin[axis];
    double speed = sqrt(sp_greater(0, v * v + 2 * g * way));
    if (!rising)
        speed = -speed;
    return g == 0 || speed * v > 0 ? 2 * way / (speed + v) : (speed - v) / g;
}

static inline double clamp(double t, double from, double to)
{
    return sp_lesser(sp_greater(t, from), to);
}

bool sp_parabola_cut(const sp_parabola *p, int axis, double low, double high, double *from, double *to)
{
    double a = sp_parabola_coordinate(p, axis, *from), b = sp_parabola_coordinate(p, axis, *to);
    if (sp_greater(a, b) < low || sp_lesser(a, b) > high)
        return false;
    bool rising = b > a;
    double enter = rising ? low : high, leave = rising ? high : low, start = *from, end = *to;
    if (rising ? a < enter : a > enter)
        *from = clamp(time_at(p, axis, enter, rising), start, end);
    if (rising ? b > leave : b < leave)
        *to = clamp(time_at(p, axis, leave, rising), start, end);
    return *from <= *to;
}

/* Cuts the piece to the tree's box; twice, as the first time the margin may be far larger than needed. */
static bool enter(walk *w, const sp_kd_tree *tree, double *from, double *to)
{
    const sp_parabola *p = w->flight;
    for (int pass = 0; pass < 2; pass++) {
        w->margin = sp_parabola_margin(p, sp_greater(fabs(*from), fabs(*to)));
        for (int axis = 0; axis < 3; axis++)
            if (!sp_parabola_cut(p, axis, tree->low[axis] - w->margin, tree->high[axis] + w->margin, from, to))
                return false;
    }
    for (int axis = 0; axis < 3; axis++) {
        double way = sp_parabola_coordinate(p, axis, *to) - sp_parabola_coordinate(p, axis, *from);
        w->rising[axis] = way > 0;
        w->still[axis] = fabs(way) <= w->margin;
        w->inverse[axis] = 1 / p->velocity[axis];
        w->slack[axis] = w->margin * fabs(w->inverse[axis]);
    }
    return true;
}

/* When the flight comes within the margin of the plane, and when it has left it: within from..to, or before or after
 * where that is not so. */
static inline void pass_plane(const walk *w, int axis, double split, double from, double to, double *arrival,
                              double *departure)
{
    const sp_parabola *p = w->flight;
    if (p->gravity[axis] == 0) {
        double crossing = (split - p->origin[axis]) * w->inverse[axis];
        *arrival = crossing - w->slack[axis];
        *departure = crossing + w->slack[axis];
        return;
    }
    bool rising = w->rising[axis];
    double sign = rising ? 1 : -1, a = sign * (sp_parabola_coordinate(p, axis, from) - split);
    double b = sign * (sp_parabola_coordinate(p, axis, to) - split);
    *arrival = a >= -w->margin ? from : INFINITY;
    *departure = b <= w->margin ? to : a > w->margin ? -INFINITY : to;
    if (a < -w->margin && b >= -w->margin)
        *arrival = clamp(time_at(p, axis, split - sign * w->margin, rising), from, to);
    if (a <= w->margin && b > w->margin)
        *departure = clamp(time_at(p, axis, split + sign * w->margin, rising), from, to);
}

static inline double ahead(const walk *w, int axis, double split, double time)
{
    return split - sp_parabola_coordinate(w->flight, axis, time);
}

static inline void test(const walk *w, const sp_corners corners, uint32_t triangle, sp_ray_search *search)
{
    sp_parabola_test(w->flight, corners, triangle, search);
}

#include "trace/ray/kd_walk.h"

static void search_piece(const sp_parabola *flight, const sp_corners *corners, const sp_kd_tree *tree, double from,
                         double to, sp_ray_search *search)
{
    walk w = {.flight = flight};
    if (enter(&w, tree, &from, &to))
        search_leaves(&w, corners, tree, from, to, search);
}

double sp_parabola_turn(const sp_parabola *p, double from, double last)
{
    for (int axis = 0; axis < 3; axis++) {
        double turn = -p->velocity[axis] / p->gravity[axis];
        if (p->gravity[axis] != 0 && turn > from && turn < last)
            last = turn;
    }
    return last;
}

void sp_parabola_search_tree(const sp_parabola *p, const sp_corners *corners, const sp_kd_tree *tree,
                             sp_ray_search *search)
{
    double from = search->t_min, last = search->limit;
    while (from <= sp_lesser(last, search->limit) && !sp_ray_search_done(search)) {
        double to = sp_parabola_turn(p, from, last);
        search_piece(p, corners, tree, from, sp_lesser(to, search->limit), search);
        if (to == last)
            return;
        from = to;
    }
}
