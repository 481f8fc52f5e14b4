/* What a command leaves on standard output: a summary, or JSON. */
#include "amounts.h"
#include "cli.h"

#include <stdlib.h>
#include <string.h>

#define FEW_JETS 10 /* on a texel that is just covered: with fewer, longer texels were more exact on the vessel */

bool cli_print_object(json_t *object, int digits)
{
    char *text = object ? json_dumps(object, JSON_INDENT(1) | JSON_REAL_PRECISION(digits)) : NULL;
    json_decref(object);
    if (text)
        puts(text);
    free(text);
    return text != NULL;
}

/* No design before it is counted on the same. */
static bool is_first_on(const sp_result *result, size_t design)
{
    size_t first = 0;
    while (result->designs[first].evaluator != result->designs[design].evaluator)
        first++;
    return first == design;
}

/* What of the geometry is not sound, and what was done about it, once for every evaluator. */
static void print_geometry(const sp_result *result)
{
    size_t listed = 0;
    for (size_t i = 0; i < result->design_count; i++) {
        const sp_evaluator *evaluator = result->designs[i].evaluator;
        if (!evaluator || !is_first_on(result, i))
            continue;
        sp_geometry_clause clauses[SP_GEOMETRY_CLAUSES];
        size_t count = sp_geometry_clauses(evaluator, clauses);
        for (size_t k = 0; k < count; k++)
            if (clauses[k].doubtful)
                printf("geometry: %s\n", clauses[k].text), listed++;
    }
    if (listed)
        printf("(`check` says where)\n\n");
}

/* A column of L/min, with the digits that tell `whole`, of which `flow` is a part or which it is. */
static void print_water(int width, double flow, double whole)
{
    char text[CLI_AMOUNT];
    cli_amount_text(6e4 * flow, 6e4 * whole, 1, 3, text);
    printf(" %*s", width, text);
}

/* m² of the surface to be cleaned, with the digits that tell all of it. */
static void area_text(const sp_figures *figures, double area, int least, char text[CLI_AMOUNT])
{
    cli_amount_text(area, figures->clean_area, least, least + 1, text);
}

/* Water and mounts, and that in money; nothing where neither is known. */
static void print_price(const sp_figures *figures)
{
    if (isfinite(figures->mount_cost))
        print_water(12, sp_figures_price(figures), sp_figures_price(figures));
    if (isfinite(sp_figures_money(figures)))
        printf(" %12.2f %s", sp_figures_money(figures), figures->water_cost.currency);
}

static void print_figures(const sp_figures *figures, const char *name, int width)
{
    char covered[CLI_AMOUNT], by_water[CLI_AMOUNT];
    area_text(figures, figures->covered_area, 3, covered);
    printf("%-*s %8zu", width, name, figures->nozzle_count);
    print_water(12, figures->flow, figures->flow);
    printf(" %13s %10.1f", covered, 100 * figures->coverage);
    if (!isnan(figures->of_attainable))
        printf(" %15.1f", 100 * figures->of_attainable);
    else
        printf(" %15s", "");
    double ratio = isnan(figures->area_per_water) ? 0 : figures->area_per_water / 6e4;
    cli_amount_text(ratio, ratio, 4, 3, by_water);
    printf(" %14s", by_water);
    print_price(figures);
    printf("\n");
}

/* How far each coverage is off, where that was measured. Rounded upwards: the error is no larger than said. */
static void print_errors(const sp_result *result, const sp_figures *figures, int width)
{
    for (size_t i = 0, listed = 0; i < result->design_count; i++)
        if (isfinite(figures[i].error_estimate))
            printf("%s%-*s coverage %.2f %%, measured error \xc2\xb1%.2f points\n", listed++ ? "" : "\n", width,
                   result->designs[i].name, 100 * figures[i].coverage,
                   sp_percent_at_most(figures[i].error_estimate, 1));
}

/* Where jets are so few that their noise tells more than a shorter texel does. */
static void print_noise(const sp_result *result)
{
    for (size_t i = 0; i < result->design_count; i++) {
        const sp_evaluator *evaluator = result->designs[i].evaluator;
        if (!evaluator || !(sp_evaluator_jets_wanted(evaluator) > 0) || sp_evaluator_jets_met(evaluator) >= FEW_JETS)
            continue;
        const sp_fidelity *fidelity = sp_evaluator_fidelity(evaluator);
        double met = sp_evaluator_jets_met(evaluator);
        printf("\nwarning: %.3g million jets a nozzle are fewer than the %.3g million that texels of %.3g mm want. One "
               "that is just covered is\nmet by about %.2g, and its flux is off by some %.0f %%: longer texels or more "
               "jets are more exact.\n",
               1e-6 * (double)fidelity->jets, 1e-6 * sp_evaluator_jets_wanted(evaluator), 1e3 * fidelity->texel, met,
               100 / sqrt(fmax(1, met)));
        return;
    }
}

/* A setting that was left to auto. */
static void print_setting(int setting, const sp_evaluator *evaluator, const char *why)
{
    const sp_fidelity *fidelity = sp_evaluator_fidelity(evaluator);
    if (setting == 0)
        printf("auto: texel %.3g mm, %s\n", 1e3 * fidelity->texel, why);
    else if (setting == 1)
        printf("auto: %llu jets a nozzle, %s\n", (unsigned long long)fidelity->jets, why);
    else if (setting == 4)
        printf("auto: %d reflections, %s\n", fidelity->reflections, why);
    else
        printf("auto: %s\n", why);
}

/* Where texels are set the scene may also leave them to auto. */
static void print_missed(const sp_design *design)
{
    const sp_fidelity *fidelity = sp_evaluator_fidelity(design->evaluator);
    bool set = sp_evaluator_setup(design->evaluator)->fidelity.texel > 0;
    printf("warning: the coverage of %s does not keep the accuracy of %.3g %% that was asked for; texels shorter than "
           "%.3g mm%s%s may keep it\n",
           design->name, 100 * fidelity->accuracy, 1e3 * fidelity->texel, set ? ", or `texel: auto`," : "",
           fidelity->method == SP_METHOD_FORWARD ? " with more jets" : "");
}

/* What auto took and why, once for every evaluator, and what does not keep the accuracy. */
static void print_choice(const sp_result *result, const sp_figures *figures)
{
    for (size_t i = 0; i < result->design_count; i++) {
        const sp_evaluator *evaluator = result->designs[i].evaluator;
        if (!evaluator)
            continue;
        bool first = is_first_on(result, i);
        char long_texel[CLI_LONG_TEXEL], threshold[CLI_LARGE_THRESHOLD];
        const sp_choice *choice = sp_evaluator_choice(evaluator);
        double accuracy = sp_evaluator_fidelity(evaluator)->accuracy, error = figures[i].error_estimate;
        const char *why[] = {choice->texel, choice->jets, choice->trajectory, choice->method, choice->reflections};
        for (int k = 0; k < 5 && first; k++)
            if (why[k][0])
                print_setting(k, evaluator, why[k]);
        if (first && cli_warn_of_long_texel(sp_evaluator_setup(evaluator), long_texel))
            printf("warning: %s\n", long_texel);
        if (first && cli_warn_of_large_threshold(sp_evaluator_setup(evaluator), threshold))
            printf("warning: %s\n", threshold);
        if (error > accuracy || (!isfinite(error) && first && choice->missed))
            print_missed(&result->designs[i]);
    }
}

static void print_share(const sp_figures *figures, double flow)
{
    print_water(12, flow, figures->flow);
    printf(" %5.1f %%", figures->flow > 0 ? 100 * flow / figures->flow : 0);
}

/* Where the liquid goes, which coverage does not tell: what flies out or onto obstacles cleans nothing. */
static void print_liquid(const sp_result *result, const sp_figures *figures, int width)
{
    bool known = false;
    for (size_t i = 0; i < result->design_count; i++)
        known = known || isfinite(figures[i].landed_clean);
    if (!known)
        return;
    printf("\n%-*s %20s %20s %20s %20s\n", width, "L/min", "on surface to clean", "on other surface", "flies out",
           "not followed");
    for (size_t i = 0; i < result->design_count; i++) {
        if (!isfinite(figures[i].landed_clean))
            continue;
        printf("%-*s", width, result->designs[i].name);
        print_share(&figures[i], figures[i].landed_clean);
        print_share(&figures[i], figures[i].landed_other);
        print_share(&figures[i], figures[i].left);
        print_share(&figures[i], figures[i].unfollowed);
        printf("\n");
    }
}

/* What runs down the walls, and what of it stays: a hollow that cannot drain is a fault of the vessel. */
static void print_film(const sp_result *result, const sp_figures *figures, int width)
{
    bool headed = false;
    for (size_t i = 0; i < result->design_count; i++) {
        const sp_film_balance *film = &figures[i].film;
        if (!film->known)
            continue;
        if (!headed)
            printf("\n%-*s %12s %16s %16s %16s %16s %22s\n", width, "film", "alone m2", "arrives L/min", "drains L/min",
                   "stands L/min", "astray L/min", "per girth L/min/m");
        headed = true;
        char alone[CLI_AMOUNT];
        area_text(&figures[i], film->area, 3, alone);
        printf("%-*s %12s", width, result->designs[i].name, alone);
        print_water(16, film->arriving, figures[i].flow);
        print_water(16, film->left, figures[i].flow);
        print_water(16, film->held, figures[i].flow);
        print_water(16, film->astray, figures[i].flow);
        print_water(22, film->per_girth, film->per_girth);
        printf("\n");
    }
}

/* What goods that move take with them. */
static void print_dose(const sp_result *result, const sp_figures *figures, int width)
{
    for (size_t i = 0, listed = 0; i < result->design_count; i++)
        if (isfinite(figures[i].pass))
            printf("%s%-*s dose L/m2: mean %.4g, 5th percentile %.4g, highest %.4g, in a pass of %.4g s\n",
                   listed++ ? "" : "\n", width, result->designs[i].name, 1e3 * figures[i].pass * figures[i].flux_mean,
                   1e3 * figures[i].pass * figures[i].flux_p05, 1e3 * figures[i].pass * figures[i].flux_max,
                   figures[i].pass);
}

/* What is proved, in the report's own words; rounded so that it stays true. */
static void print_forward_check(const sp_forward_check *check)
{
    if (!check->computed)
        return;
    double inverse = 100 * (check->coverage - check->difference), forward = 100 * check->coverage;
    if (check->agrees)
        printf("\nCounted again by %.3g million jets, on %zu texels: %.1f %% are hit as asked for, where the inverse "
               "evaluation finds %.1f %%.\n",
               1e-6 * (double)check->jets, check->texels, forward, inverse);
    else
        printf(
            "\nwarning: the proposal's coverage is in doubt. Counted by %.3g million jets, on %zu texels, %.1f %% are "
            "hit as asked for, by the inverse evaluation %.1f %%;\nthat is more apart than the accuracy of %.2g %%.\n",
            1e-6 * (double)check->jets, check->texels, forward, inverse, 100 * check->tolerance);
}

/* Water that is proved from below. */
static void print_least_water(const sp_proposal *proposal, double flow)
{
    double least = sp_water_at_least(6e4 * flow);
    printf("%.*f L/min%s", sp_water_decimals(least), least, proposal->costly ? " of water and cost of mounts" : "");
}

/* A share of 100 % would say nothing. */
static void print_every_aim(const sp_proposal *proposal)
{
    const sp_certificate *certificate = &proposal->certificate;
    double percent = ceil(1e3 * certificate->every_aim.area_bound / certificate->whole - 1e-9) / 10;
    bool one = certificate->every_aim.places == 1;
    printf("Whichever way nozzles at %s %zu mounting point%s are aimed, at any roll, angle and flow allowed: none "
           "reaches it with less\nthan ",
           one ? "this" : "these", certificate->every_aim.places, one ? "" : "s");
    print_least_water(proposal, certificate->every_aim.water_bound);
    if (percent < 100)
        printf(", and %s none covers more than %.1f %%",
               proposal->costly ? "for the proposal's price" : "with the proposal's water", percent);
    printf(". Places between are not covered.\n");
}

static void print_certificate(const sp_proposal *proposal)
{
    const sp_certificate *certificate = &proposal->certificate;
    if (!certificate->computed) {
        if (proposal->interrupted)
            printf("\nThe search ended before anything was proved of how much better a layout could be.\n");
        return;
    }
    bool one = certificate->candidates == 1;
    printf("\nAmong %s %zu candidate pose%s ", one ? "this" : "these", certificate->candidates, one ? "" : "s");
    if (certificate->candidates < proposal->candidates)
        printf("(of %zu; the others are in ports that kept nozzles hold, or were not traced in time) ",
               proposal->candidates);
    printf("and the proposal's own, on %zu texels, no layout reaches %.1f %% with less than ", certificate->texels,
           ceil(1e3 * certificate->counted / certificate->whole - 1e-9) / 10);
    print_least_water(proposal, certificate->water_bound);
    printf(".\n%s none covers more than %.1f %% of them (gap %.1f %%). Poses between candidates are not covered.\n",
           proposal->costly ? "For the proposal's price" : "With the proposal's water",
           ceil(1e3 * certificate->area_bound / certificate->whole - 1e-9) / 10,
           ceil(1e3 * certificate->gap - 1e-9) / 10);
    if (sp_allows_more_water(proposal))
        printf("More water is allowed than the proposal takes; what layouts that take more could cover is not bounded "
               "here.\n");
    if (certificate->every_aim.computed)
        print_every_aim(proposal);
}

enum { PARTS_NAMED = 3 };

/* Some of what is missing, which has a digit however small it is. */
static void print_missing_area(const sp_figures *figures, double area)
{
    char text[CLI_AMOUNT];
    cli_amount_text(area, area, sp_area_decimals(figures, 4), 1, text);
    printf(" %s", text);
}

/* Those that the reason keeps most out of reach of, by name, and how many more there are. */
static void print_parts(const sp_figures *figures, sp_reason reason)
{
    size_t last = SP_UNKNOWN, part;
    for (int i = 0; i < PARTS_NAMED && (part = sp_missing_next(figures, reason, last)) != SP_UNKNOWN; i++) {
        printf("%s%s", i ? ", " : ": ", figures->missing[part].part);
        print_missing_area(figures, figures->missing[part].areas[reason]);
        last = part;
    }
    double area;
    size_t others = sp_missing_after(figures, reason, last, &area);
    if (!others)
        return;
    printf(", %zu other part%s", others, others == 1 ? "" : "s");
    print_missing_area(figures, area);
}

/* What no layout can cover, by reason and part; `name` of the alternative, "" for none. */
static void print_missing(const sp_figures *figures, const sp_proposal *proposal, const char *name)
{
    double missing = figures->clean_area - figures->attainable_area;
    const char *looked = proposal->attainable_hurried ? ", as far as the time allowed to look" : "";
    char area[CLI_AMOUNT];
    area_text(figures, figures->beyond_area, 4, area);
    if (figures->beyond_area > SP_BEYOND_TOLD * figures->clean_area)
        printf("%s%sreached by the scene's own nozzles alone, by none that is allowed%s: %.1f %% of the surface to be "
               "cleaned, %s m2\n",
               name, name[0] ? ": " : "", looked, 100 * figures->beyond_area / figures->clean_area, area);
    if (!(missing > 1e-6 * figures->clean_area))
        return;
    double percent = 100 * missing / figures->clean_area;
    area_text(figures, missing, 4, area);
    printf("%s%sout of reach of every allowed nozzle%s%s: %.*f %% of the surface to be cleaned, %s m2\n", name,
           name[0] ? ": " : "", looked, figures->missing_area[SP_REASON_UNKNOWN] > 0 ? ", or not looked into" : "",
           percent < 1 ? 3 : 1, percent, area);
    for (sp_reason reason = 0; reason < SP_REASONS; reason++) {
        const char *text = reason == SP_REASON_UNKNOWN ? "not looked into" : sp_reason_text(figures, reason);
        if (!text || !(figures->missing_area[reason] > 0))
            continue;
        printf(" ");
        print_missing_area(figures, figures->missing_area[reason]);
        printf(" m2 %s", text);
        print_parts(figures, reason);
        printf("\n");
    }
    char limits[SP_LIMITS_TEXT];
    sp_limits_clause(proposal, limits);
    if (limits[0] && figures->missing_area[SP_REASON_FLUX] > 1e-6 * figures->clean_area)
        printf("  %s: with no more than %s; more may reach more\n", sp_reason_text(figures, SP_REASON_FLUX), limits);
    printf("  at the %zu mounting point%s looked at; places %s, if any, may reach more\n\n", proposal->positions,
           proposal->positions == 1 ? "" : "s", proposal->positions == 1 ? "beside it" : "between them");
}

/* What no layout can cover, of each alternative. */
static void print_all_missing(const sp_result *result, const sp_figures *figures)
{
    size_t proposed = sp_result_proposed(result);
    for (size_t i = 0; i < result->design_count; i++)
        if (result->designs[i].alternative || i == proposed)
            print_missing(&figures[i], sp_result_proposal(result, i),
                          result->designs[i].alternative ? result->designs[i].name : "");
}

/* Which alternative is proposed, and why. */
static void print_proposed(const sp_result *result)
{
    char why[SP_CHOICE_TEXT];
    sp_result_choice(result, why);
    if (why[0])
        printf("\nproposed: %s (%s)\n", result->designs[sp_result_proposed(result)].name, why);
}

/* `of`: which alternative, "" for none. */
static void print_cut(const sp_proposal *proposal, const char *of, bool *any)
{
    for (size_t k = 0; k < proposal->cut_count; k++)
        printf("%s%s%s%s",
               k      ? ""
               : *any ? "; "
                      : "\nCut short or left out: ",
               k ? ", " : of, !k && of[0] ? ": " : "", proposal->cut[k]);
    *any = *any || proposal->cut_count > 0;
}

/* By name, of the proposal or all alternatives, and of what follows them. */
static void print_left_out(const sp_result *result)
{
    bool any = false;
    if (result->proposal && !sp_result_has_alternatives(result))
        print_cut(result->proposal, "", &any);
    for (size_t i = 0; i < result->design_count; i++)
        if (result->designs[i].alternative)
            print_cut(result->designs[i].alternative, result->designs[i].name, &any);
    for (size_t i = 0; i < result->left_out_count; i++, any = true)
        printf("%s%s", i ? ", " : any ? "; " : "\nCut short or left out: ", result->left_out[i]);
    if (any)
        printf(".\n");
}

/* That the scene's own nozzles are better. */
static void print_own_better(const sp_result *result, const sp_figures *figures)
{
    char text[SP_OWN_TEXT];
    sp_result_own_better(result, figures, text);
    if (text[0])
        printf("\n%s\n", text);
}

/* Nozzles that cannot all be mounted where they are listed. */
static void print_overlaps(const sp_result *result, const sp_figures *figures)
{
    for (size_t i = 0, listed = 0; i < result->design_count; i++)
        for (size_t k = 0; k < figures[i].nozzle_count; k++)
            if (figures[i].nozzles[k].overlap[0])
                printf("%swarning: %s: %s\n", listed++ ? "" : "\n", result->designs[i].name,
                       figures[i].nozzles[k].overlap);
}

/* What is checked and proved of the proposal, or of each alternative. */
static void print_proofs(const sp_result *result)
{
    if (sp_result_counts_thrown_back(result))
        printf(
            "\nThe coverage of the layouts counts liquid that walls throw back. The search goes by first impacts and "
            "puts the nozzles\nthat it found together anew with it; what is counted again and proved below is "
            "by first impacts alone,\nand layouts may cover more than that says.\n");
    if (result->proposal && !sp_result_has_alternatives(result)) {
        print_forward_check(&result->proposal->forward_check);
        print_certificate(result->proposal);
    }
    for (size_t i = 0; i < result->design_count; i++) {
        const sp_proposal *alternative = result->designs[i].alternative;
        if (!alternative)
            continue;
        printf("\n%s:", result->designs[i].name);
        print_forward_check(&alternative->forward_check);
        print_certificate(alternative);
    }
}

static bool print_summary(const sp_result *result, sp_error *error)
{
    sp_figures *figures = sp_result_figures(result, error);
    if (!figures)
        return false;
    print_geometry(result);
    print_all_missing(result, figures);
    cli_print_differing(result, figures);
    int width = 0;
    for (size_t i = 0; i < result->design_count; i++)
        width = (int)strlen(result->designs[i].name) > width ? (int)strlen(result->designs[i].name) : width;
    bool priced = false, in_money = false;
    for (size_t i = 0; i < result->design_count; i++) {
        priced |= isfinite(figures[i].mount_cost);
        in_money |= isfinite(sp_figures_money(&figures[i]));
    }
    printf("%-*s %8s %12s %13s %10s %15s %14s%s%s\n", width, "layout", "nozzles", "water L/min", "covered m2",
           "coverage %", "of attainable %", "m2 per L/min", priced ? "  price L/min" : "",
           in_money ? "        money" : "");
    for (size_t i = 0; i < result->design_count; i++)
        print_figures(&figures[i], result->designs[i].name, width);
    print_proposed(result);
    print_own_better(result, figures);
    print_overlaps(result, figures);
    print_dose(result, figures, width);
    print_errors(result, figures, width);
    print_choice(result, figures);
    print_noise(result);
    print_liquid(result, figures, width);
    print_film(result, figures, width);
    print_proofs(result);
    print_left_out(result);
    sp_figures_destroy(figures, result->design_count);
    return true;
}

bool cli_print(const cli_options *options, const sp_result *result, sp_error *error)
{
    cli_progress_end();
    if (options->json) {
        char *text = sp_result_json(result, error);
        if (text)
            fputs(text, stdout);
        free(text);
        return text != NULL;
    }
    return options->quiet || print_summary(result, error);
}
