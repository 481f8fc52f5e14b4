#include "refine.h"

#include "anneal.h"
#include "compass.h"

#include <stdlib.h>
#include <string.h>

#define ROUNDS_MOST 5        /* annealings of one design */
#define FLOW_TRIALS 7        /* measurements to find how far the flow can be turned down */
#define GAIN_LEAST 1e-4      /* of area or water: less is no improvement */
#define ROUNDS_SAVING 2      /* the same, for a design that may turn out short of the target */
#define MISSING_MOST 0.02    /* of the target: more, refinement is not expected to make up for */
#define GAIN_REPEAT 1e-3     /* of the area: less is no reason to anneal the same way again */
#define ROUGH_PATCHES 5000.0 /* wide annealing sees no more detail than these show */
#define ROUGH_END 5          /* width from which the search's own patches are needed */
#define SIGHTS 48

/* Where an annealing starts. A narrow one keeps what is there; a wide one forgets it, and may find what is better. */
static const size_t starts[] = {4, 2, 0};
#define STARTS (sizeof starts / sizeof *starts)

typedef struct {
    const sp_search *search;
    const sp_pool *pool;
    sp_watch *watch;
    sp_front *front;
    sp_error *error;
    sp_evaluator *rough_evaluator; /* NULL: the search's patches are few enough */
    sp_search rough;
    sp_sights sights, rough_sights;
} sp_refining;

static void refining_free(sp_refining *refining)
{
    sp_sights_free(&refining->sights);
    sp_sights_free(&refining->rough_sights);
    if (refining->rough_evaluator)
        sp_search_free(&refining->rough);
    sp_evaluator_destroy(refining->rough_evaluator);
}

static bool refining_create(const sp_search *search, const sp_pool *pool, sp_watch *watch, sp_front *front,
                            sp_refining *refining, sp_error *error)
{
    const sp_patches *patches = sp_evaluator_patches(search->coarse);
    *refining = (sp_refining){.search = search, .pool = pool, .watch = watch, .front = front, .error = error};
    size_t most = search->options->max_nozzles, capacity = SIGHTS;
    for (size_t i = 0; i < front->count; i++)
        most = front->entries[i].design.count > most ? front->entries[i].design.count : most;
    capacity += 2 * most;
    refining->rough = *search;
    bool done = true;
    if ((double)patches->count > 1.5 * ROUGH_PATCHES) {
        refining->rough_evaluator =
            sp_evaluator_resample(front->fine, sqrt(patches->total_area / ROUGH_PATCHES), error);
        done = refining->rough_evaluator &&
               sp_search_create(refining->rough_evaluator, search->options, search->sites, search->candidates,
                                search->visibility, &refining->rough, error);
    }
    done = done && sp_sights_create(search, capacity, &refining->sights, error) &&
           sp_sights_create(&refining->rough, capacity, &refining->rough_sights, error);
    if (!done)
        refining_free(refining);
    return done;
}

/* The same nozzles on other patches. */
static bool transfer(sp_sights *sights, const sp_design *from, sp_design *to, sp_error *error)
{
    if (!sp_design_create(sights->search, to, error))
        return false;
    bool done = true;
    for (size_t i = 0; done && i < from->count; i++) {
        sp_placed placed = from->items[i];
        placed.field = malloc(sights->search->patch_count * sizeof *placed.field);
        done = placed.field ? sp_sights_field(sights, &placed, placed.field, error) : (bool)sp_fail_memory(error);
        if (done)
            done = sp_design_add(sights->search, to, placed, error);
        else
            free(placed.field);
    }
    if (!done)
        sp_design_free(to);
    return done;
}

/* Takes the copy over where it covers more. */
static void keep_better(sp_design *design, sp_design *copy)
{
    bool better = copy->covered > design->covered;
    sp_design_free(better ? design : copy);
    if (better)
        *design = *copy;
}

/* Anneals from the given width on: the soft part on few patches, the sharp part on the search's own. */
static bool anneal(sp_refining *refining, sp_design *design, size_t start, double budget)
{
    sp_design rough, sharp;
    size_t middle = refining->rough_evaluator ? ROUGH_END : start;
    if (!transfer(&refining->rough_sights, design, &rough, refining->error))
        return false;
    bool done = sp_anneal(&refining->rough_sights, start, middle, budget, refining->watch, &rough, refining->error) &&
                transfer(&refining->sights, &rough, &sharp, refining->error);
    sp_design_free(&rough);
    if (!done)
        return false;
    done = sp_anneal(&refining->sights, middle, SP_WIDTHS, budget, refining->watch, &sharp, refining->error);
    keep_better(design, &sharp);
    return done;
}

/* Refines a design at equal water: annealed with Ceres while that gains, then by compass. The front measures each. */
static bool refine(sp_refining *refining, sp_design *design, int rounds)
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
    return sp_compass(&refining->sights, budget, refining->watch, design, refining->error) &&
           (design->covered <= before || sp_front_measure(refining->front, search, design, NULL, refining->error));
}

/* Refines a copy of the best design; the front takes what is better. */
static bool polish(sp_refining *refining)
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
static bool save_flow(sp_refining *refining)
{
    const sp_search *search = refining->search;
    sp_front *front = refining->front;
    double high = front->best.flow, low = search->kept_flow;
    for (size_t i = 0; i < front->best.count; i++)
        low += sp_least_flow(search, &front->best.items[i]);
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
        sp_turn_down(search, &design, middle);
        done = sp_design_look(&refining->sights, &design, refining->error) &&
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
static bool save_share(sp_refining *refining, double share, bool *saved)
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

static bool save_water(sp_refining *refining)
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
static bool polish_front(sp_refining *refining)
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

static bool refine_all(sp_refining *refining)
{
    const sp_front *front = refining->front;
    if (!polish(refining))
        return false;
    bool saves = front->objective != SP_OBJECTIVE_MAX_COVERAGE && front->measured.area >= front->target;
    if (saves && !(save_water(refining) && polish(refining) && save_flow(refining)))
        return false;
    return polish_front(refining);
}

bool sp_refine_best(const sp_search *search, const sp_pool *pool, sp_watch *watch, sp_front *front, sp_error *error)
{
    const sp_refine *allowed = &search->options->refine;
    if (allowed->position == 0 && allowed->axis == 0 && !allowed->roll && allowed->angle == 0 && allowed->flow == 0)
        return true;
    sp_refining refining;
    if (!refining_create(search, pool, watch, front, &refining, error))
        return false;
    bool done = refine_all(&refining);
    refining_free(&refining);
    return done;
}
