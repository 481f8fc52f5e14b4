#include "attainable/attainable.h"
#include "candidates/valid_options.h"
#include "scoring/prepare.h"
#include "certificate/certificate.h"
#include "deadline/time_shares.h"
#include "forward_check.h"
#include "remedies.h"
#include "scoring/footprints.h"
#include "search/few_jets.h"
#include "search/front_gaps.h"
#include "search/find.h"
#include "search/known.h"
#include "ceres/least_squares.h"
#include "refine/other_types.h"
#include "refine/refine.h"
#include "refine/settable.h"

#include "ranks/messages.h"

#include <sprayplan/points.h>

#include <stdlib.h>
#include <string.h>

/* Measuring the proposal's error takes so many seconds of processor, roughly, and may end so much of the limit late. */
#define MEASURING 0.25
#define MEASURING_LATE 0.1
#define FIRST_HURRIED 0.93 /* of the target, for a first layout of which little more than the poses is wanted */

/* What a placement makes on its way, in the order in which it comes about. */
typedef struct {
    const sp_evaluator *fine;
    const sp_place_options *options;
    sp_deadline deadline;
    sp_sites sites;
    sp_candidates candidates;
    sp_evaluator *resampled; /* NULL: the fine one is coarse enough */
    sp_visibility visibility;
    sp_search search;
    sp_pool pool;
    sp_front front;
} sp_placement;

static void placement_free(sp_placement *placement)
{
    sp_front_free(&placement->front);
    sp_pool_free(&placement->pool);
    sp_search_free(&placement->search);
    sp_visibility_free(&placement->visibility);
    sp_evaluator_destroy(placement->resampled);
    sp_candidates_free(&placement->candidates);
    sp_sites_free(&placement->sites);
    free(placement->deadline.stages);
}

static bool check(const sp_evaluator *evaluator, const sp_place_options *options, sp_error *error)
{
    if (!options->mount_count)
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "place: no mounts");
    if (!(options->coverage >= 0 && options->coverage <= 1))
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "place: coverage: %g, expected 0 to 1", options->coverage);
    const sp_setup *setup = sp_evaluator_setup(evaluator);
    if (setup->sweep.speed > 0 && !(setup->criterion.flux > 0))
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                       "dose: found none, expected one such as 2 L/m2: place proposes nozzles for what goods that move "
                       "have to take");
    if (setup->sweep.speed > 0 && setup->criterion.combine == SP_COMBINE_SINGLE)
        return sp_fail(
            error, SP_ERROR_INPUT, NULL, 0, 0,
            "combine: found single beside a sweep, expected sum: place adds up what goods that move take from "
            "all nozzles");
    for (size_t i = 0; options->kept && i < options->kept->count; i++)
        if (options->kept->nozzles[i].keep &&
            (!sp_evaluator_admits(evaluator, &options->kept->nozzles[i], error) ||
             !sp_mounts_admit(setup, options->mounts, options->mount_count, &options->kept->nozzles[i], error)))
            return false;
    /* said now, not after the minutes that a search may take */
    return !sp_refine_asked(&options->refine) || sp_least_squares_ready(error);
}

/* m³/s that max_water is short of what the kept nozzles and the least further one take; 0 where one fits. */
static double water_lacking(const sp_search *search)
{
    double least = INFINITY, most = search->options->max_water;
    for (size_t k = 0; k < search->candidates->variant_count; k++)
        least = fmin(least, search->candidates->variants[k].flow);
    double taken = search->kept_flow + least;
    return taken <= most * (1 + SP_ROUNDING) ? 0 : taken - most;
}

/* Mounting points, candidates, and what each point can reach on patches few enough. */
static bool look_around(sp_placement *placement, sp_error *error)
{
    const sp_evaluator *fine = placement->fine;
    if (!sp_sites_create(fine, placement->options, &placement->sites, error) ||
        !sp_candidates_create(fine, placement->options, &placement->sites, &placement->candidates, error))
        return false;
    if (!sp_visibility_fit(fine, placement->options, &placement->sites, &placement->candidates, &placement->deadline,
                           &placement->resampled, &placement->visibility, error))
        return false;
    const sp_evaluator *coarse = placement->resampled ? placement->resampled : fine;
    return sp_search_create(coarse, placement->options, &placement->sites, &placement->candidates,
                            &placement->visibility, &placement->search, error) &&
           sp_deadline_stage(&placement->deadline, "visibility", error) &&
           (!placement->search.footprints ||
            (sp_footprints_fill(placement->search.footprints, &placement->deadline, error) &&
             sp_deadline_stage(&placement->deadline, "footprints", error)));
}

static double area_of(const sp_evaluator *fine, const bool *chosen)
{
    const sp_patches *patches = sp_evaluator_patches(fine);
    double area = 0;
    for (size_t p = 0; p < patches->count; p++)
        area += chosen[p] ? patches->area[p] : 0;
    return area;
}

/* What is asked for, and what to aim at: where less is attainable, that share of what is; what was not looked into may
 * be. */
static void set_areas(const sp_placement *placement, sp_proposal *proposal)
{
    double share = placement->options->coverage, attainable = 0;
    const sp_patches *patches = sp_evaluator_patches(placement->fine);
    for (size_t p = 0; p < patches->count; p++)
        attainable += proposal->attainable[p] || proposal->reasons[p] == SP_REASON_UNKNOWN ? patches->area[p] : 0;
    proposal->asked_area = share * patches->total_area;
    proposal->target_area = attainable < proposal->asked_area ? share * attainable : proposal->asked_area;
}

static bool set_target(sp_placement *placement, sp_proposal *proposal, sp_error *error)
{
    size_t patches = sp_evaluator_patches(placement->fine)->count;
    proposal->attainable = calloc(patches ? patches : 1, sizeof *proposal->attainable);
    proposal->reasons = calloc(patches ? patches : 1, sizeof *proposal->reasons);
    if (!proposal->attainable || !proposal->reasons)
        return sp_fail_memory(error);
    if (!sp_attainable(placement->fine, &placement->search, &placement->deadline, proposal->reasons, error))
        return false;
    for (size_t p = 0; p < patches; p++)
        proposal->attainable[p] = proposal->reasons[p] == SP_REASON_ATTAINABLE;
    set_areas(placement, proposal);
    placement->front = (sp_front){.fine = placement->fine,
                                  .deadline = &placement->deadline,
                                  .objective = placement->options->objective,
                                  .target = proposal->target_area};
    return sp_deadline_stage(&placement->deadline, "attainable", error);
}

/* The best partial layout so far as a layout with its coverage. */
static bool write_down(const sp_placement *placement, sp_layout **layout, sp_coverage **coverage, sp_error *error)
{
    *layout = sp_partial_to_layout(&placement->search, &placement->front.best, error);
    *coverage = *layout ? sp_evaluate(placement->fine, *layout, error) : NULL;
    return *coverage != NULL;
}

/* What the mounts of the best layout's nozzles cost, the kept ones' first; malloc'd, NULL with an error. */
static double *list_costs(const sp_placement *placement, sp_error *error)
{
    const sp_search *search = &placement->search;
    const sp_partial *best = &placement->front.best;
    double *costs = calloc(search->kept_count + best->count + 1, sizeof *costs);
    for (size_t i = 0; costs && i < best->count; i++)
        costs[search->kept_count + i] = search->options->mounts[best->items[i].site.mount].cost;
    return costs ? costs : sp_fail_memory(error);
}

/* The best found on the candidates. */
static bool write_greedy(sp_placement *placement, sp_proposal *proposal, sp_error *error)
{
    if (!write_down(placement, &proposal->greedy, &proposal->greedy_coverage, error) ||
        !(proposal->greedy_costs = list_costs(placement, error)))
        return false;
    return sp_aim_by_few_jets(&placement->front, &placement->search, proposal->target_area,
                              proposal->greedy_coverage->covered_area, error);
}

/* By what the scene says of the best draft of now. */
static bool aim_again(sp_placement *placement, const sp_proposal *proposal, sp_error *error)
{
    sp_layout *layout = NULL;
    sp_coverage *coverage = NULL;
    if (!placement->front.draft_jets || !sp_deadline_goes_on(&placement->deadline, "refine", 1))
        return true;
    bool done =
        write_down(placement, &layout, &coverage, error) &&
        sp_aim_by_few_jets(&placement->front, &placement->search, proposal->target_area, coverage->covered_area, error);
    sp_coverage_destroy(coverage);
    sp_layout_destroy(layout);
    return done;
}

/* False where what candidates bring could not be found when it was asked for. */
static bool is_sound(const sp_placement *placement, sp_error *error)
{
    return sp_visibility_sound(&placement->visibility, error) &&
           sp_footprints_sound(placement->search.footprints, error);
}

/* A proposal next to the first layout, before better ones and the front are looked for; the first layout stands for the
 * best of the candidates, and with its first nozzles for what less water can do. */
static bool refine_first(sp_placement *placement, const sp_partial *first, sp_proposal *proposal, sp_error *error)
{
    return write_greedy(placement, proposal, error) && is_sound(placement, error) &&
           sp_find_steps(&placement->search, first, &placement->deadline, &placement->front, error) &&
           sp_deadline_stage(&placement->deadline, "greedy", error) &&
           sp_refine_first(&placement->search, &placement->pool, &placement->deadline, &placement->front, error) &&
           sp_deadline_stage(&placement->deadline, "refine", error);
}

/* At leisure all is found on the candidates before anything is refined. In a hurry the proposal comes first, and where
 * the time may be short for all that it has a share of it, so that there is something by then. */
static bool find(sp_placement *placement, sp_proposal *proposal, sp_error *error)
{
    sp_search *search = &placement->search;
    const sp_run *run = &placement->options->run;
    sp_deadline *deadline = &placement->deadline;
    sp_front *front = &placement->front;
    front->draft_jets = sp_few_jets(search, placement->fine);
    bool refines = sp_refine_asked(&placement->options->refine), brief = sp_run_hurries(run);
    bool hurried = refines && (brief || sp_deadline_presses(deadline));
    sp_partial first;
    if (!sp_take_known(front, search, error) ||
        !sp_find_first(search, hurried ? FIRST_HURRIED : 1, deadline, front, &placement->pool, &first, error))
        return false;
    if (hurried && !brief)
        sp_deadline_lend(deadline, SP_FIRST_SHARE);
    bool done = !hurried || refine_first(placement, &first, proposal, error);
    sp_deadline_allow(deadline, sp_search_share(placement->options));
    done = done && (!hurried || aim_again(placement, proposal, error)) &&
           sp_find_more(search, deadline, front, &placement->pool, &first, error) &&
           (hurried || write_greedy(placement, proposal, error));
    sp_partial_free(&first);
    return done;
}

/* What was found on the candidates, moved and aimed anew, put together anew, and all of it as it can be set, the best
 * then of the types that suit its places; in the end as the scene measures it. */
static bool improve(sp_placement *placement, const sp_proposal *proposal, sp_error *error)
{
    const sp_search *search = &placement->search;
    sp_deadline *deadline = &placement->deadline;
    sp_front *front = &placement->front;
    if (!sp_refine_best(search, &placement->pool, deadline, front, error) ||
        !sp_deadline_stage(deadline, "refine", error) ||
        !sp_fill_front(search, &placement->pool, deadline, front, error) ||
        !sp_fill_front_by_jets(search, &placement->pool, deadline, front, error) ||
        !sp_deadline_stage(deadline, "fill", error))
        return false;
    sp_deadline_allow(deadline, sp_setting_share(placement->options));
    if (!sp_set_front(search, deadline, front, error) || !sp_try_other_types(search, deadline, front, error))
        return false;
    sp_deadline_allow(deadline, sp_counting_share(placement->options));
    return sp_count_by_all_jets(front, search, proposal->target_area, error);
}

/* The best in the end as the proposal, with which of its nozzles want a fitting and what their mounts cost. */
static bool propose(sp_placement *placement, sp_proposal *proposal, sp_error *error)
{
    const sp_search *search = &placement->search;
    if (!sp_front_settle(&placement->front, search, error) ||
        !write_down(placement, &proposal->layout, &proposal->coverage, error) ||
        !(proposal->costs = list_costs(placement, error)))
        return false;
    proposal->costly = search->costly;
    proposal->outlay = proposal->coverage->flow + sp_partial_costs(search, &placement->front.best);
    proposal->fittings = calloc(proposal->layout->count + 1, sizeof *proposal->fittings);
    for (size_t i = 0; proposal->fittings && i < placement->front.best.count; i++) {
        uint32_t mount = placement->front.best.items[i].site.mount;
        proposal->fittings[search->kept_count + i] = search->options->mounts[mount].kind != SP_MOUNT_PORT;
    }
    return proposal->fittings || sp_fail_memory(error);
}

static bool measure(const sp_placement *placement, sp_proposal *proposal, sp_error *error)
{
    return sp_measure_error(placement->fine, proposal->layout, proposal->coverage, SP_TRAJECTORY_AUTO,
                            sp_evaluator_fidelity(placement->fine)->seed, &proposal->coverage->measured, error);
}

/* Every layout of the fronts, counted on the fine evaluator of now. */
static bool count_front_again(sp_placement *placement, const sp_front *before, sp_error *error)
{
    const sp_front_list *lists[] = {&before->by_water, &before->by_number};
    bool done = sp_front_measure(&placement->front, &placement->search, &before->best, NULL, error);
    for (int k = 0; k < 2; k++)
        for (size_t i = 0; done && i < lists[k]->count; i++)
            done = sp_front_measure(&placement->front, &placement->search, &lists[k]->entries[i].partial, NULL, error);
    return done;
}

/* All that was found, on another evaluator, which becomes the proposal's; what is best then is proposed. */
static bool count_again(sp_placement *placement, sp_proposal *proposal, sp_evaluator *again, sp_error *error)
{
    sp_front before = placement->front;
    sp_evaluator *outdated = proposal->again;
    placement->front = (sp_front){0};
    placement->fine = proposal->again = again;
    free(proposal->attainable);
    free(proposal->reasons);
    sp_coverage_destroy(proposal->greedy_coverage);
    sp_coverage_destroy(proposal->coverage);
    sp_layout_destroy(proposal->layout);
    free(proposal->fittings);
    free(proposal->costs);
    proposal->fittings = NULL;
    proposal->costs = NULL;
    proposal->attainable = NULL;
    proposal->reasons = NULL;
    proposal->coverage = NULL;
    proposal->layout = NULL;
    proposal->greedy_coverage = sp_evaluate(again, proposal->greedy, error);
    bool done = proposal->greedy_coverage && set_target(placement, proposal, error) &&
                count_front_again(placement, &before, error) && propose(placement, proposal, error);
    sp_front_free(&before);
    sp_evaluator_destroy(outdated);
    return done;
}

/* Where a machine is so busy that an error takes too long to measure. Who interrupts a placement waits for it. */
static bool is_too_late(sp_deadline *deadline)
{
    return sp_deadline_left(deadline) + MEASURING_LATE * deadline->run.time_limit <
               MEASURING / sp_deadline_pace(deadline) &&
           !deadline->cancelled;
}

/* No coverage is proposed that points of the surface do not confirm: where auto's choice does not keep the accuracy, or
 * was made by lines for another layout, all is counted again by a dearer one, as long as there are any. */
static bool confirm(sp_placement *placement, sp_proposal *proposal, sp_error *error)
{
    sp_deadline_allow(&placement->deadline, 1);
    double accuracy = sp_evaluator_fidelity(placement->fine)->accuracy;
    if (is_too_late(&placement->deadline)) {
        sp_deadline_cut(&placement->deadline, "measured error");
        return sp_deadline_stage(&placement->deadline, "measured error", error);
    }
    while (measure(placement, proposal, error)) {
        const sp_measured_error *measured = &proposal->coverage->measured;
        bool off = measured->known && measured->estimate > accuracy;
        sp_evaluator *again = NULL;
        if (!sp_deadline_has_time(&placement->deadline, "measured error", 0)) {
            if (off)
                sp_deadline_cut(&placement->deadline, "measured error");
            return sp_deadline_stage(&placement->deadline, "measured error", error);
        }
        if (!sp_evaluator_again(placement->fine, off, &again, error))
            return false;
        if (!again)
            return sp_deadline_stage(&placement->deadline, "measured error", error);
        if (!count_again(placement, proposal, again, error))
            return false;
    }
    return false;
}

/* What would mend the shadows of the scene's own nozzles, which all stay. */
static bool mend_own(sp_placement *placement, sp_proposal *proposal, sp_error *error)
{
    const sp_layout *own = placement->options->kept;
    if (!placement->options->mend_kept || !own || !own->count)
        return true;
    if (!sp_deadline_has_time(&placement->deadline, "remedies", 0)) {
        sp_deadline_cut(&placement->deadline, "remedies");
        return true;
    }
    sp_search keeping;
    if (!sp_search_keep_all(&placement->search, &keeping, error))
        return false;
    sp_partial partial = {0};
    sp_coverage *coverage = sp_evaluate(placement->fine, own, error);
    bool done = coverage && sp_partial_create(&keeping, &partial, error) &&
                sp_remedies_find(&keeping, placement->fine, &partial, coverage, &placement->deadline,
                                 proposal->own_remedies, &proposal->own_remedy_count, error);
    sp_partial_free(&partial);
    sp_coverage_destroy(coverage);
    sp_search_keep_all_free(&keeping);
    return done;
}

/* What would mend the shadows of the proposal, and then those of the layout that it is compared with. */
static bool find_remedies(sp_placement *placement, sp_proposal *proposal, sp_error *error)
{
    return sp_remedies_find(&placement->search, placement->fine, &placement->front.best, proposal->coverage,
                            &placement->deadline, proposal->remedies, &proposal->remedy_count, error) &&
           mend_own(placement, proposal, error) && sp_deadline_stage(&placement->deadline, "remedies", error);
}

/* Nothing is proved by the one evaluation of which the other was not asked first. */
static bool check_forward(sp_placement *placement, sp_proposal *proposal, sp_error *error)
{
    return sp_check_forward(placement->search.coarse, proposal->layout, &placement->deadline, &proposal->forward_check,
                            error) &&
           sp_deadline_stage(&placement->deadline, "forward check", error);
}

/* How near to the best all that is, in the time that is left. */
static bool certify(sp_placement *placement, sp_proposal *proposal, sp_error *error)
{
    return sp_certify(&placement->search, &placement->deadline, &placement->front, &proposal->certificate, error);
}

/* What a reported layout covers is attainable: patches of which it covers half or more, and never less in all than it
 * covers. The attainable area, m². */
static double note_attained(const sp_evaluator *fine, sp_proposal *proposal)
{
    for (size_t p = 0; p < proposal->coverage->deposits.count; p++)
        if (proposal->coverage->deposits.covered[p] || proposal->greedy_coverage->deposits.covered[p]) {
            proposal->attainable[p] = true;
            proposal->reasons[p] = SP_REASON_ATTAINABLE;
        }
    return fmax(area_of(fine, proposal->attainable),
                fmax(proposal->coverage->covered_area, proposal->greedy_coverage->covered_area));
}

static bool conclude(sp_placement *placement, sp_proposal *proposal, sp_error *error)
{
    const sp_place_options *options = placement->options;
    proposal->attainable_area = note_attained(placement->fine, proposal);
    proposal->reached = proposal->asked_area > 0 && proposal->coverage->covered_area >= proposal->asked_area &&
                        proposal->coverage->flow <= options->max_water * (1 + SP_ROUNDING) &&
                        (!options->max_nozzles || proposal->layout->count <= options->max_nozzles);
    proposal->objective = options->objective;
    proposal->max_nozzles = options->max_nozzles;
    proposal->max_water = options->max_water;
    proposal->interrupted = placement->deadline.interrupted;
    proposal->water_lacking = water_lacking(&placement->search);
    proposal->positions = placement->sites.count;
    proposal->candidates = placement->candidates.pose_start[placement->sites.count];
    proposal->front = sp_front_by_water(&placement->front, &proposal->front_count, error);
    proposal->by_number = sp_front_by_number(&placement->front, &proposal->by_number_count, error);
    proposal->found = sp_found_create(&placement->front, &placement->search, proposal->again, error);
    proposal->stage_count = placement->deadline.stage_count;
    proposal->stages = placement->deadline.stages;
    proposal->cut_count = placement->deadline.cut_count;
    proposal->attainable_hurried = sp_deadline_was_cut(&placement->deadline, "attainable");
    memcpy(proposal->cut, placement->deadline.cut, sizeof proposal->cut);
    placement->deadline.stages = NULL;
    return proposal->front && proposal->by_number && proposal->found;
}

/* What all ranks decide alike has to be the same on all: so many threads as every one has, and the shortest time. Where
 * they see other surface they have read other files. */
static bool settle(const sp_evaluator *evaluator, const sp_place_options *given, sp_place_options *options,
                   sp_error *error)
{
    const sp_patches *patches = sp_evaluator_patches(evaluator);
    *options = *given;
    double limit = options->run.time_limit > 0 ? options->run.time_limit : INFINITY;
    double most[] = {-(double)sp_threads(&options->run), -limit, patches->total_area, -patches->total_area};
    if (!sp_ranks_highest(options->run.ranks, "options", most, 4, error))
        return false;
    if (sp_ranks_lost(options->run.ranks))
        return sp_fail(error, SP_ERROR_INTERRUPTED, NULL, 0, 0, "another rank has failed");
    options->run.threads = (int)-most[0];
    options->run.time_limit = isfinite(most[1]) ? -most[1] : 0;
    return most[2] == -most[3] ||
           sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                   "the ranks see %g and %g m2 of surface, expected the same files on all machines", -most[3], most[2]);
}

sp_proposal *sp_place(const sp_evaluator *evaluator, const sp_place_options *given, sp_error *error)
{
    sp_place_options settled, *options = &settled;
    if (!evaluator || !given || !sp_options_are_valid(given, error) || !settle(evaluator, given, &settled, error) ||
        !check(evaluator, options, error))
        return NULL;
    sp_proposal *proposal = calloc(1, sizeof *proposal);
    if (!proposal)
        return sp_fail_memory(error);
    sp_placement placement = {.fine = evaluator, .options = options, .deadline = sp_deadline_start(&options->run)};
    sp_deadline_allow(&placement.deadline, sp_search_share(options));
    bool done = look_around(&placement, error) && set_target(&placement, proposal, error) &&
                find(&placement, proposal, error) && is_sound(&placement, error) &&
                improve(&placement, proposal, error) && is_sound(&placement, error) &&
                propose(&placement, proposal, error) && sp_deadline_stage(&placement.deadline, "refine", error) &&
                confirm(&placement, proposal, error) && find_remedies(&placement, proposal, error) &&
                check_forward(&placement, proposal, error) && certify(&placement, proposal, error) &&
                is_sound(&placement, error) && sp_deadline_stage(&placement.deadline, "certificate", error) &&
                conclude(&placement, proposal, error);
    placement_free(&placement);
    if (done)
        return proposal;
    sp_proposal_destroy(proposal);
    return NULL;
}

void sp_proposal_destroy(sp_proposal *proposal)
{
    if (!proposal)
        return;
    sp_layout_destroy(proposal->layout);
    free(proposal->fittings);
    free(proposal->costs);
    free(proposal->greedy_costs);
    sp_coverage_destroy(proposal->coverage);
    sp_layout_destroy(proposal->greedy);
    sp_coverage_destroy(proposal->greedy_coverage);
    free(proposal->attainable);
    free(proposal->reasons);
    free(proposal->front);
    free(proposal->by_number);
    sp_found_destroy(proposal->found);
    free(proposal->stages);
    sp_evaluator_destroy(proposal->again);
    free(proposal);
}
