/* sp_parabola_flight_prepare and sp_bvh_arc_prepare, many flights at once, where gravity is along an axis. Included
 * once by each file that is compiled for a set of instructions, with SP_KERNEL(name) naming its functions. A compiler
 * sees vectors in these loops. */
#include "trace/parabola/parabola_bvh.h"

typedef struct {
    double place[3][SP_BVH_STARTS], speed[3][SP_BVH_STARTS], inverse[3][SP_BVH_STARTS];
    double from[SP_BVH_STARTS], to[SP_BVH_STARTS];
    double enter[SP_BVH_STARTS], leave[SP_BVH_STARTS]; /* when the steep coordinate passes the limits */
} start_lanes;

static void gather_starts(const sp_parabola_queue *queue, const sp_bvh_starts *s, start_lanes *lanes)
{
    const double *centre = queue->bvh->centre, scale = queue->bvh->scale;
    const int *axis = queue->axis;
    for (int i = 0; i < s->count; i++) {
        const sp_ray *ray = &queue->rays[s->ray[i]];
        double origin[3], velocity[3];
        sp_to_array(ray->origin, origin);
        sp_to_array(ray->velocity, velocity);
        for (int k = 0; k < 3; k++) {
            lanes->place[k][i] = (origin[axis[k]] - centre[axis[k]]) * scale;
            lanes->speed[k][i] = velocity[axis[k]] * scale;
        }
        lanes->from[i] = ray->t_min;
        lanes->to[i] = sp_ray_search_limit(ray);
    }
}

/* Cuts the flights along the other axes, and where the steep coordinate turns. */
static inline void cut_straight_lanes(start_lanes *lanes, double acceleration, sp_bvh_starts *s, int count)
{
    for (int i = 0; i < count; i++) {
        double from = lanes->from[i], to = lanes->to[i];
        for (int k = 1; k < 3; k++) {
            double place = lanes->place[k][i], speed = lanes->speed[k][i], inverse = 1 / speed;
            double way = speed < 0 ? -place : place;
            to = sp_lesser((SP_BVH_LIMIT - way) * fabs(inverse), to);
            from = sp_greater((-SP_BVH_LIMIT - way) * fabs(inverse), from);
            lanes->inverse[k][i] = inverse;
        }
        double turn = -lanes->speed[0][i] / acceleration;
        int64_t later = (turn > from) & (turn < to), inside = from <= to;
        s->end[i] = to;
        s->later[i] = later;
        s->fits[i] = inside;
        s->to[i] = later ? turn : to;
        lanes->to[i] = later ? turn : to;
        lanes->from[i] = from;
    }
}

/* time_of, both ways. */
static inline void time_limits(start_lanes *lanes, double acceleration, int count)
{
    for (int i = 0; i < count; i++) {
        double place = lanes->place[0][i], speed = lanes->speed[0][i];
        double middle = speed + 0.5 * acceleration * (lanes->from[i] + lanes->to[i]), sign = middle < 0 ? -1.0 : 1.0;
        double enter = -sign * SP_BVH_LIMIT - place, leave = sign * SP_BVH_LIMIT - place;
        double enter_square = speed * speed + 2 * acceleration * enter,
               leave_square = speed * speed + 2 * acceleration * leave;
        double enter_speed = sign * sqrt(enter_square), leave_speed = sign * sqrt(leave_square);
        bool enter_alike = enter_speed * speed > 0, leave_alike = leave_speed * speed > 0;
        double enter_top = enter_alike ? 2 * enter : enter_speed - speed;
        double leave_top = leave_alike ? 2 * leave : leave_speed - speed;
        double enter_time = enter_top / (enter_alike ? enter_speed + speed : acceleration);
        double leave_time = leave_top / (leave_alike ? leave_speed + speed : acceleration);
        lanes->enter[i] = enter_square > 0 ? enter_time : INFINITY;
        lanes->leave[i] = leave_square > 0 ? leave_time : INFINITY;
    }
}

/* cut_curved, and whether the pieces are such as sp_bvh_arc_prepare takes. */
static inline void cut_curved_lanes(const sp_parabola_queue *queue, start_lanes *lanes, double acceleration,
                                    sp_bvh_starts *s, int count)
{
    double strength = queue->acceleration->strength * queue->bvh->scale;
    for (int i = 0; i < count; i++) {
        double place0 = lanes->place[0][i], place1 = lanes->place[1][i], place2 = lanes->place[2][i];
        double speed0 = lanes->speed[0][i], speed1 = lanes->speed[1][i], speed2 = lanes->speed[2][i];
        double from = lanes->from[i], to = lanes->to[i];
        double summed = sp_greater(sp_greater(1, fabs(place0)), sp_greater(fabs(place1), fabs(place2)));
        double sideways = sp_greater(fabs(speed1), fabs(speed2)), speed = sp_greater(fabs(speed0), sideways);
        double middle = speed0 + 0.5 * acceleration * (from + to), sign = middle < 0 ? -1.0 : 1.0;
        double first = sign * (place0 + from * (speed0 + 0.5 * from * acceleration));
        double last = sign * (place0 + to * (speed0 + 0.5 * to * acceleration));
        double enter = sp_greater(from, lanes->enter[i]), leave = sp_lesser(to, lanes->leave[i]);
        from = first < -SP_BVH_LIMIT ? enter : from;
        to = last <= SP_BVH_LIMIT ? to : leave;
        double fastest =
            sp_greater(sp_greater(fabs(speed0 + from * acceleration), fabs(speed0 + to * acceleration)), sideways);
        double latest = sp_greater(fabs(from), fabs(to));
        double most = 2 * (summed + latest * (speed + 0.5 * latest * strength)), way = (to - from) * fastest;
        double all = fabs(place0) + fabs(place1) + fabs(place2) + fabs(speed0) + fabs(speed1) + fabs(speed2);
        int64_t inside = s->fits[i] & (first <= SP_BVH_LIMIT) & (from <= to);
        int64_t usual = (summed <= SP_BVH_SUMMED) & (all <= 1e100) & (most <= SP_BVH_SUMMED) & (way <= 4.2) &
                        (fastest > 1e-100) & (fastest < 1e100);
        /* a first piece that is nowhere says nothing of the next */
        int64_t known = usual & (inside | (s->later[i] ^ 1));
        s->fits[i] = known ? inside ? SP_BVH_READY : SP_BVH_NOWHERE : SP_BVH_FAR;
        lanes->enter[i] = lanes->from[i]; /* of the piece */
        lanes->leave[i] = lanes->to[i];
        lanes->from[i] = from; /* in the box */
        lanes->to[i] = to;
        s->start[i] = from;
        s->rate[i] = fastest;
    }
}

static inline double clamp_way(double way)
{
    return sp_lesser(sp_greater(way, -64), 64);
}

/* What sp_bvh_arc_prepare and set_axis fill in. */
static inline void fill_starts(const start_lanes *lanes, const double span[SP_BVH_STARTS], double acceleration,
                               sp_bvh_starts *s, int count)
{
    for (int i = 0; i < count; i++) {
        double from = lanes->from[i], to = lanes->to[i], rate = s->rate[i], per_rate = span[i];
        double place = lanes->place[0][i], speed = lanes->speed[0][i], length = (to - from) * rate;
        float bend = (float)(0.5 * acceleration * per_rate * per_rate);
        double slope = (speed + 0.5 * acceleration * (from + to)) * per_rate, inverse = fabs(1 / slope);
        double way = fabs(slope) > 0x1p-60 ? inverse : 0x1p60;
        double off = -0.25 * bend * length * length, ahead = slope > 0 ? off : -off;
        s->origin[0][i] = (float)(place + from * (speed + 0.5 * from * acceleration));
        s->direction[0][i] = (float)((speed + from * acceleration) * per_rate);
        s->inverse[0][i] = (float)way;
        s->bend[i] = bend;
        s->sooner[i] = (float)(-sp_greater(ahead, 0) * way);
        s->behind[i] = (float)(-sp_lesser(ahead, 0) * way);
        s->last[i] = (float)(length + 0x1p-20);
        s->surely_first[i] = (float)clamp_way((lanes->enter[i] - from) * rate + 4 * SP_BVH_PAD);
        s->surely_last[i] = (float)clamp_way((lanes->leave[i] - from) * rate - 4 * SP_BVH_PAD);
        s->falls[0][i] = !(slope > 0);
    }
    for (int k = 1; k < 3; k++)
        for (int i = 0; i < count; i++) {
            double slope = lanes->speed[k][i] * span[i], most = slope > 0 ? 0x1p60 : -0x1p60;
            double way = fabs(slope) > 0x1p-60 ? lanes->inverse[k][i] * s->rate[i] : most;
            s->origin[k][i] = (float)(lanes->place[k][i] + lanes->from[i] * lanes->speed[k][i]);
            s->direction[k][i] = (float)slope;
            s->inverse[k][i] = (float)way;
            s->falls[k][i] = !(slope > 0);
        }
}

void SP_KERNEL(sp_bvh_prepare_starts)(const sp_parabola_queue *queue, sp_bvh_starts *starts)
{
    start_lanes lanes = {0};
    double acceleration = queue->acceleration->vector[queue->axis[0]] * queue->bvh->scale, span[SP_BVH_STARTS];
    int count = (starts->count + 7) / 8 * 8;
    gather_starts(queue, starts, &lanes);
    cut_straight_lanes(&lanes, acceleration, starts, count);
    time_limits(&lanes, acceleration, count);
    cut_curved_lanes(queue, &lanes, acceleration, starts, count);
    for (int i = 0; i < count; i++)
        starts->rate[i] = sp_bvh_power_above(starts->rate[i], &span[i]);
    fill_starts(&lanes, span, acceleration, starts, count);
}
