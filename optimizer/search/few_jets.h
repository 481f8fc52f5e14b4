/* Drafts: where layouts are measured by many jets, the search measures them by few on its own patches, and only what it
 * ends with as the scene says. */
#ifndef OPTIMIZER_FEW_JETS_H
#define OPTIMIZER_FEW_JETS_H

#include "search/front.h"

/* How many of each nozzle; 0 where drafts would save little, or goods move. */
uint64_t sp_few_jets(const sp_search *search, const sp_evaluator *fine);
/* Keeps the front's best, which covers `area` (m²) as the scene says, for the count, and has a front of drafts aim as
 * much higher than at `target` (m²) as they flatter it. */
bool sp_aim_by_few_jets(sp_front *front, const sp_search *search, double target, double area, sp_error *error);
/* The front in the end: what was kept for the count is on it, and drafts are measured as the scene says, for `target`
 * (m²): the best, what it takes to reach the target where that falls short, and of the others as many as there is time
 * for, evenly. */
bool sp_count_by_all_jets(sp_front *front, const sp_search *search, double target, sp_error *error);

#endif
