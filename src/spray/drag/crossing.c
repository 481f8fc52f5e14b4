/* When the front crosses a point: it comes once, on its way out, and once more as it sinks past.
 *
 * At a time the end lies in the direction e = (cos θ, sin θ) from the front's middle d, which says what is on the front
 * there, and by `outside` beyond it: P = (q + outside) e + d (0, 1). As time goes by `outside` falls to a least value
 * and rises again, and flights arrive where it is 0. With w the derivative of P by θ at a given `outside`, n across it
 * and v the velocity of what arrives, its derivative by time is -n·v / n·e, and by P, n / n·e. */
#include "wavefronts.h"

#define ROUNDS 60
#define TURNS 12
#define LINEAR 1e-6 /* rad: closer, what follows from an elevation is told by its slope */
#define ROUGH 1e-3  /* the same, to tell between which moments something is */
#define WIDER 0.01  /* of the time between moments, by which they may be told wrongly so */
#define BEYOND 3
#define DONE 1e-13
#define ROUND_OFF 4e-16

/* An end in the upright plane through the start. */
typedef struct {
    const sp_wavefronts *fronts;
    double forward, up;
} end;

/* The front as an end sees it. */
typedef struct {
    sp_drop_wavefront front;
    double elevation, sine, cosine; /* that lead there, rad */
    double outside;                 /* m */
    double approach;                /* its derivative by time, m/s */
    sp_vec3 across;                 /* n of length 1, outwards; x forwards, z upwards */
    double area;                    /* m²/s: |v x w| */
} view;

/* Where to look: at a time after moment i or, roughly, at that moment. */
typedef struct {
    size_t i;
    double time; /* s */
    bool roughly;
} glance;

static sp_drop_wavefront front_of(const sp_wavefronts *fronts, const glance *at, double elevation)
{
    return at->roughly ? sp_wavefront_at_moment(fronts, at->i, fronts->rough[at->i], elevation)
                       : sp_wavefront_between(fronts, at->i, at->time, elevation);
}

/* The elevation that leads to the end, by Newton, and the front there. */
static void face(const end *end, const glance *at, view *view)
{
    double linear = at->roughly ? ROUGH : LINEAR;
    sp_drop_wavefront *front = &view->front;
    for (int round = 0; round < TURNS; round++) {
        *front = front_of(end->fronts, at, view->elevation);
        double rise = end->up - front->d,
               slope = 1 + front->d_turn * end->forward / (rise * rise + end->forward * end->forward);
        double turn = atan2(rise, end->forward) - view->elevation;
        turn = slope > 0.1 ? turn / slope : turn;
        turn = fmin(fmax(turn, -0.5 * M_PI - view->elevation), 0.5 * M_PI - view->elevation);
        view->elevation += turn;
        if (fabs(turn) > linear)
            continue;
        front->q += turn * front->q_turn;
        front->d += turn * front->d_turn;
        return;
    }
}

static view view_by(const end *end, const glance *at, double elevation)
{
    view view = {.elevation = elevation};
    face(end, at, &view);
    const sp_drop_wavefront *front = &view.front;
    double rise = end->up - front->d, way = hypot(end->forward, rise);
    view.outside = way - front->q;
    view.cosine = way > 0 ? end->forward / way : cos(view.elevation);
    view.sine = way > 0 ? rise / way : sin(view.elevation);
    sp_vec3 along = sp_v(front->q_turn * view.cosine - way * view.sine, 0,
                         front->q_turn * view.sine + way * view.cosine + front->d_turn);
    sp_vec3 velocity = sp_v(front->q_time * view.cosine, 0, front->q_time * view.sine + front->d_time);
    view.across = sp_unit(sp_v(along.z, 0, -along.x));
    double facing = view.across.x * view.cosine + view.across.z * view.sine;
    view.approach = -sp_dot(view.across, velocity) / facing;
    view.area = fabs(along.z * velocity.x - along.x * velocity.z);
    return view;
}

static view view_of(const end *end, size_t i, double time, double elevation)
{
    return view_by(end, &(glance){i, time, false}, elevation);
}

static view view_at(const end *end, size_t i, double elevation)
{
    return view_by(end, &(glance){i, end->fronts->time[i], true}, elevation);
}

/* A part of the table, the elevation to start from, and how far outside the end is at either moment, where it is known.
 */
typedef struct {
    size_t low, high;         /* moments */
    double elevation;         /* rad */
    double low_out, high_out; /* m, or NAN */
    double inside;            /* m, as far as it was seen to be at some moment */
} span;

static span whole(const end *end)
{
    return (span){0, end->fronts->count - 1, atan2(end->up, end->forward), hypot(end->forward, end->up), NAN, 0};
}

/* The first moment at which the front is about as wide as the end is far: low flights arrive near it. */
static size_t first_guess(const end *end)
{
    const sp_wavefronts *fronts = end->fronts;
    double way = hypot(end->forward, end->up);
    size_t low = 0, high = fronts->count - 1;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        *(fronts->sum[middle * fronts->most][0] < way ? &low : &high) = middle;
    }
    return high;
}

static view look(const end *end, size_t i, span *span)
{
    view view = view_at(end, i, span->elevation);
    span->elevation = view.elevation;
    span->inside = fmax(span->inside, -view.outside);
    return view;
}

/* Halves, at first at the guess, until the end is inside at one of both moments, or they are neighbours; true where
 * inside, at `low` then. */
static bool find_inside(const end *end, span *span)
{
    size_t middle = first_guess(end);
    for (; span->high - span->low > 1; middle = (span->low + span->high) / 2) {
        if (middle <= span->low || middle >= span->high)
            continue;
        view view = look(end, middle, span);
        if (view.outside < 0) {
            span->low = middle;
            span->low_out = view.outside;
            return true;
        }
        *(view.approach < 0 ? &span->low : &span->high) = middle;
        *(view.approach < 0 ? &span->low_out : &span->high_out) = view.outside;
    }
    return false;
}

/* Of neighbours, the end inside at just one of both moments, as it is at the start: halves or, as long as the last is
 * inside only, goes back from there in strides. */
static void find_crossing(const end *end, bool low_inside, span *span)
{
    for (size_t stride = low_inside ? SIZE_MAX : 1; span->high - span->low > 1;) {
        size_t gap = span->high - span->low, probe = span->low + gap / 2;
        probe = stride < gap / 2 ? span->high - stride : probe;
        stride = stride > gap ? stride : 2 * stride;
        view view = look(end, probe, span);
        bool low = (view.outside < 0) == low_inside;
        *(low ? &span->low : &span->high) = probe;
        *(low ? &span->low_out : &span->high_out) = view.outside;
        stride = low ? SIZE_MAX : stride;
    }
}

/* Where between its moments an end that is on the front there is so, about. */
static double interpolate(const end *end, const span *span)
{
    double low = end->fronts->time[span->low], high = end->fronts->time[span->high];
    double share = span->low_out / (span->low_out - span->high_out);
    return low + (share > 0 && share < 1 ? share : 0.5) * (high - low);
}

/* Between two times after moment i the end is on the front once, on the way in or out. */
typedef struct {
    size_t i;
    double low, start, high; /* s */
    bool low_inside;
    double elevation; /* rad */
} crossing;

/* By Newton, kept in between until the very end. */
static view cross(const end *end, const crossing *at, double *time)
{
    size_t i = at->i;
    double low = at->low, high = at->high, t = at->start, beyond = WIDER * (high - low), elevation = at->elevation;
    view view = {0};
    for (int round = 0; round < ROUNDS; round++) {
        view = view_of(end, i, t, elevation);
        elevation = view.elevation;
        if ((view.outside < 0) == at->low_inside)
            low = t;
        else
            high = t;
        double next = t - view.outside / view.approach;
        if (!(next > low && next < high))
            next = fabs(view.outside) <= ROUND_OFF * view.front.q ? t : 0.5 * (low + high);
        if (fabs(next - t) <= ROUND_OFF * t)
            break;
        t = next;
    }
    for (int round = 0; round < BEYOND && fabs(view.outside) > DONE * view.front.q; round++) {
        double step = -view.outside / view.approach;
        if (!(fabs(step) <= beyond))
            break;
        t += step;
        view = view_of(end, i, t, elevation);
    }
    *time = t;
    return view;
}

/* The time between moments i and i + 1 at which `outside` is least, where its derivative changes its sign. */
static double find_least(const end *end, size_t i, double *elevation)
{
    double low = end->fronts->time[i], high = end->fronts->time[i + 1];
    double falls = view_of(end, i, low, *elevation).approach, rises = view_of(end, i, high, *elevation).approach,
           time = low;
    for (int round = 0; round < ROUNDS && high - low > ROUND_OFF * high; round++) {
        time = round % 3 == 2 ? 0.5 * (low + high) : low + (high - low) * falls / (falls - rises);
        view view = view_of(end, i, time, *elevation);
        *elevation = view.elevation;
        if (fabs(view.approach) <= 1e-12 * (fabs(falls) + fabs(rises)))
            break;
        if (view.approach < 0) {
            low = time;
            falls = view.approach;
        } else {
            high = time;
            rises = view.approach;
        }
    }
    return time;
}

/* How an end is reached. */
typedef struct {
    bool reached, left; /* from some time on, until another */
    crossing in, out;
    double margin; /* m, that it is inside at some time at least */
} passage;

static crossing crossing_of(const end *end, const span *span, bool low_inside)
{
    const double *time = end->fronts->time;
    return (crossing){span->low,        time[span->low], interpolate(end, span),
                      time[span->high], low_inside,      span->elevation};
}

/* Inside between two neighbouring moments at most. */
static passage pass_between(const end *end, const span *inner)
{
    const double *time = end->fronts->time;
    double from = time[inner->low], to = time[inner->high], elevation = inner->elevation;
    passage own = {.left = true};
    if (from == to)
        return own;
    double middle = find_least(end, inner->low, &elevation);
    own.margin = -view_of(end, inner->low, middle, elevation).outside;
    own.reached = own.margin > 0;
    own.in = (crossing){inner->low, from, 0.5 * (from + middle), middle, false, elevation};
    own.out = (crossing){inner->low, middle, 0.5 * (middle + to), to, true, elevation};
    return own;
}

/* With gravity what is reached is left again; without it, it is reached where it is in the end. */
static passage passage_at(const end *end)
{
    const sp_wavefronts *fronts = end->fronts;
    span inner = whole(end);
    bool found = find_inside(end, &inner), falls = sp_length(fronts->gravity) > 0;
    if (!found && !falls) {
        inner.low = fronts->count - 1;
        inner.low_out = look(end, inner.low, &inner).outside;
        found = inner.low_out < 0;
    }
    if (!found)
        return falls ? pass_between(end, &inner) : (passage){0};
    span before = whole(end), after = inner;
    before.high = inner.low;
    before.high_out = inner.low_out;
    before.elevation = inner.elevation;
    after.high = fronts->count - 1;
    after.high_out = NAN;
    find_crossing(end, false, &before);
    if (falls)
        find_crossing(end, true, &after);
    double margin = falls ? fmax(before.inside, after.inside) : INFINITY;
    return (passage){true, falls, crossing_of(end, &before, false), crossing_of(end, &after, true), margin};
}

/* The world about a flight. */
typedef struct {
    end end;
    sp_vec3 forward; /* unit; any that is level straight up and down */
} plane;

static plane plane_to(const sp_wavefronts *fronts, sp_vec3 from, sp_vec3 to)
{
    sp_vec3 way = sp_sub(to, from), level = sp_sub(way, sp_scale(fronts->up, sp_dot(way, fronts->up)));
    sp_vec3 other = fabs(fronts->up.x) < 0.6 ? sp_v(1, 0, 0) : sp_v(0, 1, 0);
    double forward = sp_length(level);
    sp_vec3 ahead = forward > 0 ? sp_scale(level, 1 / forward) : sp_unit(sp_cross(fronts->up, other));
    return (plane){{fronts, forward, sp_dot(way, fronts->up)}, ahead};
}

static sp_vec3 outwards(const plane *plane, double forward, double up)
{
    return sp_along(sp_scale(plane->forward, forward), up, plane->end.fronts->up);
}

static sp_flight flight_of(const plane *plane, const view *view, double time)
{
    const sp_drop_wavefront *front = &view->front;
    return (sp_flight){.direction = sp_unit(outwards(plane, view->cosine, view->sine)),
                       .velocity =
                           outwards(plane, front->q_time * view->cosine, front->q_time * view->sine + front->d_time),
                       .time = time,
                       .spread = front->q * view->area,
                       .lever = front->q};
}

int sp_wavefronts_reach(const sp_wavefronts *fronts, sp_vec3 from, sp_vec3 to, sp_flight flights[2], double *margin)
{
    plane plane = plane_to(fronts, from, to);
    *margin = 0;
    if (!(sp_distance(from, to) > 0 && fronts->speed > 0))
        return 0;
    passage own = passage_at(&plane.end);
    int count = 0;
    double time;
    *margin = own.margin;
    if (!own.reached)
        return 0;
    view view = cross(&plane.end, &own.in, &time);
    flights[count] = flight_of(&plane, &view, time);
    count += flights[count].spread > 0;
    if (!own.left || !count)
        return count;
    view = cross(&plane.end, &own.out, &time);
    flights[count] = flight_of(&plane, &view, time);
    return count + (flights[count].spread > 0);
}

int sp_wavefronts_flights(const sp_wavefronts *fronts, sp_vec3 from, sp_vec3 to, sp_flight flights[2])
{
    double margin;
    return sp_wavefronts_reach(fronts, from, to, flights, &margin);
}

bool sp_wavefronts_limit(const sp_wavefronts *fronts, sp_vec3 from, sp_vec3 to, sp_wavefront_limit *limit)
{
    plane plane = plane_to(fronts, from, to);
    const end *end = &plane.end;
    if (!(sp_length(fronts->gravity) > 0) || !(sp_distance(from, to) > 0))
        return false;
    span span = whole(end);
    while (span.high - span.low > 1) {
        size_t middle = (span.low + span.high) / 2;
        *(look(end, middle, &span).approach < 0 ? &span.low : &span.high) = middle;
    }
    double time = find_least(end, span.low, &span.elevation);
    double step = 1e-3 * fmin(time - fronts->time[span.low], fronts->time[span.high] - time);
    view view = view_of(end, span.low, time, span.elevation);
    double later = view_of(end, span.low, time + step, span.elevation).approach;
    double sooner = view_of(end, span.low, time - step, span.elevation).approach;
    double facing = view.across.x * view.cosine + view.across.z * view.sine;
    *limit = (sp_wavefront_limit){
        .margin = -view.outside,
        .slope = sp_scale(outwards(&plane, view.across.x, view.across.z), -1 / facing),
        .lever = view.front.q,
        .arriving = hypot(view.front.q_time * view.cosine, view.front.q_time * view.sine + view.front.d_time),
        .turn = step > 0 ? facing * view.front.q * sqrt(fmax(0, later - sooner) / step) : 0};
    return true;
}
