/* Whether a design has all that is reported of one: what failed on the way to it left NULL there. */
#ifndef RESULT_DESIGN_H
#define RESULT_DESIGN_H

#include <sprayplan/result.h>

/* There are patches to tell of and what came of them. Accepts NULL. */
static inline bool sp_design_is_evaluated(const sp_design *design)
{
    return design && design->evaluator && design->coverage;
}

/* design_figures.c. False where a design has neither layout and coverage on its evaluator nor figures alone; with an
 * error, unless the one is reported already that this came from. Accepts NULL. */
bool sp_result_is_whole(const sp_result *result, sp_error *error);

#endif
