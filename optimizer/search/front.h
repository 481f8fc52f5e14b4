/* What the search has found: layouts measured by the scene's own evaluator, or by a draft of it, and the fronts of
 * coverage against water and against number of nozzles. */
#ifndef OPTIMIZER_FRONT_H
#define OPTIMIZER_FRONT_H

#include "deadline/deadline.h"
#include "scoring/partial.h"
#include "search/jet_cache.h"

#include <math.h>

#define SP_GAIN_LEAST 1e-4 /* of area or water: less is no improvement */
#define SP_MISJUDGED 3e-3  /* of what is covered: by so much the search's patches may rank layouts wrongly */

typedef struct {
    sp_front_point point;
    sp_partial partial;
} sp_front_entry;

/* What nothing measured betters with no more outlay, or no more nozzles: by rising outlay or number, all areas rising
 * too. `Water` in names of the front is outlay where mounts cost something. */
typedef struct {
    size_t count, capacity;
    sp_front_entry *entries;
} sp_front_list;

typedef struct {
    const sp_evaluator *fine;
    uint64_t draft_jets; /* of a nozzle, on the search's patches; 0: layouts are measured as the scene says; stays what
                          * it is from the first layout on */
    sp_front_list counted;  /* layouts of which is known what the scene says, for the end, in the order of finding */
    sp_jet_cache jet_cache; /* where jets tell what layouts cover */
    sp_deadline *deadline;
    sp_objective objective;
    double target; /* m² */
    sp_front_list by_water, by_number;
    bool found;
    sp_partial best;         /* with what follows, the best measured yet by the objective */
    sp_front_point measured; /* of it */
    double bias;             /* m² that the fine measure lies above the best one's coarse `covered` */
} sp_front;

/* The layouts of the front by water, then the best. */
static inline const sp_partial *sp_front_partial(const sp_front *front, size_t i)
{
    return i < front->by_water.count ? &front->by_water.entries[i].partial : &front->best;
}

/* No better and no worse to speak of. */
static inline bool sp_point_same(const sp_front_point *a, const sp_front_point *b)
{
    return fabs(a->area - b->area) <= SP_GAIN_LEAST * b->area &&
           fabs(a->outlay - b->outlay) <= SP_GAIN_LEAST * b->outlay;
}

/* Whether the best is to take less: it covers what is asked for. Else it is to cover more. */
static inline bool sp_front_saves(const sp_front *front)
{
    return front->objective != SP_OBJECTIVE_MAX_COVERAGE && front->measured.area >= front->target;
}

/* An empty one that measures as `front` does, for the same target; what was flown and counted becomes its own. */
sp_front sp_front_anew(sp_front *front);
/* True where a is better than b: by the objective among layouts that reach the target, by area among others. */
bool sp_front_better(const sp_front *front, const sp_front_point *a, const sp_front_point *b);
/* Keeps a copy of a layout, with what the scene says of it, among what is counted. */
bool sp_front_count(sp_front *front, const sp_search *search, const sp_partial *partial, const sp_front_point *point,
                    sp_error *error);
/* In the end, where nothing reaches the target and the objective saves: of the layouts that cover all but
 * SP_COVERAGE_TOLD as much as the best, that of least outlay becomes the best. Before, the best is to be the one that
 * covers most, from which the search climbs on. */
bool sp_front_settle(sp_front *front, const sp_search *search, sp_error *error);
/* For another target from now on; the best becomes that by it. */
bool sp_front_aim(sp_front *front, const sp_search *search, double target, sp_error *error);
/* Measures the layout, notes it, and keeps a copy where it is the best yet. *point may be NULL. */
bool sp_front_measure(sp_front *front, const sp_search *search, const sp_partial *partial, sp_front_point *point,
                      sp_error *error);
/* Measures layouts, NULL for none, at once, of several ranks each some of them, and notes nothing: points [count], of
 * which those that nobody has measured have an area of -1. Jets are flown for as many as there is time for. */
bool sp_front_measure_ahead(sp_front *front, const sp_search *search, const sp_partial *const *partials, size_t count,
                            sp_front_point *points, sp_error *error);
/* Measures and notes layouts, measured ahead. */
bool sp_front_measure_all(sp_front *front, const sp_search *search, const sp_partial *partials, size_t count,
                          sp_error *error);
/* As sp_front_measure, with what measuring ahead gave; where it gave nothing and jets would have to be flown, only
 * while there is time: after that *point is as it was. */
bool sp_front_note(sp_front *front, const sp_search *search, const sp_partial *partial, sp_front_point *point,
                   sp_error *error);
/* All nozzles of the layouts by water, one layout's after the other's; malloc'd, to be freed before anything is noted.
 * NULL when memory runs out. */
const sp_placed **sp_front_nozzles(const sp_front *front, size_t *count);
/* False where the next entry by water that counts covers more with hardly more. */
bool sp_front_counts(const sp_front *front, size_t i);
/* The points by water that count, and those by number, without one of no water; malloc'd, the caller frees. */
sp_front_point *sp_front_by_water(const sp_front *front, size_t *count, sp_error *error);
sp_front_point *sp_front_by_number(const sp_front *front, size_t *count, sp_error *error);
void sp_front_free(sp_front *front);

#endif
