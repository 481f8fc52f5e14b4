/* How long the ways of flights are free where goods pass: they are looked along in the positions in which goods may be
 * in the way. */
#ifndef SPRAY_FREE_SHARE_H
#define SPRAY_FREE_SHARE_H

#include "ray_queue_state.h"

/* The share of an arrival's time in which no goods are in the way of the queue's ray `i`: all or none where they are
 * looked at in one position, and of what stands the mean over the pass. */
double sp_ray_free_share(const sp_source *source, sp_ray_queue *queue, uint32_t patch, size_t i);
/* The same of a flight with drag, of what stands as well. */
double sp_pass_free_share(const sp_gathering *own, const sp_target *target, const sp_flight *way);

#endif
