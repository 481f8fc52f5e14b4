/* What could be built, side by side: what each alternative gives against the first, and what each new fitting buys. */
#include "page.h"

#include <stdlib.h>
#include <string.h>

#define L_MIN 6e4 /* L/min per m³/s */

static bool is_alternative(const sp_page *page, size_t design)
{
    return page->result->designs[design].alternative != NULL;
}

/* The first of them, which the others are held against. */
static size_t first_of(const sp_page *page)
{
    size_t first = 0;
    while (!is_alternative(page, first))
        first++;
    return first;
}

static void add_own_name(const sp_page *page, sp_text *text, size_t design)
{
    sp_markup_escape(text, page->figures[design].name);
}

static size_t count_of(const sp_page *page)
{
    size_t count = 0;
    for (size_t i = 0; i < page->result->design_count; ++i)
        count += is_alternative(page, i);
    return count;
}

/* Escaped; no line ends between a number and its per cent sign. */
static void add_why(sp_text *text, char *why)
{
    for (char *space; (space = strstr(why, " %")); why = space + 1) {
        *space = 0;
        sp_markup_escape(text, why);
        sp_text_add(text, "&nbsp;");
    }
    sp_markup_escape(text, why);
}

void sp_page_choice(const sp_page *page, sp_text *text)
{
    char why[SP_CHOICE_TEXT];
    sp_result_choice(page->result, why);
    sp_text_add(text, "Of %zu alternatives, <strong>", count_of(page));
    add_own_name(page, text, page->main);
    sp_text_add(text, "</strong> is proposed: ");
    add_why(text, why);
    sp_text_add(text, ". It ");
}

static void add_nozzle_count(sp_text *text, size_t nozzles, size_t fittings)
{
    sp_text_add(text, "%zu nozzle%s, %zu new fitting%s", nozzles, nozzles == 1 ? "" : "s", fittings,
                fittings == 1 ? "" : "s");
}

typedef void add_cell(const sp_page *page, sp_text *text, size_t design);

static void add_coverage(const sp_page *page, sp_text *text, size_t design)
{
    sp_page_coverage(text, &page->figures[design]);
}

static void add_water(const sp_page *page, sp_text *text, size_t design)
{
    sp_markup_water(text, L_MIN * page->figures[design].flow);
    sp_text_add(text, "&nbsp;L/min");
}

/* Water and mounts, and that in money. */
static void add_price(const sp_page *page, sp_text *text, size_t design)
{
    const sp_figures *figures = &page->figures[design];
    sp_markup_water(text, L_MIN * sp_page_price(page, figures));
    sp_text_add(text, "&nbsp;L/min");
    if (isfinite(sp_figures_money(figures))) {
        sp_text_add(text, ", ");
        sp_markup_significant(text, sp_figures_money(figures), 4);
        sp_text_add(text, "&nbsp;%s", figures->water_cost.currency);
    }
    sp_text_add(text, "<br><span class=\"unit\">");
    sp_markup_water_of(text, L_MIN * figures->mount_cost, L_MIN * sp_page_price(page, figures));
    sp_text_add(text, "&nbsp;L/min for mounts</span>");
}

static void add_counts(const sp_page *page, sp_text *text, size_t design)
{
    add_nozzle_count(text, page->figures[design].nozzle_count, page->figures[design].fittings);
}

/* What was asked for, and whether it is reached. */
static void add_reached(const sp_page *page, sp_text *text, size_t design)
{
    const sp_proposal *proposal = page->result->designs[design].alternative;
    sp_text_add(text, proposal->reached ? "yes" : "no");
    if (proposal->interrupted)
        sp_text_add(text, ", the search was stopped before its end");
    sp_page_cut(text, proposal);
}

static void add_limits(const sp_page *page, sp_text *text, size_t design)
{
    char limits[SP_LIMITS_TEXT];
    sp_limits_clause(page->result->designs[design].alternative, limits);
    sp_text_add(text, "%s", limits[0] ? limits : "any number and water");
}

/* Whether any alternative has limits of its own on number or water. */
static bool has_limits(const sp_page *page)
{
    bool any = false;
    for (size_t i = 0; i < page->result->design_count; ++i) {
        char limits[SP_LIMITS_TEXT] = "";
        if (is_alternative(page, i))
            sp_limits_clause(page->result->designs[i].alternative, limits);
        any |= limits[0] != 0;
    }
    return any;
}

static void add_attainable(const sp_page *page, sp_text *text, size_t design)
{
    const sp_figures *figures = &page->figures[design];
    sp_markup_decimals(text, 100 * figures->attainable_area / figures->clean_area, 1);
    sp_text_add(text, "&nbsp;%%%s", sp_page_looked(page, design));
}

/* By how much, and by how much for each fitting that it has more. */
static void add_gain(sp_text *text, double gain, int decimals, const char *unit, size_t fittings, size_t had)
{
    sp_markup_signed(text, gain, decimals);
    sp_text_add(text, "&nbsp;%s", unit);
    if (fittings <= had + 1)
        return;
    sp_text_add(text, ", ");
    sp_markup_signed(text, gain / (double)(fittings - had), decimals);
    sp_text_add(text, " for each");
}

/* The most that was found for no higher price than the first's layout takes. */
static void add_at_its_price(const sp_page *page, sp_text *text, size_t design)
{
    const sp_figures *first = &page->figures[first_of(page)];
    sp_page_point best, ignored;
    sp_page_best_points(page, design, sp_page_price(page, first), first->covered_area, &best, &ignored);
    if (best.area < 0) {
        sp_text_add(text, page->costly ? "nothing found for so low a price" : "nothing found with so little water");
        return;
    }
    double share = best.area / page->figures[design].clean_area;
    sp_markup_decimals(text, 100 * share, 1);
    sp_text_add(text, "&nbsp;%%");
    if (design == first_of(page))
        return;
    sp_text_add(text, " (");
    add_gain(text, 100 * (share - first->coverage), 1, "points", best.fittings, first->fittings);
    sp_text_add(text, ")<br><span class=\"unit\">");
    add_nozzle_count(text, best.nozzles, best.fittings);
    sp_text_add(text, "</span>");
}

/* The least price at which what was found covers no less than the first's layout does. */
static void add_at_its_coverage(const sp_page *page, sp_text *text, size_t design)
{
    const sp_figures *first = &page->figures[first_of(page)];
    double area = first->coverage * page->figures[design].clean_area;
    sp_page_point best, ignored;
    sp_page_best_points(page, design, sp_page_price(page, first), area, &ignored, &best);
    if (!isfinite(best.price)) {
        sp_text_add(text, "nothing found that covers as much");
        return;
    }
    sp_markup_water(text, L_MIN * best.price);
    sp_text_add(text, "&nbsp;L/min");
    if (design == first_of(page))
        return;
    sp_text_add(text, " (");
    add_gain(text, L_MIN * (best.price - sp_page_price(page, first)),
             sp_water_decimals(L_MIN * sp_page_price(page, first)), "L/min", best.fittings, first->fittings);
    sp_text_add(text, ")<br><span class=\"unit\">");
    add_nozzle_count(text, best.nozzles, best.fittings);
    sp_text_add(text, "</span>");
}

static void add_sheet_link(const sp_page *page, sp_text *text, size_t design)
{
    sp_text_add(text, "<a href=\"#");
    sp_page_sheet_id(page, text, design);
    sp_text_add(text, "\">sheet</a>");
}

static void add_row(const sp_page *page, sp_text *text, const char *title, add_cell *cell)
{
    sp_text_add(text, "<tr><th scope=\"row\">%s</th>", title);
    for (size_t i = 0; i < page->result->design_count; ++i) {
        if (!is_alternative(page, i))
            continue;
        sp_text_add(text, "<td%s>", sp_page_column(page, i));
        cell(page, text, i);
        sp_text_add(text, "</td>");
    }
    sp_text_add(text, "</tr>\n");
}

/* A title that tells of the first alternative. */
static void add_row_of_first(const sp_page *page, sp_text *text, const char *before, const char *after, add_cell *cell)
{
    sp_text title = {0};
    sp_text_add(&title, "%s ", before);
    add_own_name(page, &title, first_of(page));
    sp_text_add(&title, "%s", after);
    text->failed |= title.failed;
    if (!title.failed)
        add_row(page, text, title.text, cell);
    free(title.text);
}

static void add_table(const sp_page *page, sp_text *text)
{
    sp_text_add(text, "<div class=\"wide\"><table class=\"numbers\"><thead><tr><th scope=\"col\">Alternative</th>");
    for (size_t i = 0; i < page->result->design_count; ++i) {
        if (!is_alternative(page, i))
            continue;
        sp_text_add(text, "<th scope=\"col\"%s>", sp_page_column(page, i));
        sp_page_name(page, text, i);
        sp_text_add(text, "</th>");
    }
    sp_text_add(text, "</tr></thead>\n<tbody>\n");
    double asked = 100 * page->result->proposal->asked_area / page->figures[page->main].clean_area;
    sp_text reached = {0};
    sp_text_add(&reached, "Covers the %.4g&nbsp;%% asked for", asked);
    add_row(page, text, "Coverage", add_coverage);
    if (!reached.failed)
        add_row(page, text, reached.text, add_reached);
    text->failed |= reached.failed;
    free(reached.text);
    if (has_limits(page))
        add_row(page, text, "Allowed at most", add_limits);
    add_row(page, text, "Attainable at all", add_attainable);
    add_row(page, text, "Water", add_water);
    if (page->costly)
        add_row(page, text, "Price: water and mounts", add_price);
    add_row(page, text, "Made of", add_counts);
    add_row_of_first(page, text, page->costly ? "For no higher price than" : "With no more water than",
                     ", the most found", add_at_its_price);
    add_row_of_first(page, text, "To cover as much as",
                     page->costly ? ", the lowest price found" : ", the least water found", add_at_its_coverage);
    add_row(page, text, "What to weld and order", add_sheet_link);
    sp_text_add(text, "</tbody></table></div>\n");
}

static void add_fitting(const sp_page *page, sp_text *text, size_t design, const sp_nozzle_figures *nozzle)
{
    const double place[] = {nozzle->position.x, nozzle->position.y, nozzle->position.z};
    sp_text_add(text, "<tr><th scope=\"row\">");
    sp_markup_escape(text, nozzle->name);
    sp_text_add(text, "</th><td class=\"text\">");
    add_own_name(page, text, design);
    sp_text_add(text, "</td><td class=\"text\">");
    sp_markup_escape(text, nozzle->type);
    sp_text_add(text, "</td>");
    for (int k = 0; k < 3; ++k) {
        sp_text_add(text, "<td>");
        sp_markup_decimals(text, place[k], sp_place_decimals(&page->figures[design], 3));
        sp_text_add(text, "</td>");
    }
    sp_text_add(text, "<td>");
    sp_markup_water_beside(text, L_MIN * nozzle->flow, L_MIN * page->figures[design].flow);
    sp_text_add(text, "</td><td>");
    sp_markup_decimals(text, nozzle->lost, sp_area_decimals(&page->figures[design], 3));
    sp_text_add(text, "</td><td>");
    sp_markup_decimals(text, 100 * nozzle->lost / page->figures[design].clean_area, 2);
    sp_text_add(text, "</td>");
    if (page->costly)
        sp_page_cost_cells(text, nozzle, page->figures[design].clean_area);
    sp_text_add(text, "</tr>\n");
}

static void add_fittings(const sp_page *page, sp_text *text)
{
    size_t total = 0;
    for (size_t i = 0; i < page->result->design_count; ++i)
        total += is_alternative(page, i) ? page->figures[i].fittings : 0;
    if (total == 0)
        return;
    sp_text_add(text,
                "<div class=\"wide\"><table class=\"numbers small\"><caption>What each new fitting buys</caption>\n"
                "<thead><tr><th scope=\"col\">Nozzle</th><th scope=\"col\" class=\"text\">Alternative</th><th "
                "scope=\"col\" class=\"text\">Type</th><th scope=\"col\">x&nbsp;m</th><th scope=\"col\">y&nbsp;m</th>"
                "<th scope=\"col\">z&nbsp;m</th><th scope=\"col\">L/min</th><th scope=\"col\">Lost without it, "
                "m\xc2\xb2</th><th scope=\"col\">points</th>%s</tr></thead>\n<tbody>\n",
                page->costly ? sp_page_cost_heads : "");
    for (size_t i = 0; i < page->result->design_count; ++i)
        for (size_t k = 0; is_alternative(page, i) && k < page->figures[i].nozzle_count; ++k)
            if (page->figures[i].nozzles[k].fitting)
                add_fitting(page, text, i, &page->figures[i].nozzles[k]);
    sp_text_add(text, "</tbody></table></div>\n");
}

void sp_page_alternatives(const sp_page *page, sp_text *text)
{
    if (!page->alternatives)
        return;
    sp_text_add(text, "<section id=\"alternatives\"><h2>Alternatives</h2>\n");
    add_table(page, text);
    sp_text_add(text,
                "<p class=\"note\">A new fitting is a place of a nozzle that is not a port and is not kept from "
                "the layout there is: a weld, or a place on a pipe. Alternatives that allow less are searched first; "
                "what is found after that is not handed back to them, so that they may do better than is told of "
                "them. What was found need not be the best%s.</p>\n",
                sp_page_proves(page) ? ": the <a href=\"#front\">chart</a> and the <a href=\"#certificate\">bounds</a> "
                                       "tell how much better each could be"
                                     : "");
    add_fittings(page, text);
    sp_text_add(text, "</section>\n");
}
