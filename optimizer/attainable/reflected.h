/* What only reflected liquid reaches. */
#ifndef OPTIMIZER_REFLECTED_H
#define OPTIMIZER_REFLECTED_H

#include "deadline/deadline.h"
#include "scoring/partial.h"

/* Turns SP_REASON_NO_LINE into SP_REASON_REFLECTION where a jet of some candidate that a wall has thrown back passes,
 * judged on the coarse patches by jets spread over all that the candidates can aim at. `reasons` are of the patches of
 * `fine`. Does nothing where no surface reflects. Takes a tenth of the time left at most; what it has not come to by
 * then keeps its reason. */
bool sp_bounces(const sp_evaluator *fine, const sp_search *search, sp_deadline *deadline, sp_reason *reasons,
                sp_error *error);

#endif
