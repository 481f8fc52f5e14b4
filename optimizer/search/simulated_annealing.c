#include "search/simulated_annealing.h"

#include "scoring/bodies.h"

#include <assert.h>
#include <stdlib.h>

#define SITES 3          /* mounting points that are looked at for one nozzle, each with one variant */
#define POSES 24         /* of each */
#define MISSES 3         /* times that none of these gains, before a layout counts as full */
#define HOT 3e-3         /* of the area: the loss that is taken in one of e cases, at first */
#define COLD 1e-5        /* at last */
#define TWO_SHARE 0.3    /* of the steps, that take two nozzles out */
#define NEAR_SHARE 0.5   /* of the mounting points, that are the one a nozzle was taken from */
#define CREDIT_SHARE 0.7 /* of the steps, that give credit for what is on the way */
#define GAIN_LEAST 1e-6  /* of the area, for one more nozzle */
#define STEP_EFFORT 10   /* patches that a step goes through, per patch and nozzle */
#define STEPS_MOST 120   /* for each nozzle: on few patches a step takes as long as its poses do */

typedef struct {
    const sp_search *search; /* with the credit of now */
    double budget, area;
    uint64_t state;
    sp_scorer *scorer;
    sp_partial *partial;
    sp_error *error;
} sp_annealer;

/* SplitMix64: Steele, Lea and Flood, Fast splittable pseudorandom number generators, OOPSLA 2014. */
static double uniform(sp_annealer *annealer)
{
    uint64_t z = annealer->state += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static size_t draw(sp_annealer *annealer, size_t count)
{
    assert(count > 0);
    return (size_t)(uniform(annealer) * (double)count);
}

/* The best pose that one addition has looked at. */
typedef struct {
    sp_pose pose;
    double merit; /* gain per outlay^power; 0: none */
} sp_annealing_choice;

/* Some of the poses of one variant at one mounting point. */
static void look(sp_annealer *annealer, uint32_t site, uint32_t variant, double power, sp_annealing_choice *best)
{
    const sp_candidates *candidates = annealer->search->candidates;
    const sp_variant *own = &candidates->variants[variant];
    uint32_t mount = annealer->search->sites->items[site].mount;
    size_t poses = own->roll_count * sp_candidates_axes(candidates, mount, variant)->count;
    double price = pow(sp_outlay_at(annealer->search, mount, own->flow), power);
    for (size_t i = 0; i < POSES && i < poses; i++) {
        size_t at = poses > POSES ? draw(annealer, poses) : i;
        sp_pose pose = {site, variant, (uint32_t)(at / own->roll_count), (uint32_t)(at % own->roll_count)};
        double least = fmax(GAIN_LEAST * annealer->area, best->merit * price);
        double gain = sp_score_pose(annealer->scorer, annealer->search, annealer->partial, pose, least).gain;
        gain = sp_gain_at(annealer->search, annealer->partial, pose, gain);
        if (gain > GAIN_LEAST * annealer->area && (gain - SP_SCORE_TIE * annealer->area) / price > best->merit)
            *best = (sp_annealing_choice){pose, gain / price};
    }
}

/* Adds one nozzle; *added is false where nothing that was looked at gains. */
static bool add(sp_annealer *annealer, uint32_t near, double power, bool *added)
{
    const sp_search *search = annealer->search;
    sp_annealing_choice best = {.merit = 0};
    for (int i = 0; i < SITES; i++) {
        uint32_t site = uniform(annealer) < NEAR_SHARE ? near : (uint32_t)draw(annealer, search->sites->count);
        uint32_t variant = (uint32_t)draw(annealer, search->candidates->variant_count);
        uint32_t mount = search->sites->items[site].mount;
        if (sp_affords(search, annealer->partial->flow, annealer->partial->outlay, mount,
                       search->candidates->variants[variant].flow, annealer->budget) &&
            sp_partial_has_place(search, annealer->partial, mount) &&
            sp_body_clear(search, annealer->partial,
                          sp_pose_body(search, &(sp_pose){.site = site, .variant = variant})))
            look(annealer, site, variant, power, &best);
    }
    sp_scorers_forget(annealer->scorer, 1);
    *added = best.merit > 0;
    return !*added || sp_partial_add_pose(search, annealer->partial, best.pose, annealer->error);
}

/* The mounting point nearest to where a nozzle is, which refinement may have moved. */
static uint32_t site_of(const sp_sites *sites, const sp_placed *placed)
{
    size_t nearest = 0;
    for (size_t i = 1; i < sites->count; i++)
        if (sp_distance(sites->items[i].position, placed->nozzle.position) <
            sp_distance(sites->items[nearest].position, placed->nozzle.position))
            nearest = i;
    return (uint32_t)nearest;
}

static bool refill(sp_annealer *annealer, uint32_t near)
{
    double power = 0.5 * (double)draw(annealer, 3);
    for (int misses = 0; misses < MISSES;) {
        bool added;
        if (!add(annealer, near, power, &added))
            return false;
        misses += !added;
    }
    return true;
}

/* One step, taken back where it loses too much. */
static bool step(sp_annealer *annealer, double temperature)
{
    const sp_search *search = annealer->search;
    sp_partial *partial = annealer->partial;
    double before = partial->value;
    size_t wanted = 1 + (uniform(annealer) < TWO_SHARE), removed = wanted < partial->count ? wanted : partial->count;
    size_t left = partial->count - removed;
    uint32_t near = 0;
    sp_placed out[2];
    for (size_t i = 0; i < removed; i++) {
        out[i] = sp_partial_take(search, partial, draw(annealer, partial->count));
        near = site_of(search->sites, &out[i]);
    }
    bool done = refill(annealer, near);
    if (done && partial->value >= before + temperature * log(1 - uniform(annealer))) {
        for (size_t i = 0; i < removed; i++)
            free(out[i].field);
        return true;
    }
    while (partial->count > left)
        sp_partial_remove(search, partial, partial->count - 1);
    for (size_t i = 0; i < removed; i++)
        done = sp_partial_add(search, partial, out[i], annealer->error) && done;
    return done;
}

/* Takes the partial layout over where it covers more than the best. */
static bool keep(const sp_annealer *annealer, sp_partial *best)
{
    sp_partial copy;
    if (annealer->partial->covered <= best->covered + SP_TIE * annealer->area)
        return true;
    if (!sp_partial_copy(annealer->search, annealer->partial, &copy, annealer->error))
        return false;
    sp_partial_free(best);
    *best = copy;
    return true;
}

static bool anneal(sp_annealer *annealer, const sp_search *exact, double effort, sp_deadline *deadline,
                   sp_partial *best)
{
    double nozzles = (double)(best->count + 1);
    double steps = effort / (STEP_EFFORT * (double)annealer->search->patch_count * nozzles);
    steps = fmin(ceil(steps), STEPS_MOST * nozzles);
    for (double i = 0; i < steps && sp_deadline_goes_on(deadline, "front", 0); i++) {
        if (annealer->search != exact && i >= CREDIT_SHARE * steps) {
            annealer->search = exact;
            sp_partial_refresh(exact, annealer->partial);
        }
        if (!step(annealer, annealer->area * HOT * pow(COLD / HOT, i / steps)) || !keep(annealer, best))
            return false;
    }
    return true;
}

bool sp_simulated_annealing(const sp_search *search, double budget, double effort, uint64_t seed, sp_deadline *deadline,
                            sp_partial *partial, sp_error *error)
{
    sp_search exact = *search;
    exact.credit = 0;
    sp_partial moving;
    if (!sp_partial_copy(search, partial, &moving, error))
        return false;
    sp_annealer annealer = {.search = search,
                            .budget = budget,
                            .area = search->all,
                            .state = seed,
                            .scorer = sp_scorers_create(search, 1, error),
                            .partial = &moving,
                            .error = error};
    bool done = annealer.scorer && anneal(&annealer, &exact, effort, deadline, partial);
    sp_scorers_destroy(annealer.scorer, 1);
    sp_partial_free(&moving);
    sp_partial_refresh(search, partial);
    return done;
}
