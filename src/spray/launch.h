/* How liquid leaves nozzles, with drag. */
#ifndef SPRAY_LAUNCH_H
#define SPRAY_LAUNCH_H

#include "spray/state/state.h"

#include <sprayplan/launch.h>

/* Whether what leaves a pattern flies with drag. */
static inline bool sp_flies_as_drops(const sp_evaluator *evaluator, const sp_nozzle *pattern)
{
    return sp_trajectory_of(evaluator, pattern->type->trajectory) == SP_TRAJECTORY_DRAG;
}
/* Drops so small that air stops them at once are none, nor is anything said of them: false, with an error. */
bool sp_are_drops(const sp_setup *setup, const sp_nozzle *pattern, sp_error *error);

#endif
