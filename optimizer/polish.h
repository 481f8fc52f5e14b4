/* Polishing: refining many designs at once, each annealed and then improved by compass. */
#ifndef OPTIMIZER_POLISH_H
#define OPTIMIZER_POLISH_H

#include "anneal.h"
#include "exchange.h"
#include "kick.h"

typedef enum {
    SP_TRIAL_POLISH, /* the design as it is */
    SP_TRIAL_KICK,   /* after a kick */
    SP_TRIAL_THRIFT, /* another in its place, of nozzles turned down as far as refinement may */
} sp_trial_kind;

/* One design to polish at equal water. */
typedef struct {
    sp_trial_kind kind;
    sp_design design; /* what comes out takes its place, if it is better */
    double budget;    /* m³/s */
    uint64_t seed;    /* of the kick */
    bool better;      /* it came to cover more on few patches; the search's and the final ones may see it otherwise */
    double covered;   /* m² of few patches */
} sp_trial;

typedef struct {
    const sp_search *search;
    const sp_pool *pool;
    sp_watch *watch;
    sp_evaluator *rough_evaluator; /* NULL: the search's patches are few enough */
    sp_search rough;
    bool adjustable; /* some nozzles can be turned down */
    sp_candidates thrifty_candidates;
    sp_search thrifty; /* the search with all makes turned down */
    int threads;
    sp_sights *sights, *rough_sights; /* [threads] */
} sp_polishing;

bool sp_polishing_create(const sp_search *search, const sp_pool *pool, const sp_evaluator *fine, sp_watch *watch,
                         sp_polishing *polishing, sp_error *error);
void sp_polishing_free(sp_polishing *polishing);

/* Polishes every trial on few patches. What comes out does not depend on the number of threads. */
bool sp_polish(sp_polishing *polishing, sp_trial *trials, size_t count, sp_error *error);
/* Polishes one design sharply on the search's own patches, where it never gets worse. */
bool sp_sharpen(sp_polishing *polishing, double budget, sp_design *design, sp_error *error);
/* Looks anew on the search's own patches. */
bool sp_look_anew(sp_polishing *polishing, sp_design *design, sp_error *error);

#endif
