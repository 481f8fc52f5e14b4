#include "refine/refine.h"

#include "mesh/grow.h"

#include "ranking.h"

#include "search/guess.h"
#include "refine/polish.h"

#include <stdlib.h>

#define FLOW_TRIALS 7     /* measurements to find how far the flow can be turned down */
#define GAIN_LEAST 1e-4   /* of area or water: less is no improvement */
#define MISSING_MOST 0.03 /* of the target: more, refinement is not expected to make up for */
#define BATCH 8           /* walks from one draft at a time; fixed, so that the answer does not depend on the threads */
#define BATCHES 2         /* before less water is given up */
#define SAVINGS 3
#define SAVING 0.015    /* less water than the best draft, so many times, for another */
#define MISJUDGED 0.003 /* of what is covered: by so much the search's patches may rank drafts wrongly */
#define BETWEEN 0.05    /* less water than a draft of the front, for another */
#define APART 0.02      /* share by which waters must differ for that */
#define NEAR 0.006      /* of the target: what may be missing for a draft to be near it */
#define NEAR_MOST 5     /* drafts near it that are tried */
#define LEEWAY 0.03     /* more water that such a draft may take */

#define RUNGS 12          /* amounts of water for which other drafts are looked for in a hurry */
#define RUNG 0.95         /* of each, the next */
#define RUNG_FIRST 1.4    /* of what the first draft takes, which does not reach the target */
#define RUNGS_TRIED 4     /* of the drafts found for these, that are polished */
#define PROMISING 0.012   /* of the target: what may be missing for that */
#define CLOSE 0.004       /* the same for the last polish */
#define CLOSEST 2         /* drafts so close that have it at a time */
#define MISSING_COST 15.0 /* share of the water that makes up for what is missing, per share of the target */
#define WALKS 6           /* from the closest */
#define SAVED_LEAST 0.005 /* of the best draft's water, by what is to be better */

#define SHARP_ROUNDS 3    /* of the last polish */
#define SHARP_SAVING 2e-3 /* less water, for another round */
typedef struct {
    const sp_search *search;
    const sp_pool *pool;
    sp_watch *watch;
    sp_front *front;
    sp_polishing polishing;
    uint64_t seeds; /* used so far */
    sp_error *error;
} sp_refining;

/* Trials in the making. */
typedef struct {
    size_t count, capacity;
    sp_trial *items;
} sp_trials;

static void trials_free(sp_trials *trials)
{
    for (size_t i = 0; i < trials->count; i++) {
        sp_draft_free(&trials->items[i].draft);
        sp_draft_free(&trials->items[i].other);
    }
    free(trials->items);
    *trials = (sp_trials){0};
}

static bool try_also(sp_refining *refining, sp_trials *trials, const sp_draft *draft, double budget, sp_trial_kind kind)
{
    if (!sp_grow(&trials->items, &trials->capacity, trials->count + 1, sizeof *trials->items))
        return sp_fail_memory(refining->error);
    sp_trial *trial = &trials->items[trials->count];
    *trial = (sp_trial){.kind = kind, .seed = ++refining->seeds, .budget = fmin(budget, refining->search->outlay_most)};
    if (!sp_draft_copy(refining->search, draft, &trial->draft, refining->error))
        return false;
    trials->count++;
    return true;
}

/* Whether the final patches may see the draft on the front: none of no more water covers clearly more on the search's.
 */
static bool may_count(const sp_front *front, const sp_draft *draft)
{
    for (size_t i = 0; i < front->by_water.count && front->by_water.entries[i].point.outlay <= draft->outlay; i++)
        if (front->by_water.entries[i].draft.covered > draft->covered * (1 + MISJUDGED))
            return false;
    return true;
}

/* Polishes the trials and lets the front have them. *best, where not NULL, becomes a copy of the one that covers most,
 * if that is more than it does itself. */
static bool carry_out(sp_refining *refining, sp_trials *trials, sp_draft *best)
{
    const sp_search *search = refining->search;
    bool done = sp_polish(&refining->polishing, trials->items, trials->count, refining->error);
    for (size_t i = 0; done && i < trials->count; i++) {
        sp_draft *draft = &trials->items[i].draft;
        if (!trials->items[i].better || !may_count(refining->front, draft))
            continue;
        done = sp_front_measure(refining->front, search, draft, NULL, refining->error);
        if (done && best && sp_covers_more(search, draft, best)) {
            sp_draft copy;
            done = sp_draft_copy(search, draft, &copy, refining->error);
            if (done) {
                sp_draft_free(best);
                *best = copy;
            }
        }
    }
    return done;
}

/* Every draft of the front once more. */
static bool try_front(sp_refining *refining, sp_trials *trials)
{
    const sp_front *front = refining->front;
    for (size_t i = 0; i < front->by_water.count; i++)
        if (sp_front_counts(front, i) && !try_also(refining, trials, &front->by_water.entries[i].draft,
                                                   front->by_water.entries[i].point.outlay, SP_TRIAL_POLISH))
            return false;
    return true;
}

static bool on_water_front(const sp_front *front, const sp_front_point *point)
{
    for (size_t i = 0; i < front->by_water.count; i++)
        if (front->by_water.entries[i].point.outlay == point->outlay &&
            front->by_water.entries[i].point.area == point->area)
            return true;
    return false;
}

/* Those that cover most with fewer nozzles than the best has and take more water than others that cover as much. */
static bool try_fewest(sp_refining *refining, sp_trials *trials)
{
    const sp_front *front = refining->front;
    for (size_t i = 0; i < front->by_number.count; i++) {
        const sp_front_entry *entry = &front->by_number.entries[i];
        if (entry->draft.count && entry->draft.count < front->best.count && !on_water_front(front, &entry->point) &&
            !try_also(refining, trials, &entry->draft, entry->point.outlay, SP_TRIAL_POLISH))
            return false;
    }
    return true;
}

/* A trial of another draft for so much water, to be better than what the front has for no more. */
static bool ask_other(sp_refining *refining, sp_trials *trials, double outlay)
{
    const sp_front *front = refining->front;
    size_t i = 0;
    while (i + 1 < front->by_water.count && front->by_water.entries[i + 1].point.outlay <= outlay * (1 + SP_ROUNDING))
        i++;
    return try_also(refining, trials, &front->by_water.entries[i].draft, outlay, SP_TRIAL_OTHER);
}

/* Trials of other drafts for the water of every draft of the front, `between` also for a little less, where the front
 * has none, and for that of the scene's own layout, with which the proposal will be compared. The drafts are still to
 * be found. */
static bool ask_others(sp_refining *refining, sp_trials *trials, bool between)
{
    const sp_front *front = refining->front;
    double own = sp_own_outlay(refining->search);
    for (size_t i = 0; i < front->by_water.count; i++) {
        double outlay = front->by_water.entries[i].point.outlay, less = outlay * (1 - BETWEEN);
        if (!sp_front_counts(front, i))
            continue;
        if (between && front->by_water.entries[i].draft.count > 1 &&
            less > front->by_water.entries[i - 1].point.outlay * (1 + APART) && !ask_other(refining, trials, less))
            return false;
        if (!ask_other(refining, trials, outlay))
            return false;
    }
    return own <= 0 || ask_other(refining, trials, own);
}

/* The same for a little less water than the best draft takes. */
static bool ask_savings(sp_refining *refining, sp_trials *trials)
{
    for (int i = 1; i <= SAVINGS; i++)
        if (!ask_other(refining, trials, refining->front->best.outlay * (1 - SAVING * i)))
            return false;
    return true;
}

/* All nozzles of the front's drafts; NULL when memory runs out. */
static const sp_placed **list_nozzles(const sp_front *front, size_t *count)
{
    size_t total = 0;
    for (size_t i = 0; i < front->by_water.count; i++)
        total += front->by_water.entries[i].draft.count;
    const sp_placed **nozzles = malloc((total + 1) * sizeof *nozzles);
    *count = 0;
    for (size_t i = 0; nozzles && i < front->by_water.count; i++)
        for (size_t n = 0; n < front->by_water.entries[i].draft.count; n++)
            nozzles[(*count)++] = &front->by_water.entries[i].draft.items[n];
    return nozzles;
}

/* The trials' other drafts: of the pool at the flows that refinement may set, and of nozzles that the front's drafts
 * have already, put together anew. */
static bool find_others(sp_refining *refining, sp_trials *trials)
{
    const sp_tuned *tuned = &refining->polishing.tuned;
    size_t count = trials->count, nozzle_count;
    double *budgets = malloc((count + 1) * sizeof *budgets);
    sp_lineup *lineups = calloc(count + 1, sizeof *lineups);
    const sp_placed **nozzles = list_nozzles(refining->front, &nozzle_count);
    sp_table table = {0};
    bool done = (budgets && lineups && nozzles) || sp_fail_memory(refining->error);
    for (size_t i = 0; done && i < count; i++)
        budgets[i] = trials->items[i].budget * (1 + SP_ROUNDING);
    done = done && sp_table_create(&tuned->search, &tuned->pool, nozzles, nozzle_count, &table, refining->error) &&
           sp_guess(&table, budgets, count, refining->watch, lineups, refining->error);
    for (size_t i = 0; done && i < count; i++)
        done = sp_lineup_draft(&lineups[i], &trials->items[i].other, refining->error);
    for (size_t i = 0; lineups && i < count; i++)
        sp_lineup_free(&lineups[i]);
    free(budgets);
    free(lineups);
    free(nozzles);
    sp_table_free(&table);
    return done;
}

/* Drops the trials whose other draft covers no more than what they hold. */
static void drop_others(sp_trials *trials)
{
    size_t kept = 0;
    for (size_t i = 0; i < trials->count; i++) {
        sp_trial *trial = &trials->items[i];
        if (trial->other.covered > trial->draft.covered * (1 + GAIN_LEAST)) {
            trials->items[kept++] = *trial;
            continue;
        }
        sp_draft_free(&trial->draft);
        sp_draft_free(&trial->other);
    }
    trials->count = kept;
}

/* Every draft of the front, and others in their places and between. */
static bool polish_front(sp_refining *refining)
{
    sp_trials trials = {0};
    bool done = ask_others(refining, &trials, true) && find_others(refining, &trials) && try_front(refining, &trials) &&
                try_fewest(refining, &trials) && carry_out(refining, &trials, NULL);
    trials_free(&trials);
    return done;
}

/* What the drafts of the front have in common, they give to one another. */
static bool recombine_front(sp_refining *refining)
{
    sp_trials trials = {0};
    bool done =
        ask_others(refining, &trials, false) && ask_savings(refining, &trials) && find_others(refining, &trials);
    if (done)
        drop_others(&trials);
    done = done && carry_out(refining, &trials, NULL);
    trials_free(&trials);
    return done;
}

static bool same(const sp_front_point *a, const sp_front_point *b)
{
    return fabs(a->area - b->area) <= GAIN_LEAST * b->area && fabs(a->outlay - b->outlay) <= GAIN_LEAST * b->outlay;
}

/* Turns a draft's adjustable nozzles down while it reaches the target. */
static bool save_flow(sp_refining *refining, const sp_draft *full)
{
    const sp_search *search = refining->search;
    sp_front *front = refining->front;
    double high = full->flow, low = search->kept_flow;
    for (size_t i = 0; i < full->count; i++)
        low += sp_least_flow(search, &full->items[i]);
    if (!(low < high * (1 - 1e-6)))
        return true;
    bool done = true;
    for (int trial = 0; done && trial < FLOW_TRIALS && sp_watch_goes_on(refining->watch, "refine", 1); trial++) {
        sp_draft draft;
        sp_front_point point;
        double middle = 0.5 * (low + high);
        done = sp_draft_copy(search, full, &draft, refining->error);
        if (!done)
            break;
        sp_turn_down(search, &draft, middle);
        done = sp_look_anew(&refining->polishing, &draft, refining->error) &&
               sp_front_measure(front, search, &draft, &point, refining->error);
        sp_draft_free(&draft);
        if (done && point.area >= front->target)
            high = middle;
        else
            low = middle;
    }
    return done;
}

/* Anneals a draft and walks from it once, on two cores, then polishes what more walks from it find, until the front has
 * one that takes less water than `before` and reaches the target, or it is given up. */
static bool insist(sp_refining *refining, sp_draft *draft, double budget, const sp_front_point *before)
{
    sp_front *front = refining->front;
    bool done = true;
    for (int batch = 0; done && batch <= BATCHES && same(before, &front->measured); batch++) {
        double missing = front->target - front->bias - draft->covered;
        if (missing > MISSING_MOST * front->target || !sp_watch_goes_on(refining->watch, "refine", 0))
            break;
        sp_trials trials = {0};
        for (size_t i = 0; done && i < (batch ? BATCH : 2); i++)
            done = try_also(refining, &trials, draft, budget, batch || i ? SP_TRIAL_WALK : SP_TRIAL_ANNEAL);
        done = done && carry_out(refining, &trials, draft);
        trials_free(&trials);
    }
    return done;
}

/* Less water by the share given: exchange within it, then refine to make up for what is missing. *saved says whether
 * the best draft got better. */
static bool save_share(sp_refining *refining, double share, bool *saved)
{
    sp_front *front = refining->front;
    sp_front_point before = front->measured;
    double budget = front->best.outlay * (1 - share);
    sp_draft reduced;
    bool found;
    *saved = false;
    if (!sp_reduce(refining->search, refining->pool, &front->best, budget, front->target - front->bias, refining->watch,
                   &reduced, &found, refining->error))
        return false;
    if (!found)
        return true;
    bool done = sp_front_measure(front, refining->search, &reduced, NULL, refining->error) &&
                insist(refining, &reduced, budget, &before);
    sp_draft_free(&reduced);
    *saved = done && !same(&before, &front->measured);
    return done;
}

static bool save_water(sp_refining *refining)
{
    static const double shares[] = {0.06, 0.03};
    for (size_t i = 0; i < sizeof shares / sizeof *shares;) {
        bool saved = false;
        if (!refining->front->best.count || !sp_watch_goes_on(refining->watch, "refine", 0))
            return true;
        if (!save_share(refining, shares[i], &saved))
            return false;
        i += !saved;
    }
    return true;
}

/* The best once more, and drafts that all but reach the target with less water, on the final patches; those may take a
 * little more, if it is less than the best's. */
static bool sharpen(sp_refining *refining, bool saves, bool near)
{
    sp_front *front = refining->front;
    sp_trials trials = {0};
    bool done = try_also(refining, &trials, &front->best, front->best.outlay, SP_TRIAL_POLISH);
    for (size_t i = 0; near && done && i < front->by_water.count && trials.count <= NEAR_MOST; i++) {
        const sp_front_entry *entry = &front->by_water.entries[i];
        double budget = fmin(entry->point.outlay * (1 + LEEWAY), front->best.outlay);
        if (entry->point.outlay < front->best.outlay * (1 - GAIN_LEAST) && entry->point.area < front->target &&
            entry->point.area >= front->target * (1 - NEAR))
            done = try_also(refining, &trials, &entry->draft, budget, SP_TRIAL_POLISH);
    }
    done = done && sp_sharpen(&refining->polishing, trials.items, trials.count, refining->error);
    for (size_t i = 0; done && i < trials.count; i++) {
        sp_front_point point;
        done = sp_front_measure(front, refining->search, &trials.items[i].draft, &point, refining->error);
        if (done && saves && point.area >= front->target)
            done = save_flow(refining, &trials.items[i].draft);
    }
    trials_free(&trials);
    return done;
}

/* Until that saves no more water. */
static bool sharpen_often(sp_refining *refining, bool saves)
{
    double before = INFINITY;
    const sp_draft *best = &refining->front->best;
    for (int round = 0; round < SHARP_ROUNDS && best->outlay < before * (1 - SHARP_SAVING); round++) {
        before = best->outlay;
        if (!sharpen(refining, saves, saves && round == 0))
            return false;
    }
    return true;
}

static bool aims_at_target(const sp_front *front)
{
    return front->objective != SP_OBJECTIVE_MAX_COVERAGE;
}

/* Trials of other drafts for ever less water, from a little more than the best draft takes where that does not reach
 * the target; where as much as possible is to be covered, for what it takes alone. */
static bool ask_rungs(sp_refining *refining, sp_trials *trials)
{
    const sp_front *front = refining->front;
    double outlay = front->best.outlay;
    if (!aims_at_target(front))
        return ask_other(refining, trials, outlay);
    outlay *= front->measured.area >= front->target ? 1 : RUNG_FIRST;
    for (int i = 0; i < RUNGS; i++, outlay *= RUNG)
        if (!ask_other(refining, trials, outlay))
            return false;
    return true;
}

/* The water that a draft may take once it is refined to reach the target. */
static double outlay_at_target(const sp_front *front, double outlay, double area)
{
    return outlay * (1 + MISSING_COST * fmax(0, 1 - area / front->target));
}

/* Keeps those few that promise to reach the target with least water; all where there are no more. */
static bool keep_promising(const sp_refining *refining, sp_trials *trials)
{
    const sp_front *front = refining->front;
    size_t count = trials->count;
    sp_ranked *ranked = malloc((count + 1) * sizeof *ranked);
    if (!ranked)
        return sp_fail_memory(refining->error);
    for (size_t i = 0; i < count; i++) {
        const sp_draft *other = &trials->items[i].other;
        bool promising = other->covered >= front->target * (1 - PROMISING);
        ranked[i] = (sp_ranked){promising ? outlay_at_target(front, other->outlay, other->covered) : INFINITY, i};
    }
    sp_rank_rising(ranked, count);
    for (size_t k = RUNGS_TRIED; k < count; k++) {
        sp_trial *trial = &trials->items[ranked[k].at];
        sp_draft_free(&trial->draft);
        sp_draft_free(&trial->other);
        trial->budget = -1;
    }
    trials->count = 0;
    for (size_t i = 0; i < count; i++)
        if (trials->items[i].budget >= 0)
            trials->items[trials->count++] = trials->items[i];
    free(ranked);
    return true;
}

/* The drafts of the front that are close to the target or reach it, and that which covers most, by the water they may
 * take there; malloc'd, the caller frees. NULL when memory runs out. */
static sp_ranked *rank_close(const sp_front *front, size_t *count)
{
    const sp_front_list *list = &front->by_water;
    sp_ranked *ranked = malloc((list->count + 1) * sizeof *ranked);
    *count = 0;
    for (size_t i = 0; ranked && i < list->count; i++) {
        const sp_front_point *point = &list->entries[i].point;
        bool close = aims_at_target(front) && point->area >= front->target * (1 - CLOSE);
        if (close || i + 1 == list->count)
            ranked[(*count)++] = (sp_ranked){outlay_at_target(front, point->outlay, point->area), i};
    }
    if (ranked)
        sp_rank_rising(ranked, *count);
    return ranked;
}

/* Walks from the closest drafts, by turns. */
static bool walk_closest(sp_refining *refining)
{
    sp_trials trials = {0};
    size_t count;
    sp_ranked *ranked = rank_close(refining->front, &count);
    bool done = ranked || sp_fail_memory(refining->error);
    size_t turns = count < CLOSEST ? count : CLOSEST;
    for (size_t k = 0; done && turns && k < WALKS; k++) {
        const sp_front_entry *entry = &refining->front->by_water.entries[ranked[k % turns].at];
        done = try_also(refining, &trials, &entry->draft, entry->point.outlay * (1 + LEEWAY), SP_TRIAL_WALK);
    }
    free(ranked);
    done = done && carry_out(refining, &trials, NULL);
    trials_free(&trials);
    return done;
}

/* Trials of the closest drafts for the water that they may take at the target, if that is less than the best's. */
static bool try_closest(sp_refining *refining, sp_trials *trials)
{
    const sp_front *front = refining->front;
    bool saves = aims_at_target(front) && front->measured.area >= front->target;
    double most = saves ? front->measured.outlay * (1 - SAVED_LEAST) : INFINITY;
    size_t count;
    sp_ranked *ranked = rank_close(front, &count);
    bool done = ranked || sp_fail_memory(refining->error);
    for (size_t k = count < CLOSEST ? count : CLOSEST; done && k-- > 0;) {
        const sp_front_entry *entry = &front->by_water.entries[ranked[k].at];
        double outlay = aims_at_target(front) ? ranked[k].merit : entry->point.outlay;
        done = try_also(refining, trials, &entry->draft, fmin(outlay, most), SP_TRIAL_POLISH);
    }
    free(ranked);
    return done;
}

/* The closest drafts on the final patches. */
static bool sharpen_closest(sp_refining *refining)
{
    sp_front *front = refining->front;
    sp_trials trials = {0};
    bool done =
        try_closest(refining, &trials) && sp_sharpen(&refining->polishing, trials.items, trials.count, refining->error);
    for (size_t i = 0; done && i < trials.count; i++) {
        sp_front_point point;
        done = sp_front_measure(front, refining->search, &trials.items[i].draft, &point, refining->error);
        if (done && aims_at_target(front) && point.area >= front->target)
            done = save_flow(refining, &trials.items[i].draft);
    }
    trials_free(&trials);
    return done;
}

/* Other drafts for ever less water, as long as that gains; at first without walks, so that there soon is something. */
static bool refine_first(sp_refining *refining)
{
    const sp_front *front = refining->front;
    bool gained = true;
    for (int pass = 0; gained && sp_watch_goes_on(refining->watch, "refine", 0); pass++) {
        sp_front_point before = front->measured;
        sp_trials trials = {0};
        bool done = ask_rungs(refining, &trials) && find_others(refining, &trials) &&
                    keep_promising(refining, &trials) && carry_out(refining, &trials, NULL);
        trials_free(&trials);
        if (!done || (pass && !walk_closest(refining)) || !sharpen_closest(refining))
            return false;
        gained = pass == 0 || !same(&before, &front->measured);
    }
    bool saves = aims_at_target(front) && front->measured.area >= front->target;
    return !saves || (save_water(refining) && sharpen_closest(refining));
}

static bool refine_all(sp_refining *refining)
{
    const sp_front *front = refining->front;
    if (!polish_front(refining))
        return false;
    bool saves = front->objective != SP_OBJECTIVE_MAX_COVERAGE && front->measured.area >= front->target;
    return recombine_front(refining) && (!saves || save_water(refining)) && recombine_front(refining) &&
           sharpen_often(refining, saves);
}

bool sp_refine_asked(const sp_refine *refine)
{
    return refine->position != 0 || refine->axis != 0 || refine->roll || refine->angle != 0 || refine->flow != 0;
}

typedef bool (*refine_step)(sp_refining *refining);

static bool run(const sp_search *search, const sp_pool *pool, sp_watch *watch, sp_front *front, refine_step step,
                sp_error *error)
{
    if (!sp_refine_asked(&search->options->refine) || !sp_watch_goes_on(watch, "refine", 0))
        return true;
    sp_refining refining = {.search = search, .pool = pool, .watch = watch, .front = front, .error = error};
    if (!sp_polishing_create(search, pool, front->fine, watch, &refining.polishing, error))
        return false;
    bool done = step(&refining);
    sp_polishing_free(&refining.polishing);
    return done;
}

bool sp_refine_first(const sp_search *search, const sp_pool *pool, sp_watch *watch, sp_front *front, sp_error *error)
{
    return run(search, pool, watch, front, refine_first, error);
}

bool sp_refine_best(const sp_search *search, const sp_pool *pool, sp_watch *watch, sp_front *front, sp_error *error)
{
    return run(search, pool, watch, front, refine_all, error);
}
