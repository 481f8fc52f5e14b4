/* Flights as pieces that go through the hierarchy. */
#include "trace/parabola/parabola_bvh.h"

static inline double course_at(const sp_bvh_course *c, double t)
{
    return c->place + t * (c->speed + 0.5 * t * c->acceleration);
}

/* Cuts the span to when a coordinate without gravity is within ±SP_BVH_LIMIT. */
static inline void cut_straight(const sp_bvh_course *c, double *from, double *to)
{
    double way = c->speed < 0 ? -c->place : c->place, inverse = fabs(c->inverse);
    /* Where the speed is 0 these are infinite, or no numbers, which change nothing. */
    double leave = (SP_BVH_LIMIT - way) * inverse, enter = (-SP_BVH_LIMIT - way) * inverse;
    *to = sp_lesser(leave, *to);
    *from = sp_greater(enter, *from);
}

/* When a coordinate with gravity is `way` away from its place, moving with that sign; infinite for never. */
static double time_of(const sp_bvh_course *c, double way, double sign)
{
    double square = c->speed * c->speed + 2 * c->acceleration * way;
    if (!(square > 0))
        return INFINITY;
    double speed = sign * sqrt(square);
    return speed * c->speed > 0 ? 2 * way / (speed + c->speed) : (speed - c->speed) / c->acceleration;
}

/* Likewise for a coordinate with gravity, which does not turn in the span. */
static inline bool cut_curved(const sp_bvh_course *c, double *from, double *to)
{
    /* in the middle: at its ends it may be turning */
    double middle = *to < INFINITY ? c->speed + 0.5 * c->acceleration * (*from + *to) : c->acceleration,
           sign = middle < 0 ? -1 : 1;
    double first = sign * course_at(c, *from);
    if (!(first <= SP_BVH_LIMIT))
        return false;
    if (first < -SP_BVH_LIMIT)
        *from = sp_greater(*from, time_of(c, -sign * SP_BVH_LIMIT - c->place, sign));
    if (!(sign * course_at(c, *to) <= SP_BVH_LIMIT))
        *to = sp_lesser(*to, time_of(c, sign * SP_BVH_LIMIT - c->place, sign));
    return *from <= *to;
}

sp_bvh_fitness sp_parabola_flight_prepare(const sp_bvh *bvh, const sp_acceleration *acceleration,
                                          sp_parabola_flight *flight, double *from, double *to)
{
    const double *centre = bvh->centre, scale = bvh->scale;
    double origin[3], velocity[3];
    sp_to_array(flight->asked->origin, origin);
    sp_to_array(flight->asked->velocity, velocity);
    flight->summed = 1;
    flight->speed = 0;
    flight->strength = acceleration->strength * scale;
    for (int k = 0; k < 3; k++) {
        sp_bvh_course *c = &flight->course[k];
        *c = (sp_bvh_course){(origin[k] - centre[k]) * scale, velocity[k] * scale, acceleration->vector[k] * scale, 0};
        flight->summed = sp_greater(flight->summed, fabs(c->place));
        flight->speed = sp_greater(flight->speed, fabs(c->speed));
        if (c->acceleration == 0) {
            c->inverse = 1 / c->speed;
            cut_straight(c, from, to);
        }
    }
    if (!isfinite(flight->speed + flight->strength + origin[0] + origin[1] + origin[2] + velocity[0] + velocity[1] +
                  velocity[2]))
        return SP_BVH_NOWHERE;
    if (!(flight->summed <= SP_BVH_SUMMED))
        return SP_BVH_FAR;
    return *from <= *to ? SP_BVH_READY : SP_BVH_NOWHERE;
}

/* Where in a node the bounds begin that are passed first and last. */
static inline void set_passage(sp_bvh_arc *arc, int i, bool falls)
{
    arc->near[i] = (uint32_t)(8 * arc->axis[i] + (falls ? 24 : 0));
    arc->far[i] = (uint32_t)(8 * arc->axis[i] + (falls ? 0 : 24));
}

/* Fills what of the arc is about the axis at this place in its order, `slope` being the chord's. */
static inline void set_axis(sp_bvh_arc *arc, int i, double slope, double inverse, double last)
{
    int axis = arc->axis[i];
    bool rises = slope > 0;
    double way = fabs(slope) > 0x1p-60 ? fabs(inverse) : 0x1p60; /* per unit along the axis */
    /* Halfway the flight is away from the chord by this: all on one side. */
    double off = -0.25 * arc->bend[axis] * last * last, ahead = rises ? off : -off;
    double most = sp_greater(ahead, 0), least = sp_lesser(ahead, 0);
    set_passage(arc, i, !rises);
    if (i == 0) { /* along the motion, from the origin */
        arc->sign = rises ? 1 : -1;
        arc->inverse[0] = (float)way;
        arc->sooner[0] = (float)(-most * way);
        arc->later[0] = (float)(-least * way);
    } else {
        arc->inverse[i] = (float)(rises ? way : -way);
        arc->sooner[i] = (float)(arc->origin[axis] + (rises ? most : -most));
        arc->later[i] = (float)((most - least) * way);
    }
}

bool sp_bvh_order_axes(const sp_acceleration *acceleration, int axis[3])
{
    int steep = fabs(acceleration->down[0]) > fabs(acceleration->down[1]) ? 0 : 1;
    steep = fabs(acceleration->down[2]) > fabs(acceleration->down[steep]) ? 2 : steep;
    axis[0] = steep;
    axis[1] = steep == 2 ? 0 : steep + 1;
    axis[2] = steep == 0 ? 2 : steep - 1;
    return acceleration->vector[axis[1]] == 0 && acceleration->vector[axis[2]] == 0;
}

static inline float way_of(const sp_bvh_arc *arc, double t, double margin)
{
    return (float)sp_lesser(sp_greater((t - arc->start) * arc->rate + margin, -64), 64);
}

/* What sp_bvh_arc.diagonal is, falls having bit k where the flight falls along axis k. */
static inline uint32_t diagonal_of(uint32_t falls)
{
    return falls & 1 ? (~falls & 6) | 1 : falls & 6;
}

sp_bvh_fitness sp_bvh_arc_prepare(const sp_acceleration *acceleration, sp_parabola_flight *flight, double from,
                                  double to)
{
    sp_bvh_arc *arc = &flight->arc;
    double t_min = from, t_max = to, fastest = 0, span;
    for (int k = 0; k < 3; k++)
        if (flight->course[k].acceleration != 0 && !cut_curved(&flight->course[k], &from, &to))
            return SP_BVH_NOWHERE;
    double latest = sp_greater(fabs(from), fabs(to));
    for (int k = 0; k < 3; k++) {
        const sp_bvh_course *c = &flight->course[k];
        fastest = sp_greater(
            fastest, sp_greater(fabs(c->speed + from * c->acceleration), fabs(c->speed + to * c->acceleration)));
    }
    if (!(2 * (flight->summed + latest * (flight->speed + 0.5 * latest * flight->strength)) <= SP_BVH_SUMMED &&
          (to - from) * fastest <= 4.2 && fastest > 1e-100 && fastest < 1e100))
        return SP_BVH_FAR;
    arc->start = from;
    arc->rate = sp_bvh_power_above(fastest, &span);
    double last = (to - from) * arc->rate;
    arc->aligned = sp_bvh_order_axes(acceleration, arc->axis);
    arc->sag = 0;
    uint32_t falls = 0;
    for (int i = 0; i < 3; i++) {
        int k = arc->axis[i];
        const sp_bvh_course *c = &flight->course[k];
        arc->origin[k] = (float)course_at(c, from);
        arc->direction[k] = (float)((c->speed + from * c->acceleration) * span);
        arc->bend[k] = (float)(0.5 * c->acceleration * span * span);
        arc->sag = fabsf(arc->bend[k]) > arc->sag ? fabsf(arc->bend[k]) : arc->sag;
        double slope = (c->speed + 0.5 * c->acceleration * (from + to)) * span;
        set_axis(arc, i, slope, c->acceleration == 0 ? c->inverse * arc->rate : 1 / slope, last);
        falls |= (uint32_t) !(slope > 0) << k;
    }
    arc->diagonal = diagonal_of(falls);
    if (!arc->aligned)
        arc->sag *= 2;
    arc->last = (float)(last + 0x1p-20);
    arc->surely_first = way_of(arc, t_min, 4 * SP_BVH_PAD);
    arc->surely_last = way_of(arc, t_max, -4 * SP_BVH_PAD);
    return SP_BVH_READY;
}

void sp_bvh_start_take(const sp_parabola_queue *queue, int i, sp_bvh_arc *arc)
{
    const sp_bvh_starts *s = &queue->starts;
    uint32_t falls = 0;
    for (int k = 0; k < 3; k++) {
        int axis = arc->axis[k] = queue->axis[k];
        arc->origin[axis] = s->origin[k][i];
        arc->direction[axis] = s->direction[k][i];
        arc->bend[axis] = k ? 0 : s->bend[i];
        arc->inverse[k] = s->inverse[k][i];
        arc->sooner[k] = k ? s->origin[k][i] : s->sooner[i];
        arc->later[k] = k ? 0 : s->behind[i];
        set_passage(arc, k, s->falls[k][i]);
        falls |= (uint32_t)s->falls[k][i] << axis;
    }
    arc->sign = s->falls[0][i] ? -1 : 1;
    arc->aligned = true;
    arc->sag = fabsf(s->bend[i]);
    arc->last = s->last[i];
    arc->diagonal = diagonal_of(falls);
    arc->surely_first = s->surely_first[i];
    arc->surely_last = s->surely_last[i];
    arc->start = s->start[i];
    arc->rate = s->rate[i];
}
