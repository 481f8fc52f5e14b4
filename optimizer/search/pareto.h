/* Pareto local search (Paquete, Chiarandini, Stützle 2004): layouts of the coverage matrix's rows for every amount of
 * water at once. Fixed nozzles take water in steps, so that what is best for one amount is seldom a neighbour of what
 * is best for the next that was searched for; here each layout leads to better ones at whatever amount its neighbours
 * take. */
#ifndef OPTIMIZER_PARETO_H
#define OPTIMIZER_PARETO_H

#include "deadline/deadline.h"
#include "search/selection.h"

typedef struct {
    size_t count;
    uint32_t row[SP_SELECTION_MOST]; /* of the matrix */
    double outlay, covered;          /* m³/s with the kept nozzles; m² of the sample, 0: none is known */
    bool explored;                   /* all its neighbours have been tried */
} sp_pareto_layout;

/* Of each range of outlays the layout that covers most. */
typedef struct {
    size_t count; /* ranges */
    double *ends; /* [count], m³/s, rising: the most that layouts of a range take; the first takes all less */
    sp_pareto_layout *layouts; /* [count] */
} sp_pareto;

/* Ranges that end at each of the outlays (m³/s, rising but for round-off) and hold nothing else that differs by more than a
 * hundredth. Freed by the caller, after failure too. */
bool sp_pareto_create(const sp_coverage_matrix *matrix, const double *outlays, size_t count, sp_pareto *pareto,
                      sp_error *error);
void sp_pareto_free(sp_pareto *pareto);
/* Enters what is selected, where nothing of its range covers as much. */
void sp_pareto_enter(sp_pareto *pareto, const sp_selection *selection);
/* Whether the layout of range i covers more than all of less outlay. */
bool sp_pareto_counts(const sp_pareto *pareto, size_t i);
/* Nozzles added, left out and exchanged, from what is entered and from none, until that leads no further, or for a time
 * that is set by the matrix alone. Reported as of `stage`. */
bool sp_pareto_search(const sp_coverage_matrix *matrix, sp_deadline *deadline, const char *stage, sp_pareto *pareto,
                      sp_error *error);

#endif
