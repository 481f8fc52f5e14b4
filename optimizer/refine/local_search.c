#include "refine/local_search.h"

#include "scoring/prepare.h"
#include "refine/compass.h"
#include "refine/dealt_trials.h"
#include "scoring/scoring.h"
#include "search/simulated_annealing.h"

#include <omp.h>
#include <stdlib.h>

#define ROUGH_PATCHES 4000.0  /* most of the local search sees no more than these show */
#define SHARP_PATCHES 60000.0 /* the last of it sees the final patches, or so many */
#define FILM_PATCHES 20000.0  /* or where film is asked for so many */
#define SIGHTS 24             /* kept for each thread */
#define STEP_FIRST 0.25       /* of half an unknown's range, of the compass */
#define STEP_SHARP 0.12
#define STEP_TURN 0.045 /* small enough for places to stay */
#define STEP_LEAST 0.006
#define SHARP_START 4   /* width at which the last local search starts */
#define KEEPS_UP 0.002  /* of what is covered, by which few patches may mislead */
#define ANNEALING 1e8   /* patches that simulated annealing goes through */
#define GAIN_LEAST 1e-5 /* of what is covered: less is no improvement */
#define BEHIND_MOST                                                                                                    \
    0.005 /* of what was covered before: with more to make up for, continuation is the end of it                       \
           */

static bool sights_create(const sp_search *search, int threads, bool exact, sp_sights **sights, sp_error *error)
{
    *sights = calloc(threads > 0 ? (size_t)threads : 1, sizeof **sights);
    if (!*sights)
        return sp_fail_memory(error);
    for (int i = 0; i < threads; i++)
        if (!sp_sights_create(search, SIGHTS, exact, &(*sights)[i], error))
            return false;
    return true;
}

static void sights_free(sp_sights *sights, int threads)
{
    for (int i = 0; sights && i < threads; i++)
        sp_sights_free(&sights[i]);
    free(sights);
}

void sp_local_search_free(sp_local_search *local)
{
    sights_free(local->sights, local->threads);
    sights_free(local->rough_sights, local->threads);
    sights_free(local->sharp_sights, local->threads);
    if (local->sharp.coarse)
        sp_search_free(&local->sharp);
    sp_evaluator_destroy(local->sharp_evaluator);
    if (local->rough_evaluator)
        sp_search_free(&local->rough);
    sp_evaluator_destroy(local->rough_evaluator);
    sp_tuned_free(&local->tuned);
    *local = (sp_local_search){0};
}

/* The search on the final patches. */
static bool create_sharp(sp_local_search *local, const sp_evaluator *fine, sp_error *error)
{
    const sp_search *search = local->search;
    double texel = sp_evaluator_fidelity(fine)->texel, most = search->runoffs ? FILM_PATCHES : SHARP_PATCHES;
    double coarser = sqrt((double)sp_evaluator_patches(fine)->count / most);
    const sp_evaluator *sharp = fine;
    if (search->runoffs || coarser > sqrt(1.5))
        sharp = local->sharp_evaluator = sp_evaluator_resample(fine, texel * fmax(1, coarser), error);
    return sharp &&
           sp_search_create(sharp, search->options, search->sites, search->candidates, search->visibility,
                            &local->sharp, error) &&
           sights_create(&local->sharp, local->threads, false, &local->sharp_sights, error);
}

bool sp_local_search_create(const sp_search *search, const sp_pool *pool, const sp_evaluator *fine,
                            sp_deadline *deadline, sp_local_search *local, sp_error *error)
{
    const sp_patches *patches = sp_evaluator_patches(search->coarse);
    *local = (sp_local_search){
        .search = search, .deadline = deadline, .rough = *search, .threads = sp_threads(&search->options->run)};
    bool done = sp_tuned_create(search, pool, &local->tuned, error);
    if (done && (double)patches->count > 1.5 * ROUGH_PATCHES) {
        local->rough_evaluator = sp_evaluator_resample(
            fine, sp_evaluator_fidelity(search->coarse)->texel * sqrt((double)patches->count / ROUGH_PATCHES), error);
        done = local->rough_evaluator && sp_search_create(local->rough_evaluator, search->options, search->sites,
                                                          search->candidates, search->visibility, &local->rough, error);
    }
    done = done && create_sharp(local, fine, error) &&
           sights_create(search, local->threads, true, &local->sights, error) &&
           sights_create(&local->rough, local->threads, false, &local->rough_sights, error);
    if (!done)
        sp_local_search_free(local);
    return done;
}

/* The same nozzles on other patches, or on the same ones looked at anew. */
static bool transfer(sp_sights *sights, const sp_partial *from, sp_partial *to, sp_error *error)
{
    if (!sp_partial_create(sights->search, to, error))
        return false;
    bool done = true;
    for (size_t i = 0; done && i < from->count; i++) {
        sp_placed placed = from->items[i];
        placed.field = malloc((sights->search->field_count + 1) * sizeof *placed.field);
        if (!placed.field)
            done = sp_fail_memory(error);
        else if (sp_sights_field(sights, &placed, NULL, placed.field, error))
            done = sp_partial_add(sights->search, to, placed, error);
        else {
            free(placed.field);
            done = false;
        }
    }
    if (!done)
        sp_partial_free(to);
    return done;
}

static bool fits_within(const sp_search *search, const sp_partial *partial, double budget)
{
    return partial->flow <= sp_partial_water(search, partial, budget) * (1 + SP_ROUNDING);
}

/* Within the budget by turning nozzles down; false in *fits where that is not enough. */
static bool fit(sp_sights *sights, double budget, sp_partial *partial, bool *fits, sp_error *error)
{
    double water = sp_partial_water(sights->search, partial, budget);
    if (partial->flow > water) {
        sp_turn_down(sights->search, partial, water);
        if (!sp_partial_look(sights, partial, error))
            return false;
    }
    *fits = fits_within(sights->search, partial, budget);
    return true;
}

/* From ever wider starts: a narrow one keeps what is there; a wide one forgets it, and may find better. */
static bool continue_wider(const sp_local_search *local, sp_sights *sights, const sp_trial *trial, sp_partial *partial,
                           sp_error *error)
{
    static const size_t starts[SP_STARTS] = {3, 0};
    double water = sp_partial_water(local->search, partial, trial->budget);
    for (size_t i = 0; i < SP_STARTS; i++)
        if ((trial->kind == SP_TRIAL_CONTINUATION || i == trial->turn) &&
            !sp_continuation(sights, starts[i], SP_WIDTHS, water, local->deadline, partial, error))
            return false;
    return true;
}

/* What `start` becomes on few patches, if it keeps up with `before`. */
static bool refine(const sp_local_search *local, sp_sights *sights, const sp_trial *trial, double before,
                   const sp_partial *start, sp_partial *refined, sp_error *error)
{
    bool fits;
    if (!transfer(sights, start, refined, error))
        return false;
    double water = sp_partial_water(local->search, refined, trial->budget);
    bool done = fit(sights, trial->budget, refined, &fits, error);
    if (done && fits)
        done = continue_wider(local, sights, trial, refined, error) &&
               (refined->covered < before * (1 - BEHIND_MOST) ||
                sp_compass(sights, STEP_FIRST, STEP_LEAST, water, local->deadline, refined, error));
    if (!done)
        sp_partial_free(refined);
    return done;
}

/* What the trial covers on few patches before anything is done to it, within its budget; 0 where it cannot be that. */
static bool cover_before(sp_sights *sights, const sp_trial *trial, double *covered, sp_error *error)
{
    sp_partial partial;
    bool fits;
    if (!transfer(sights, &trial->partial, &partial, error))
        return false;
    bool done = fit(sights, trial->budget, &partial, &fits, error);
    *covered = done && fits ? partial.covered : 0;
    sp_partial_free(&partial);
    return done;
}

/* Anneals, where the trial is to begin so. */
static bool anneal(const sp_local_search *local, sp_trial *trial, sp_error *error)
{
    return trial->kind != SP_TRIAL_ANNEALING ||
           (sp_partial_copy(local->search, &trial->partial, &trial->start, error) &&
            sp_simulated_annealing(&local->tuned.search, trial->budget * (1 + SP_ROUNDING), ANNEALING, trial->seed,
                                   local->deadline, &trial->start, error));
}

static bool is_same(const sp_placed *a, const sp_placed *b)
{
    const sp_nozzle *m = &a->nozzle, *n = &b->nozzle;
    return m->type == n->type && sp_distance(m->position, n->position) == 0 && sp_distance(m->axis, n->axis) == 0 &&
           m->roll == n->roll && m->angle == n->angle && a->flow == b->flow && m->pressure == n->pressure &&
           a->site.mount == b->site.mount;
}

/* Nozzle by nozzle, as the order decides which is turned first. */
static bool are_same(const sp_partial *a, const sp_partial *b)
{
    bool same = a->count == b->count;
    for (size_t i = 0; same && i < a->count; i++)
        same = is_same(&a->items[i], &b->items[i]);
    return same;
}

/* The layout that a trial is refined from. */
static const sp_partial *start_of(const sp_trial *trial)
{
    bool other = trial->kind == SP_TRIAL_OTHER || trial->kind == SP_TRIAL_RUNNER_UP;
    return other ? &trial->other : trial->kind == SP_TRIAL_ANNEALING ? &trial->start : &trial->partial;
}

/* Annealed starts are known to their rank alone, which compares them with one another. */
static bool comes_to_the_same(const sp_search *search, const sp_trial *a, const sp_trial *b)
{
    const sp_partial *from = start_of(a);
    bool alike = a->turn == b->turn && (a->kind == SP_TRIAL_ANNEALING) == (b->kind == SP_TRIAL_ANNEALING) &&
                 (a->kind == SP_TRIAL_CONTINUATION) == (b->kind == SP_TRIAL_CONTINUATION);
    if (!alike || !from->count || !are_same(from, start_of(b)))
        return false;
    /* more water than its nozzles can be turned up to makes no difference to what it is refined to */
    return a->budget == b->budget || fmin(a->budget, b->budget) >= sp_turned_up(search, from) * (1 - SP_ROUNDING);
}

/* Whether all that makes a trial better by what it is refined to would make the other, too: against what it is held. */
static bool is_no_easier(const sp_trial *a, const sp_trial *b)
{
    return a->budget >= b->budget && a->partial.covered >= b->partial.covered;
}

/* Often annealing finds nothing and ends where it began, and another layout is one for several amounts of water. What
 * is refined alike from there comes to the same: once is enough, where least is asked of it. */
static void find_repeats(const sp_search *search, sp_trial *trials, size_t count)
{
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < i && !trials[i].repeats; k++) {
            if (trials[k].repeats || !comes_to_the_same(search, &trials[i], &trials[k]))
                continue;
            trials[i].repeats = is_no_easier(&trials[i], &trials[k]);
            trials[k].repeats = !trials[i].repeats && is_no_easier(&trials[k], &trials[i]);
        }
}

/* What the trial starts from. */
static bool begin(const sp_local_search *local, sp_trial *trial, sp_partial *start, sp_error *error)
{
    if (!sp_partial_copy(local->search, start_of(trial), start, error))
        return false;
    sp_tuned_settle(&local->tuned, start);
    return true;
}

/* The refined layout on the search's own patches, turned a little more on these, becomes the trial's. */
static bool take_over(const sp_local_search *local, sp_trial *trial, sp_error *error)
{
    sp_sights *sights = &local->sights[omp_get_thread_num()];
    sp_partial partial;
    sp_sights_forget(sights);
    if (!transfer(sights, &trial->refined, &partial, error))
        return false;
    double water = sp_partial_water(local->search, &partial, trial->budget);
    if (!sp_compass(sights, STEP_TURN, STEP_LEAST, water, local->deadline, &partial, error)) {
        sp_partial_free(&partial);
        return false;
    }
    sp_partial_free(&trial->partial);
    trial->partial = partial;
    return true;
}

static bool search_locally(const sp_local_search *local, sp_trial *trial, sp_error *error)
{
    sp_sights *sights = &local->rough_sights[omp_get_thread_num()];
    sp_partial start;
    double before;
    if (trial->repeats || !sp_deadline_goes_on(local->deadline, "refine", 0))
        return true;
    /* what was looked at before is another thread's luck */
    sp_sights_forget(sights);
    if (!cover_before(sights, trial, &before, error) || !begin(local, trial, &start, error))
        return false;
    bool done = refine(local, sights, trial, before, &start, &trial->refined, error);
    sp_partial_free(&start);
    if (!done)
        return false;
    trial->covered = trial->refined.covered;
    trial->better = fits_within(local->search, &trial->refined, trial->budget) &&
                    trial->refined.covered > before * (1 + GAIN_LEAST);
    return true;
}

/* It got better, and no other trial of the same water much more so: few patches do not tell more. */
static bool keeps_up(const sp_trial *trials, size_t count, size_t i)
{
    for (size_t k = 0; k < count; k++)
        if (trials[k].better && trials[k].budget == trials[i].budget &&
            trials[k].covered * (1 - KEEPS_UP) > trials[i].covered)
            return false;
    return trials[i].better;
}

bool sp_local_search_run(sp_local_search *local, sp_trial *trials, size_t count, sp_error *error)
{
    bool done = sp_trials_for_each(local, trials, count, false, anneal, error);
    find_repeats(local->search, trials, count);
    done = done && sp_trials_for_each(local, trials, count, false, search_locally, error) &&
           sp_trials_share_merits(local, trials, count, error);
    bool *keeps = calloc(count ? count : 1, sizeof *keeps);
    if (!keeps)
        done = sp_fail_memory(error);
    for (size_t i = 0; done && i < count; i++)
        keeps[i] = keeps_up(trials, count, i);
    for (size_t i = 0; done && i < count; i++)
        trials[i].better = keeps[i];
    free(keeps);
    done = done && sp_trials_for_each(local, trials, count, true, take_over, error) &&
           sp_trials_share_partials(local, trials, count, true, error);
    for (size_t i = 0; i < count; i++) {
        sp_partial_free(&trials[i].start);
        sp_partial_free(&trials[i].refined);
    }
    return done;
}

/* On the final patches, then as the search's own see it. */
static bool sharpen(const sp_local_search *local, sp_trial *trial, sp_error *error)
{
    sp_sights *sights = &local->sharp_sights[omp_get_thread_num()], *own = &local->sights[omp_get_thread_num()];
    sp_partial sharp, partial;
    sp_sights_forget(sights);
    sp_sights_forget(own);
    if (!transfer(sights, &trial->partial, &sharp, error))
        return false;
    double water = sp_partial_water(local->search, &sharp, trial->budget);
    bool done = sp_continuation(sights, SHARP_START, SP_WIDTHS, water, local->deadline, &sharp, error) &&
                sp_compass(sights, STEP_SHARP, STEP_LEAST, water, local->deadline, &sharp, error) &&
                transfer(own, &sharp, &partial, error);
    sp_partial_free(&sharp);
    if (!done)
        return false;
    sp_partial_free(&trial->partial);
    trial->partial = partial;
    return true;
}

bool sp_sharpen(sp_local_search *local, sp_trial *trials, size_t count, sp_error *error)
{
    return sp_trials_for_each(local, trials, count, false, sharpen, error) &&
           sp_trials_share_partials(local, trials, count, false, error);
}
