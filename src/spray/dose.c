#include "dose.h"

#include "sure_miss.h"
#include "movers.h"

#define FINE 4      /* steps of a texel, where spray reaches the point */
#define HALVINGS 8u /* of one of these, to where spray or shadow begins or ends */

/* A point on its pass. */
typedef struct {
    const sp_emitter *emitter;
    double flow; /* m³/s */
    sp_target target;
    bool moves;  /* the point does; else goods pass it */
    double step; /* of the pass, between two positions of the evaluator */
} passing_point;

/* What is seen at a share of the pass: by bits 1, 2, 4, 8 of either arc whether it is there, in the spray, arrives as
 * the criterion asks, and is free. */
typedef struct {
    double at;
    unsigned state;
    double flux;   /* m³/s per m² */
    double margin; /* rad, 0 or less, of the arc outside the spray that is nearest to it; -INFINITY: there is none */
    sp_vec3 direction; /* its */
} glance;

enum { THERE = 1, HELD = 2, PASSES = 4, FREE = 8, ARC = 4 };

/* The way as it is looked along. */
typedef struct {
    const sp_evaluator *evaluator;
    sp_vec3 offset, back; /* m: of the goods, and of the point */
} looking;

static bool meets(void *user, const sp_ray *piece, sp_vec3 acceleration)
{
    const looking *l = user;
    sp_ray ray = *piece;
    ray.origin = sp_add(ray.origin, l->back);
    return sp_movers_occlude(l->evaluator, SP_STANDING, &ray, acceleration, sp_v(0, 0, 0)) ||
           sp_movers_occlude(l->evaluator, SP_MOVING, &ray, acceleration, l->offset);
}

static glance look(const passing_point *p, double at)
{
    const sp_emitter *emitter = p->emitter;
    sp_source source = emitter->source;
    looking looking = {.evaluator = source.evaluator, .offset = sp_pass_offset(source.evaluator, at)};
    if (p->moves)
        looking.back = looking.offset;
    source.position = sp_sub(source.position, looking.back);
    glance seen = {.at = at, .margin = -INFINITY};
    sp_flight ways[2];
    int count = sp_source_flights(&source, p->target.point, ways);
    for (int k = 0; k < count; k++) {
        bool held = sp_emitter_holds(emitter, ways[k].direction);
        double margin = held ? -INFINITY : fmin(0, sp_emitter_margin(emitter, ways[k].direction));
        unsigned state = held ? THERE | HELD : THERE;
        sp_arrival arrival;
        if (margin > seen.margin) {
            seen.margin = margin;
            seen.direction = ways[k].direction;
        }
        if (held && sp_arrive(&source, &p->target, &ways[k], &arrival) && arrival.passes) {
            state |= PASSES;
            if (!sp_flight_visit(&source, &p->target, &ways[k], meets, &looking)) {
                state |= FREE;
                arrival.breadth = 0;
                seen.flux += sp_emitter_flux(emitter, p->flow, &arrival, 0);
            }
        }
        seen.state |= state << ARC * k;
    }
    return seen;
}

static bool arrives(const glance *seen)
{
    return seen->state & (PASSES | PASSES << ARC);
}

/* Whether spray or shadow may begin or end between two places; a thin spray may do both. What is in the spray at
 * both and arrives from behind, too slowly or too slanted is taken to do so in between: it could arrive as asked for
 * less than a step alone, where a wall passes the nozzle within a fraction of one. */
static bool changes(const glance *from, const glance *to)
{
    if (from->state != to->state)
        return true;
    if (arrives(from))
        return false;
    double turn = acos(fmin(1, fmax(-1, sp_dot(from->direction, to->direction))));
    return from->margin + to->margin + turn > 0;
}

static double trapezoid(const glance *from, const glance *to)
{
    return 0.5 * (to->at - from->at) * (from->flux + to->flux);
}

/* Between two places: down to `fine` wherever spray is or anything changes, and there halved so many times more. */
static double integrate(const passing_point *p, const glance *from, const glance *to, double fine, unsigned halvings)
{
    bool is_fine = to->at - from->at <= fine, halve = changes(from, to);
    if (is_fine ? !halve || !halvings : !halve && !arrives(from) && !arrives(to))
        return trapezoid(from, to);
    glance middle = look(p, 0.5 * (from->at + to->at));
    unsigned left = is_fine ? halvings - 1 : halvings;
    return integrate(p, from, &middle, fine, left) + integrate(p, &middle, to, fine, left);
}

/* Whether the spray surely misses the point from one position to another. */
static bool passes_aside(const passing_point *p, size_t first, size_t end)
{
    const sp_emitter *emitter = p->emitter;
    const sp_source *source = &emitter->source;
    if (!p->moves)
        return false;
    sp_vec3 from = sp_pass_offset(source->evaluator, p->step * (double)first),
            to = sp_pass_offset(source->evaluator, p->step * (double)end);
    sp_vec3 middle = sp_along(p->target.point, 0.5, sp_add(from, to));
    double radius = 0.5 * sp_distance(from, to), reach = sp_spray_reach(&emitter->spray);
    return sp_spray_surely_misses(source, emitter->frame.z, reach, emitter, 0, middle, radius);
}

/* From position `first`, which *from shows, to `end`, which it shows then. */
static double integrate_positions(const passing_point *p, size_t first, size_t end, glance *from)
{
    if (passes_aside(p, first, end)) {
        *from = (glance){.at = -1};
        return 0;
    }
    if (end - first > 1) {
        size_t middle = first + (end - first) / 2;
        double one = integrate_positions(p, first, middle, from);
        return one + integrate_positions(p, middle, end, from);
    }
    glance begin = from->at < 0 ? look(p, p->step * (double)first) : *from;
    *from = look(p, p->step * (double)end);
    return integrate(p, &begin, from, p->step / FINE * (1 + 1e-9), HALVINGS);
}

double sp_point_dose(const sp_emitter *emitter, double flow, const sp_point *point)
{
    const sp_evaluator *evaluator = emitter->source.evaluator;
    passing_point p = {
        .emitter = emitter,
        .flow = flow,
        .target = {.point = point->position, .normal = point->normal, .side = point->side, .triangle = point->triangle},
        .moves = sp_motion_of(evaluator, point->triangle) == SP_MOVING,
        .step = 1 / (double)evaluator->positions};
    glance from = {.at = -1};
    return integrate_positions(&p, 0, evaluator->positions, &from);
}
