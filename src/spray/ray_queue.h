/* The flights to a chunk of patches that pass all questions but whether their way is free, while they are gathered. */
#ifndef SPRAY_RAY_QUEUE_H
#define SPRAY_RAY_QUEUE_H

#include "ray_queue_state.h"

/* Room for as many more arrivals; false where memory ran out, as from then on. */
bool sp_ray_queue_make_room(sp_ray_queue *queue, size_t more);
void sp_ray_queue_free(sp_ray_queue *queue);

/* The flights to the patch, whole or in cells, from where the source is. */
void sp_gather_flights(sp_gathering *own, const sp_target *target);
/* Whether the way of an arrival at `part` of a patch is to be looked along. */
bool sp_way_is_traced(const sp_evaluator *evaluator, const sp_aim *aim, double part);

#endif
