/* How far from the best possible the proposal can be, as far as that is proved. */
#include "page.h"

static const char of_both[] = " of water and cost of mounts together";

/* Fractions that are proved from above are rounded up, from below down. */
static void add_percent(sp_text *text, double fraction, bool up)
{
    double tenths = 1000 * fraction;
    sp_markup_decimals(text, (up ? ceil(tenths - 1e-9) : floor(tenths + 1e-9)) / 10, 1);
    sp_text_add(text, "&nbsp;%%");
}

/* Water that is proved from below. */
static void add_least_water(sp_text *text, double flow)
{
    sp_markup_water(text, sp_water_at_least(6e4 * flow));
}

/* `only`: there is no other on the page. */
static void add_every_aim(const sp_proposal *proposal, sp_text *text, bool only)
{
    const sp_certificate *found = &proposal->certificate;
    if (!found->every_aim.computed)
        return;
    sp_text_add(text,
                "<p%s>Not only the candidates: of all nozzles at the %zu mounting point%s, whichever way "
                "they point within the mounts&#39; tilt, at any roll and at any angle and flow that refinement may "
                "set, and of the proposal&#39;s own poses, no layout reaches that with less than ",
                only ? " id=\"every-aim\"" : "", found->every_aim.places, found->every_aim.places == 1 ? "" : "s");
    add_least_water(text, found->every_aim.water_bound);
    sp_text_add(text, "&nbsp;L/min%s", proposal->costly ? of_both : "");
    if (ceil(1e3 * found->every_aim.area_bound / found->whole - 1e-9) < 1e3) { /* else it says nothing */
        sp_text_add(text, ", and with the proposal&#39;s %s none reaches more than ",
                    proposal->costly ? "price" : "water");
        add_percent(text, found->every_aim.area_bound / found->whole, true);
    }
    sp_text_add(text, ". Places between the mounting points are not covered.</p>\n");
}

/* What is proved of one proposal. */
static void add_proof(const sp_proposal *proposal, sp_text *text, bool thrown_back, bool only)
{
    const sp_certificate *found = &proposal->certificate;
    bool one = found->candidates == 1;
    if (thrown_back)
        sp_text_add(text, "<p>What follows is by first impacts alone: what walls throw back, which the other figures "
                          "count, may cover more, for this layout as for any other.</p>\n");
    sp_text_add(text, "<p>Among %s %zu candidate pose%s ", one ? "this" : "these", found->candidates, one ? "" : "s");
    if (found->candidates < proposal->candidates)
        sp_text_add(text, "(of %zu; the others are in ports that kept nozzles hold, or were not traced in time) ",
                    proposal->candidates);
    sp_text_add(text, "and the proposal&#39;s own, on %zu texels, no layout reaches ", found->texels);
    add_percent(text, found->counted / found->whole, true);
    sp_text_add(text, " with less than ");
    add_least_water(text, found->water_bound);
    sp_text_add(
        text,
        "&nbsp;L/min%s. Poses between candidates are not covered.</p>\n<p>That share of the surface to be cleaned, "
        "attainable or not, rounded up, is what the proposal itself reaches on these texels, with ",
        proposal->costly ? of_both : "");
    sp_markup_water(text, 6e4 * proposal->outlay);
    sp_text_add(text, "&nbsp;L/min%s. %s no layout reaches more than ", proposal->costly ? of_both : "",
                proposal->costly ? "For the same price" : "With as much water");
    add_percent(text, found->area_bound / found->whole, true);
    sp_text_add(text, ": at most ");
    add_percent(text, found->gap, true);
    sp_text_add(text, " of what is possible is left.%s</p>\n",
                found->every_layout ? " Every layout of the candidates was looked at that their bodies allow." : "");
    if (sp_allows_more_water(proposal))
        sp_text_add(text, "<p>More water is allowed than the proposal takes. What layouts that take "
                          "more could cover is not bounded here.</p>\n");
    add_every_aim(proposal, text, only);
}

/* The same of each alternative. */
static void add_proofs(const sp_page *page, sp_text *text)
{
    for (size_t i = 0; i < page->result->design_count; ++i) {
        const sp_proposal *alternative = page->result->designs[i].alternative;
        bool thrown_back = sp_evaluator_counts_thrown_back(page->result->designs[i].evaluator);
        if (!alternative)
            continue;
        sp_text_add(text, "<div class=\"block\"><h3>");
        sp_page_name(page, text, i);
        sp_text_add(text, "</h3>\n");
        if (alternative->certificate.computed)
            add_proof(alternative, text, thrown_back, false);
        else
            sp_text_add(text, "<p>Nothing is proved of how much better its layout could be.</p>\n");
        sp_text_add(text, "</div>\n");
    }
}

bool sp_page_proves(const sp_page *page)
{
    bool any = false;
    for (size_t i = 0; i < page->result->design_count; ++i) {
        const sp_proposal *proposal = sp_result_proposal(page->result, i);
        any |= proposal && proposal->certificate.computed;
    }
    return any;
}

void sp_page_certificate(const sp_page *page, sp_text *text)
{
    if (!sp_page_proves(page))
        return;
    sp_text_add(text, "<section id=\"certificate\"><h2>How good any layout could be</h2>\n");
    if (page->alternatives)
        add_proofs(page, text);
    else
        add_proof(page->result->proposal, text, sp_result_counts_thrown_back(page->result), true);
    sp_text_add(
        text,
        "<p class=\"note\">%sProved, by Lagrangian duality where not every layout was looked at, for every choice "
        "of these poses that keeps the limits on nozzles, water and ports, rounded outwards. The texels "
        "are those of the search and may be coarser than those that the other figures are counted on; "
        "liquid that is thrown back from walls does not count here.</p></section>\n",
        page->costly ? "Where mounts cost something, a limit on water does not limit what is proved here: layouts "
                       "beyond it are among those that do no better. "
                     : "");
}
