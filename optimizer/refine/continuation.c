#include "refine/continuation.h"

#include "refine/move.h"
#include "scoring/bodies.h"

#include <assert.h>
#include <stdlib.h>

#define SHARE_LEAST 0.2 /* of a step, that is tried before it is given up */
#define MARKS 512       /* of half an unknown's range: finer, the solver's answers are round-off */

static const sp_width widths[SP_WIDTHS] = {{0.8, 0.085},  {0.4, 0.06},    {0.2, 0.042},   {0.1, 0.03},
                                           {0.05, 0.021}, {0.025, 0.015}, {0.0125, 0.006}};

typedef struct {
    sp_sights *sights;
    double water; /* m³/s */
    sp_error *error;
} sp_continuing;

/* What a nozzle's flow may be set to; its own alone where that is fixed. */
static void set_flows(const sp_search *search, const sp_placed *placed, double *low, double *high)
{
    sp_flow_range(search->options, sp_evaluator_setup(search->coarse), placed->nozzle.type, placed->nozzle.pressure,
                  low, high);
    bool fixed = !(*high > *low * (1 + 1e-9));
    *low = fixed ? placed->flow : fmin(*low, placed->flow);
    *high = fixed ? placed->flow : fmax(*high, placed->flow);
}

double sp_least_flow(const sp_search *search, const sp_placed *placed)
{
    double low, high;
    set_flows(search, placed, &low, &high);
    return low;
}

double sp_most_flow(const sp_search *search, const sp_placed *placed)
{
    double low, high;
    set_flows(search, placed, &low, &high);
    return high;
}

double sp_turned_up(const sp_search *search, const sp_partial *partial)
{
    double outlay = partial->outlay;
    for (size_t i = 0; i < partial->count; i++)
        outlay += sp_most_flow(search, &partial->items[i]) - partial->items[i].flow;
    return fmin(outlay, search->outlay_most);
}

void sp_turn_down(const sp_search *search, sp_partial *partial, double water)
{
    double total = search->kept_flow, spare = 0;
    for (size_t i = 0; i < partial->count; i++) {
        total += partial->items[i].flow;
        spare += partial->items[i].flow - sp_least_flow(search, &partial->items[i]);
    }
    if (total <= water || spare <= 0)
        return;
    double share = fmin(1, (total - water) / spare * (1 + 1e-12));
    for (size_t i = 0; i < partial->count; i++) {
        sp_placed *placed = &partial->items[i];
        double low = sp_least_flow(search, placed);
        assert(share > 0 && low >= 0 && low <= placed->flow);
        if (low < placed->flow)
            placed->nozzle.flow = placed->flow = placed->flow - share * (placed->flow - low);
    }
}

bool sp_partial_look(sp_sights *sights, sp_partial *partial, sp_error *error)
{
    for (size_t i = 0; i < partial->count; i++)
        if (!sp_sights_field(sights, &partial->items[i], NULL, partial->items[i].field, error))
            return false;
    sp_partial_refresh(sights->search, partial);
    return true;
}

/* Takes over a share of the way from each nozzle's start to its values, and looks again. */
static bool go(const sp_continuing *continuing, const sp_pose_parameters *parameters, double (*values)[SP_UNKNOWNS],
               double share, sp_partial *partial)
{
    const sp_search *search = continuing->sights->search;
    for (size_t i = 0; i < partial->count; i++) {
        double part[SP_UNKNOWNS];
        for (size_t k = 0; k < parameters[i].count; k++)
            part[k] = parameters[i].value[k] + share * (values[i][k] - parameters[i].value[k]);
        sp_placed_move(search, &partial->items[i], &parameters[i], part);
    }
    sp_turn_down(search, partial, continuing->water);
    return sp_partial_look(continuing->sights, partial, continuing->error);
}

/* Goes the whole way; where `careful`, half or a quarter of it if that is what is worth more than before, or stays. */
static bool line_search(const sp_continuing *continuing, const sp_pose_parameters *parameters,
                        double (*values)[SP_UNKNOWNS], bool careful, sp_partial *partial)
{
    const sp_search *search = continuing->sights->search;
    if (!careful)
        return go(continuing, parameters, values, 1, partial);
    for (double share = 1; share >= SHARE_LEAST; share /= 2) {
        sp_partial trial;
        if (!sp_partial_copy(search, partial, &trial, continuing->error))
            return false;
        if (!go(continuing, parameters, values, share, &trial)) {
            sp_partial_free(&trial);
            return false;
        }
        bool better = trial.value > partial->value + SP_TIE * search->all;
        sp_partial_free(better ? partial : &trial);
        if (better) {
            *partial = trial;
            return true;
        }
    }
    return true;
}

/* The solver takes its slopes from differences, so that its answers hold to 1e-8 or so of the range, and what comes of
 * them would be another layout at another scale. They are brought to the nearest mark, which is finer than the
 * compass's least step. */
static void mark(const sp_pose_parameters *parameters, double values[SP_UNKNOWNS])
{
    for (size_t k = 0; k < parameters->count; k++) {
        double half = 0.5 * (parameters->high[k] - parameters->low[k]), middle = parameters->low[k] + half;
        values[k] = middle + half * (nearbyint((values[k] - middle) / half * MARKS) / MARKS);
    }
}

/* One outer step: solve with visibility frozen, apply, look again. */
static bool step(const sp_continuing *continuing, size_t width, sp_partial *partial)
{
    const sp_search *search = continuing->sights->search;
    sp_pose_parameters *parameters = malloc(partial->count * sizeof *parameters);
    const sp_sight **views = malloc(partial->count * sizeof *views);
    double(*values)[SP_UNKNOWNS] = malloc(partial->count * sizeof *values);
    bool done = (parameters && values && views) || sp_fail_memory(continuing->error);
    for (size_t i = 0; done && i < partial->count; i++) {
        parameters[i] = sp_pose_parameters_create(search, &partial->items[i]);
        for (size_t k = 0; k < parameters[i].count; k++)
            values[i][k] = parameters[i].value[k];
        views[i] = sp_sights_look(continuing->sights, &partial->items[i], continuing->error);
        done = views[i] != NULL;
    }
    done = done && sp_smooth_objective_minimise(search, partial, parameters, views, widths[width], continuing->water,
                                                values, continuing->error);
    for (size_t i = 0; done && i < partial->count; i++)
        mark(&parameters[i], values[i]);
    done = done && line_search(continuing, parameters, values, width >= SP_CAREFUL, partial);
    free(parameters);
    free(views);
    free(values);
    return done;
}

/* Takes the copy over where it covers more with no more water. */
static void keep_better(const sp_search *search, sp_partial *partial, sp_partial *copy, double water)
{
    bool better = sp_covers_more(search, copy, partial) && copy->flow <= water * (1 + SP_ROUNDING);
    sp_partial_free(better ? partial : copy);
    if (better)
        *partial = *copy;
}

/* Back to the best where a step has brought bodies into each other, from which no other would part them. */
static bool part_bodies(const sp_search *search, const sp_partial *best, sp_partial *moving, sp_error *error)
{
    sp_partial copy;
    if (sp_partial_clear(search, moving))
        return true;
    if (!sp_partial_copy(search, best, &copy, error))
        return false;
    sp_partial_free(moving);
    *moving = copy;
    return true;
}

bool sp_continuation(sp_sights *sights, size_t start, size_t end, double water, sp_deadline *deadline,
                     sp_partial *partial, sp_error *error)
{
    sp_continuing continuing = {sights, water, error};
    sp_partial moving;
    if (!partial->count)
        return true;
    if (!sp_sights_reserve(sights, partial->count, error) || !sp_partial_copy(sights->search, partial, &moving, error))
        return false;
    bool done = true;
    for (size_t w = start; done && w < end && sp_deadline_goes_on(deadline, "refine", (double)w / SP_WIDTHS); w++) {
        sp_partial copy;
        done = step(&continuing, w, &moving) && part_bodies(sights->search, partial, &moving, error) &&
               sp_partial_copy(sights->search, &moving, &copy, error);
        if (done)
            keep_better(sights->search, partial, &copy, water);
    }
    sp_partial_free(&moving);
    return done;
}
