/* Trials of the local search, and what it holds while it carries them out. */
#ifndef OPTIMIZER_TRIAL_H
#define OPTIMIZER_TRIAL_H

#include "refine/continuation.h"
#include "search/tuned.h"

#define SP_STARTS 2 /* of continuation, at different widths */

typedef enum {
    SP_TRIAL_CONTINUATION, /* the layout as it is, by continuation from every start */
    SP_TRIAL_BY_TURNS,     /* the same, from one of the starts by turns as all that follow */
    SP_TRIAL_ANNEALING,    /* after simulated annealing */
    SP_TRIAL_OTHER,        /* another in its place */
    SP_TRIAL_RUNNER_UP,    /* one that covers less than the best other, before it is refined */
} sp_trial_kind;

/* One layout to search from at equal water. */
typedef struct {
    sp_trial_kind kind;
    sp_partial partial; /* what comes out takes its place, if better, and no other of the same water much more so */
    sp_partial other;   /* of the tuned search, of the last two kinds */
    double budget;      /* m³/s of outlay */
    uint64_t seed;      /* of the annealing */
    size_t turn;        /* the start of continuation that it takes; SP_STARTS: none */
    sp_partial start;   /* where the annealing of that kind ended */
    bool repeats;       /* another is refined in the same way from there */
    bool better;        /* it came to cover more on few patches; the search's and the final ones may see it otherwise */
    sp_partial refined; /* on few patches */
    double covered;     /* m² of these */
} sp_trial;

typedef struct {
    const sp_search *search;
    sp_deadline *deadline;
    sp_evaluator *rough_evaluator; /* NULL: the search's patches are few enough */
    sp_search rough;
    sp_evaluator *sharp_evaluator; /* NULL: the final patches are few enough */
    sp_search sharp;               /* on these */
    sp_tuned tuned;                /* where annealing and other layouts find their poses */
    int threads;
    sp_sights *sights, *rough_sights, *sharp_sights; /* [threads]; the first are exact */
} sp_local_search;

#endif
