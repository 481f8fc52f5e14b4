/* The table of fronts: drops that leave at Chebyshev's elevations are flown side by side, in common steps. */
#include "wavefronts.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#define TOLERANCE 1e-8 /* of a step, of the speed: by what a lower order is off, and the step far less */
#define CUT 1e-10      /* of the way flown, that a polynomial left out may come to */
#define CUT_ROUGH 1e-4
#define ORDER_FIRST 16u
#define MOMENTS_MOST 20000u
#define JOINT 5e-5    /* of how far it has come, that a piece may miss its parabola by */
#define PARTS_MOST 16 /* of what lies between two moments */

/* The drops under way. */
typedef struct {
    unsigned count;
    double sine[SP_FRONT_ORDER], cosine[SP_FRONT_ORDER];     /* of their elevations */
    double share[4 * SP_FRONT_ORDER];                        /* cosines of a full turn, 4 count of them */
    sp_drag_state now[SP_FRONT_ORDER], next[SP_FRONT_ORDER]; /* x forwards, z upwards */
    sp_vec3 gravity;
} drops;

static void set_off(const sp_wavefronts *fronts, drops *drops, unsigned count)
{
    drops->count = count;
    drops->gravity = sp_v(0, 0, -sp_length(fronts->gravity));
    for (unsigned i = 0; i < 4 * count; i++)
        drops->share[i] = cos(0.5 * M_PI * i / count);
    for (unsigned k = 0; k < count; k++) {
        double elevation = 0.5 * M_PI * cos(M_PI * (k + 0.5) / count);
        drops->sine[k] = sin(elevation);
        drops->cosine[k] = cos(elevation);
        sp_vec3 velocity = sp_v(fronts->speed * drops->cosine[k], 0, fronts->speed * drops->sine[k]);
        drops->now[k] = sp_drag_state_of(&fronts->drag, sp_v(0, 0, 0), velocity, drops->gravity);
    }
}

static bool make_room(sp_wavefronts *fronts)
{
    if (fronts->count < fronts->capacity)
        return true;
    size_t capacity = fronts->capacity ? 2 * fronts->capacity : 64;
    double *time = realloc(fronts->time, capacity * sizeof *time);
    fronts->time = time ? time : fronts->time;
    unsigned *terms = realloc(fronts->terms, capacity * sizeof *terms);
    fronts->terms = terms ? terms : fronts->terms;
    unsigned *rough = realloc(fronts->rough, capacity * sizeof *rough);
    fronts->rough = rough ? rough : fronts->rough;
    double(*sum)[SP_FRONT_DATA] = realloc(fronts->sum, capacity * fronts->most * sizeof *sum);
    fronts->sum = sum ? sum : fronts->sum;
    if (!time || !terms || !rough || !sum)
        return false;
    fronts->capacity = capacity;
    return true;
}

/* How large a datum is, as a length, over a step to or from its moment. */
static double length_of(const double *sum, unsigned datum, double step)
{
    return fabs(sum[datum]) * (datum % 3 == 0 ? 1 : datum % 3 == 1 ? step : 0.5 * step * step);
}

/* Polynomials beyond which all are too small to tell. */
static unsigned terms_needed(double (*sum)[SP_FRONT_DATA], unsigned count, double step, double cut)
{
    double least = cut * (sum[0][0] + step * sum[0][1]);
    for (unsigned n = count; n > 1; n--)
        for (unsigned datum = 0; datum < SP_FRONT_DATA; datum++)
            if (length_of(sum[n - 1], datum, step) > least)
                return n;
    return 1;
}

/* q, d and their derivatives of one drop, from its place, velocity and acceleration. */
static void data_of(const drops *drops, unsigned k, double data[SP_FRONT_DATA])
{
    const sp_vec3 own[3] = {drops->now[k].point, drops->now[k].velocity, drops->now[k].acceleration};
    for (int i = 0; i < 3; i++) {
        data[i] = own[i].x / drops->cosine[k];
        data[3 + i] = own[i].z - data[i] * drops->sine[k];
    }
}

/* Where the drops are becomes a moment of the table; `step`: the longer of those before and after. False where memory
 * ran out. */
static bool record(sp_wavefronts *fronts, const drops *drops, double time, double step)
{
    if (!make_room(fronts))
        return false;
    double(*sum)[SP_FRONT_DATA] = fronts->sum + fronts->count * fronts->most;
    memset(sum, 0, fronts->most * sizeof *sum);
    for (unsigned k = 0; k < drops->count; k++) {
        double data[SP_FRONT_DATA];
        data_of(drops, k, data);
        for (unsigned n = 0; n < drops->count; n++) {
            double share = drops->share[n * (2 * k + 1) % (4 * drops->count)] * (n ? 2 : 1) / drops->count;
            for (int i = 0; i < SP_FRONT_DATA; i++)
                sum[n][i] += share * data[i];
        }
    }
    fronts->terms[fronts->count] = terms_needed(sum, drops->count, step, CUT);
    fronts->rough[fronts->count] = terms_needed(sum, drops->count, step, CUT_ROUGH);
    assert(fronts->count == 0 || time >= fronts->time[fronts->count - 1]);
    fronts->time[fronts->count++] = time;
    return true;
}

/* As long as what leaves is a stream. */
static bool fly_free(sp_wavefronts *fronts, drops *drops)
{
    double delay = fronts->drag.delay;
    for (unsigned k = 0; k < drops->count; k++)
        drops->now[k].acceleration = drops->gravity;
    if (!record(fronts, drops, 0, delay))
        return false;
    for (unsigned k = 0; k < drops->count; k++) {
        sp_drag_state *now = &drops->now[k];
        now->point = sp_along(sp_scale(now->velocity, delay), 0.5 * delay * delay, drops->gravity);
        now->velocity = sp_along(now->velocity, delay, drops->gravity);
    }
    if (!record(fronts, drops, delay, delay))
        return false;
    for (unsigned k = 0; k < drops->count; k++)
        drops->now[k] = sp_drag_state_of(&fronts->drag, drops->now[k].point, drops->now[k].velocity, drops->gravity);
    return true;
}

/* One common step, of the length that the worst of them asks for; *step is what to try next. Returns what was made. */
static double fly_on(const sp_wavefronts *fronts, drops *drops, double *step)
{
    double error = INFINITY, made = *step;
    while (error > TOLERANCE) {
        made = *step;
        error = 0;
        double speed = 0;
        for (unsigned k = 0; k < drops->count; k++) {
            error = fmax(error, sp_drag_step(&fronts->drag, &drops->now[k], drops->gravity, made, &drops->next[k]));
            speed = fmax(speed, sp_length(drops->next[k].velocity));
        }
        error = error > 0 ? error / speed : 0;
        *step *= sp_drag_stride(error, TOLERANCE);
    }
    memcpy(drops->now, drops->next, drops->count * sizeof *drops->now);
    return made;
}

static bool are_settled(const sp_wavefronts *fronts, const drops *drops)
{
    for (unsigned k = 0; k < drops->count; k++)
        if (!sp_drag_is_settled(&drops->now[k], drops->gravity, fronts->speed, TOLERANCE))
            return false;
    return true;
}

/* Nothing comes to within `far` any more. */
static bool are_past(const sp_wavefronts *fronts)
{
    sp_drop_wavefront up =
        sp_wavefront_at_moment(fronts, fronts->count - 1, fronts->terms[fronts->count - 1], 0.5 * M_PI);
    return sp_length(fronts->gravity) > 0 ? up.q + up.d < -fronts->far : up.q > fronts->far;
}

/* The last moment is one at which all fall at terminal speed, and a later one at which they are past, after a straight
 * way; without gravity it is the last. */
static bool settle(sp_wavefronts *fronts)
{
    size_t last = fronts->count - 1;
    double(*sum)[SP_FRONT_DATA] = fronts->sum + last * fronts->most, fall = fmin(sum[0][4], 0);
    for (unsigned n = 0; n < fronts->most; n++)
        sum[n][1] = sum[n][2] = sum[n][4] = sum[n][5] = 0;
    if (!(sp_length(fronts->gravity) > 0) || !(fall < 0))
        return true;
    sum[0][4] = fall;
    sp_drop_wavefront up = sp_wavefront_at_moment(fronts, last, fronts->terms[last], 0.5 * M_PI);
    double time = fmax(up.q + up.d + 2 * fronts->far, fronts->far) / -fall;
    if (!make_room(fronts))
        return false;
    sum = fronts->sum + last * fronts->most;
    memcpy(sum + fronts->most, sum, fronts->most * sizeof *sum);
    sum[fronts->most][3] += fall * time;
    fronts->terms[last + 1] = fronts->terms[last];
    fronts->rough[last + 1] = fronts->rough[last];
    fronts->time[last + 1] = fronts->time[last] + time;
    fronts->count++;
    return true;
}

static double first_step(const sp_wavefronts *fronts, const drops *drops)
{
    double change = 0;
    for (unsigned k = 0; k < drops->count; k++)
        change = fmax(change, sp_length(drops->now[k].acceleration));
    return change > 0 ? 0.1 * fronts->speed / change : fronts->far / fronts->speed;
}

/* False, with an error. */
static bool build(sp_wavefronts *fronts, unsigned order, sp_error *error)
{
    drops drops;
    double time = fronts->drag.delay;
    fronts->count = 0;
    set_off(fronts, &drops, order);
    bool done = !(time > 0) || fly_free(fronts, &drops);
    double step = first_step(fronts, &drops), made = step;
    done = done && record(fronts, &drops, time, step);
    while (done && !are_past(fronts)) {
        if (are_settled(fronts, &drops))
            return settle(fronts) || sp_fail_memory(error);
        if (fronts->count == MOMENTS_MOST)
            return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                           "trajectory: drag found with flights of more than %u steps; expected drops that come to "
                           "rest, or down, sooner",
                           MOMENTS_MOST);
        made = fly_on(fronts, &drops, &step);
        time += made;
        done = record(fronts, &drops, time, fmax(made, step));
    }
    return done || sp_fail_memory(error);
}

static bool is_resolved(const sp_wavefronts *fronts, unsigned order)
{
    for (size_t i = 0; i < fronts->count; i++)
        if (fronts->terms[i] > order - 2)
            return false;
    return true;
}

/* How far the ways from one time to another are from parabolas, as a share of how far they have come. */
static double misses(const sp_wavefronts *fronts, double from, double to)
{
    static const double shares[4] = {0, 0.5, 1, 0.25};
    double worst = 0;
    for (int k = -2; k <= 2; k++) {
        sp_vec3 place[4];
        double elevation = 0.75 * k, sine = sin(elevation), cosine = cos(elevation);
        for (int i = 0; i < 4; i++) {
            double time = from + shares[i] * (to - from);
            sp_drop_wavefront front =
                sp_wavefront_between(fronts, sp_wavefront_moment_before(fronts, time), time, elevation);
            place[i] = sp_v(front.q * cosine, 0, front.q * sine + front.d);
        }
        worst = fmax(worst, sp_parabola_misses(place, place[3]) / sp_length(place[3]));
    }
    return worst;
}

/* As far apart as their error allows: at moments, or where these are too far apart themselves between them. */
static bool find_joints(sp_wavefronts *fronts)
{
    double last = 0, *joints = fronts->joints = malloc(fronts->count * PARTS_MOST * sizeof *joints);
    if (!joints)
        return false;
    joints[fronts->joint_count++] = 0;
    for (size_t i = 1; i < fronts->count; i++) {
        double before = fronts->time[i - 1], now = fronts->time[i];
        if (now == before || !(misses(fronts, last, now) > JOINT))
            continue;
        if (before > last)
            joints[fronts->joint_count++] = last = before;
        double parts = fmin(fmax(ceil(cbrt(misses(fronts, before, now) / JOINT)), 1), PARTS_MOST - 1);
        for (int k = 1; k < parts; k++)
            joints[fronts->joint_count++] = last = before + k / parts * (now - before);
        assert(last < now && fronts->joint_count <= (i + 1) * PARTS_MOST);
    }
    return true;
}

/* From Chebyshev's sums, none of whose polynomials is beyond 1. */
static bool find_bounds(sp_wavefronts *fronts)
{
    fronts->bound = malloc(fronts->count * sizeof *fronts->bound);
    sp_wavefront_bound last = {0, 0};
    for (size_t i = 0; fronts->bound && i < fronts->count; i++) {
        const double(*sum)[SP_FRONT_DATA] = (const double(*)[SP_FRONT_DATA])fronts->sum + i * fronts->most;
        double q = sum[0][0], d = fabs(sum[0][3]);
        for (unsigned n = 1; n < fronts->most; n++) {
            q -= fabs(sum[n][0]);
            d += fabs(sum[n][3]);
        }
        last = (sp_wavefront_bound){fmax(last.out, q), fmax(last.sunk, d)};
        fronts->bound[i] = last;
    }
    return fronts->bound != NULL;
}

static bool make(sp_wavefronts *fronts, sp_error *error)
{
    for (unsigned order = ORDER_FIRST; order <= SP_FRONT_ORDER; order *= 2) {
        fronts->most = order;
        fronts->capacity = 0;
        if (!build(fronts, order, error))
            return false;
        if (is_resolved(fronts, order))
            break;
    }
    return (find_joints(fronts) && find_bounds(fronts)) || sp_fail_memory(error);
}

sp_wavefronts *sp_wavefronts_create(const sp_drag *drag, double speed, sp_vec3 gravity, double far, sp_error *error)
{
    if (!drag)
        return NULL;
    sp_wavefronts *fronts = calloc(1, sizeof *fronts);
    if (!fronts)
        return sp_fail_memory(error);
    *fronts = (sp_wavefronts){.drag = *drag, .speed = speed, .gravity = gravity, .far = far};
    fronts->up = sp_length(gravity) > 0 ? sp_scale(sp_unit(gravity), -1) : sp_v(0, 0, 1);
    if (make(fronts, error))
        return fronts;
    sp_wavefronts_destroy(fronts);
    return NULL;
}

void sp_wavefronts_destroy(sp_wavefronts *fronts)
{
    if (!fronts)
        return;
    free(fronts->time);
    free(fronts->terms);
    free(fronts->rough);
    free(fronts->sum);
    free(fronts->bound);
    free(fronts->joints);
    free(fronts);
}
