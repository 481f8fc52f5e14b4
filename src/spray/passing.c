#include "passing.h"

#include "sure_miss.h"
#include "movers.h"

#define WIDEST 3.0 /* of a patch's length, from its point: it lies within */

/* Whether the spray surely misses a patch at all positions from one to another. */
static bool passes_aside(const sp_gathering *own, const sp_source *source, const sp_target *target, size_t first,
                         size_t end)
{
    const sp_evaluator *evaluator = source->evaluator;
    sp_vec3 from = sp_pass_offset(evaluator, sp_pass_share(evaluator, own->patch, first)),
            to = sp_pass_offset(evaluator, sp_pass_share(evaluator, own->patch, end - 1));
    sp_vec3 middle = sp_along(target->point, 0.5, sp_add(from, to));
    double radius = 0.5 * sp_distance(from, to) + WIDEST * target->length;
    double fringe = sp_spray_fringe(sp_breadth_most(source, middle, radius, fmax(target->length, own->step)));
    return sp_spray_surely_misses(source, own->aim->axis, own->aim->half_angle, own->aim->emitter, fringe, middle,
                                  radius);
}

/* A patch that moves, at the positions first to end: halves of the way that the spray misses are not looked at. */
static void gather_between(sp_gathering *own, const sp_source *source, const sp_target *target, size_t first,
                           size_t end)
{
    const sp_evaluator *evaluator = source->evaluator;
    if (passes_aside(own, source, target, first, end))
        return;
    if (end - first > 1) {
        gather_between(own, source, target, first, first + (end - first) / 2);
        gather_between(own, source, target, first + (end - first) / 2, end);
        return;
    }
    own->position = first;
    own->share = 1 / (double)evaluator->positions;
    own->offset = sp_pass_offset(evaluator, sp_pass_share(evaluator, own->patch, first));
    own->source.position = sp_sub(source->position, own->offset);
    sp_gather_flights(own, target);
}

void sp_gather_passing(sp_gathering *own, const sp_target *target)
{
    sp_source source = own->source;
    own->step = sp_pass_step(source.evaluator);
    gather_between(own, &source, target, 0, source.evaluator->positions);
}
