#include "free_share.h"

#include "movers.h"

#include <string.h>

/* A way while it is looked along: the positions of the goods in which it is asked for. */
typedef struct {
    const sp_evaluator *evaluator;
    uint32_t patch;
    size_t first, end;
    bool *shaded;   /* [end - first], those in which they are in the way so far */
    size_t free;    /* the others */
    sp_vec3 offset; /* m, of what the way ends at */
} watch;

/* All positions where the end stands, else the one in which it was looked at. */
static watch watch_for(const sp_evaluator *evaluator, uint32_t patch, uint32_t triangle, size_t position, bool *shaded)
{
    bool moves = sp_motion_of(evaluator, triangle) == SP_MOVING;
    watch w = {.evaluator = evaluator,
               .patch = patch,
               .first = moves ? position : 0,
               .end = moves ? position + 1 : evaluator->positions,
               .shaded = shaded};
    w.free = w.end - w.first;
    memset(shaded, 0, w.free * sizeof *shaded);
    return w;
}

static double share_of(const watch *w)
{
    return (double)w->free / (double)(w->end - w->first);
}

/* Looks along a piece that is given where it flies; true where the goods are in the way in every position. */
static bool shade(watch *w, const sp_ray *ray, sp_vec3 acceleration)
{
    for (size_t k = w->first; k < w->end; k++) {
        sp_vec3 offset = sp_pass_offset(w->evaluator, sp_pass_share(w->evaluator, w->patch, k));
        bool *shaded = &w->shaded[k - w->first];
        if (*shaded || !sp_movers_occlude(w->evaluator, SP_MOVING, ray, acceleration, offset))
            continue;
        *shaded = true;
        w->free--;
    }
    return w->free == 0;
}

double sp_ray_free_share(const sp_source *source, sp_ray_queue *queue, uint32_t patch, size_t i)
{
    const sp_evaluator *evaluator = source->evaluator;
    const sp_passing_ray *passing = &queue->passing[i];
    sp_ray ray = queue->rays[i];
    ray.skip = passing->target;
    watch w = watch_for(evaluator, patch, passing->target, passing->position, queue->shaded);
    shade(&w, &ray, source->gravity);
    return share_of(&w);
}

/* The same of a piece that is given as the end sees it, and of what stands. */
static bool look_along(void *user, const sp_ray *piece, sp_vec3 acceleration)
{
    watch *w = user;
    sp_ray ray = *piece;
    ray.origin = sp_add(ray.origin, w->offset);
    if (sp_movers_occlude(w->evaluator, SP_STANDING, &ray, acceleration, sp_v(0, 0, 0)))
        return true;
    return shade(w, &ray, acceleration);
}

double sp_pass_free_share(const sp_gathering *own, const sp_target *target, const sp_flight *way)
{
    const sp_source *source = &own->source;
    watch w = watch_for(source->evaluator, own->patch, target->triangle, own->position, own->queue->shaded);
    w.offset = own->offset;
    return sp_flight_visit(source, target, way, look_along, &w) ? 0 : share_of(&w);
}
