/* Layouts made of rows of a coverage matrix, searched on its sample of the patches by the exact objective: greedy after
 * enumerated first nozzles, single exchanges, merges and neighbours placed anew. */
#ifndef OPTIMIZER_SELECTION_H
#define OPTIMIZER_SELECTION_H

#include "search/coverage_matrix.h"
#include "search/kept_gains.h"
#include "search/selection_memo.h"

typedef struct {
    const sp_coverage_matrix *matrix;
    size_t count;
    uint32_t row[SP_SELECTION_MOST];
    double flow;                   /* m³/s, kept nozzles included */
    double outlay;                 /* m³/s, the same with what the mounts cost */
    double covered;                /* m² of the sample */
    float *hit, *film, *wet, *dry; /* [matrix->patch_count], as sp_partial's */
    sp_kept_gains known[2];        /* without and with the search's credit, on what was last asked about */
    double *score;                 /* [matrix->row_count], scratch */
    sp_selection_memo *memo;       /* of best rows found already, borrowed; NULL: each is found anew */
    const bool *barred;            /* [matrix->row_count], rows that may not come in, borrowed; NULL: none. No memo then */
} sp_selection;

bool sp_selection_create(const sp_coverage_matrix *matrix, sp_selection *selection, sp_error *error);
void sp_selection_free(sp_selection *selection);
/* Takes these rows, of the same matrix. */
void sp_selection_set(sp_selection *selection, const uint32_t *rows, size_t count);
void sp_selection_add(sp_selection *selection, uint32_t row);
void sp_selection_remove(sp_selection *selection, size_t i);
/* What a row would add to what is covered, and the credit for what is on the way; 0 where it does not fit within the
 * budget, the number or its port. */
double sp_selection_gain(const sp_selection *selection, uint32_t row, double budget);
/* What every row would add, without the credit or with the search's, in shares of all, 0 where it does not fit:
 * [matrix->row_count], which holds until the selection is asked or changed again. */
const double *sp_selection_gains(sp_selection *selection, float credit, double budget);
/* The row of most gain per outlay^power, the first of equals, that fits within the budget, an uncovered patch being
 * worth `credit`, 0 or the search's, per share of what it needs; *gain in m², 0 for none. */
uint32_t sp_selection_best(sp_selection *selection, double power, float credit, double budget, double *gain);

/* Puts one row, of no more outlay than the two together, in the place of two: the one that gains most there. False, and
 * nothing changed, where there is none. */
bool sp_selection_merge(sp_selection *selection, size_t a, size_t b, double budget);
/* Adds what the budget allows and exchanges one row at a time, until neither helps. */
void sp_selection_improve(sp_selection *selection, double budget);
/* Takes two that overlap most out, fills their place anew, by a merge or by gain per outlay, and improves what comes of
 * it, as long as that helps. `trial` is scratch of the same matrix. */
void sp_selection_regroup(sp_selection *selection, double budget, sp_selection *trial);

#endif
