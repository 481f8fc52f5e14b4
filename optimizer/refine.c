#include "refine.h"

#include "compass.h"
#include "move.h"
#include "soft.h"

#include <stdlib.h>

#define ROUNDS_MOST 5     /* annealings of one design */
#define FLOW_TRIALS 7     /* measurements to find how far the flow can be turned down */
#define GAIN_LEAST 1e-4   /* of area or water: less is no improvement */
#define ROUNDS_SAVING 2   /* the same, for a design that may turn out short of the target */
#define MISSING_MOST 0.02 /* of the target: more, refinement is not expected to make up for */
#define GAIN_REPEAT 1e-3  /* of the area: less is no reason to anneal the same way again */
#define SHARE_LEAST 0.2   /* of a step, that is tried before it is given up */
#define CAREFUL 3         /* from this width on a step must improve what it starts from */

static const sp_width widths[] = {{0.8, 0.085},  {0.4, 0.06},    {0.2, 0.042},   {0.1, 0.03},
                                  {0.05, 0.021}, {0.025, 0.015}, {0.0125, 0.006}};
#define WIDTHS (sizeof widths / sizeof *widths)
/* Where an annealing starts. A narrow one keeps what is there; a wide one forgets it, and may find what is better. */
static const size_t starts[] = {4, 2, 0};
#define STARTS (sizeof starts / sizeof *starts)

typedef struct {
    const sp_search *search;
    const sp_pool *pool;
    sp_watch *watch;
    sp_front *front;
    sp_error *error;
} sp_refining;

/* The flow that a nozzle may be turned down to; its own where that is fixed. */
static double least_flow(const sp_search *search, const sp_placed *placed)
{
    double low, high;
    sp_flow_range(search->options, &sp_evaluator_setup(search->coarse)->liquid, placed->nozzle.type,
                  placed->nozzle.pressure, &low, &high);
    return high > low * (1 + 1e-9) ? fmin(low, placed->flow) : placed->flow;
}

/* Turns adjustable nozzles down by the same share of what they have above their least, to a total of `budget`. */
static void turn_down(const sp_search *search, sp_design *design, double budget)
{
    double total = search->kept_flow, spare = 0;
    for (size_t i = 0; i < design->count; i++) {
        total += design->items[i].flow;
        spare += design->items[i].flow - least_flow(search, &design->items[i]);
    }
    if (total <= budget || spare <= 0)
        return;
    double share = fmin(1, (total - budget) / spare * (1 + 1e-12));
    for (size_t i = 0; i < design->count; i++) {
        sp_placed *placed = &design->items[i];
        double low = least_flow(search, placed);
        if (low < placed->flow)
            placed->nozzle.flow = placed->flow = placed->flow - share * (placed->flow - low);
    }
}

static bool retrace(const sp_search *search, sp_design *design, sp_error *error)
{
    for (size_t i = 0; i < design->count; i++)
        if (!sp_field_nozzle(search, &design->items[i].nozzle, design->items[i].field, error))
            return false;
    sp_design_refresh(search, design);
    return true;
}

/* Takes over a share of the way from each freedom's start to its values, and traces again. */
static bool go(const sp_refining *refining, const sp_freedom *freedoms, double (*values)[SP_UNKNOWNS], double share,
               double budget, sp_design *design)
{
    for (size_t i = 0; i < design->count; i++) {
        double part[SP_UNKNOWNS];
        for (size_t k = 0; k < freedoms[i].count; k++)
            part[k] = freedoms[i].value[k] + share * (values[i][k] - freedoms[i].value[k]);
        sp_placed_move(refining->search, &design->items[i], &freedoms[i], part);
    }
    turn_down(refining->search, design, budget);
    return retrace(refining->search, design, refining->error);
}

/* Goes the whole way; where `careful`, half or a quarter of it if that is what covers more than before, or stays. */
static bool line_search(const sp_refining *refining, const sp_freedom *freedoms, double (*values)[SP_UNKNOWNS],
                        bool careful, double budget, sp_design *design, bool *stayed)
{
    *stayed = false;
    if (!careful)
        return go(refining, freedoms, values, 1, budget, design);
    for (double share = 1; share >= SHARE_LEAST; share /= 2) {
        sp_design trial;
        if (!sp_design_copy(refining->search, design, &trial, refining->error))
            return false;
        if (!go(refining, freedoms, values, share, budget, &trial)) {
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
    *stayed = true;
    return true;
}

/* One outer step: solve with visibility frozen, apply, trace again. */
static bool step(const sp_refining *refining, sp_width width, bool careful, double budget, sp_design *design,
                 bool *stayed)
{
    const sp_search *search = refining->search;
    sp_freedom *freedoms = malloc(design->count * sizeof *freedoms);
    double(*values)[SP_UNKNOWNS] = malloc(design->count * sizeof *values);
    bool done = freedoms && values;
    if (!done)
        sp_fail_memory(refining->error);
    for (size_t i = 0; done && i < design->count; i++) {
        freedoms[i] = sp_freedom_create(search, &design->items[i]);
        for (size_t k = 0; k < freedoms[i].count; k++)
            values[i][k] = freedoms[i].value[k];
    }
    done = done && sp_soft_solve(search, freedoms, design->count, width, budget, values, refining->error) &&
           line_search(refining, freedoms, values, careful, budget, design, stayed);
    free(freedoms);
    free(values);
    return done;
}

/* Takes the copy over where it covers more on the coarse patches with no more water. */
static void keep_better(sp_design *design, sp_design *copy, double budget)
{
    bool better = copy->covered > design->covered && copy->flow <= budget * (1 + 1e-9);
    sp_design_free(better ? design : copy);
    if (better)
        *design = *copy;
}

/* Anneals from the given width on and leaves the design at the best of its steps on the coarse patches. */
static bool anneal(const sp_refining *refining, sp_design *design, size_t start, double budget)
{
    const sp_search *search = refining->search;
    sp_design moving;
    if (!sp_design_copy(search, design, &moving, refining->error))
        return false;
    bool done = true;
    for (size_t w = start; done && w < WIDTHS && sp_watch_goes_on(refining->watch, "refine", (double)w / WIDTHS); w++) {
        sp_design copy;
        bool stayed;
        done = step(refining, widths[w], w >= CAREFUL, budget, &moving, &stayed) &&
               sp_design_copy(search, &moving, &copy, refining->error);
        if (done)
            keep_better(design, &copy, budget);
    }
    sp_design_free(&moving);
    return done;
}

/* Refines a design at equal water: annealed with Ceres while that gains, then by compass. The front measures each. */
static bool refine(const sp_refining *refining, sp_design *design, int rounds)
{
    const sp_search *search = refining->search;
    double budget = fmin(design->flow, search->options->max_water), before = design->covered;
    size_t start = 0;
    for (int round = 0; round < rounds && start < STARTS && design->count; round++) {
        if (!sp_watch_goes_on(refining->watch, "refine", 0))
            return true;
        double last = design->covered;
        if (!anneal(refining, design, starts[start], budget))
            return false;
        start += design->covered <= last * (1 + GAIN_REPEAT);
    }
    if (design->covered > before && !sp_front_measure(refining->front, search, design, NULL, refining->error))
        return false;
    before = design->covered;
    return sp_compass(search, budget, refining->watch, design, refining->error) &&
           (design->covered <= before || sp_front_measure(refining->front, search, design, NULL, refining->error));
}

/* Refines a copy of the best design; the front takes what is better. */
static bool polish(const sp_refining *refining)
{
    sp_design design;
    if (!sp_design_copy(refining->search, &refining->front->best, &design, refining->error))
        return false;
    bool done = refine(refining, &design, ROUNDS_MOST);
    sp_design_free(&design);
    return done;
}

static bool same(const sp_front_point *a, const sp_front_point *b)
{
    return fabs(a->area - b->area) <= GAIN_LEAST * b->area && fabs(a->flow - b->flow) <= GAIN_LEAST * b->flow;
}

/* Turns adjustable nozzles down while the target holds. */
static bool save_flow(const sp_refining *refining)
{
    const sp_search *search = refining->search;
    sp_front *front = refining->front;
    double high = front->best.flow, low = search->kept_flow;
    for (size_t i = 0; i < front->best.count; i++)
        low += least_flow(search, &front->best.items[i]);
    sp_design full;
    if (!(low < high * (1 - 1e-6)))
        return true;
    if (!sp_design_copy(search, &front->best, &full, refining->error))
        return false;
    bool done = true;
    for (int trial = 0; done && trial < FLOW_TRIALS && sp_watch_goes_on(refining->watch, "refine", 1); trial++) {
        sp_design design;
        sp_front_point point;
        double middle = 0.5 * (low + high);
        done = sp_design_copy(search, &full, &design, refining->error);
        if (!done)
            break;
        turn_down(search, &design, middle);
        done = retrace(search, &design, refining->error) &&
               sp_front_measure(front, search, &design, &point, refining->error);
        sp_design_free(&design);
        if (done && point.area >= front->target)
            high = middle;
        else
            low = middle;
    }
    sp_design_free(&full);
    return done;
}

/* Less water by the share given: exchange within it, then refine to make up for what is missing. *saved says whether
 * the best design got better. */
static bool save_share(const sp_refining *refining, double share, bool *saved)
{
    const sp_search *search = refining->search;
    sp_front *front = refining->front;
    sp_front_point before = front->measured;
    sp_design reduced;
    bool found;
    *saved = false;
    if (!sp_reduce(search, refining->pool, &front->best, front->best.flow * (1 - share), front->target - front->bias,
                   refining->watch, &reduced, &found, refining->error))
        return false;
    if (!found)
        return true;
    bool done = sp_front_measure(front, search, &reduced, NULL, refining->error);
    double missing = front->target - front->bias - reduced.covered;
    if (done && same(&before, &front->measured) && missing < MISSING_MOST * front->target)
        done = refine(refining, &reduced, ROUNDS_SAVING);
    sp_design_free(&reduced);
    *saved = done && !same(&before, &front->measured);
    return done;
}

static bool save_water(const sp_refining *refining)
{
    static const double shares[] = {0.12, 0.06, 0.03};
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

/* The front's other designs get a quick refinement each. */
static bool polish_front(const sp_refining *refining)
{
    const sp_search *search = refining->search;
    sp_front *front = refining->front;
    bool done = true;
    double passed = search->kept_flow; /* what has been refined reaches up to this water */
    for (size_t i = 0; done && i < front->count && sp_watch_goes_on(refining->watch, "refine", 1);) {
        sp_design design;
        double flow = front->entries[i].point.flow;
        if (flow <= passed || flow >= front->measured.flow) {
            i++;
            continue;
        }
        passed = flow;
        done = sp_design_copy(search, &front->entries[i].design, &design, refining->error);
        if (!done)
            break;
        done = refine(refining, &design, 1);
        sp_design_free(&design);
    }
    return done;
}

bool sp_refine_best(const sp_search *search, const sp_pool *pool, sp_watch *watch, sp_front *front, sp_error *error)
{
    const sp_refine *allowed = &search->options->refine;
    sp_refining refining = {search, pool, watch, front, error};
    if (allowed->position == 0 && allowed->axis == 0 && !allowed->roll && allowed->angle == 0 && allowed->flow == 0)
        return true;
    if (!polish(&refining))
        return false;
    bool saves = front->objective != SP_OBJECTIVE_MAX_COVERAGE && front->measured.area >= front->target;
    if (saves && !(save_water(&refining) && polish(&refining) && save_flow(&refining)))
        return false;
    return polish_front(&refining);
}
