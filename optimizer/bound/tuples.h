/* Layouts of few nozzles, looked at one by one: where water allows no more, fractions of many candidates cover far more
 * than any few whole ones, and no multipliers of texels say so.
 *
 * Within a budget W shares of a layout's nozzles come to 1 only where one of them is its weight / W at least. So no
 * layout covers more than the union of the texels to which its nozzles bring that much, and what their edges cover
 * besides; and what a nozzle adds to a union only falls as that grows. Candidates are chosen one after the other,
 * heavier ones first, in every way that could still come above a target by what is left to gain and by texels'
 * multipliers; what does is covered exactly. */
#ifndef OPTIMIZER_TUPLES_H
#define OPTIMIZER_TUPLES_H

#include "bound/candidate_list.h"

/* The candidates that layouts of so much water could be made of. */
typedef struct sp_tuples sp_tuples;

typedef struct {
    size_t water;            /* units that a layout takes at most */
    double floor;            /* m² that a layout found covers: what covers no more need not be looked at */
    double bound;            /* m² that none is known to exceed */
    size_t most;             /* candidates at a time */
    const sp_multipliers *u; /* read while sp_tuples_create runs, as the next one */
    const float *price;      /* [list->count], what a candidate is worth at u, or more */
} sp_tuple_task;

/* Borrows cover and list. */
sp_tuples *sp_tuples_create(const sp_cover *cover, const sp_candidate_list *list, const sp_tuple_task *task,
                            sp_error *error);
void sp_tuples_destroy(sp_tuples *tuples);
/* The lowest target for which no more than so many candidates, at most task->most, come into question by their prices;
 * the bound where there is none. */
double sp_tuples_target(const sp_tuples *tuples, size_t candidates);

typedef struct {
    bool complete; /* else nothing is proved: it took too much, or was broken off */
    double bound;  /* m² that no layout of so much water covers more than: the target, or what the best one covers */
    double work;   /* that it took, in words of 64 texels: the same on any number of threads where it is complete */
} sp_tuple_answer;

/* For a target no lower than sp_tuples_target tells for task->most. */
bool sp_tuples_bound(sp_tuples *tuples, double target, double work_most, sp_tuple_answer *answer, sp_error *error);

#endif
