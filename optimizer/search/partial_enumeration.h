/* Partial enumeration: greedy orders after one first nozzle of many, or two, and what becomes of the best of them.
 * Greedy by gain per water alone may be far off; that every first nozzle, or every two, have their turn is what bounds
 * are proved for, where one nozzle alone must cover (Sviridenko, Operations Research Letters 32, 2004; Feldman, Nutov
 * and Shoham, Practical budgeted submodular maximization, Algorithmica 85, 2023). Here those have that promise most. */
#ifndef OPTIMIZER_PARTIAL_ENUMERATION_H
#define OPTIMIZER_PARTIAL_ENUMERATION_H

#include "search/selection.h"

/* For each outlay (m³/s) the best selection found in the coverage matrix; selections[count] are created by it, and
 * freed by the caller. What is found does not depend on the number of threads. */
bool sp_enumerate_partially(const sp_coverage_matrix *matrix, const double *budgets, size_t count,
                            sp_deadline *deadline, sp_selection *selections, sp_error *error);
/* Rows as a partial layout of `search`. `others`: the nozzles that the matrix's rows behind the pool's stand for, as
 * they are in that search, where the matrix may tell of them what only jets find; NULL where there are none. */
bool sp_rows_partial(const sp_coverage_matrix *matrix, const uint32_t *rows, size_t count, const sp_search *search,
                     const sp_placed *const *others, sp_partial *partial, sp_error *error);
/* The same of a selection's. */
bool sp_selection_partial(const sp_selection *selection, const sp_search *search, const sp_placed *const *others,
                          sp_partial *partial, sp_error *error);

#endif
