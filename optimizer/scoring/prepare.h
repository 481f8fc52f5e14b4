/* Prepares a search: counts what is to be cleaned and traces what every layout contains. */
#ifndef OPTIMIZER_PREPARE_H
#define OPTIMIZER_PREPARE_H

#include "scoring/search.h"

bool sp_search_create(const sp_evaluator *coarse, const sp_place_options *options, const sp_sites *sites,
                      const sp_candidates *candidates, const sp_visibility *visibility, sp_search *search,
                      sp_error *error);
void sp_search_free(sp_search *search);
/* The same of layouts that contain all of the scene's own nozzles, not only those that are marked; for partial layouts
 * and scores, with the limits on water as they were. Borrows all else of `search`. False, and nothing to free, on
 * error. */
bool sp_search_keep_all(const sp_search *search, sp_search *keeping, sp_error *error);
void sp_search_keep_all_free(sp_search *keeping);

/* m³/s that the scene's own layout would take, with what the mounts that its nozzles lie on cost. */
double sp_own_outlay(const sp_search *search);

#endif
