/* What the report says first. */
#include "page.h"

static void add_statement(const sp_page *page, sp_text *text, size_t design)
{
    const sp_figures *figures = &page->figures[design];
    sp_text_add(text, "covers <strong>");
    sp_page_coverage(text, figures);
    sp_text_add(text, "</strong> of the surface to be cleaned with <strong>");
    sp_markup_water(text, 6e4 * figures->flow);
    sp_text_add(text, "&nbsp;L/min</strong>");
}

static void add_card(const sp_page *page, sp_text *text, const char *title, const char *unit, const double values[2],
                     const int decimals[2], bool points)
{
    sp_text_add(text, "<div class=\"card\"><div class=\"title\">%s</div><div class=\"value\">", title);
    sp_markup_decimals(text, values[0], decimals[0]);
    if (points)
        sp_page_error(text, &page->figures[page->main]);
    sp_text_add(text, " <span class=\"unit\">%s</span></div>", unit);
    if (page->manual != SP_UNKNOWN && page->manual != page->main && isfinite(values[1])) {
        sp_text_add(text, "<div class=\"against\">manual ");
        sp_markup_decimals(text, values[1], decimals[1]);
        sp_text_add(text, " %s (", unit);
        sp_markup_signed(text, points ? values[0] - values[1] : 100 * (values[0] / values[1] - 1), points ? 1 : 0);
        sp_text_add(text, points ? "&nbsp;points)</div>" : "&nbsp;%%)</div>");
    }
    sp_text_add(text, "</div>\n");
}

static void add_water_card(const sp_page *page, sp_text *text, const char *title, const double values[2])
{
    const int decimals[2] = {sp_water_decimals(values[0]), sp_water_decimals(values[1])};
    add_card(page, text, title, "L/min", values, decimals, false);
}

/* As the table of figures, but to the thousandth where that is more exact. */
static void add_ratio_card(const sp_page *page, sp_text *text, const double values[2])
{
    const int decimals[2] = {sp_told_decimals(values[0], 3, 3), sp_told_decimals(values[1], 3, 3)};
    add_card(page, text, "Area per water", "m\xc2\xb2 per L/min", values, decimals, false);
}

static void add_cards(const sp_page *page, sp_text *text)
{
    const sp_figures *main = &page->figures[page->main];
    const sp_figures *manual = &page->figures[page->manual == SP_UNKNOWN ? page->main : page->manual];
    const double coverage[2] = {100 * main->coverage, 100 * manual->coverage};
    const double water[2] = {6e4 * main->flow, 6e4 * manual->flow};
    const double ratio[2] = {main->area_per_water / 6e4, manual->area_per_water / 6e4};
    const double price[2] = {6e4 * sp_page_price(page, main), 6e4 * sp_page_price(page, manual)};
    const double money[2] = {sp_figures_money(main), sp_figures_money(manual)};
    const double count[2] = {(double)main->nozzle_count, (double)manual->nozzle_count};
    static const int none[2] = {0, 0}, tenths[2] = {1, 1};
    sp_text_add(text, "<div class=\"cards\">\n");
    add_card(page, text, "Coverage", "%", coverage, tenths, true);
    add_water_card(page, text, "Water", water);
    if (isfinite(sp_figures_money(main)))
        add_card(page, text, "Price", main->water_cost.currency, money, none, false);
    else if (page->costly)
        add_water_card(page, text, "Price", price);
    add_ratio_card(page, text, ratio);
    add_card(page, text, "Nozzles", "", count, none, false);
    sp_text_add(text, "</div>\n");
}

/* Less than was asked for, and what that left to aim at: the engineer's nozzles may reach more than those that were
 * chosen from. */
static void add_attainable(const sp_figures *proposed, const sp_proposal *proposal, sp_text *text)
{
    double whole = proposed->clean_area;
    double attainable = sp_percent_at_most(proposed->attainable_area, whole),
           allowed = sp_percent_at_most(proposal->attainable_area, whole);
    bool own = allowed < attainable;
    sp_text_add(text, own ? "nozzles that are allowed reach no more than " : "no more than ");
    sp_markup_decimals(text, own ? allowed : attainable, 2);
    sp_text_add(text, own ? "&nbsp;%%, so that " : "&nbsp;%% are attainable, so that ");
    sp_markup_decimals(text, 100 * proposal->target_area / whole, 1);
    sp_text_add(text, "&nbsp;%% were aimed at; ");
    if (own) {
        sp_text_add(text, "with what the engineer&#39;s own reach ");
        sp_markup_decimals(text, attainable, 2);
        sp_text_add(text, "&nbsp;%% are attainable; ");
    }
}

/* Within which limits it was asked for, as far as there are any. */
static void add_limits(const sp_design *design, const sp_proposal *proposal, sp_text *text)
{
    char limits[SP_LIMITS_TEXT];
    bool ports = false;
    sp_limits_clause(proposal, limits);
    for (size_t i = 0; i < design->mount_count; ++i)
        ports = ports || design->mounts[i].kind == SP_MOUNT_PORT;
    if (limits[0])
        sp_text_add(text, " with no more than %s", limits);
    if (ports)
        sp_text_add(text, "%s one nozzle in a port at most", limits[0] ? ", and" : " with");
}

/* The coverage asked for, and why the proposal falls short of it. */
static void add_shortfall(const sp_page *page, const sp_proposal *proposal, sp_text *text)
{
    const sp_figures *proposed = &page->figures[page->main];
    double percent = 100 / proposed->clean_area;
    sp_text_add(text, "<p class=\"warning\"><strong>The coverage asked for is not reached.</strong> ");
    sp_markup_decimals(text, percent * proposal->asked_area, 1);
    sp_text_add(text, "&nbsp;%% of the surface to be cleaned (");
    sp_markup_significant(text, proposal->asked_area, 4);
    sp_text_add(text, "&nbsp;m\xc2\xb2) were asked for");
    add_limits(&page->result->designs[page->main], proposal, text);
    sp_text_add(text, "; ");
    if (proposal->attainable_area < proposal->asked_area && !proposal->attainable_hurried &&
        !(proposed->missing_area[SP_REASON_UNKNOWN] > 0))
        add_attainable(proposed, proposal, text);
    sp_text_add(text, "the proposal covers ");
    sp_markup_decimals(text, percent * proposed->covered_area, 1);
    sp_text_add(text, "&nbsp;%% (");
    sp_markup_significant(text, proposed->covered_area, 4);
    sp_text_add(text, "&nbsp;m\xc2\xb2).</p>\n");
}

static void add_doubt(const sp_forward_check *check, sp_text *text)
{
    sp_text_add(text, "<p class=\"warning\" id=\"doubt\"><strong>The proposal&#39;s coverage is in doubt.</strong> "
                      "Counted again by jets flown from its nozzles, what is hit as asked for is ");
    sp_markup_decimals(text, 100 * check->coverage, 1);
    sp_text_add(text, "&nbsp;%%, by the inverse evaluation, which the search uses, ");
    sp_markup_decimals(text, 100 * (check->coverage - check->difference), 1);
    sp_text_add(text, "&nbsp;%%, on the same %zu texels: more apart than the accuracy of ", check->texels);
    sp_markup_significant(text, 100 * check->tolerance, 2);
    sp_text_add(text, "&nbsp;%%.</p>\n");
}

/* The proposal's coverage is not confirmed. */
static void add_error(const sp_figures *proposed, double accuracy, sp_text *text)
{
    sp_text_add(text,
                "<p class=\"warning\" id=\"error\"><strong>The accuracy asked for is not kept.</strong> The "
                "proposal&#39;s coverage may be off by %.2f&nbsp;points, more than the ",
                sp_percent_at_most(proposed->error_estimate, 1));
    sp_markup_significant(text, 100 * accuracy, 2);
    sp_text_add(text, "&nbsp;%% that were asked for. Texels shorter than ");
    sp_markup_significant(text, 1e3 * proposed->texel, 3);
    sp_text_add(text, "&nbsp;mm (<code>simulate: {texel: ..}</code>) may keep it.</p>\n");
}

/* What must not be overlooked of the alternatives that are not proposed. */
static void add_doubtful_alternatives(const sp_page *page, sp_text *text)
{
    for (size_t i = 0; i < page->result->design_count; ++i) {
        const sp_proposal *alternative = page->result->designs[i].alternative;
        if (!alternative || i == page->main)
            continue;
        bool doubt = alternative->forward_check.computed && !alternative->forward_check.agrees,
             error =
                 page->figures[i].error_estimate > sp_evaluator_fidelity(page->result->designs[i].evaluator)->accuracy;
        if (!doubt && !error)
            continue;
        sp_text_add(text, "<p class=\"warning\"><strong>The coverage of the alternative ");
        sp_page_name(page, text, i);
        sp_text_add(text, " is in doubt.</strong> %s</p>\n",
                    doubt ? "Counted again by jets flown from its nozzles it is more apart than the accuracy."
                          : "It may be off by more than the accuracy that was asked for.");
    }
}

/* Where there is a nozzle though, all are kept: what these leave is too little. */
static void add_lacking(const sp_proposal *proposal, sp_text *text)
{
    sp_text_add(text, "<p class=\"warning\"><strong>No %snozzle is allowed.</strong> max_water is less than %s, by ",
                proposal->layout->count > 0 ? "further " : "",
                proposal->layout->count > 0 ? "the nozzles to keep and any further one take together"
                                            : "any nozzle takes");
    sp_markup_significant(text, 6e4 * proposal->water_lacking, 3);
    sp_text_add(text, "&nbsp;L/min.</p>\n");
}

static void add_warnings(const sp_page *page, const sp_proposal *proposal, double accuracy, sp_text *text)
{
    const sp_figures *proposed = &page->figures[page->main];
    if (proposal->interrupted) {
        sp_text_add(text, "<p class=\"warning\"><strong>Cut short.</strong> The search was stopped before its end");
        sp_page_cut(text, proposal);
        sp_text_add(text, "; this is the best layout found until then.</p>\n");
    }
    if (proposal->forward_check.computed && !proposal->forward_check.agrees)
        add_doubt(&proposal->forward_check, text);
    if (proposed->error_estimate > accuracy)
        add_error(proposed, accuracy, text);
    if (proposal->reached)
        return;
    if (sp_exceeds_limits(proposal))
        sp_text_add(
            text, "<p class=\"warning\"><strong>Beyond the limits.</strong> The nozzles to keep are more, or take more "
                  "water, than was allowed.</p>\n");
    if (proposal->target_area > 0 && proposed->covered_area >= proposal->asked_area)
        return;
    bool lacking = proposal->water_lacking > 0, nothing = !(proposal->target_area > 0);
    if (lacking)
        add_lacking(proposal, text);
    if (nothing && lacking)
        return;
    if (nothing)
        sp_text_add(text,
                    "<p class=\"warning\"><strong>Nothing can be covered.</strong> No nozzle that is allowed, at any "
                    "mounting point that takes it, covers anything by the criteria.</p>\n");
    else
        add_shortfall(page, proposal, text);
}

/* Where the proposal does not beat what it is compared with, and one reason why that can be. */
static void add_own_better(const sp_page *page, sp_text *text)
{
    char sentence[SP_OWN_TEXT];
    sp_result_own_better(page->result, page->figures, sentence);
    if (sentence[0]) {
        sp_text_add(text, "<p class=\"warning\" id=\"own-better\">");
        sp_markup_escape(text, sentence);
        sp_text_add(text, "</p>\n");
    }
    if (sp_result_counts_thrown_back(page->result))
        sp_text_add(text, "<p class=\"note\" id=\"thrown-back\">The coverage of the layouts counts liquid that walls "
                          "throw back. The search goes by first impacts and puts the nozzles that it found together "
                          "anew with it; what is counted again and proved below is without it.</p>\n");
}

void sp_page_headline(const sp_page *page, sp_text *text)
{
    sp_text_add(text, "<p class=\"headline\">");
    if (page->main == SP_UNKNOWN) {
        sp_text_add(text, "%zu designs side by side.</p>\n", page->result->design_count);
        return;
    }
    if (page->alternatives)
        sp_page_choice(page, text);
    else
        sp_text_add(text, page->result->proposal ? "The proposed layout " : "The layout ");
    add_statement(page, text, page->main);
    if (page->manual != SP_UNKNOWN && page->manual != page->main) {
        sp_text_add(text, "; the engineer&#39;s own ");
        add_statement(page, text, page->manual);
    }
    sp_text_add(text, ".</p>\n");
    sp_page_gain(page, text);
    add_own_better(page, text);
    if (page->result->proposal)
        add_warnings(page, page->result->proposal,
                     sp_evaluator_fidelity(page->result->designs[page->main].evaluator)->accuracy, text);
    add_doubtful_alternatives(page, text);
    add_cards(page, text);
}
