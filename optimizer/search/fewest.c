#include "search/fewest.h"

#include "search/exchange.h"

/* Exchanges nozzles of the layout, and adds some up to `number`, until nothing is gained. */
static bool improve(const sp_search *search, sp_pool_gains *gains, size_t number, double budget, sp_deadline *deadline,
                    sp_partial *partial, sp_error *error)
{
    sp_place_options options = *search->options;
    options.max_nozzles = search->kept_count + number;
    sp_search limited = *search;
    limited.options = &options;
    return sp_improve(&limited, gains, budget, deadline, partial, error);
}

/* The greedy order's first so many. */
static bool first_of(const sp_search *search, const sp_partial *greedy, size_t number, sp_partial *partial,
                     sp_error *error)
{
    if (!sp_partial_copy(search, greedy, partial, error))
        return false;
    while (partial->count > number)
        sp_partial_remove(search, partial, partial->count - 1);
    return true;
}

/* *best, of at most number - 1 nozzles, becomes the best that two starts improve to. */
static bool add_one(const sp_search *search, sp_pool_gains *gains, const sp_partial *greedy, size_t number,
                    double budget, sp_deadline *deadline, sp_partial *best, sp_error *error)
{
    sp_partial other;
    if (!first_of(search, greedy, number, &other, error))
        return false;
    bool done = improve(search, gains, number, budget, deadline, &other, error) &&
                improve(search, gains, number, budget, deadline, best, error);
    bool better = done && sp_covers_more(search, &other, best);
    sp_partial_free(better ? best : &other);
    if (better)
        *best = other;
    return done;
}

bool sp_find_fewest(const sp_search *search, sp_pool_gains *gains, const sp_partial *greedy, double budget,
                    sp_deadline *deadline, sp_front *front, sp_error *error)
{
    sp_partial partial;
    if (!sp_partial_create(search, &partial, error))
        return false;
    bool done = true;
    for (size_t number = 1; done && number < front->best.count && sp_deadline_goes_on(deadline, "front", 1); number++)
        done = add_one(search, gains, greedy, number, budget, deadline, &partial, error) &&
               sp_front_measure(front, search, &partial, NULL, error);
    sp_partial_free(&partial);
    return done;
}
