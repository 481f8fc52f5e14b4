/* Branch and bound on what the Lagrangian bound leaves open, for one amount of water at a time.
 *
 * A branch says of some nozzles of a layout from which ranges of the line of candidates they are (slots), and of the
 * others only that they are lighter. At prices u no layout of a branch covers more than Σ (area - u) + what the best of
 * each slot and the best of the others are worth. What prices one branch yields holds for all branches, which are all
 * bounded anew by them; a candidate is shut out once no open branch could cover more with it than what was found
 * (reduced-cost fixing). Stops anywhere: the bound is that of the highest branch. */
#ifndef OPTIMIZER_BRANCH_H
#define OPTIMIZER_BRANCH_H

#include "bound/dual.h"
#include "bound/highest.h"
#include "bound/line.h"

typedef struct {
    size_t first, end; /* positions of the line */
    uint32_t weight;   /* units of water that each takes at least */
    uint32_t count;    /* nozzles of the layout */
} sp_slot;

typedef struct {
    double bound;          /* m², cover->base included */
    size_t rest;           /* kind of the heaviest nozzles that may be in no slot; line->kind_count: there are none */
    size_t nozzles, water; /* of those, at most */
    size_t slot_count;
    sp_slot *slots;
    size_t solves;
} sp_branch;

/* What all trees share. */
typedef struct {
    const sp_cover *cover;
    const sp_line *line;
    sp_rows rows;   /* the few that prices are sought on; keys are positions */
    uint8_t *among; /* [positions], whether a candidate is of the few */
    uint32_t *slot_of;
    size_t slot_room; /* of slot_of */
    size_t solved;    /* rows that the last solve was about */
    sp_dual dual;
    sp_lifts lifts;
    sp_highest price, least; /* of the last prices; least: what a candidate must be worth to stay alive */
    uint32_t *alive_before;  /* [positions + 1], of the tree in hand */
    double *run_best;        /* [runs] */
    sp_knapsack *rest;       /* [kinds + 1], of nozzles of these kinds and lighter; empty: not filled yet */
    double rest_area;        /* m² that the last prices leave, base included */
    size_t valid;            /* nozzles of a layout that they hold for */
} sp_branching;

typedef struct {
    size_t water;
    double found; /* m²: what is no better need not be looked at */
    double shut;  /* the highest bound of what is closed */
    size_t count, capacity;
    sp_branch *open;
    uint8_t *alive; /* [positions] */
    size_t steps;
    double work;      /* that these took: as long as so many candidates are priced */
    double rows_work; /* that the rows of the last took, alone */
    double next_work; /* that another is likely to take */
} sp_tree;

/* Borrows cover and line. */
bool sp_branching_create(const sp_cover *cover, const sp_line *line, sp_branching *b, sp_error *error);
void sp_branching_free(sp_branching *b);
/* Adds to the few; keys are positions, others are left out. */
bool sp_branching_take(sp_branching *b, const sp_rows *rows, sp_error *error);

/* For layouts of at most `water` units, of which `bound` (m²) was proved and one of `found` m² is known. */
bool sp_tree_create(const sp_branching *b, size_t water, double bound, double found, sp_tree *tree, sp_error *error);
void sp_tree_free(sp_tree *tree);
/* One solve and one pricing of what is alive, for the highest branch, which then parts where no more is to be had. */
bool sp_tree_step(sp_branching *b, sp_tree *tree, sp_error *error);
/* Lowers all branches, and shuts out candidates, by prices from elsewhere: price[position] is what a candidate is worth
 * at u, rounded upwards. */
bool sp_tree_hear(sp_branching *b, sp_tree *tree, const sp_prices *u, const float *price, sp_error *error);
/* m² that no layout of so much water exceeds. */
double sp_tree_bound(const sp_tree *tree);
/* No branch is left that could hold anything better than what was found. */
bool sp_tree_closed(const sp_tree *tree);

#endif
