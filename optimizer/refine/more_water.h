/* More coverage with more water, where that is not what is to be saved: nozzles turned up, and as many as are allowed.
 * The candidates have each type at one flow, so that nothing else tries more. */
#ifndef OPTIMIZER_MORE_WATER_H
#define OPTIMIZER_MORE_WATER_H

#include "refine/trials.h"

/* What the best layout may take (m³/s of outlay) to cover more: what it takes, or where what is asked for is out of its
 * reach, as much as its nozzles can be turned up to. */
double sp_best_budget(const sp_refining *refining);
/* Trials of other layouts for more water than the best takes, up to the most that is allowed, or where nothing limits
 * it, to what the best can be turned up to. */
bool sp_ask_more(sp_refining *refining, sp_trials *trials);
/* Trials of the best layouts of every number of nozzles, turned up as far as they can be: a few strong nozzles may
 * cover more than the many that the candidates' flows ask for. */
bool sp_try_turned_up(sp_refining *refining, sp_trials *trials);
/* Anneals the best layout, as long as it comes to cover more. */
bool sp_cover_more(sp_refining *refining);

#endif
