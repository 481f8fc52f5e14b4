/* Runners-up: layouts of few nozzles that cover nearly as much of a coverage matrix's sample as the best found does.
 * Which of them comes to cover most once its nozzles may leave the candidates' places is not seen before. One of the
 * best's nozzles after another is barred, of one nozzle also what came in its place (Lawler, A procedure for computing
 * the K best solutions, Management Science 18, 1972); and single nozzles in the place of several. */
#ifndef OPTIMIZER_RUNNERS_UP_H
#define OPTIMIZER_RUNNERS_UP_H

#include "search/selection.h"

#define SP_RUNNERS_UP 8 /* to a layout, at most */
#define SP_FEW 3        /* nozzles that they have, at most: of more, exchanges find others as they are */

typedef struct {
    size_t count; /* 0: there is none */
    uint32_t row[SP_FEW];
} sp_runner_up;

/* Those of each best selection within its outlay (m³/s), [count * SP_RUNNERS_UP], by selection. The same whatever the
 * number of threads. */
bool sp_find_runners_up(const sp_selection *best, const double *budgets, size_t count, sp_deadline *deadline,
                        sp_runner_up *found, sp_error *error);
/* The single nozzle of no more than an outlay (m³/s) that covers most, and those all but as good, [SP_RUNNERS_UP]. */
bool sp_find_singles(const sp_coverage_matrix *matrix, double most, sp_deadline *deadline, sp_runner_up *found,
                     sp_error *error);

#endif
