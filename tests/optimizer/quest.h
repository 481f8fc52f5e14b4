/* A search for the most coverage, without the proof, which takes as long again. */
#ifndef TESTS_QUEST_H
#define TESTS_QUEST_H

#include "prepared.h"

#include "refine/refine.h"
#include "search/find.h"

typedef struct {
    prepared ready;
    sp_pool pool;
    sp_front front;
    sp_partial first; /* what greedy finds */
} quest;

/* In place; borrows both. */
static inline void quest_begin(quest *q, const sp_evaluator *evaluator, const sp_place_options *options)
{
    sp_error error = {0};
    *q = (quest){0};
    prepare(&q->ready, evaluator, options);
    q->front = (sp_front){.fine = evaluator,
                          .deadline = &q->ready.deadline,
                          .objective = SP_OBJECTIVE_MAX_COVERAGE,
                          .target = q->ready.search.all};
    assert_true(sp_find_first(&q->ready.search, 1, &q->ready.deadline, &q->front, &q->pool, &q->first, &error));
}

/* m² that the best covers, with no more than is allowed. */
static inline double quest_area(const quest *q)
{
    assert_true(q->front.measured.flow <= q->ready.search.options->max_water * (1 + 1e-9));
    return q->front.measured.area;
}

/* The same after all that is done at leisure. */
static inline double quest_finish(quest *q)
{
    sp_error error = {0};
    const sp_search *search = &q->ready.search;
    assert_true(sp_find_more(search, &q->ready.deadline, &q->front, &q->pool, &q->first, &error) &&
                sp_refine_best(search, &q->pool, &q->ready.deadline, &q->front, &error));
    return quest_area(q);
}

/* And in a hurry. */
static inline double quest_hurry(quest *q)
{
    sp_error error = {0};
    assert_true(sp_refine_first(&q->ready.search, &q->pool, &q->ready.deadline, &q->front, &error));
    return quest_area(q);
}

static inline void quest_end(quest *q)
{
    sp_partial_free(&q->first);
    sp_front_free(&q->front);
    sp_pool_free(&q->pool);
    prepared_free(&q->ready);
}

#endif
