/* Placements by several settings: what each proposes, what points confirm of it, and how long it takes. */
#include "state.h"

#include <math.h>
#include <stdlib.h>

#define SECONDS 420 /* of wall time for all placements, where the study has no limit */
#define APART 0.03  /* of the texel, within a group */
enum { TEXELS = 3, SHARES = 2, IN_GROUP = 3, GROUPS = TEXELS + SP_STUDY_TRAJECTORIES + SHARES };
static const double texel_steps[TEXELS] = {4, 2, 1};
static const double shares[SHARES] = {0.25, 0.5}; /* of the seconds that the placement takes without a limit */

/* Three placements that differ by their texels alone. */
typedef struct {
    sp_fidelity fidelity;
    bool refine;
    double share; /* 0: no limit but the study's own */
} group;

typedef struct {
    group groups[GROUPS];
    size_t count;
} plan;

static void add(plan *p, const sp_setup *setup, double texel, sp_trajectory trajectory, bool refine, double share)
{
    group *g = &p->groups[p->count++];
    *g = (group){.fidelity = setup->fidelity, .refine = refine, .share = share};
    g->fidelity.trajectory = trajectory;
    g->fidelity.method = SP_METHOD_INVERSE;
    g->fidelity.splat = SP_SPLAT_NEAREST;
    g->fidelity.reflections = 0;
    g->fidelity.texel = texel;
}

static bool refines(const sp_refine *refine)
{
    return refine->position != 0 || refine->axis > 0 || refine->roll || refine->angle > 0 || refine->flow > 0;
}

/* The quickest first, so that the others have what they leave of the time; those with little time last: they need to
 * know how long the others took. */
static plan make_plan(const sp_setup *setup, const sp_place_options *place, double texel)
{
    plan p = {.count = 0};
    bool set = setup->fidelity.texel > 0, refine = refines(&place->refine);
    double middle = set ? texel : 2 * texel;
    sp_trajectory trajectories[SP_STUDY_TRAJECTORIES], trajectory = sp_study_reference_trajectory(setup);
    size_t simpler = sp_study_trajectories(setup, trajectories) - 1;
    if (refine)
        add(&p, setup, middle, trajectory, false, 0);
    for (size_t i = 0; i < simpler; i++)
        add(&p, setup, middle, trajectories[i], refine, 0);
    for (size_t i = 0; i < TEXELS; i++)
        if (!set || texel_steps[i] == 1)
            add(&p, setup, texel_steps[i] * texel, trajectory, refine, 0);
    for (size_t i = 0; i < SHARES; i++)
        add(&p, setup, middle, trajectory, refine, shares[i]);
    return p;
}

/* Of the placements like this one but without a limit, the middle one's. */
static double seconds_of(const sp_study *study, const group *g)
{
    for (size_t i = 0; i < study->place_count; i++) {
        const sp_study_place *place = &study->places[i];
        if (place->shift == 0 && !place->limited && place->refine == g->refine &&
            place->fidelity.trajectory == g->fidelity.trajectory && place->fidelity.texel == g->fidelity.texel)
            return place->seconds;
    }
    return INFINITY;
}

/* What holds at the points, into studying->values. */
static bool confirm(sp_studying *studying, const sp_layout *layout, sp_error *error)
{
    sp_trajectory trajectory = sp_study_reference_trajectory(studying->setup);
    sp_reference *reference = sp_reference_create(studying->own, layout, trajectory, error);
    bool good = sp_sample_covered(studying, reference, studying->values, error);
    sp_reference_destroy(reference);
    return good;
}

static bool search(sp_studying *studying, const sp_evaluator *evaluator, const sp_place_options *place,
                   sp_study_place *found, sp_error *error)
{
    sp_place_options options = *place;
    options.run = sp_study_place_run(studying);
    options.run.time_limit = found->limited ? found->limit : 0;
    options.prove = false;
    if (!found->refine)
        options.refine = (sp_refine){0};
    sp_study_placing(studying, found->limited ? INFINITY : found->limit);
    sp_proposal *proposal = sp_place(evaluator, &options, error);
    sp_clock_reading taken = sp_study_placed(studying, &found->ended_early);
    bool good = proposal && confirm(studying, proposal->layout, error);
    if (good) {
        sp_point_mean sample = sp_sample_of(studying->values, studying->points);
        found->nozzles = proposal->layout->count;
        found->water = proposal->coverage->flow;
        found->outlay = proposal->outlay;
        found->costly = proposal->costly;
        found->coverage = proposal->coverage->fraction;
        found->reached = proposal->reached;
        found->confirmed = sample.mean;
        found->confirmed_spread = sample.spread;
        found->seconds = taken.wall;
        found->cpu = taken.cpu;
    }
    sp_proposal_destroy(proposal);
    return good;
}

static bool run_one(sp_studying *studying, const sp_place_options *place, const group *g, int shift, double limit,
                    sp_study_place *found, sp_error *error)
{
    const sp_study_options *options = studying->options;
    *found = (sp_study_place){
        .fidelity = g->fidelity, .refine = g->refine, .shift = shift, .limit = limit, .limited = g->share > 0};
    found->fidelity.texel *= 1 + APART * shift;
    sp_setup setup = sp_study_setup(studying, &found->fidelity);
    if (options->meter_start)
        options->meter_start();
    sp_evaluator *evaluator = sp_evaluator_create(&setup, error);
    bool good = evaluator && search(studying, evaluator, place, found, error);
    found->memory = options->meter_peak ? options->meter_peak() : 0;
    sp_evaluator_destroy(evaluator);
    return good;
}

/* Three placements, which have as much time each; false where the study is to end. */
static bool run_group(sp_studying *studying, const sp_place_options *place, const plan *p, size_t index, double limit,
                      sp_study *study, sp_error *error)
{
    const group *g = &p->groups[index];
    for (int i = 0; i < IN_GROUP; i++) {
        size_t number = IN_GROUP * index + (size_t)i;
        if (!sp_study_next(studying, "place", number, IN_GROUP * p->count, limit, error) ||
            !run_one(studying, place, g, i - 1, limit, &study->places[study->place_count], error))
            return false;
        study->place_count++;
        if (studying->cancelled)
            return sp_fail(error, SP_ERROR_INTERRUPTED, NULL, 0, 0, "interrupted");
    }
    return true;
}

/* Of what is left of the time, a placement's even share. */
static double fair_limit(const plan *p, size_t from, double left)
{
    double placements = 0;
    for (size_t i = from; i < p->count; i++)
        placements += IN_GROUP * (p->groups[i].share > 0 ? p->groups[i].share : 1);
    return fmax(0, left) / placements;
}

bool sp_study_run_places(sp_studying *studying, const sp_place_options *place, double texel, sp_study *study,
                         sp_error *error)
{
    plan p = make_plan(studying->setup, place, texel);
    sp_clock_reading start = sp_moment_now();
    double time = sp_study_left(studying);
    time = isinf(time) ? SECONDS : time;
    study->places = calloc(IN_GROUP * p.count, sizeof *study->places);
    if (!study->places)
        return sp_fail_memory(error);
    for (size_t i = 0; i < p.count; i++) {
        const group *g = &p.groups[i];
        double limit = fair_limit(&p, i, time - sp_moment_since(start).wall);
        if (g->share > 0)
            limit = g->share * fmin(limit, seconds_of(study, g));
        if (!run_group(studying, place, &p, i, limit, study, error))
            return false;
    }
    return true;
}
