/* Goods on their way past a nozzle, as what it reaches: patches that move are looked at in every position. */
#ifndef SPRAY_PASSING_H
#define SPRAY_PASSING_H

#include "ray_queue.h"

/* The flights to a patch that moves, in all positions. */
void sp_gather_passing(sp_gathering *own, const sp_target *target);

#endif
