/* Steps of flights with drag. Acceleration depends on velocity alone, so that a step solves for the velocity and the
 * place follows as its integral by the same weights. J. R. Dormand and P. J. Prince, "A family of embedded Runge-Kutta
 * formulae", Journal of Computational and Applied Mathematics 6, 1980. */
#include "integrate.h"

#define STAGES 7
#define FROM_REST 1e-6 /* s, of a first step */

static const double weights[STAGES][STAGES] = {
    {0},
    {1. / 5},
    {3. / 40, 9. / 40},
    {44. / 45, -56. / 15, 32. / 9},
    {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
    {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
    {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84},
};
/* The last row less the weights of order 4. */
static const double differences[STAGES] = {71. / 57600,      0,         -71. / 16695, 71. / 1920,
                                           -17253. / 339200, 22. / 525, -1. / 40};

sp_drag_state sp_drag_state_of(const sp_drag *drag, sp_vec3 point, sp_vec3 velocity, sp_vec3 gravity)
{
    return (sp_drag_state){point, velocity, sp_drag_acceleration(drag, velocity, gravity)};
}

double sp_drag_step(const sp_drag *drag, const sp_drag_state *from, sp_vec3 gravity, double step, sp_drag_state *to)
{
    sp_vec3 velocity[STAGES] = {from->velocity}, acceleration[STAGES] = {from->acceleration};
    sp_vec3 way = sp_v(0, 0, 0), way_error = way, speed_error = sp_scale(acceleration[0], differences[0]);
    for (int i = 1; i < STAGES; i++) {
        sp_vec3 change = way;
        for (int k = 0; k < i; k++)
            change = sp_along(change, weights[i][k], acceleration[k]);
        velocity[i] = sp_along(from->velocity, step, change);
        acceleration[i] = sp_drag_acceleration(drag, velocity[i], gravity);
        speed_error = sp_along(speed_error, differences[i], acceleration[i]);
    }
    for (int i = 0; i < STAGES; i++) {
        way = sp_along(way, weights[STAGES - 1][i], velocity[i]);
        way_error = sp_along(way_error, differences[i], velocity[i]);
    }
    *to = (sp_drag_state){sp_along(from->point, step, way), velocity[STAGES - 1], acceleration[STAGES - 1]};
    double error = fmax(step * sp_length(speed_error), sp_length(way_error));
    return isfinite(error + sp_length(to->point)) ? error : INFINITY;
}

double sp_drag_stride(double error, double tolerance)
{
    return fmin(fmax(0.9 * pow(tolerance / error, 0.2), 0.1), 5);
}

bool sp_drag_is_settled(const sp_drag_state *moment, sp_vec3 gravity, double speed, double tolerance)
{
    double g = sp_length(gravity);
    return g > 0 ? sp_length(moment->acceleration) <= tolerance * g : sp_length(moment->velocity) <= tolerance * speed;
}

sp_drag_state sp_leg_at(const sp_leg *leg, double t)
{
    const sp_drag_state *a = &leg->from, *b = &leg->to;
    if (isinf(leg->time))
        return (sp_drag_state){sp_along(a->point, t, a->velocity), a->velocity, sp_v(0, 0, 0)};
    double h = leg->time, x = t / h;
    /* what the end lacks of place, velocity and acceleration, each times so much time as makes a place of it */
    sp_vec3 place = sp_sub(b->point, sp_along(sp_along(a->point, h, a->velocity), 0.5 * h * h, a->acceleration));
    sp_vec3 speed = sp_scale(sp_sub(b->velocity, sp_along(a->velocity, h, a->acceleration)), h);
    sp_vec3 acceleration = sp_scale(sp_sub(b->acceleration, a->acceleration), h * h);
    sp_vec3 third = sp_along(sp_along(sp_scale(place, 10), -4, speed), 0.5, acceleration);
    sp_vec3 fourth = sp_along(sp_along(sp_scale(place, -15), 7, speed), -1, acceleration);
    sp_vec3 fifth = sp_along(sp_along(sp_scale(place, 6), -3, speed), 0.5, acceleration);
    sp_vec3 rest = sp_scale(sp_along(sp_along(third, x, fourth), x * x, fifth), x * x * x);
    sp_vec3 slope = sp_scale(sp_along(sp_along(sp_scale(third, 3), 4 * x, fourth), 5 * x * x, fifth), x * x / h);
    return (sp_drag_state){.point =
                               sp_add(sp_along(sp_along(a->point, t, a->velocity), 0.5 * t * t, a->acceleration), rest),
                           .velocity = sp_add(sp_along(a->velocity, t, a->acceleration), slope)};
}

sp_march sp_march_from(const sp_drag *drag, sp_vec3 gravity, sp_vec3 point, sp_vec3 velocity)
{
    sp_march march = {.drag = drag, .gravity = gravity, .speed = sp_length(velocity)};
    march.now = sp_drag_state_of(drag, point, velocity, gravity);
    /* the time in which the velocity changes about as much as it is, or from rest a little */
    double change = sp_length(march.now.acceleration);
    march.step = change > 0 && march.speed > 0 ? march.speed / change : FROM_REST;
    return march;
}

/* As long as it feels nothing. */
static sp_leg fly_free(sp_march *march)
{
    double delay = march->drag->delay;
    sp_drag_state *now = &march->now;
    sp_leg leg = {.from = {now->point, now->velocity, march->gravity}, .time = delay};
    leg.to = leg.from;
    leg.to.point = sp_along(sp_along(now->point, delay, now->velocity), 0.5 * delay * delay, march->gravity);
    leg.to.velocity = sp_along(now->velocity, delay, march->gravity);
    march->flown = delay;
    *now = sp_drag_state_of(march->drag, leg.to.point, leg.to.velocity, march->gravity);
    return leg;
}

sp_leg sp_march_on(sp_march *march, double tolerance)
{
    if (march->flown < march->drag->delay)
        return fly_free(march);
    sp_leg leg = {.from = march->now, .time = INFINITY};
    if (sp_drag_is_settled(&march->now, march->gravity, march->speed, tolerance))
        return leg;
    for (double error = INFINITY; error > tolerance; march->step *= sp_drag_stride(error, tolerance)) {
        leg.time = march->step;
        error = sp_drag_step(march->drag, &march->now, march->gravity, march->step, &leg.to);
        error = error > 0 ? error / fmax(sp_length(leg.from.velocity), sp_length(leg.to.velocity)) : 0;
    }
    march->flown += leg.time;
    march->now = leg.to;
    return leg;
}

sp_ray sp_parabola_through(const sp_vec3 place[3], double time, sp_vec3 *acceleration)
{
    sp_vec3 half = sp_sub(place[1], place[0]), whole = sp_sub(place[2], place[0]);
    *acceleration = sp_scale(sp_along(whole, -2, half), 4 / time / time);
    return (sp_ray){.origin = place[0],
                    .velocity = sp_scale(sp_along(sp_scale(half, 4), -1, whole), 1 / time),
                    .t_max = time,
                    .skip = SP_NONE};
}

double sp_parabola_misses(const sp_vec3 place[3], sp_vec3 quarter)
{
    sp_vec3 half = sp_sub(place[1], place[0]), whole = sp_sub(place[2], place[0]);
    return sp_length(sp_sub(sp_sub(quarter, place[0]), sp_along(sp_scale(half, 0.75), -0.125, whole)));
}
