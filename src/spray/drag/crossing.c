/* When the front crosses a point: it comes once, on its way out, and once more as it sinks past.
 *
 * At a time the end lies in the direction e = (cos θ, sin θ) from the front's middle d, which says what is on the front
 * there, and by `outside` beyond it: P = (q + outside) e + d (0, 1). As time goes by `outside` falls to a least value
 * and rises again, and flights arrive where it is 0. With w the derivative of P by θ at a given `outside`, n across it
 * and v the velocity of what arrives, its derivative by time is -n·v / n·e, and by P, n / n·e. */
#include "fronts.h"

#define ROUNDS 60
#define TURNS 12
#define LINEAR 1e-8 /* rad: closer, what follows from an elevation is told by its slope */
#define ROUGH 1e-3  /* the same, to tell between which moments something is */
#define WIDER 0.01  /* of the time between moments, by which they may be told wrongly so */
#define BEYOND 3
#define DONE 1e-13
#define ROUND_OFF 4e-16

/* An end in the upright plane through the start. */
typedef struct {
    const sp_fronts *fronts;
    double forward, up;
} end;

/* The front as an end sees it. */
typedef struct {
    sp_front front;
    double elevation, sine, cosine; /* that lead there, rad */
    double outside;                 /* m */
    double approach;                /* its derivative by time, m/s */
    sp_vec3 across;                 /* n of length 1, outwards; x forwards, z upwards */
    double area;                    /* m²/s: |v x w| */
} view;

/* Of moment i, or at a time after it. */
static sp_front front_of(const sp_fronts *fronts, size_t i, double time, double elevation)
{
    return time == fronts->time[i] ? sp_front_at_moment(fronts, i, elevation)
                                   : sp_front_between(fronts, i, time, elevation);
}

/* The elevation that leads to the end, by Newton, and the front there. */
static void face(const end *end, size_t i, double time, double linear, view *view)
{
    sp_front *front = &view->front;
    for (int round = 0; round < TURNS; round++) {
        *front = front_of(end->fronts, i, time, view->elevation);
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

static view view_by(const end *end, size_t i, double time, double elevation, double linear)
{
    view view = {.elevation = elevation};
    face(end, i, time, linear, &view);
    const sp_front *front = &view.front;
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

/* At a time after moment i. */
static view view_of(const end *end, size_t i, double time, double elevation)
{
    return view_by(end, i, time, elevation, LINEAR);
}

/* Roughly, at a moment. */
static view view_at(const end *end, size_t i, double elevation)
{
    return view_by(end, i, end->fronts->time[i], elevation, ROUGH);
}

/* A part of the table, and the elevation to start from. */
typedef struct {
    size_t low, high; /* moments */
    double elevation; /* rad */
} span;

/* Halves until the end is inside at one of both moments, or they are neighbours; true where inside, at `low` then. */
static bool find_inside(const end *end, span *span)
{
    while (span->high - span->low > 1) {
        size_t middle = (span->low + span->high) / 2;
        view view = view_at(end, middle, span->elevation);
        span->elevation = view.elevation;
        if (view.outside < 0) {
            span->low = middle;
            return true;
        }
        if (view.approach < 0)
            span->low = middle;
        else
            span->high = middle;
    }
    return false;
}

/* Halves until they are neighbours, the end inside at just one of both moments, as it is at the start. */
static void find_crossing(const end *end, bool low_inside, span *span)
{
    while (span->high - span->low > 1) {
        size_t middle = (span->low + span->high) / 2;
        view view = view_at(end, middle, span->elevation);
        span->elevation = view.elevation;
        if ((view.outside < 0) == low_inside)
            span->low = middle;
        else
            span->high = middle;
    }
}

/* Where the end is on the front, between two times after moment i: Newton, kept in between until the very end. */
static view cross(const end *end, size_t i, double low, double high, bool low_inside, double elevation, double *time)
{
    double t = 0.5 * (low + high), beyond = WIDER * (high - low);
    view view = {0};
    for (int round = 0; round < ROUNDS; round++) {
        view = view_of(end, i, t, elevation);
        elevation = view.elevation;
        if ((view.outside < 0) == low_inside)
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
    double falls = view_of(end, i, low, *elevation).approach, rises = view_of(end, i + 1, high, *elevation).approach,
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

/* How an end is reached: between which times it is inside, and which moments lie before them. */
typedef struct {
    bool reached, left; /* from some time on, until another */
    size_t in, out;
    double in_from, in_to, out_from, out_to; /* s */
    double elevation;                        /* rad */
} passage;

static passage passage_at(const end *end)
{
    const sp_fronts *fronts = end->fronts;
    const double *time = fronts->time;
    span inner = {0, fronts->count - 1, atan2(end->up, end->forward)}, before, after;
    passage own = {.in_to = 0};
    bool found = find_inside(end, &inner);
    double middle = time[inner.low];
    view last = view_at(end, fronts->count - 1, inner.elevation);
    own.left = !(last.outside < 0);
    own.elevation = inner.elevation;
    if (!found && !own.left) {
        inner.low = fronts->count - 1; /* without gravity it stays inside */
        found = true;
    }
    if (!found) {
        if (time[inner.low] == time[inner.high])
            return own;
        middle = find_least(end, inner.low, &own.elevation);
        own.reached = view_of(end, inner.low, middle, own.elevation).outside < 0;
        before = after = inner;
    } else {
        own.reached = true;
        before = (span){0, inner.low, own.elevation};
        after = (span){inner.low, fronts->count - 1, own.elevation};
        find_crossing(end, false, &before);
        if (own.left)
            find_crossing(end, true, &after);
        middle = time[inner.low];
    }
    own.in = before.low;
    own.out = after.low;
    own.in_from = time[before.low];
    own.in_to = found ? time[before.high] : middle;
    own.out_from = found ? time[after.low] : middle;
    own.out_to = time[after.high];
    return own;
}

/* The world about a flight. */
typedef struct {
    end end;
    sp_vec3 forward; /* unit; any that is level straight up and down */
} plane;

static plane plane_to(const sp_fronts *fronts, sp_vec3 from, sp_vec3 to)
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
    const sp_front *front = &view->front;
    return (sp_flight){.direction = sp_unit(outwards(plane, view->cosine, view->sine)),
                       .velocity =
                           outwards(plane, front->q_time * view->cosine, front->q_time * view->sine + front->d_time),
                       .time = time,
                       .spread = front->q * view->area,
                       .lever = front->q};
}

int sp_fronts_flights(const sp_fronts *fronts, sp_vec3 from, sp_vec3 to, sp_flight flights[2])
{
    plane plane = plane_to(fronts, from, to);
    if (!(sp_distance(from, to) > 0 && fronts->speed > 0))
        return 0;
    passage own = passage_at(&plane.end);
    int count = 0;
    double time;
    if (!own.reached)
        return 0;
    view view = cross(&plane.end, own.in, own.in_from, own.in_to, false, own.elevation, &time);
    flights[count] = flight_of(&plane, &view, time);
    count += flights[count].spread > 0;
    if (!own.left || !count)
        return count;
    view = cross(&plane.end, own.out, own.out_from, own.out_to, true, own.elevation, &time);
    flights[count] = flight_of(&plane, &view, time);
    return count + (flights[count].spread > 0);
}

double sp_fronts_margin_least(const sp_fronts *fronts, sp_vec3 from, sp_vec3 to)
{
    plane plane = plane_to(fronts, from, to);
    const end *end = &plane.end;
    span span = {0, fronts->count - 1, atan2(end->up, end->forward)};
    if (!(sp_length(fronts->gravity) > 0))
        return INFINITY;
    return find_inside(end, &span) ? -view_at(end, span.low, span.elevation).outside : -INFINITY;
}

bool sp_fronts_limit(const sp_fronts *fronts, sp_vec3 from, sp_vec3 to, sp_front_limit *limit)
{
    plane plane = plane_to(fronts, from, to);
    const end *end = &plane.end;
    if (!(sp_length(fronts->gravity) > 0) || !(sp_distance(from, to) > 0))
        return false;
    span span = {0, fronts->count - 1, atan2(end->up, end->forward)};
    while (span.high - span.low > 1) {
        size_t middle = (span.low + span.high) / 2;
        view view = view_of(end, middle, fronts->time[middle], span.elevation);
        span.elevation = view.elevation;
        *(view.approach < 0 ? &span.low : &span.high) = middle;
    }
    double time = find_least(end, span.low, &span.elevation);
    double step = 1e-3 * fmin(time - fronts->time[span.low], fronts->time[span.high] - time);
    view view = view_of(end, span.low, time, span.elevation);
    double later = view_of(end, span.low, time + step, span.elevation).approach;
    double sooner = view_of(end, span.low, time - step, span.elevation).approach;
    double facing = view.across.x * view.cosine + view.across.z * view.sine;
    *limit = (sp_front_limit){
        .margin = -view.outside,
        .slope = sp_scale(outwards(&plane, view.across.x, view.across.z), -1 / facing),
        .lever = view.front.q,
        .arriving = hypot(view.front.q_time * view.cosine, view.front.q_time * view.sine + view.front.d_time),
        .turn = step > 0 ? facing * view.front.q * sqrt(fmax(0, later - sooner) / step) : 0};
    return true;
}
