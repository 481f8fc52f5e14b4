/* Coverage against number of nozzles: every nozzle more is a hole in the vessel, whatever its water. */
#include "page.h"

/* `most`: the last of the table's rows, as exactly as which the others are told. */
static void add_row(sp_text *text, const sp_front_point *point, const sp_front_point *most, double whole,
                    const sp_page *page)
{
    sp_text_add(text, "<tr><th scope=\"row\">%zu</th>", point->nozzles);
    if (page->alternatives)
        sp_text_add(text, "<td>%zu</td>", point->fittings);
    sp_text_add(text, "<td>");
    sp_markup_decimals(text, 100 * point->area / whole, 1);
    sp_text_add(text, "&nbsp;%%</td><td>");
    sp_markup_water_beside(text, 6e4 * point->flow, 6e4 * most->flow);
    sp_text_add(text, "&nbsp;L/min</td>");
    if (page->costly) {
        sp_text_add(text, "<td>");
        sp_markup_water_beside(text, 6e4 * point->outlay, 6e4 * most->outlay);
        sp_text_add(text, "&nbsp;L/min</td>");
    }
    sp_text_add(text, "</tr>\n");
}

/* `design` whose front it is, where there are several. */
static void add_table(const sp_page *page, sp_text *text, size_t design)
{
    const sp_proposal *proposal = sp_result_proposal(page->result, design);
    sp_text_add(text, "<table class=\"numbers small narrow\">");
    if (page->alternatives) {
        sp_text_add(text, "<caption>");
        sp_page_name(page, text, design);
        sp_text_add(text, "</caption>\n");
    }
    sp_text_add(text,
                "<thead><tr><th scope=\"col\">Nozzles</th>%s<th scope=\"col\">Coverage</th><th "
                "scope=\"col\">Water</th>%s</tr></thead>\n<tbody>\n",
                page->alternatives ? "<th scope=\"col\">New fittings</th>" : "",
                page->costly ? "<th scope=\"col\">Price</th>" : "");
    for (size_t i = 0; i < proposal->by_number_count; ++i)
        add_row(text, &proposal->by_number[i], &proposal->by_number[proposal->by_number_count - 1],
                page->figures[design].clean_area, page);
    sp_text_add(text, "</tbody></table>\n");
}

void sp_page_nozzle_counts(const sp_page *page, sp_text *text)
{
    const sp_proposal *proposal = page->result->proposal;
    if (!proposal || proposal->by_number_count == 0 || page->main == SP_UNKNOWN)
        return;
    sp_text_add(text, "<section id=\"counts\"><h2>Coverage against number of nozzles</h2>\n");
    /* side by side, as far as there is room */
    if (page->alternatives)
        sp_text_add(text, "<div style=\"display:flex;flex-wrap:wrap;gap:0 40px;align-items:flex-start\">\n");
    for (size_t i = 0; i < page->result->design_count; ++i)
        if (page->alternatives ? page->result->designs[i].alternative != NULL : i == page->main)
            add_table(page, text, i);
    if (page->alternatives)
        sp_text_add(text, "</div>\n");
    sp_text_add(text, "<p class=\"note\">The most that was found with so many nozzles, whatever their "
                      "water. A number is left out where none was found that covers more than fewer "
                      "nozzles.</p></section>\n");
}
