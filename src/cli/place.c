/* sprayplan place: a proposed layout, or one for each alternative, compared with the scene's own nozzles. */
#include "amounts.h"
#include "cli.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LATE                                                                                                           \
    1.5 /* times what measuring one error takes: with less than that and half the ending left it is left out           \
         */

typedef struct {
    sp_coverage *manual;     /* NULL where the scene has no nozzles */
    sp_proposal **proposals; /* [count], one for each alternative in their order, or the only one */
    size_t *which;           /* [count], the alternative that each is for */
    size_t count, best;
    bool ended;    /* some rank was interrupted, or could not go on */
    double ending; /* s, that what follows the search will take; 0 without a limit */
    cli_left_out left_out;
} placement;

/* What a proposal is counted on. */
static const sp_evaluator *evaluator_of(const cli_scene *opened, const sp_proposal *proposal)
{
    return proposal->again ? proposal->again : opened->evaluator;
}

/* What the scene's own nozzles are counted on. */
static const sp_evaluator *own_evaluator(const cli_scene *opened, const placement *found)
{
    return evaluator_of(opened, found->proposals[found->best]);
}

/* The alternative that looks for what would mend the shadows of the scene's own nozzles: that of most mounts, of
 * equals the first. */
static size_t mender(const sp_scene *scene)
{
    size_t widest = 0, most = 0;
    for (size_t i = 0; i < sp_scene_alternative_count(scene); i++) {
        size_t mounts = sp_scene_alternative_options(scene, i).mount_count;
        widest = mounts > most ? i : widest;
        most = mounts > most ? mounts : most;
    }
    return widest;
}

/* None where that alternative was not come to, or was counted on other texels, whose shadows are others. */
static void give_own_remedies(const cli_scene *opened, const placement *found, sp_design *design)
{
    const sp_proposal *proposal = NULL;
    for (size_t i = 0; i < found->count; i++)
        proposal = found->which[i] == mender(opened->scene) ? found->proposals[i] : proposal;
    if (!proposal || evaluator_of(opened, proposal) != own_evaluator(opened, found))
        return;
    design->remedies = proposal->own_remedies;
    design->remedy_count = proposal->own_remedy_count;
}

/* `designs` has room for two more than there are proposals. */
static size_t list_designs(const cli_scene *opened, const placement *found, sp_design *designs)
{
    size_t count = 0;
    bool alternatives = sp_scene_alternative_count(opened->scene) > 0;
    if (found->manual) {
        designs[count] =
            cli_design(opened, "manual", own_evaluator(opened, found), sp_scene_layout(opened->scene), found->manual);
        give_own_remedies(opened, found, &designs[count++]);
    }
    for (size_t i = 0; i < found->count; i++) {
        const sp_proposal *proposal = found->proposals[i];
        const sp_evaluator *evaluator = evaluator_of(opened, proposal);
        const char *name = alternatives ? sp_scene_alternative_name(opened->scene, found->which[i]) : "proposed";
        if (!alternatives) {
            designs[count] = cli_design(opened, "greedy", evaluator, proposal->greedy, proposal->greedy_coverage);
            designs[count++].costs = proposal->greedy_costs;
        }
        designs[count] = cli_design(opened, name, evaluator, proposal->layout, proposal->coverage);
        designs[count].costs = proposal->costs;
        designs[count].remedies = proposal->remedies;
        designs[count].remedy_count = proposal->remedy_count;
        designs[count++].alternative = alternatives ? proposal : NULL;
    }
    return count;
}

/* True where it is known of all of the surface whether it is attainable. */
static bool is_looked_into(const sp_proposal *proposal)
{
    if (proposal->attainable_hurried)
        return false;
    for (size_t p = 0; p < proposal->coverage->deposits.count; p++)
        if (proposal->reasons[p] == SP_REASON_UNKNOWN)
            return false;
    return true;
}

/* Where there is a nozzle though, all are kept: what these leave is too little. */
static void say_water_is_lacking(const sp_proposal *proposal)
{
    double lacking = 6e4 * proposal->water_lacking;
    if (proposal->layout->count > 0)
        fprintf(stderr,
                "sprayplan: max_water allows no nozzle besides those to keep: with these the least of those that are "
                "allowed takes %.3g L/min more\n",
                lacking);
    else
        fprintf(stderr,
                "sprayplan: max_water allows no nozzle at all: the least of those that are allowed takes %.3g L/min "
                "more\n",
                lacking);
}

static void say_what_is_covered(const sp_coverage *coverage, double percent_asked)
{
    char covered[CLI_AMOUNT];
    cli_amount_text(coverage->covered_area, coverage->area, 3, 4, covered);
    fprintf(stderr, "sprayplan: the proposal covers %.1f %% of the surface (%s m2), not the %.4g %% asked for\n",
            100 * coverage->fraction, covered, percent_asked);
}

/* Where less is attainable than was asked for, by what is reported: the engineer's nozzles may reach more than those
 * that were chosen from. */
static bool say_what_is_attainable(const sp_result *result, sp_error *error)
{
    const sp_proposal *proposal = result->proposal;
    sp_figures *all = sp_result_figures(result, error);
    if (!all)
        return false;
    const sp_figures *figures = &all[sp_result_proposed(result)];
    double whole = figures->clean_area;
    double attainable = sp_percent_at_most(figures->attainable_area, whole),
           allowed = sp_percent_at_most(proposal->attainable_area, whole);
    fprintf(stderr, "sprayplan: %.4g %% of the surface was asked for, of which ", 100 * proposal->asked_area / whole);
    if (allowed < attainable)
        fprintf(stderr,
                "nozzles that are allowed reach no more than %.2f %%; with what the scene's own reach %.2f %% is "
                "attainable",
                allowed, attainable);
    else
        fprintf(stderr, "no more than %.2f %% is attainable", attainable);
    fprintf(stderr, ": the proposal covers %.1f %%, %.1f %% of what is attainable\n", 100 * figures->coverage,
            100 * figures->of_attainable);
    sp_figures_destroy(all, result->design_count);
    return true;
}

static bool say_what_is_missing(const sp_result *result, sp_error *error)
{
    const sp_proposal *proposal = result->proposal;
    const sp_coverage *coverage = proposal->coverage;
    if (sp_exceeds_limits(proposal))
        fprintf(stderr, "sprayplan: the nozzles to keep are more, or take more water, than max_nozzles and max_water "
                        "allow\n");
    if (proposal->target_area > 0 && coverage->covered_area >= proposal->asked_area)
        return true;
    bool lacking = proposal->water_lacking > 0, nothing = !(proposal->target_area > 0);
    if (lacking)
        say_water_is_lacking(proposal);
    if (nothing && lacking)
        return true;
    if (!nothing && proposal->attainable_area < proposal->asked_area && is_looked_into(proposal))
        return say_what_is_attainable(result, error);
    if (nothing)
        fprintf(stderr,
                "sprayplan: no nozzle that is allowed, at any mounting point that takes it, covers anything by the "
                "criteria\n");
    else
        say_what_is_covered(coverage, 100 * proposal->asked_area / coverage->area);
    return true;
}

/* Whether this rank has reason to end. */
static bool ends(void)
{
    return cli_interrupted() || sp_ranks_lost(cli_ranks());
}

static void say_interrupted(const cli_scene *opened, const placement *found)
{
    size_t asked = sp_scene_alternative_count(opened->scene);
    fprintf(stderr, "sprayplan: %s; this is the best layout so far",
            sp_ranks_lost(cli_ranks()) ? "interrupted, the other ranks being gone" : "interrupted");
    if (found->count < asked)
        fprintf(stderr, ", without %zu of the %zu alternatives", asked - found->count, asked);
    fprintf(stderr, "\n");
}

static int report(const cli_options *options, const cli_scene *opened, const placement *found, const cli_clock *clock,
                  sp_error *error)
{
    sp_design *designs = calloc(found->count + 2, sizeof *designs);
    const sp_proposal *best = found->proposals[found->best];
    const sp_scene *scene = opened->scene;
    sp_result result = {.command = "place",
                        .scene = cli_input_name(options->inputs[0]),
                        .designs = designs,
                        .proposal = best,
                        .stage_count = clock->count,
                        .stages = clock->stages,
                        .left_out_count = found->left_out.count,
                        .left_out = found->left_out.list};
    result.design_count = designs ? list_designs(opened, found, designs) : 0;
    bool good = (designs || sp_fail_memory(error)) &&
                cli_report(options, &result, &scene, &opened->inputs, best->layout, error);
    bool cut = found->ended || cli_interrupted();
    if (good && cut)
        say_interrupted(opened, found);
    else if (good && !best->reached)
        good = say_what_is_missing(&result, error);
    free(designs);
    if (!good)
        return cli_fail_in(opened, error);
    return cut ? EXIT_INTERRUPTED : best->reached ? EXIT_DONE : EXIT_SHORT;
}

/* For one of the searches that are still to come, before what follows them; 0 where there is no limit. */
static double time_for_search(const cli_options *options, const placement *found, size_t to_come)
{
    double left = (cli_time_left() - found->ending) / (double)to_come;
    return options->time_limit > 0 ? fmax(left, 1e-3) : 0;
}

/* Judged by the scene's own nozzles, or by none. */
static bool reserve_ending(const cli_options *options, const cli_scene *opened, placement *found, sp_error *error)
{
    static const sp_layout none = {0};
    size_t alternatives = sp_scene_alternative_count(opened->scene), designs = alternatives ? alternatives : 2;
    if (!(options->time_limit > 0))
        return true;
    const sp_layout *layout = found->manual ? sp_scene_layout(opened->scene) : &none;
    sp_coverage *dry = found->manual ? NULL : sp_evaluate(opened->evaluator, layout, error);
    const sp_coverage *coverage = found->manual ? found->manual : dry;
    sp_design design = coverage ? cli_design(opened, "", opened->evaluator, layout, coverage) : (sp_design){0};
    bool good =
        coverage && cli_picture_time(options, &design, designs + (found->manual != NULL), &found->ending, error);
    sp_coverage_destroy(dry);
    return good;
}

/* Which alternative an error is about. */
static void name_alternative(const cli_scene *opened, size_t index, sp_error *error)
{
    size_t used = strlen(error->message);
    if (sp_scene_alternative_count(opened->scene) > 0 && error->kind == SP_ERROR_INPUT)
        snprintf(error->message + used, sizeof error->message - used, " (alternative '%s')",
                 sp_scene_alternative_name(opened->scene, index));
}

/* Before those of its like that come later in the scene. */
static void keep_proposal(placement *found, sp_proposal *proposal, size_t which)
{
    size_t at = found->count++;
    for (; at > 0 && found->which[at - 1] > which; at--) {
        found->proposals[at] = found->proposals[at - 1];
        found->which[at] = found->which[at - 1];
    }
    found->proposals[at] = proposal;
    found->which[at] = which;
}

/* For alternative `which`, or the only one; `to_come`: searches, this one among them. */
static bool propose_one(const cli_options *options, const cli_scene *opened, placement *found, size_t which,
                        size_t to_come, sp_error *error)
{
    bool alternatives = sp_scene_alternative_count(opened->scene) > 0;
    sp_place_options how =
        alternatives ? sp_scene_alternative_options(opened->scene, which) : sp_scene_place_options(opened->scene);
    how.run = cli_search_run(options);
    how.run.time_limit = time_for_search(options, found, to_come);
    how.mend_kept = which == mender(opened->scene);
    how.memory = options->memory;
    how.prove = options->prove;
    how.known_count = found->count;
    how.known = (const sp_proposal *const *)found->proposals;
    sp_proposal *proposal = sp_place(opened->evaluator, &how, error);
    if (proposal)
        keep_proposal(found, proposal, which);
    else
        name_alternative(opened, which, error);
    return proposal;
}

/* One proposal for each alternative, as many as there is time for before an interruption; or the only one. Those that
 * allow less come first, so that the others know what they found. */
static bool propose(const cli_options *options, const cli_scene *opened, placement *found, sp_error *error)
{
    size_t alternatives = sp_scene_alternative_count(opened->scene), count = alternatives ? alternatives : 1;
    size_t *order = cli_order_alternatives(opened->scene);
    found->proposals = calloc(count, sizeof(sp_proposal *));
    found->which = calloc(count, sizeof *found->which);
    bool good = (order && found->proposals && found->which) || sp_fail_memory(error);
    for (size_t i = 0; good && i < count && !found->ended; i++) {
        cli_progress_round(i);
        good = propose_one(options, opened, found, order[i], count - i, error);
        found->ended = good && sp_ranks_any(cli_ranks(), ends());
    }
    free(order);
    if (!good)
        return false;
    found->best = sp_place_best((const sp_proposal *const *)found->proposals, found->count);
    return true;
}

/* The scene's own nozzles, where everything else was counted again. */
static bool count_manual_again(const cli_scene *opened, placement *found, sp_error *error)
{
    const sp_evaluator *evaluator = own_evaluator(opened, found);
    if (!found->manual || evaluator == opened->evaluator)
        return true;
    sp_coverage_destroy(found->manual);
    found->manual = sp_evaluate(evaluator, sp_scene_layout(opened->scene), error);
    return found->manual != NULL;
}

/* Nothing is left even of what was kept for what follows the search. */
static bool is_over(void)
{
    return cli_time_left() <= 0;
}

/* Where the liquid of every layout goes. */
static bool follow_liquid(const cli_scene *opened, placement *found, sp_error *error)
{
    if (is_over()) {
        cli_leave_out(&found->left_out, "where the liquid goes");
        return true;
    }
    const sp_layout *own = sp_scene_layout(opened->scene);
    bool alternatives = sp_scene_alternative_count(opened->scene) > 0;
    bool good = !found->manual || sp_evaluate_balance(own_evaluator(opened, found), own, found->manual, error);
    for (size_t i = 0; good && i < found->count; i++) {
        const sp_proposal *proposal = found->proposals[i];
        const sp_evaluator *evaluator = evaluator_of(opened, proposal);
        good = (alternatives || sp_evaluate_balance(evaluator, proposal->greedy, proposal->greedy_coverage, error)) &&
               sp_evaluate_balance(evaluator, proposal->layout, proposal->coverage, error);
    }
    return good;
}

/* How long the proposal's took, s. */
static double error_time(const sp_proposal *proposal)
{
    for (size_t k = 0; k < proposal->stage_count; k++)
        if (!strcmp(proposal->stages[k].name, "measured error"))
            return proposal->stages[k].seconds;
    return 0;
}

/* Left out where there is no time for it. */
static bool measure_one(const sp_evaluator *evaluator, const sp_layout *layout, sp_coverage *coverage, const char *name,
                        placement *found, sp_error *error)
{
    double taken = error_time(found->proposals[found->best]);
    if (cli_time_left() < LATE * taken + found->ending / 2) {
        cli_leave_out(&found->left_out, "the error of %s", name);
        return true;
    }
    return cli_measure(evaluator, layout, coverage, error);
}

/* What the search, which measured its error, does not tell of a proposal: what round-off could turn, and what is proved
 * of lines. `late` becomes what there was no time for. */
static bool finish_measuring(const sp_evaluator *evaluator, const sp_proposal *proposal, const char **late,
                             sp_error *error)
{
    bool lines = cli_bounds_lines(evaluator);
    if (*late || is_over()) {
        *late = lines ? "what round-off could turn, the bound on the error of lines" : "what round-off could turn";
        return true;
    }
    if (!cli_find_borderline(evaluator, proposal->layout, proposal->coverage, error))
        return false;
    if (!lines || !is_over())
        return cli_bound_lines(evaluator, proposal->layout, proposal->coverage, error);
    *late = "the bound on the error of lines";
    return true;
}

/* How far the coverage of the other layouts is off: the proposals' is measured. */
static bool measure_errors(const cli_scene *opened, placement *found, sp_error *error)
{
    const sp_layout *own = sp_scene_layout(opened->scene);
    const char *late = NULL;
    bool alternatives = sp_scene_alternative_count(opened->scene) > 0;
    bool good = !found->manual ||
                measure_one(own_evaluator(opened, found), own, found->manual, "the scene's own nozzles", found, error);
    for (size_t i = 0; good && i < found->count; i++) {
        const sp_proposal *proposal = found->proposals[i];
        const sp_evaluator *evaluator = evaluator_of(opened, proposal);
        good = (alternatives || measure_one(evaluator, proposal->greedy, proposal->greedy_coverage,
                                            "the layout before refinement", found, error));
        good = good && finish_measuring(evaluator, proposal, &late, error);
    }
    if (late)
        cli_leave_out(&found->left_out, "%s", late);
    return good;
}

/* A nozzle of the scene's own that could not stand where it is drawn: what the proposal is compared with is in doubt.
 */
static bool warn_of_own(const cli_scene *opened, const sp_layout *own, sp_error *failure)
{
    for (size_t i = 0; i < own->count; i++) {
        sp_error error = {0};
        if (own->nozzles[i].keep || cli_admits(opened, &own->nozzles[i], &error))
            continue;
        if (error.kind == SP_ERROR_MEMORY)
            return sp_fail_memory(failure);
        cli_progress_end();
        fprintf(stderr, "sprayplan: the layout compared with is in doubt: %s\n", error.message);
    }
    return true;
}

static void say_idle(void *user, const char *text)
{
    (void)user;
    cli_progress_end();
    fprintf(stderr, "sprayplan: %s\n", text);
}

/* Asked before the minutes that a search may take. */
static bool can_write(const cli_options *options, const cli_scene *opened, sp_error *error)
{
    size_t alternatives = sp_scene_alternative_count(opened->scene);
    bool good = cli_output_ready(options, opened->scene, cli_result_files, error);
    for (size_t i = 0; good && i < alternatives; i++) {
        char name[CLI_LAYOUT_NAME];
        cli_layout_name(i, name);
        const char *const names[] = {name, NULL};
        good = cli_output_ready(options, opened->scene, names, error);
    }
    return good;
}

/* What is done with what was found, by the first rank alone. */
static int conclude(const cli_options *options, const cli_scene *opened, cli_clock *clock, placement *found,
                    sp_error *error)
{
    cli_progress_stage(options, "report");
    bool good = count_manual_again(opened, found, error) && follow_liquid(opened, found, error) &&
                measure_errors(opened, found, error) &&
                (options->quiet || (warn_of_own(opened, sp_scene_layout(opened->scene), error) &&
                                    cli_warn_of_idle_mounts(opened, say_idle, NULL, error)));
    return good ? report(options, opened, found, clock, error) : cli_fail_in(opened, error);
}

static int place(const cli_options *options, const cli_scene *opened, cli_clock *clock, sp_error *error)
{
    placement found = {0};
    bool good = false;
    if (!can_write(options, opened, error))
        return cli_fail(error);
    const sp_layout *own = sp_scene_layout(opened->scene);
    cli_progress_stage(options, "simulate");
    if (!sp_scene_has_place(opened->scene))
        sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "place: found no mounts, expected where nozzles may be mounted");
    else if (own->count == 0 || (found.manual = sp_evaluate(opened->evaluator, own, error))) {
        cli_clock_stage(clock, "simulate");
        good = reserve_ending(options, opened, &found, error) && propose(options, opened, &found, error);
    }
    int status = !good              ? cli_fail_in(opened, error)
                 : sp_ranks_first() ? conclude(options, opened, clock, &found, error)
                                    : EXIT_DONE;
    for (size_t i = 0; i < found.count; i++)
        sp_proposal_destroy(found.proposals[i]);
    free(found.proposals);
    free(found.which);
    sp_coverage_destroy(found.manual);
    return status;
}

int cli_place(const cli_options *options)
{
    static const char *const stages[] = {"geometry",    "accelerator|wet sides|atlas|settings",
                                         "simulate",    "visibility|footprints",
                                         "attainable",  "greedy|exchange|front",
                                         "refine|fill", "measured error|remedies|forward check",
                                         "certificate", "report",
                                         NULL};
    cli_progress_plan(stages, 3, 6, 1);
    sp_error error = {0};
    cli_options own = *options;
    if (!sp_ranks_first()) {
        own.quiet = true;
        own.json = false;
        own.output = NULL;
    }
    if (!cli_join(&error)) /* of those that cannot the first alone says so */
        return sp_ranks_first() ? cli_fail(&error) : EXIT_DONE;
    if (cli_ranks() && cli_is_standard_input(own.inputs[0]))
        sp_fail(&error, SP_ERROR_INPUT, NULL, 0, 0,
                "standard input: found several processes, expected one: only the first of them has it");
    int status = error.kind ? cli_fail(&error) : cli_with_scene(&own, true, place);
    cli_leave();
    return status;
}
