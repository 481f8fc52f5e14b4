/* What one more nozzle could do for what a layout leaves uncovered. */
#ifndef OPTIMIZER_REMEDIES_H
#define OPTIMIZER_REMEDIES_H

#include "scoring/scoring.h"
#include "deadline/deadline.h"

/* Of each of the largest SP_REMEDIES shadows of `partial`, whose `coverage` is that on `fine`, the candidate found
 * that, beside the partial layout, covers most of it, whatever the limits on number and water. `remedies` [SP_REMEDIES]
 * is the caller's; *count of them were looked for in the time there is. */
bool sp_remedies_find(const sp_search *search, const sp_evaluator *fine, const sp_partial *partial,
                      const sp_coverage *coverage, sp_deadline *deadline, sp_remedy *remedies, size_t *count,
                      sp_error *error);

#endif
