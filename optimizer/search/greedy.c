#include "search/greedy.h"

#include "ranking/ranking.h"
#include "ranks/messages.h"
#include "scoring/bodies.h"
#include "scoring/strided.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

#define GAIN_LEAST 1e-6   /* of the area: less is no reason for a nozzle */
#define POOL_PER_ROUND 64 /* best mounting points of a round whose poses are remembered */
#define BATCH 16          /* mounting points that each thread scans between two looks at the clock, at most */
#define BATCH_HURRIED 4   /* the same where time is short */
#define RANK_THREADS 16   /* that a rank is taken to have */

/* The best pose of one mounting point and variant in this round. */
typedef struct {
    sp_pose pose;
    double merit; /* gain per outlay^power; 0: none */
    double gain;
} sp_round_best;

typedef struct {
    const sp_search *search;
    double power, budget;
    double tie;          /* m² by which gains may differ that are equal */
    float *room;         /* [poses], what each could gain at most; INFINITY: not yet known */
    sp_round_best *best; /* [sites x variants] */
    int threads;
    sp_scorer *scorers; /* [threads] */
    bool started;
} sp_rounds;

static void forget_rooms(sp_rounds *rounds)
{
    for (size_t i = 0; i < rounds->search->candidates->pose_start[rounds->search->sites->count]; i++)
        rounds->room[i] = INFINITY;
}

/* Credit is for what later nozzles complete: the last one gets none. */
static bool is_last(const sp_search *search, const sp_partial *partial)
{
    return search->options->max_nozzles && search->kept_count + partial->count + 1 >= search->options->max_nozzles;
}

static bool rounds_create(const sp_search *search, double power, double budget, sp_rounds *rounds, sp_error *error)
{
    size_t sites = search->sites->count, poses = search->candidates->pose_start[sites];
    *rounds = (sp_rounds){.search = search,
                          .power = power,
                          .budget = budget,
                          .tie = SP_SCORE_TIE * search->all,
                          .threads = sp_scorer_threads(search)};
    rounds->room = malloc((poses ? poses : 1) * sizeof *rounds->room);
    rounds->best = calloc(sites, search->candidates->variant_count * sizeof *rounds->best);
    if (!rounds->room || !rounds->best)
        return sp_fail_memory(error);
    forget_rooms(rounds);
    rounds->scorers = sp_scorers_create(search, rounds->threads, error);
    return rounds->scorers;
}

static void rounds_free(sp_rounds *rounds)
{
    free(rounds->room);
    free(rounds->best);
    sp_scorers_destroy(rounds->scorers, rounds->threads);
}

/* The poses of a variant that gained more than all before them, of those within a tie of the highest: the first of the
 * equals is always among them. Where there are more than fit, the last makes room. */
typedef struct {
    size_t count;
    struct {
        sp_pose pose;
        double gain;
    } step[16];
} sp_rise;

/* What a pose must gain more than to be noted. */
static double rise_least(const sp_rise *rise)
{
    return rise->count ? rise->step[rise->count - 1].gain : 0;
}

static void rise_note(sp_rise *rise, sp_pose pose, double gain, double tie)
{
    size_t kept = 0;
    if (gain <= rise_least(rise))
        return;
    for (size_t i = 0; i < rise->count; i++)
        if (rise->step[i].gain + tie >= gain)
            rise->step[kept++] = rise->step[i];
    if (kept == sizeof rise->step / sizeof *rise->step)
        kept--;
    rise->step[kept].pose = pose;
    rise->step[kept].gain = gain;
    rise->count = kept + 1;
}

/* Scores one site's poses of a variant but those that cannot beat `least`, a merit that some pose of this round has.
 * The scorer takes the variant where that is needed. */
static void scan_variant(sp_rounds *rounds, const sp_partial *partial, sp_scorer *scorer, uint32_t variant,
                         size_t number, double least)
{
    const sp_candidates *candidates = rounds->search->candidates;
    const sp_variant *own = &candidates->variants[variant];
    sp_round_best *best = &rounds->best[scorer->site * candidates->variant_count + variant];
    uint32_t mount = rounds->search->sites->items[scorer->site].mount;
    size_t axes = sp_candidates_axes(candidates, mount, variant)->count;
    double price = pow(sp_outlay_at(rounds->search, mount, own->flow), rounds->power);
    bool taken = false;
    sp_rise rise = {0};
    for (uint32_t a = 0; a < axes; a++)
        for (uint32_t r = 0; r < own->roll_count; r++, number++) {
            if ((double)rounds->room[number] * (1 + 1e-6) + rounds->tie < least * price)
                continue;
            if (!taken)
                sp_scorer_take(scorer, variant);
            taken = true;
            sp_score score = sp_scorer_score(scorer, a, r, rise_least(&rise));
            rounds->room[number] = (float)score.room;
            sp_pose pose = {scorer->site, variant, a, r};
            rise_note(&rise, pose, sp_gain_at(rounds->search, partial, pose, score.gain), rounds->tie);
        }
    if (rise.count)
        *best = (sp_round_best){rise.step[0].pose, rise.step[0].gain / price, rise.step[0].gain};
}

static void scan_site(sp_rounds *rounds, const sp_partial *partial, sp_scorer *scorer, uint32_t site, double least)
{
    const sp_candidates *candidates = rounds->search->candidates;
    uint32_t mount = rounds->search->sites->items[site].mount;
    for (size_t k = 0; k < candidates->variant_count; k++)
        rounds->best[site * candidates->variant_count + k] = (sp_round_best){0};
    if (!sp_partial_has_place(rounds->search, partial, mount))
        return;
    for (size_t s = 0; s < candidates->launch_count; s++) {
        size_t number = candidates->pose_start[site];
        sp_scorer_look(scorer, rounds->search, partial, site, s);
        for (size_t k = 0; k < candidates->variant_count; k++) {
            const sp_variant *variant = &candidates->variants[k];
            if (variant->launch == s && sp_partial_affords(rounds->search, partial, mount, k, rounds->budget) &&
                sp_body_clear(rounds->search, partial,
                              sp_pose_body(rounds->search, &(sp_pose){.site = site, .variant = (uint32_t)k})))
                scan_variant(rounds, partial, scorer, (uint32_t)k, number, least);
            number += sp_candidates_axes(candidates, mount, k)->count * variant->roll_count;
        }
    }
}

static sp_ranks *ranks_of(const sp_rounds *rounds)
{
    return rounds->search->options->run.ranks;
}

/* A merit that this round surely reaches: that of the last round's best poses, scored again, each rank those of its own
 * sites. */
static double round_floor(sp_rounds *rounds, const sp_partial *partial)
{
    const sp_search *search = rounds->search;
    size_t count = search->sites->count * search->candidates->variant_count;
    double least = 0;
    int threads = rounds->threads;
#pragma omp parallel for num_threads(threads) schedule(dynamic, 16) reduction(max : least)
    for (size_t i = 0; i < count; i++) {
        const sp_round_best *best = &rounds->best[i];
        if (best->merit <= 0 || !sp_ranks_mine(ranks_of(rounds), best->pose.site))
            continue;
        uint32_t mount = search->sites->items[best->pose.site].mount;
        if (!sp_partial_affords(search, partial, mount, best->pose.variant, rounds->budget) ||
            !sp_partial_has_place(search, partial, mount) ||
            !sp_body_clear(search, partial, sp_pose_body(search, &best->pose)))
            continue;
        sp_scorer *scorer = &rounds->scorers[omp_get_thread_num()];
        double gain =
            sp_gain_at(search, partial, best->pose, sp_score_pose(scorer, search, partial, best->pose, 0).gain);
        least = fmax(least, gain / sp_merit_price(search, &best->pose, rounds->power));
    }
    return least;
}

/* The best poses of the others' sites. */
static bool share_bests(sp_rounds *rounds, sp_error *error)
{
    size_t variants = rounds->search->candidates->variant_count, count = rounds->search->sites->count * variants;
    sp_outgoing outgoing = {0};
    sp_gathered gathered;
    for (size_t i = 0; i < count; i++)
        if (sp_ranks_mine(ranks_of(rounds), i / variants))
            sp_pack(&outgoing, &rounds->best[i], sizeof rounds->best[i]);
    if (!sp_ranks_gather(ranks_of(rounds), "round", &outgoing, &gathered, error))
        return false;
    for (size_t i = 0; i < count; i++)
        if (!sp_ranks_mine(ranks_of(rounds), i / variants))
            sp_unpack(&gathered, sp_ranks_owner(ranks_of(rounds), i / variants), &rounds->best[i],
                      sizeof rounds->best[i]);
    sp_gathered_free(&gathered);
    return true;
}

static double highest_merit(const sp_rounds *rounds)
{
    size_t count = rounds->search->sites->count * rounds->search->candidates->variant_count;
    double most = 0;
    for (size_t i = 0; i < count; i++)
        most = fmax(most, rounds->best[i].merit);
    return most;
}

/* Out of time a round ends with what it has come to, but not before there is a nozzle to show. */
static bool scans_on(const sp_rounds *rounds, const sp_partial *partial, double done, sp_deadline *deadline)
{
    if (sp_deadline_goes_on(deadline, "greedy", done))
        return true;
    double shown = partial->count ? 1 : highest_merit(rounds);
    return !deadline->cancelled && sp_ranks_highest(ranks_of(rounds), "shown", &shown, 1, NULL) && !(shown > 0);
}

/* Mounting points to scan before the next look at the clock, once so many are scanned: where time is out already no
 * more than all have threads for. */
static size_t next_batch(const sp_rounds *rounds, size_t scanned)
{
    const sp_run *run = &rounds->search->options->run;
    size_t ranks = sp_ranks_count(run->ranks);
    /* ranks look at the clock together, whatever number of threads each of them has */
    size_t all = ranks > 1 ? RANK_THREADS * ranks : (size_t)rounds->threads;
    size_t most = (sp_run_hurries(run) ? BATCH_HURRIED : BATCH) * all;
    return scanned < all ? all : scanned < most ? scanned : most;
}

/* Each rank scans its own sites, whose rooms it alone knows. */
static bool scan(sp_rounds *rounds, const sp_partial *partial, double done, sp_deadline *deadline, sp_error *error)
{
    double least = rounds->started ? round_floor(rounds, partial) : 0;
    if (!sp_ranks_highest(ranks_of(rounds), "floor", &least, 1, error))
        return false;
    rounds->started = true;
    size_t sites = rounds->search->sites->count;
    memset(rounds->best, 0, sites * rounds->search->candidates->variant_count * sizeof *rounds->best);
    int threads = rounds->threads;
    for (size_t first = 0, end; first < sites && (!first || scans_on(rounds, partial, done, deadline)); first = end) {
        size_t batch = next_batch(rounds, first);
        end = first + batch < sites ? first + batch : sites;
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1)
        for (size_t i = first; i < end; i++) {
            size_t site = sp_strided(i, sites);
            if (sp_ranks_mine(ranks_of(rounds), site))
                scan_site(rounds, partial, &rounds->scorers[omp_get_thread_num()], (uint32_t)site, least);
        }
    }
    sp_scorers_forget(rounds->scorers, rounds->threads);
    return share_bests(rounds, error);
}

/* Of the first round every site's and variant's best is remembered, of later ones the best few. */
static bool remember(const sp_rounds *rounds, bool first, sp_pool *pool, sp_error *error)
{
    size_t count = rounds->search->sites->count * rounds->search->candidates->variant_count;
    sp_ranked *sorted = malloc(count * sizeof *sorted);
    if (!sorted)
        return sp_fail_memory(error);
    size_t found = 0;
    for (size_t i = 0; i < count; i++)
        if (rounds->best[i].merit > 0)
            sorted[found++] = (sp_ranked){rounds->best[i].merit, i};
    sp_rank_falling_ties(sorted, found, SP_SCORE_TIE);
    bool done = true;
    for (size_t i = 0; done && i < found && (first || i < POOL_PER_ROUND); i++)
        done = sp_pool_add(pool, rounds->best[sorted[i].at].pose, error);
    free(sorted);
    return done;
}

static const sp_round_best *round_best(const sp_rounds *rounds)
{
    size_t count = rounds->search->sites->count * rounds->search->candidates->variant_count;
    double most = highest_merit(rounds);
    for (size_t i = 0; most > 0 && i < count; i++) {
        const sp_round_best *best = &rounds->best[i];
        if (best->merit > 0 &&
            best->gain + rounds->tie >= most * sp_merit_price(rounds->search, &best->pose, rounds->power))
            return best;
    }
    return &rounds->best[0];
}

bool sp_greedy(const sp_search *search, double power, double target, double budget, sp_deadline *deadline,
               sp_partial *partial, sp_pool *pool, sp_error *error)
{
    sp_rounds rounds;
    double least = GAIN_LEAST * search->all;
    bool done = rounds_create(search, power, budget, &rounds, error);
    bool first = true;
    sp_search exact = *search;
    exact.credit = 0;
    /* out of time there is at least one nozzle to show */
    while (done && partial->covered < target &&
           (sp_deadline_goes_on(deadline, "greedy", fmin(1, partial->covered / target)) ||
            (first && !partial->count && !deadline->cancelled))) {
        if (is_last(search, partial) && rounds.search != &exact) {
            rounds.search = &exact;
            forget_rooms(&rounds);
        }
        done = scan(&rounds, partial, fmin(1, partial->covered / target), deadline, error);
        const sp_round_best *best = round_best(&rounds);
        if (!done || best->merit <= 0 || best->gain < least)
            break;
        done = remember(&rounds, first, pool, error) && sp_partial_add_pose(search, partial, best->pose, error);
        first = false;
    }
    rounds_free(&rounds);
    sp_pool_settle(pool);
    return done;
}

bool sp_greedy_pool(const sp_search *search, sp_pool_gains *gains, double power, double target, double budget,
                    sp_partial *partial, sp_error *error)
{
    double least = GAIN_LEAST * search->all;
    bool done = true;
    while (done && partial->covered < target) {
        sp_pose pose;
        double gain;
        done = sp_pool_best(search, gains, partial, power, budget, &pose, &gain, error);
        if (!done || gain < least)
            break;
        done = sp_partial_add_pose(search, partial, pose, error);
    }
    return done;
}
