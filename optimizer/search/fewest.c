#include "search/fewest.h"

#include "search/exchange.h"

/* The draft with one nozzle more, all of them exchanged until nothing is gained. */
static bool add_one(const sp_search *search, const sp_pool *pool, double budget, sp_watch *watch, sp_draft *draft,
                    sp_error *error)
{
    sp_place_options options = *search->options;
    options.max_nozzles = search->kept_count + draft->count + 1;
    sp_search limited = *search;
    limited.options = &options;
    return sp_improve(&limited, pool, budget, watch, draft, error);
}

bool sp_find_fewest(const sp_search *search, const sp_pool *pool, double budget, sp_watch *watch, sp_front *front,
                    sp_error *error)
{
    sp_draft draft;
    if (!sp_draft_create(search, &draft, error))
        return false;
    bool done = true, more = true;
    while (done && more && draft.count < front->best.count && sp_watch_goes_on(watch, "front", 1)) {
        size_t before = draft.count;
        done = add_one(search, pool, budget, watch, &draft, error);
        more = draft.count > before;
        done = done && (!more || sp_front_measure(front, search, &draft, NULL, error));
    }
    sp_draft_free(&draft);
    return done;
}
