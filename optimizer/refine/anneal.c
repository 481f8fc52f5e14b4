#include "refine/anneal.h"

#include "refine/move.h"

#include <stdlib.h>

#define SHARE_LEAST 0.2 /* of a step, that is tried before it is given up */
#define MARKS 512       /* of half an unknown's range: finer, the solver's answers are round-off */

static const sp_width widths[SP_WIDTHS] = {{0.8, 0.085},  {0.4, 0.06},    {0.2, 0.042},   {0.1, 0.03},
                                           {0.05, 0.021}, {0.025, 0.015}, {0.0125, 0.006}};

typedef struct {
    sp_sights *sights;
    double water; /* m³/s */
    sp_error *error;
} sp_annealing;

double sp_least_flow(const sp_search *search, const sp_placed *placed)
{
    double low, high;
    sp_flow_range(search->options, sp_evaluator_setup(search->coarse), placed->nozzle.type, placed->nozzle.pressure,
                  &low, &high);
    return high > low * (1 + 1e-9) ? fmin(low, placed->flow) : placed->flow;
}

void sp_turn_down(const sp_search *search, sp_draft *draft, double water)
{
    double total = search->kept_flow, spare = 0;
    for (size_t i = 0; i < draft->count; i++) {
        total += draft->items[i].flow;
        spare += draft->items[i].flow - sp_least_flow(search, &draft->items[i]);
    }
    if (total <= water || spare <= 0)
        return;
    double share = fmin(1, (total - water) / spare * (1 + 1e-12));
    for (size_t i = 0; i < draft->count; i++) {
        sp_placed *placed = &draft->items[i];
        double low = sp_least_flow(search, placed);
        if (low < placed->flow)
            placed->nozzle.flow = placed->flow = placed->flow - share * (placed->flow - low);
    }
}

bool sp_draft_look(sp_sights *sights, sp_draft *draft, sp_error *error)
{
    for (size_t i = 0; i < draft->count; i++)
        if (!sp_sights_field(sights, &draft->items[i], NULL, draft->items[i].field, error))
            return false;
    sp_draft_refresh(sights->search, draft);
    return true;
}

/* Takes over a share of the way from each freedom's start to its values, and looks again. */
static bool go(const sp_annealing *annealing, const sp_freedom *freedoms, double (*values)[SP_UNKNOWNS], double share,
               sp_draft *draft)
{
    const sp_search *search = annealing->sights->search;
    for (size_t i = 0; i < draft->count; i++) {
        double part[SP_UNKNOWNS];
        for (size_t k = 0; k < freedoms[i].count; k++)
            part[k] = freedoms[i].value[k] + share * (values[i][k] - freedoms[i].value[k]);
        sp_placed_move(search, &draft->items[i], &freedoms[i], part);
    }
    sp_turn_down(search, draft, annealing->water);
    return sp_draft_look(annealing->sights, draft, annealing->error);
}

/* Goes the whole way; where `careful`, half or a quarter of it if that is what is worth more than before, or stays. */
static bool line_search(const sp_annealing *annealing, const sp_freedom *freedoms, double (*values)[SP_UNKNOWNS],
                        bool careful, sp_draft *draft)
{
    const sp_search *search = annealing->sights->search;
    if (!careful)
        return go(annealing, freedoms, values, 1, draft);
    for (double share = 1; share >= SHARE_LEAST; share /= 2) {
        sp_draft trial;
        if (!sp_draft_copy(search, draft, &trial, annealing->error))
            return false;
        if (!go(annealing, freedoms, values, share, &trial)) {
            sp_draft_free(&trial);
            return false;
        }
        bool better = trial.value > draft->value + SP_TIE * search->all;
        sp_draft_free(better ? draft : &trial);
        if (better) {
            *draft = trial;
            return true;
        }
    }
    return true;
}

/* The solver takes its slopes from differences, so that its answers hold to 1e-8 or so of the range, and what comes of
 * them would be another layout at another scale. They are brought to the nearest mark, which is finer than the
 * compass's least step. */
static void mark(const sp_freedom *freedom, double values[SP_UNKNOWNS])
{
    for (size_t k = 0; k < freedom->count; k++) {
        double half = 0.5 * (freedom->high[k] - freedom->low[k]), middle = freedom->low[k] + half;
        values[k] = middle + half * (nearbyint((values[k] - middle) / half * MARKS) / MARKS);
    }
}

/* One outer step: solve with visibility frozen, apply, look again. */
static bool step(const sp_annealing *annealing, size_t width, sp_draft *draft)
{
    const sp_search *search = annealing->sights->search;
    sp_freedom *freedoms = malloc(draft->count * sizeof *freedoms);
    const sp_sight **views = malloc(draft->count * sizeof *views);
    double(*values)[SP_UNKNOWNS] = malloc(draft->count * sizeof *values);
    bool done = (freedoms && values && views) || sp_fail_memory(annealing->error);
    for (size_t i = 0; done && i < draft->count; i++) {
        freedoms[i] = sp_freedom_create(search, &draft->items[i]);
        for (size_t k = 0; k < freedoms[i].count; k++)
            values[i][k] = freedoms[i].value[k];
        views[i] = sp_sights_look(annealing->sights, &draft->items[i], annealing->error);
        done = views[i] != NULL;
    }
    done = done &&
           sp_soft_solve(search, draft, freedoms, views, widths[width], annealing->water, values, annealing->error);
    for (size_t i = 0; done && i < draft->count; i++)
        mark(&freedoms[i], values[i]);
    done = done && line_search(annealing, freedoms, values, width >= SP_CAREFUL, draft);
    free(freedoms);
    free(views);
    free(values);
    return done;
}

/* Takes the copy over where it covers more with no more water. */
static void keep_better(const sp_search *search, sp_draft *draft, sp_draft *copy, double water)
{
    bool better = sp_covers_more(search, copy, draft) && copy->flow <= water * (1 + SP_ROUNDING);
    sp_draft_free(better ? draft : copy);
    if (better)
        *draft = *copy;
}

bool sp_anneal(sp_sights *sights, size_t start, size_t end, double water, sp_deadline *deadline, sp_draft *draft,
               sp_error *error)
{
    sp_annealing annealing = {sights, water, error};
    sp_draft moving;
    if (!draft->count)
        return true;
    if (!sp_sights_reserve(sights, draft->count, error) || !sp_draft_copy(sights->search, draft, &moving, error))
        return false;
    bool done = true;
    for (size_t w = start; done && w < end && sp_deadline_goes_on(deadline, "refine", (double)w / SP_WIDTHS); w++) {
        sp_draft copy;
        done = step(&annealing, w, &moving) && sp_draft_copy(sights->search, &moving, &copy, error);
        if (done)
            keep_better(sights->search, draft, &copy, water);
    }
    sp_draft_free(&moving);
    return done;
}
