/* How what nozzles bring to a patch comes together: all adds up, or one nozzle alone must meet the criterion. */
#ifndef SPRAY_COMBINATION_H
#define SPRAY_COMBINATION_H

#include "edges.h"
#include "spray/state/state.h"

typedef struct {
    const sp_evaluator *evaluator;
    sp_deposits *deposits;
    sp_edges edges;         /* of the nozzle in hand */
    bool repeats;           /* the edges of the nozzle in hand are another's, and count as that one's */
    double *counted, *even; /* [patches], m³/s per m²: of all nozzles so far, or where one alone must do, of the one in
                             * hand with all its patterns */
} sp_combination;

/* For sp_combination_free whatever the outcome. */
bool sp_combination_create(const sp_evaluator *evaluator, sp_deposits *deposits, sp_combination *combination,
                           sp_error *error);
void sp_combination_free(sp_combination *combination);
/* Adds to what the criterion counts what the pattern in hand brings to a patch: flux, m³/s per m², and where it falls;
 * `samples`: what its edges leave dry. */
void sp_combination_add(sp_combination *combination, uint32_t patch, double counted, const sp_wetting *wetting,
                        sp_edge_samples samples);
/* Takes nozzle i of a layout in hand. */
void sp_combination_begin_nozzle(sp_combination *combination, const sp_layout *layout, size_t i);
/* Takes pattern i of that nozzle's in hand, and puts it away. */
void sp_combination_begin_pattern(sp_combination *combination, const sp_nozzle *patterns, size_t i, size_t count);
void sp_combination_end_pattern(sp_combination *combination, const sp_nozzle *patterns, size_t i, size_t count);
/* All patterns of the nozzle in hand are added. */
void sp_combination_end_nozzle(sp_combination *combination);

#endif
