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

typedef struct {
    uint32_t node;
    double from, to; /* s */
} pending;

/* When the flight comes within the margin of the plane, and when it has left it: within from..to, or before or after
 * where that is not so. */
static inline void pass_plane(const walk *w, int axis, double split, const pending *at, double *arrival,
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
    double sign = rising ? 1 : -1, a = sign * (sp_parabola_coordinate(p, axis, at->from) - split);
    double b = sign * (sp_parabola_coordinate(p, axis, at->to) - split);
    *arrival = a >= -w->margin ? at->from : INFINITY;
    *departure = b <= w->margin ? at->to : a > w->margin ? -INFINITY : at->to;
    if (a < -w->margin && b >= -w->margin)
        *arrival = clamp(time_at(p, axis, split - sign * w->margin, rising), at->from, at->to);
    if (a <= w->margin && b > w->margin)
        *departure = clamp(time_at(p, axis, split + sign * w->margin, rising), at->from, at->to);
}

/* Goes on to one child; puts the other, if the flight passes it too, on the stack. */
static inline void step(const walk *w, const sp_kd_node *node, pending *at, pending stack[], int *height)
{
    int axis = (int)(node->size & 3);
    uint32_t left = at->node + 1, right = node->right;
    if (w->still[axis]) {
        double offset = node->split - sp_parabola_coordinate(w->flight, axis, at->from);
        if (fabs(offset) <= 2 * w->margin)
            stack[(*height)++] = (pending){right, at->from, at->to};
        at->node = offset >= -2 * w->margin ? left : right;
        return;
    }
    double arrival, departure;
    pass_plane(w, axis, node->split, at, &arrival, &departure);
    uint32_t near = w->rising[axis] ? left : right, far = w->rising[axis] ? right : left;
    if (departure < at->from) {
        at->node = far;
    } else {
        if (arrival <= at->to)
            stack[(*height)++] = (pending){far, sp_greater(at->from, arrival), at->to};
        at->node = near;
        at->to = sp_lesser(at->to, departure);
    }
}

static void search_piece(const sp_parabola *flight, const sp_corners *corners, const sp_kd_tree *tree, double from,
                         double to, sp_ray_search *search)
{
    walk w = {.flight = flight};
    pending stack[SP_KD_DEPTH + 1], at = {0, from, to};
    int height = 0;
    if (!enter(&w, tree, &at.from, &at.to))
        return;
    for (;;) {
        const sp_kd_node *node = &tree->nodes[at.node];
        while ((node->size & 3) != SP_KD_LEAF) {
            step(&w, node, &at, stack, &height);
            node = &tree->nodes[at.node];
        }
        const uint32_t *references = tree->references + node->right;
        for (uint32_t i = 0; i < node->size / 4; i++)
            sp_parabola_test(flight, corners[references[i]], references[i], search);
        do {
            if (height == 0 || sp_ray_search_done(search))
                return;
            at = stack[--height];
        } while (at.from > search->limit);
        at.to = sp_lesser(at.to, search->limit);
    }
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
