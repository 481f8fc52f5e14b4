#include "refine/anneal.h"

#include "refine/move.h"

#include <stdlib.h>

#define SHARE_LEAST 0.2 /* of a step, that is tried before it is given up */

static const sp_width widths[SP_WIDTHS] = {{0.8, 0.085},  {0.4, 0.06},    {0.2, 0.042},   {0.1, 0.03},
                                           {0.05, 0.021}, {0.025, 0.015}, {0.0125, 0.006}};

typedef struct {
    sp_sights *sights;
    double budget;
    sp_error *error;
} sp_annealing;

double sp_least_flow(const sp_search *search, const sp_placed *placed)
{
    double low, high;
    sp_flow_range(search->options, &sp_evaluator_setup(search->coarse)->liquid, placed->nozzle.type,
                  placed->nozzle.pressure, &low, &high);
    return high > low * (1 + 1e-9) ? fmin(low, placed->flow) : placed->flow;
}

void sp_turn_down(const sp_search *search, sp_design *design, double budget)
{
    double total = search->kept_flow, spare = 0;
    for (size_t i = 0; i < design->count; i++) {
        total += design->items[i].flow;
        spare += design->items[i].flow - sp_least_flow(search, &design->items[i]);
    }
    if (total <= budget || spare <= 0)
        return;
    double share = fmin(1, (total - budget) / spare * (1 + 1e-12));
    for (size_t i = 0; i < design->count; i++) {
        sp_placed *placed = &design->items[i];
        double low = sp_least_flow(search, placed);
        if (low < placed->flow)
            placed->nozzle.flow = placed->flow = placed->flow - share * (placed->flow - low);
    }
}

bool sp_design_look(sp_sights *sights, sp_design *design, sp_error *error)
{
    for (size_t i = 0; i < design->count; i++)
        if (!sp_sights_field(sights, &design->items[i], design->items[i].field, error))
            return false;
    sp_design_refresh(sights->search, design);
    return true;
}

/* Takes over a share of the way from each freedom's start to its values, and looks again. */
static bool go(const sp_annealing *annealing, const sp_freedom *freedoms, double (*values)[SP_UNKNOWNS], double share,
               sp_design *design)
{
    const sp_search *search = annealing->sights->search;
    for (size_t i = 0; i < design->count; i++) {
        double part[SP_UNKNOWNS];
        for (size_t k = 0; k < freedoms[i].count; k++)
            part[k] = freedoms[i].value[k] + share * (values[i][k] - freedoms[i].value[k]);
        sp_placed_move(search, &design->items[i], &freedoms[i], part);
    }
    sp_turn_down(search, design, annealing->budget);
    return sp_design_look(annealing->sights, design, annealing->error);
}

/* Goes the whole way; where `careful`, half or a quarter of it if that is what is worth more than before, or stays. */
static bool line_search(const sp_annealing *annealing, const sp_freedom *freedoms, double (*values)[SP_UNKNOWNS],
                        bool careful, sp_design *design)
{
    const sp_search *search = annealing->sights->search;
    if (!careful)
        return go(annealing, freedoms, values, 1, design);
    for (double share = 1; share >= SHARE_LEAST; share /= 2) {
        sp_design trial;
        if (!sp_design_copy(search, design, &trial, annealing->error))
            return false;
        if (!go(annealing, freedoms, values, share, &trial)) {
            sp_design_free(&trial);
            return false;
        }
        bool better = trial.value > design->value;
        sp_design_free(better ? design : &trial);
        if (better) {
            *design = trial;
            return true;
        }
    }
    return true;
}

/* One outer step: solve with visibility frozen, apply, look again. */
static bool step(const sp_annealing *annealing, size_t width, sp_design *design)
{
    const sp_search *search = annealing->sights->search;
    sp_freedom *freedoms = malloc(design->count * sizeof *freedoms);
    const sp_sight **views = malloc(design->count * sizeof *views);
    double(*values)[SP_UNKNOWNS] = malloc(design->count * sizeof *values);
    bool done = (freedoms && values && views) || sp_fail_memory(annealing->error);
    for (size_t i = 0; done && i < design->count; i++) {
        freedoms[i] = sp_freedom_create(search, &design->items[i]);
        for (size_t k = 0; k < freedoms[i].count; k++)
            values[i][k] = freedoms[i].value[k];
        views[i] = sp_sights_look(annealing->sights, &design->items[i], annealing->error);
        done = views[i] != NULL;
    }
    done = done &&
           sp_soft_solve(search, freedoms, views, design->count, widths[width], annealing->budget, values,
                         annealing->error) &&
           line_search(annealing, freedoms, values, width >= SP_CAREFUL, design);
    free(freedoms);
    free(views);
    free(values);
    return done;
}

/* Takes the copy over where it covers more with no more water. */
static void keep_better(sp_design *design, sp_design *copy, double budget)
{
    bool better = copy->covered > design->covered && copy->flow <= budget * (1 + SP_ROUNDING);
    sp_design_free(better ? design : copy);
    if (better)
        *design = *copy;
}

bool sp_anneal(sp_sights *sights, size_t start, size_t end, double budget, sp_watch *watch, sp_design *design,
               sp_error *error)
{
    sp_annealing annealing = {sights, budget, error};
    sp_design moving;
    if (!design->count)
        return true;
    if (!sp_sights_reserve(sights, design->count, error) || !sp_design_copy(sights->search, design, &moving, error))
        return false;
    bool done = true;
    for (size_t w = start; done && w < end && sp_watch_goes_on(watch, "refine", (double)w / SP_WIDTHS); w++) {
        sp_design copy;
        done = step(&annealing, w, &moving) && sp_design_copy(sights->search, &moving, &copy, error);
        if (done)
            keep_better(design, &copy, budget);
    }
    sp_design_free(&moving);
    return done;
}
