#include "compass.h"

#include "move.h"
#include "scoring.h"

#include <stdlib.h>

#define STEP_FIRST 0.25 /* of half an unknown's range */
#define STEP_LEAST 0.007
#define PLACE_LEAST 0.05 /* of half the range: each move of a place is traced */
#define SWEEPS_MOST 4    /* at one size of step */
#define GAIN_LEAST 1e-6  /* of the area, for a step to count */

/* The nozzle in hand: the design without it, and what can be reached from where it is. */
typedef struct {
    const sp_search *search;
    sp_design *design; /* without the nozzle */
    double budget, least;
    sp_placed placed;
    sp_reach *reach; /* from its position, in all directions */
    double gain;     /* of its field, exact, m² */
    float *trial;    /* [patch_count] */
    sp_error *error;
} sp_needle;

/* What can be reached from where the nozzle is, by its own pattern or by that turned and opened as far as allowed. */
static sp_reach *look(const sp_search *search, const sp_nozzle *nozzle, double spare, sp_error *error)
{
    double speed = sp_nozzle_speed(nozzle, &sp_evaluator_setup(search->coarse)->liquid);
    sp_spray spray = sp_spray_create(nozzle->type, sp_nozzle_angle(nozzle));
    return sp_evaluator_reach(search->coarse, nozzle->position, speed, nozzle->axis,
                              fmin(M_PI, sp_spray_reach(&spray) + spare + 1e-6), error);
}

/* How far beyond its pattern a nozzle could come to reach, whichever way its axis lies within its limits now. */
static double spare_of(const sp_search *search, const sp_nozzle *nozzle)
{
    double low, high;
    sp_angle_range(search->options, nozzle->type, &low, &high);
    return 0.5 * fmax(0, high - sp_nozzle_angle(nozzle)) + 2 * fmin(M_PI, search->options->refine.axis);
}

/* Tries one value of one unknown and keeps it where more is covered. */
static bool try_value(sp_needle *needle, size_t k, double step, bool *moved)
{
    sp_freedom freedom = sp_freedom_create(needle->search, &needle->placed);
    double values[SP_UNKNOWNS], half = 0.5 * (freedom.high[k] - freedom.low[k]);
    for (size_t j = 0; j < freedom.count; j++)
        values[j] = freedom.value[j];
    values[k] = fmin(freedom.high[k], fmax(freedom.low[k], values[k] + step * half));
    if (values[k] == freedom.value[k])
        return true;
    sp_placed trial = needle->placed;
    sp_placed_move(needle->search, &trial, &freedom, values);
    if (needle->design->flow + trial.flow > needle->budget * (1 + 1e-12))
        return true;
    bool elsewhere = sp_distance(trial.nozzle.position, needle->placed.nozzle.position) > 0;
    if (freedom.kind[k] == SP_UNKNOWN_PLACE && !elsewhere)
        return true;
    if (elsewhere) {
        if (!sp_field_nozzle(needle->search, &trial.nozzle, needle->trial, needle->error))
            return false;
    } else {
        sp_field_reach(needle->search, &trial.nozzle, needle->reach, needle->trial);
    }
    double gain = sp_field_gain(needle->search, needle->design->wet, needle->trial);
    if (gain <= needle->gain + needle->least)
        return true;
    trial.field = needle->trial;
    needle->trial = needle->placed.field;
    needle->placed = trial;
    needle->gain = gain;
    *moved = true;
    if (elsewhere) {
        sp_reach_destroy(needle->reach);
        needle->reach = look(needle->search, &trial.nozzle, spare_of(needle->search, &trial.nozzle), needle->error);
    }
    return needle->reach != NULL;
}

/* Both ways along every unknown of the design's first nozzle, which then stands last. *reach is what it can reach, NULL
 * where that is not known. */
static bool try_nozzle(const sp_search *search, double budget, double step, sp_design *design, sp_reach **reach,
                       bool *moved, sp_error *error)
{
    sp_needle needle = {.search = search,
                        .design = design,
                        .budget = budget,
                        .error = error,
                        .least = GAIN_LEAST * sp_evaluator_patches(search->coarse)->total_area};
    needle.placed = sp_design_take(search, design, 0);
    needle.trial = malloc(search->patch_count * sizeof *needle.trial);
    bool done = needle.trial || sp_fail_memory(error);
    if (done) {
        needle.gain = sp_field_gain(search, design->wet, needle.placed.field);
        needle.reach =
            *reach ? *reach : look(search, &needle.placed.nozzle, spare_of(search, &needle.placed.nozzle), error);
        done = needle.reach != NULL;
    }
    sp_freedom freedom = sp_freedom_create(search, &needle.placed);
    for (size_t k = 0; done && k < freedom.count; k++) {
        if (freedom.kind[k] == SP_UNKNOWN_PLACE && step < PLACE_LEAST)
            continue;
        bool forth = false;
        done = try_value(&needle, k, step, &forth) && (forth || try_value(&needle, k, -step, &forth));
        *moved |= forth;
    }
    *reach = needle.reach;
    free(needle.trial);
    return sp_design_add(search, design, needle.placed, error) && done;
}

bool sp_compass(const sp_search *search, double budget, sp_watch *watch, sp_design *design, sp_error *error)
{
    sp_search exact = *search;
    exact.credit = 0;
    sp_reach **reaches = calloc(design->count ? design->count : 1, sizeof *reaches);
    if (!reaches)
        return sp_fail_memory(error);
    bool done = true;
    int sweeps = 0;
    for (double step = STEP_FIRST; done && step >= STEP_LEAST;) {
        bool moved = false;
        if (!sp_watch_goes_on(watch, "refine", 1))
            break;
        /* after all turns the first nozzle is the first again */
        for (size_t i = 0; done && i < design->count; i++)
            done = try_nozzle(&exact, budget, step, design, &reaches[i], &moved, error);
        if (moved && ++sweeps < SWEEPS_MOST)
            continue;
        step /= 2;
        sweeps = 0;
    }
    for (size_t i = 0; i < design->count; i++)
        sp_reach_destroy(reaches[i]);
    free(reaches);
    sp_design_refresh(search, design);
    return done;
}
