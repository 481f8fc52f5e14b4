/* Coverage against number of nozzles: every nozzle more is a hole in the vessel, whatever its water. */
#include "page.h"

static void add_row(sp_text *text, const sp_front_point *point, double whole)
{
    sp_text_add(text, "<tr><th scope=\"row\">%zu</th><td>", point->nozzles);
    sp_markup_decimals(text, 100 * point->area / whole, 1);
    sp_text_add(text, "&nbsp;%%</td><td>");
    sp_markup_decimals(text, 6e4 * point->flow, 1);
    sp_text_add(text, "&nbsp;L/min</td></tr>\n");
}

void sp_page_nozzle_counts(const sp_page *page, sp_text *text)
{
    const sp_proposal *proposal = page->result->proposal;
    if (!proposal || proposal->by_number_count == 0 || page->main == SP_UNKNOWN)
        return;
    const sp_figures *figures = &page->figures[page->main];
    sp_text_add(text,
                "<section id=\"counts\"><h2>Coverage against number of nozzles</h2>\n<table class=\"numbers small "
                "narrow\"><thead><tr><th scope=\"col\">Nozzles</th><th scope=\"col\">Coverage</th><th "
                "scope=\"col\">Water</th></tr></thead>\n<tbody>\n");
    for (size_t i = 0; i < proposal->by_number_count; ++i)
        add_row(text, &proposal->by_number[i], figures->clean_area);
    sp_text_add(text,
                "</tbody></table>\n<p class=\"note\">The most that was found with so many nozzles, whatever their "
                "water. A number is left out where fewer nozzles cover as much.</p></section>\n");
}
