/* How the liquid of all nozzles that a layout may hold leaves them. */
#ifndef OPTIMIZER_LAUNCHES_H
#define OPTIMIZER_LAUNCHES_H

#include "candidates/mounts.h"

#include <sprayplan/launch.h>

/* Of every type at every pressure, wherever its mounts and refinement let it stand, and of the kept nozzles. NULL on
 * error. */
sp_launch_table *sp_launches_create(const sp_evaluator *evaluator, const sp_place_options *options,
                                    const sp_sites *sites, sp_error *error);

#endif
