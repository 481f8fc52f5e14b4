/* What lines instead of parabolas may change, patch by patch: of each nozzle the least and the most flux that passes
 * the criterion, over all points of the patch and both trajectories. A patch that gets enough at the least is covered
 * by both, one that gets too little at the most by neither; all others count towards the bound.
 *
 * What the flights to a patch have in common is bounded from its middle, at r, and a radius about it that holds all of
 * it. Ways differ from r by at most asin(radius/d). Parabolas differ from ways as sp_line_deviation says where they
 * start, and by asin(g T sin ζ / 2w) where they end: there they fly along r + g T²/2, of length w T, with
 * w² = v² + 2 r·g no less than v² (1 - 2ε). Speeds, and b and D (see flight.c), follow from d and the height
 * alone, and T²√D = 2 d² / (1 + b/√D), for one d, falls as g d/b grows.
 *
 * High arcs leave within asin(h/(v T)) of the vertical, h being the level part of r, and arrive within asin(h/(w T)) of
 * it; T is no less than √(2b)/g. They have to leave outside of the pattern, to come too slantingly for the criterion,
 * or to end at a roof. */
#include <sprayplan/deviation.h>

#include "criterion.h"
#include "nozzle_bodies.h"
#include "emitter.h"
#include "near_patches.h"
#include "nozzle/pattern.h"
#include "shaft.h"
#include "watch.h"

#include <stdlib.h>
#include <string.h>

#define SLACK 1e-9      /* relative, and rad: beyond all round-off */
#define WATCHED 16      /* patches between two questions whether to go on */
#define ROUND_OFF 1e-12 /* of the geometry's size, lengths */
#define ROOF 2.0 /* times the height at which a line straight up meets something: what shall be sheltered by it */

/* f ε / 2, or a number above 1. */
static double half_turn(double eps)
{
    return eps < 0.5 ? 0.5 * eps * sqrt(2 / (1 - eps + sqrt(1 - 2 * eps))) : INFINITY;
}

double sp_line_deviation(sp_vec3 from, sp_vec3 to, double speed, sp_vec3 gravity)
{
    sp_vec3 way = sp_sub(to, from);
    double g = sp_length(gravity), distance = sp_length(way);
    if (g == 0 || distance == 0)
        return 0;
    double half = half_turn(g * distance / (speed * speed));
    return half < INFINITY ? asin(fmin(1, half * sp_length(sp_cross(way, gravity)) / (g * distance))) : INFINITY;
}

/* A pattern with its liquid flying either way. */
typedef struct {
    sp_emitter straight, falling;
    double flow;
    size_t body; /* the nozzle that it is part of */
    bool roofed; /* no high arc comes down anywhere */
} spraying;

typedef struct {
    sp_evaluator straight, falling; /* the same but for how liquid flies */
    sp_half_edges edges;
    sp_vec3 up;
    double g, round_off;
    size_t count;
    spraying *sprayings; /* [count] */
} bounding;

/* All of a patch, and what nozzles bring to it, m/s. */
typedef struct {
    size_t corner_count, corner_room, face_count, face_room;
    sp_vec3 *corners;
    sp_shaft_face *faces;
    double *least, *most;
    uint32_t triangle; /* while it is taken apart */
    bool failed, lost; /* for want of memory; in part, to round-off */
} workplace;

static void take_face(void *user, const sp_vec3 *polygon, int corners, double area)
{
    workplace *w = user;
    size_t end = w->corner_count + (size_t)corners;
    if (end > w->corner_room) {
        sp_vec3 *more = realloc(w->corners, 2 * end * sizeof *more);
        w->corners = more ? more : w->corners;
        w->corner_room = more ? 2 * end : w->corner_room;
    }
    if (w->face_count == w->face_room) {
        sp_shaft_face *more = realloc(w->faces, (2 * w->face_count + 8) * sizeof *more);
        w->faces = more ? more : w->faces;
        w->face_room = more ? 2 * w->face_count + 8 : w->face_room;
    }
    w->failed = w->failed || end > w->corner_room || w->face_count == w->face_room;
    w->lost = w->lost || (corners < 3 && area > 0);
    if (w->failed || corners < 3)
        return;
    memcpy(&w->corners[w->corner_count], polygon, (size_t)corners * sizeof *polygon);
    w->faces[w->face_count++] = (sp_shaft_face){.triangle = w->triangle, .first = w->corner_count, .end = end};
    w->corner_count = end;
}

/* Faces, with their normals towards the side that counts, and corners; the patch's own point is one of these. */
static bool take_apart(const bounding *b, uint32_t patch, workplace *w)
{
    const sp_evaluator *evaluator = &b->straight;
    const sp_fragments *fragments = &evaluator->fragments;
    uint32_t texel = evaluator->patches.texel[patch];
    bool back = evaluator->patches.side[patch] == SP_SIDE_BACK;
    w->corner_count = w->face_count = 0;
    w->lost = false;
    for (uint32_t f = fragments->start[texel]; f < fragments->start[texel + 1]; f++) {
        w->triangle = fragments->items[f].triangle;
        sp_counted_pieces(evaluator, texel, &fragments->items[f], back, take_face, w);
    }
    for (size_t i = 0; i < w->face_count; i++) {
        sp_vec3 normal = sp_triangle_normal(evaluator->setup.mesh, w->faces[i].triangle);
        w->faces[i].normal = back ? sp_scale(normal, -1) : normal;
    }
    return w->face_count > 0 && !w->lost && !w->failed;
}

static void enclose(const workplace *w, sp_shaft *shaft)
{
    sp_vec3 sum = sp_v(0, 0, 0);
    for (size_t i = 0; i < w->corner_count; i++)
        sum = sp_add(sum, w->corners[i]);
    shaft->corners = w->corners;
    shaft->corner_count = w->corner_count;
    shaft->faces = w->faces;
    shaft->face_count = w->face_count;
    shaft->middle = sp_scale(sum, 1 / (double)w->corner_count);
    shaft->radius = 0;
    for (size_t i = 0; i < w->corner_count; i++)
        shaft->radius = fmax(shaft->radius, sp_distance(w->corners[i], shaft->middle));
    shaft->radius *= 1 + SLACK;
}

/* What all flights from a nozzle to a patch lie within. Angles in rad. */
typedef struct {
    double eps, distance, radius, high, level; /* the last two: of the way to the middle, m */
    double spread, turn, landing;              /* of ways; of parabolas from theirs, at the start and at the end */
    double incidence_least, incidence_most;
    double b_least, b_most; /* m²/s² */
} flight_bounds;

/* False where there is none: the patch is too near, or too far. */
static bool flight_bounds_of(const bounding *b, const spraying *s, const workplace *w, sp_side side, sp_shaft *shaft,
                             flight_bounds *flights)
{
    double v = s->straight.source.speed, d = shaft->distance, radius = shaft->radius,
           eps = b->g * (d + radius) / (v * v);
    double half = half_turn(eps);
    if (!(d > 2 * radius && half < INFINITY))
        return false;
    double level = sp_length(sp_cross(shaft->way, b->up)), high = sp_dot(shaft->way, b->up);
    double sine = fmin(1, level / d + radius / d), time = 2 * half / eps * (d + radius) / v;
    shaft->rise = 0.5 * b->g * time * time * (1 + SLACK);
    *flights = (flight_bounds){.eps = eps, .distance = d, .radius = radius, .high = high, .level = level};
    flights->spread = asin(radius / d) + SLACK;
    flights->turn = asin(fmin(1, half * sine));
    flights->landing = asin(fmin(1, half * sine / sqrt(1 - 2 * eps)));
    flights->b_least = v * v - b->g * (high + radius);
    flights->b_most = v * v - b->g * (high - radius);
    flights->incidence_least = INFINITY;
    for (size_t i = 0; i < w->face_count; i++) {
        double cosine = -sp_dot(shaft->axis, w->faces[i].normal);
        cosine = side == SP_SIDE_BOTH ? fabs(cosine) : cosine;
        double incidence = acos(fmin(1, fmax(-1, cosine)));
        flights->incidence_least = fmin(flights->incidence_least, incidence);
        flights->incidence_most = fmax(flights->incidence_most, incidence);
    }
    flights->incidence_least -= flights->spread + flights->landing;
    flights->incidence_most += flights->spread + flights->landing;
    return true;
}

/* The share of the patch that the evaluator gives to a flight; -1 where the pattern holds its direction all the same.
 */
static double share_of(const sp_emitter *emitter, const sp_target *target, const sp_flight *flight)
{
    sp_arrival arrival = {.direction = flight->direction, .breadth = sp_flight_breadth(flight, target->length)};
    double share = sp_emitter_share(emitter, &arrival);
    return share > 0 || !sp_emitter_holds(emitter, flight->direction) ? share : -1;
}

/* The flux of the flights per flux of solid angle, at the least and at the most, 1/m²: lines, and low parabolas. */
static void transfer_of(const bounding *b, double v, const flight_bounds *flights, double *least, double *most)
{
    double near = flights->distance - flights->radius, far = flights->distance + flights->radius;
    double flat = cos(fmax(0, flights->incidence_least)), steep = cos(fmin(M_PI / 2, flights->incidence_most));
    double e_least = b->g * near / flights->b_most, e_most = b->g * far / flights->b_least;
    double w_least = sqrt(2 * flights->b_least - v * v), w_most = sqrt(2 * flights->b_most - v * v);
    double wide = 2 * v * far * far / (1 + 1 / sqrt(1 - e_least * e_least));
    double narrow = 2 * v * near * near / (1 + 1 / sqrt(1 - e_most * e_most));
    *least = steep * fmin(1 / (far * far), w_least / wide) * (1 - SLACK);
    *most = flat * fmax(1 / (near * near), w_most / narrow) * (1 + SLACK);
}

/* The least and the most of a nozzle's flow per solid angle, m³/s/sr, within `reach` (rad) of the way to the patch. Of
 * what rotates, where no flux is asked for, any is enough; what is measured may have gaps. */
static void flux_of(const spraying *s, sp_vec3 axis, double reach, double threshold, double flux[2])
{
    const sp_spray *spray = &s->straight.spray;
    flux[0] = flux[1] = s->flow / spray->solid_angle;
    if (sp_spray_is_uniform(spray))
        return;
    sp_vec3 z = s->straight.frame.z;
    double polar = atan2(sp_length(sp_cross(axis, z)), sp_dot(axis, z)), least, most;
    sp_spray_densities(spray, fmax(0, polar - reach), fmin(M_PI, polar + reach), &least, &most);
    if (threshold > 0 || sp_spray_has_gaps(spray))
        flux[0] = s->flow * least * (1 - SLACK);
    flux[1] = s->flow * most * (1 + SLACK);
}

/* Whether high arcs cannot bring anything that passes. */
static bool high_arcs_fail(const bounding *b, const spraying *s, const workplace *w, sp_side side,
                           const flight_bounds *flights, double share)
{
    double v = s->falling.source.speed, slow = sqrt(2 * flights->b_least - v * v);
    double lean = b->g * (flights->level + flights->radius) / sqrt(2 * flights->b_least);
    if (s->roofed || (share == 0 && lean < v && sp_emitter_margin(&s->falling, b->up) < -asin(lean / v) - SLACK))
        return true;
    if (!(lean < slow))
        return false;
    double most = fmin(M_PI / 2, s->falling.source.evaluator->setup.criterion.incidence) + asin(lean / slow) + SLACK;
    for (size_t i = 0; i < w->face_count; i++) {
        double cosine = sp_dot(b->up, w->faces[i].normal);
        if (acos(fmin(1, fmax(-1, side == SP_SIDE_BOTH ? fabs(cosine) : cosine))) <= most)
            return false;
    }
    return true;
}

/* What a nozzle brings if nothing is in the way. *high where high arcs may add to it. */
static void weigh(const bounding *b, const spraying *s, uint32_t patch, const workplace *w, sp_shaft *shaft,
                  double *least, double *most, bool *high)
{
    const sp_criterion *criterion = &b->straight.setup.criterion;
    sp_target target = sp_patch_target(&b->straight, patch);
    double v = s->straight.source.speed, slow, fast, share[3];
    sp_flight line[2], parabola[2];
    flight_bounds flights;
    *least = 0;
    *most = INFINITY;
    *high = true;
    if (!flight_bounds_of(b, s, w, target.side, shaft, &flights) || sp_target_is_near(&s->straight.source, &target) ||
        sp_target_is_near(&s->falling.source, &target) ||
        sp_flights(shaft->from, target.point, v, b->straight.gravity, line) != 1 ||
        sp_flights(shaft->from, target.point, v, b->falling.gravity, parabola) != 2)
        return;
    share[0] = share_of(&s->straight, &target, &line[0]);
    share[1] = share_of(&s->falling, &target, &parabola[0]);
    share[2] = share_of(&s->falling, &target, &parabola[1]);
    *high = !high_arcs_fail(b, s, w, target.side, &flights, share[2]);
    slow = fmin(v, sqrt(2 * flights.b_least - v * v)) * (1 - SLACK);
    fast = fmax(v, sqrt(2 * flights.b_most - v * v)) * (1 + SLACK);
    double margin = sp_emitter_margin(&s->straight, shaft->axis), reach = flights.spread + flights.turn;
    double limit = fmin(M_PI / 2, criterion->incidence);
    *most = 0;
    if (fast < criterion->impact_speed || flights.incidence_least > limit + SLACK ||
        (margin < -reach && share[0] == 0 && share[1] == 0))
        return;
    double transfer[2], flux[2];
    double broad = fmax(sp_flight_breadth(&line[0], target.length), sp_flight_breadth(&parabola[0], target.length));
    flux_of(s, shaft->axis, reach + sp_spray_fringe(broad), criterion->flux, flux);
    transfer_of(b, v, &flights, &transfer[0], &transfer[1]);
    *most = flux[1] * transfer[1];
    if (slow >= criterion->impact_speed && flights.incidence_most < limit - SLACK && margin > reach && share[0] == 1 &&
        share[1] == 1)
        *least = flux[0] * transfer[0];
}

static double combined(const bounding *b, const double *each)
{
    const sp_criterion *criterion = &b->straight.setup.criterion;
    double all = 0, own = 0; /* of the nozzle in hand */
    for (size_t n = 0; n < b->count; n++) {
        own += each[n];
        if (n + 1 < b->count && b->sprayings[n + 1].body == b->sprayings[n].body)
            continue;
        all = sp_combined(criterion, all, own);
        own = 0;
    }
    return all;
}

static bool is_enough(const bounding *b, const double *least)
{
    double all = combined(b, least) * (1 - SLACK);
    return sp_flux_suffices(all, b->straight.setup.criterion.flux);
}

static bool is_too_little(const bounding *b, const double *most)
{
    double all = combined(b, most) * (1 + SLACK);
    return !sp_flux_suffices(all, b->straight.setup.criterion.flux);
}

/* The flights from a nozzle to the patch that is taken apart. */
static sp_shaft shaft_to(const bounding *b, const spraying *s, const workplace *w)
{
    sp_shaft shaft = {.tracer = b->straight.tracer,
                      .edges = &b->edges,
                      .from = s->straight.source.position,
                      .up = b->up,
                      .round_off = b->round_off};
    enclose(w, &shaft);
    sp_shaft_open(&shaft);
    return shaft;
}

/* Whether it is proved that lines and parabolas cover all of a patch, or none. What is in the way is asked last, and
 * only as far as it may tell. */
static bool is_decided(const bounding *b, uint32_t patch, workplace *w)
{
    if (!take_apart(b, patch, w))
        return false;
    double threshold = b->straight.setup.criterion.flux;
    memset(w->least, 0, b->count * sizeof *w->least);
    bool open = true;
    for (size_t n = 0; n < b->count; n++) {
        sp_shaft shaft = shaft_to(b, &b->sprayings[n], w);
        bool high;
        double least;
        weigh(b, &b->sprayings[n], patch, w, &shaft, &least, &w->most[n], &high);
        /* the evaluator lets what is enough alone stand for all that comes from one nozzle */
        if (least > 0 && (!high || least >= threshold) && sp_shaft_is_free(&shaft))
            w->least[n] = least;
        else if (w->most[n] > 0 && w->most[n] < INFINITY && sp_shaft_is_blocked(&shaft))
            w->most[n] = 0;
        w->most[n] = high ? INFINITY : w->most[n];
        open = open && !is_enough(b, w->least);
        if (!open)
            return true;
    }
    return is_too_little(b, w->most);
}

/* Whether the liquid that leaves a nozzle nearly straight up, as all high arcs do, meets something above it. It comes
 * through a disc at some height, as far out as what leans most has come then; and there it is still on its low arc. */
static bool is_roofed(const bounding *b, const spraying *s)
{
    const sp_patches *patches = &b->straight.patches;
    sp_vec3 from = s->falling.source.position, corners[8];
    double v = s->falling.source.speed, lean = 0;
    for (size_t i = 0; i < patches->count; i++) {
        sp_vec3 way = sp_sub(patches->point[i], from);
        double reach = sp_length(way) + 2 * patches->length[i],
               square = v * v - b->g * (sp_dot(way, b->up) + 2 * patches->length[i]);
        double level = sp_length(sp_cross(way, b->up)) + 2 * patches->length[i];
        if (b->g * reach < 0.5 * v * v)
            lean = fmax(lean, b->g * level / (v * sqrt(2 * square)));
    }
    sp_ray line = {.origin = from, .velocity = b->up, .t_max = INFINITY, .skip = SP_NONE};
    double height = ROOF * sp_trace_nearest(b->straight.tracer, &line, sp_v(0, 0, 0)).t;
    double rising = v * v * (1 - lean * lean) - 2 * b->g * height;
    if (!(lean < 1 && rising > 0))
        return false;
    double time = 2 * height / (v * sqrt(1 - lean * lean) + sqrt(rising));
    sp_shaft shaft = {.tracer = b->straight.tracer,
                      .edges = &b->edges,
                      .from = from,
                      .up = b->up,
                      .middle = sp_along(from, height, b->up),
                      .radius = v * lean * time * (1 + SLACK),
                      .corners = corners,
                      .corner_count = 8,
                      .round_off = b->round_off};
    double half = half_turn(b->g * (height + shaft.radius) / (v * v));
    double duration = 2 * half / (b->g * (height + shaft.radius) / (v * v)) * (height + shaft.radius) / v;
    shaft.rise = 0.5 * b->g * duration * duration * (1 + SLACK);
    for (int i = 0; i < 8; i++)
        corners[i] = sp_add(shaft.middle, sp_scale(sp_v(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1), shaft.radius));
    sp_shaft_open(&shaft);
    return half < INFINITY && sp_shaft_is_blocked(&shaft);
}

static bool bounding_create(bounding *b, const sp_evaluator *evaluator, const sp_bodies *bodies, sp_error *error)
{
    const sp_mesh *mesh = evaluator->setup.mesh;
    sp_vec3 gravity = sp_gravity_for(&evaluator->setup, SP_TRAJECTORY_PARABOLA);
    *b = (bounding){.straight = *evaluator, .falling = *evaluator, .g = sp_length(gravity), .up = evaluator->setup.up};
    b->straight.gravity = sp_v(0, 0, 0);
    b->falling.gravity = gravity;
    b->round_off = ROUND_OFF * (sp_length(evaluator->low) + sp_length(evaluator->high));
    b->sprayings = calloc(bodies->patterns->count + 1, sizeof *b->sprayings);
    if (!b->sprayings)
        return sp_fail_memory(error);
    if (!sp_half_edges_create(mesh, &b->edges, error))
        return false;
    for (size_t i = 0, body = 0; i < bodies->patterns->count; i++) {
        const sp_nozzle *pattern = &bodies->patterns->nozzles[i];
        spraying *s = &b->sprayings[b->count];
        body += i == bodies->first[body + 1];
        s->body = body;
        s->flow = sp_nozzle_flow(pattern, &evaluator->setup.liquid);
        s->straight = sp_emitter_of(&b->straight, pattern, NULL);
        s->falling = sp_emitter_of(&b->falling, pattern, NULL);
        s->roofed = s->flow > 0 && is_roofed(b, s);
        b->count += s->flow > 0;
    }
    return true;
}

static void bounding_free(bounding *b)
{
    sp_half_edges_destroy(&b->edges);
    free(b->sprayings);
}

/* Marks what is decided. */
static bool decide(const bounding *b, bool *decided, sp_error *error)
{
    bool done = true;
    sp_watch watch = sp_watch_start(&b->straight, "bound on lines", b->straight.patches.count);
    int threads = omp_in_parallel() ? 1 : sp_thread_count(b->straight.setup.run.threads);
#pragma omp parallel num_threads(threads) reduction(&& : done)
    {
        workplace w = {.least = malloc((b->count + 1) * sizeof(double)),
                       .most = malloc((b->count + 1) * sizeof(double))};
        done = w.least && w.most;
#pragma omp for schedule(dynamic, 256)
        for (size_t i = 0; i < b->straight.patches.count; i++) {
            if (i % WATCHED == 0 && !sp_watch_goes_on(&watch, WATCHED))
                done = false;
            if (done)
                decided[i] = is_decided(b, (uint32_t)i, &w);
        }
        done = done && !w.failed;
        free(w.corners);
        free(w.faces);
        free(w.least);
        free(w.most);
    }
    return done ? sp_watch_end(&watch, error) : (bool)sp_watch_fail(&watch, error);
}

/* What has a trajectory of its own does not change with the simulation's; how it lies between lines and parabolas is
 * not reckoned. */
static bool is_own(const sp_layout *patterns)
{
    for (size_t i = 0; i < patterns->count; i++)
        if (patterns->nozzles[i].type->trajectory != SP_TRAJECTORY_AUTO)
            return true;
    return false;
}

bool sp_bound_lines(const sp_evaluator *evaluator, const sp_layout *layout, double *bound, bool *decided,
                    sp_error *error)
{
    if (!evaluator || !layout)
        return false;
    const sp_patches *patches = &evaluator->patches;
    bounding b = {0};
    sp_bodies bodies;
    bool *marks = malloc(patches->count + 1);
    bool done = sp_bodies_create(evaluator, layout, &bodies, error) && (marks || sp_fail_memory(error));
    if (done)
        memset(marks, evaluator->setup.gravity == 0, patches->count);
    if (done && evaluator->setup.gravity > 0 && !evaluator->movers && !is_own(bodies.patterns)) {
        done = bounding_create(&b, evaluator, &bodies, error) && decide(&b, marks, error);
        bounding_free(&b);
    }
    sp_bodies_free(&bodies);
    double undecided = 0;
    for (size_t i = 0; done && i < patches->count; i++)
        undecided += marks[i] ? 0 : patches->area[i];
    if (done && decided)
        memcpy(decided, marks, patches->count);
    *bound = undecided > 0 ? fmin(1, undecided / patches->total_area) : 0;
    free(marks);
    return done;
}
