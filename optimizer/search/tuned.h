/* Candidates at angles and flows that refinement may set and the candidates themselves do not hold. */
#ifndef OPTIMIZER_TUNED_H
#define OPTIMIZER_TUNED_H

#include "scoring/partial.h"
#include "search/pool.h"

/* The search over the pool's poses, those of adjustable variants at several angles and flows each. What is built of
 * them says these itself, so that it belongs to the original search as well. */
typedef struct {
    sp_candidates candidates; /* the original's variants first; poses are not numbered */
    sp_search search;
    sp_pool pool;
    size_t *base; /* [variants], the original that each was made of */
} sp_tuned;

bool sp_tuned_create(const sp_search *search, const sp_pool *pool, sp_tuned *tuned, sp_error *error);
void sp_tuned_free(sp_tuned *tuned);
/* Writes the settings of poses that were added to a partial layout into their nozzles, which then are no candidates but
 * what became of those at their types' own settings. */
void sp_tuned_settle(const sp_tuned *tuned, sp_partial *partial);

#endif
