#include "auto_settings.h"

#include "resolution.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#define FEW 16         /* one jet in so many of the plain number, to begin with */
#define MORE 4         /* times the jets */
#define SHORTER 0.7    /* of a texel */
#define STEPS_MOST 6   /* of jets and texels */
#define BOUNCES_MOST 8 /* that are followed */

typedef struct {
    double texel;
    uint64_t jets;
} grain;

static grain grain_of(const sp_evaluator *evaluator)
{
    return (grain){evaluator->fidelity.texel, evaluator->fidelity.jets};
}

/* The next to try, or the same where nothing is left: what covers too much has long texels, what covers too little has
 * few jets. */
static grain next_grain(const sp_setting_trial *trial, grain now)
{
    const sp_evaluator *evaluator = trial->evaluator;
    const sp_fidelity *open = &evaluator->setup.fidelity;
    bool shorter = trial->measured.bias > 0;
    if (shorter && !(open->texel > 0))
        now.texel = fmax(SHORTER * now.texel, sp_shortest_auto_texel(evaluator));
    uint64_t plain = sp_jets_for(evaluator, now.texel);
    double more = shorter ? 1 / (SHORTER * SHORTER) : MORE;
    if (open->jets == 0)
        now.jets = (uint64_t)fmin((double)plain, ceil(more * (double)now.jets));
    return now;
}

static bool try_grain(sp_setting_trial *trial, grain grain, sp_error *error)
{
    trial->evaluator->fidelity.jets = grain.jets;
    return sp_setting_trial_at(trial, grain.texel, error);
}

/* Why, as far as it was left open. */
static void explain_grain(const sp_setting_trial *trial, double estimate)
{
    sp_evaluator *evaluator = trial->evaluator;
    const sp_fidelity *open = &evaluator->setup.fidelity;
    const char *how =
        evaluator->choice.missed ? "the best that was tried, but the accuracy is not kept" : "enough for the accuracy";
    if (open->jets == 0)
        snprintf(evaluator->choice.jets, SP_WHY, "%s: first impact within %.2f points of coverage", how,
                 100 * estimate);
    if (!(open->texel > 0))
        snprintf(evaluator->choice.texel, SP_WHY, "%s: first impact within %.2f points of coverage", how,
                 100 * estimate);
}

/* Texels and jets, by the error of the first impact. */
static bool choose_grain(sp_setting_trial *trial, sp_error *error)
{
    sp_evaluator *evaluator = trial->evaluator;
    const sp_fidelity *open = &evaluator->setup.fidelity;
    grain now = {open->texel > 0 ? open->texel : sp_texel_of(evaluator, SP_FEWEST_TEXELS), open->jets};
    if (now.jets == 0)
        now.jets = sp_jets_for(evaluator, now.texel) / FEW + 1;
    grain best = now;
    double least = INFINITY;
    for (int step = 0; step < STEPS_MOST; step++) {
        if (!try_grain(trial, now, error))
            return false;
        if (trial->measured.estimate < least) {
            least = trial->measured.estimate;
            best = now;
        }
        grain next = next_grain(trial, now);
        if (sp_setting_trial_keeps(trial) || (next.texel == now.texel && next.jets == now.jets) ||
            sp_setting_trial_late(trial))
            break;
        now = next;
    }
    evaluator->choice.missed = !(least <= 0.5 * open->accuracy);
    explain_grain(trial, least);
    grain last = grain_of(evaluator);
    if (last.texel == best.texel && last.jets == best.jets)
        return true;
    evaluator->fidelity.jets = best.jets;
    evaluator->fidelity.texel = best.texel;
    return sp_texels_create(evaluator, NULL, error);
}

/* What of a patch is not covered, and the liquid that it takes to cover it. */
typedef struct {
    double area; /* m² */
    double lack; /* m³/s per m² */
} gap;

static int by_lack(const void *left, const void *right)
{
    const gap *a = left, *b = right;
    return (a->lack > b->lack) - (a->lack < b->lack);
}

/* The most area (m²) that so much liquid (m³/s) can cover beyond the coverage, wherever it arrives: what lacks least
 * first. Negative where memory runs out. */
static double most_filled(const sp_evaluator *evaluator, const sp_coverage *coverage, double liquid)
{
    const sp_deposits *deposits = &coverage->deposits;
    gap *gaps = malloc((deposits->count + 1) * sizeof *gaps);
    double filled = gaps ? 0 : -1;
    for (size_t i = 0; gaps && i < deposits->count; i++)
        gaps[i] = (gap){(1 - deposits->share[i]) * evaluator->patches.area[i],
                        fmax(evaluator->setup.criterion.flux - deposits->counted[i], 0)};
    if (gaps)
        qsort(gaps, deposits->count, sizeof *gaps, by_lack);
    for (size_t i = 0; gaps && i < deposits->count && liquid > 0; i++) {
        double need = gaps[i].lack * gaps[i].area;
        filled += need > liquid ? gaps[i].area * liquid / need : gaps[i].area;
        liquid -= need;
    }
    free(gaps);
    return filled;
}

/* What liquid that flies on may bring in all, by so much at every impact. */
static double all_impacts(const sp_setup *setup, double able)
{
    double most = 0;
    for (size_t i = 0; i < setup->mesh->part_count; i++)
        if (setup->surfaces[i].restitution > 0)
            most = fmax(most, setup->surfaces[i].rebound);
    return able > 0 ? able / (1 - most) : 0;
}

/* The share of the surface that liquid that flies on (m³/s) can still cover at most, by the coverage of now. */
static bool find_left(const sp_setting_trial *trial, double able, double *left, sp_error *error)
{
    double filled = most_filled(trial->evaluator, trial->coverage, all_impacts(&trial->evaluator->setup, able));
    *left = filled / trial->coverage->area;
    return filled >= 0 || sp_fail_memory(error);
}

/* Evaluates with so many bounces. */
static bool try_bounces(sp_setting_trial *trial, int bounces, double *able, double *left, sp_error *error)
{
    trial->evaluator->fidelity.reflections = bounces;
    sp_coverage_destroy(trial->coverage);
    trial->coverage = sp_evaluate_jets(trial->evaluator, trial->layout, able, error);
    return trial->coverage && find_left(trial, *able, left, error);
}

/* As many as it takes until what still flies can change little. Where the first bounce takes so little that the most
 * will not do, these are tried next: all between take twice as long as they alone. */
static bool choose_reflections(sp_setting_trial *trial, sp_error *error)
{
    sp_evaluator *evaluator = trial->evaluator;
    sp_fidelity *fidelity = &evaluator->fidelity;
    uint64_t jets = fidelity->jets, few = sp_jets_for(evaluator, fidelity->texel) / FEW + 1;
    double left = 1, least = 0.25 * fidelity->accuracy, able = 0;
    fidelity->jets = jets < few ? jets : few;
    for (int bounces = 0; bounces <= BOUNCES_MOST && left > least; bounces += bounces < 4 ? 1 : 2) {
        double before = able, in_the_end, most = 0;
        if (!try_bounces(trial, bounces, &able, &left, error))
            return false;
        if (bounces != 1)
            continue;
        in_the_end = able * pow(able / before, BOUNCES_MOST - 1);
        if (!find_left(trial, in_the_end, &most, error) ||
            (most > least && !try_bounces(trial, BOUNCES_MOST, &in_the_end, &most, error)))
            return false;
        if (most > least) {
            left = most;
            break;
        }
    }
    fidelity->jets = jets;
    snprintf(evaluator->choice.reflections, SP_WHY,
             left > least ? "the most that auto follows: what flies on then may change coverage by up to %.1f points"
                          : "what flies on after so many can change coverage by %.2f points at most",
             100 * left);
    return true;
}

bool sp_auto_forward(sp_setting_trial *trial, sp_error *error)
{
    sp_evaluator *evaluator = trial->evaluator;
    const sp_fidelity *open = &evaluator->setup.fidelity;
    int reflections = evaluator->fidelity.reflections;
    evaluator->fidelity.reflections = 0;
    if (!(open->texel > 0 && open->jets > 0 ? sp_texels_create(evaluator, NULL, error) : choose_grain(trial, error)))
        return false;
    evaluator->fidelity.reflections = reflections;
    return open->reflections >= 0 || reflections == 0 || choose_reflections(trial, error);
}
