/* All that a placement makes ready before it searches. */
#ifndef TESTS_PREPARED_H
#define TESTS_PREPARED_H

#include "room.h"

#include "scoring/prepare.h"

typedef struct {
    sp_deadline deadline;
    sp_sites sites;
    sp_candidates candidates;
    sp_visibility visibility;
    sp_search search;
} prepared;

/* In place: each borrows those before it, and the evaluator and the options. */
static inline void prepare(prepared *p, const sp_evaluator *evaluator, const sp_place_options *options)
{
    sp_error error = {0};
    p->deadline = sp_deadline_start(&options->run);
    assert_true(sp_sites_create(evaluator, options, &p->sites, &error));
    assert_true(sp_candidates_create(evaluator, options, &p->sites, &p->candidates, &error));
    assert_true(
        sp_visibility_create(evaluator, options, &p->sites, &p->candidates, &p->deadline, &p->visibility, &error));
    assert_true(sp_search_create(evaluator, options, &p->sites, &p->candidates, &p->visibility, &p->search, &error));
}

static inline void prepared_free(prepared *p)
{
    sp_search_free(&p->search);
    sp_visibility_free(&p->visibility);
    sp_candidates_free(&p->candidates);
    sp_sites_free(&p->sites);
    free(p->deadline.stages);
}

#endif
