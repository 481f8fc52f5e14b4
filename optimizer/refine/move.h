/* Moving a layout's nozzle to values of its pose parameters. */
#ifndef OPTIMIZER_MOVE_H
#define OPTIMIZER_MOVE_H

#include "refine/pose_parameters.h"

/* Takes the values over, the place only where mount, cavity and clearance allow it. The field stays as it was. */
void sp_placed_move(const sp_search *search, sp_placed *placed, const sp_pose_parameters *parameters,
                    const double *values);

#endif
