/* What the files of sp_tuples share: tuples_eliminate.c leaves out candidates by prices, tuples_rows.c makes sets of
 * the rest, tuples_enumerate.c chooses them one after the other, tuples_covered.c counts exactly what comes above the
 * target. */
#ifndef OPTIMIZER_TUPLES_WORK_H
#define OPTIMIZER_TUPLES_WORK_H

#include "bound/bit_rows.h"
#include "bound/tuples.h"
#include "bound/rounding.h"

#define DEEP_MOST 6  /* nozzles of a layout that are chosen one by one */
#define WORK_ROW 2e5 /* words that take as long as a row */
#define NO_SET UINT32_MAX
/* Multipliers that layouts are told by: those given, the texels' areas, and what lies between. */
#define BY_MULTIPLIERS 5

/* A candidate in question. */
typedef struct {
    size_t position, kind;
    uint32_t weight, set; /* set: of the sets, NO_SET: not yet */
    size_t port;
    float price[BY_MULTIPLIERS], above; /* above: m², up to which targets are that multipliers leave it for */
    double alone;                       /* m², of the set */
} sp_tuple_item;

/* A layout whose union comes above the target. */
typedef struct {
    uint32_t count, item[DEEP_MOST];
} sp_tuple;

struct sp_tuples {
    const sp_cover *cover;
    const sp_candidate_list *list;
    size_t water, most;
    double floor, bound, target;
    double least;                /* of targets, for which all candidates in question are items; INFINITY: of none */
    size_t priced;               /* of BY_MULTIPLIERS, that tell anything */
    double rest[BY_MULTIPLIERS]; /* m² that the multipliers leave, base included */
    double *most_priced[BY_MULTIPLIERS]; /* [kinds][steps + 1], what candidates could add to sums of prices */
    sp_tuple_item *items;                /* heavier ones first */
    size_t count, capacity;
    sp_bit_rows sets;
    uint32_t lightest, unit; /* unit: of a step */
    size_t steps;            /* of all water; 0: more than can be told apart */
    uint32_t *able;          /* [able_count], items that could be part of a layout above the target */
    size_t able_count;
    sp_tuple *found;
    size_t found_count, found_capacity;
    double work, work_most;
    bool failed, over; /* memory ran out; more was to do than may be */
};

/* most[s] = the most that candidates of s steps in all can come to: `lighter`, and any number of one kind. */
void sp_tuples_fill_kind(const sp_tuples *o, size_t kind, double best, const double *lighter, double *most);
/* The kind's part of tables [kinds][steps + 1]. */
double *sp_tuples_of_kind(const sp_tuples *o, double *tables, size_t kind);
/* Could a layout that holds candidates worth `priced` and `more` [o->priced] by the multipliers, and others of the kind
 * and lighter in so much water, come above the target by all of them? */
bool sp_tuples_all_above(const sp_tuples *o, const double *priced, const float *more, size_t kind, size_t water);
/* The lowest target, from the floor on, that no more than so many of the numbers lie above. */
double sp_tuples_target_for(const sp_tuples *o, size_t most, const float *above, size_t count);
/* Lists the candidates in question: `found` is what each is worth at u, or more. */
bool sp_tuples_find_items(sp_tuples *o, const sp_multipliers *u, const float *found, sp_error *error);
/* Lists what could be part of a layout above the target, sets built. */
bool sp_tuples_list_able(sp_tuples *o, sp_error *error);
/* Every layout, by the first of its nozzles. */
bool sp_tuples_enumerate(sp_tuples *o, sp_error *error);
/* Raises *most to what the layouts found cover. */
bool sp_tuples_check_found(sp_tuples *o, double *most, sp_error *error);

#endif
