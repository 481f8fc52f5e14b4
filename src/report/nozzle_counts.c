/* Coverage against number of nozzles: every nozzle more is a hole in the vessel, whatever its water. */
#include "page.h"

/* The point that covers most with at most `most` nozzles, of equals the first, which has the least water; false where
 * there is none. */
static bool best_of_few(const sp_page *page, size_t most, sp_page_point *best)
{
    sp_page_point p;
    bool found = false;
    for (size_t i = 0; sp_page_point_at(page, i, &p); ++i)
        if (p.nozzles <= most && p.nozzles > 0 && (!found || p.area > best->area)) {
            *best = p;
            found = true;
        }
    return found;
}

static size_t most_nozzles(const sp_page *page)
{
    sp_page_point p;
    size_t most = 0;
    for (size_t i = 0; sp_page_point_at(page, i, &p); ++i)
        most = p.nozzles > most ? p.nozzles : most;
    return most;
}

static void add_row(sp_text *text, const sp_page_point *best, double whole)
{
    sp_text_add(text, "<tr><th scope=\"row\">%zu</th><td>", best->nozzles);
    sp_markup_decimals(text, 100 * best->area / whole, 1);
    sp_text_add(text, "&nbsp;%%</td><td>");
    sp_markup_decimals(text, 6e4 * best->flow, 1);
    sp_text_add(text, "&nbsp;L/min</td></tr>\n");
}

void sp_page_nozzle_counts(const sp_page *page, sp_text *text)
{
    const sp_proposal *proposal = page->result->proposal;
    if (!proposal || proposal->front_count == 0 || page->main == SP_UNKNOWN)
        return;
    const sp_figures *figures = &page->figures[page->main];
    double whole = page->of_attainable ? figures->attainable_area : figures->clean_area;
    sp_text_add(text,
                "<section id=\"counts\"><h2>Coverage against number of nozzles</h2>\n<table class=\"numbers small "
                "narrow\"><thead><tr><th scope=\"col\">Nozzles</th><th scope=\"col\">Coverage of the %s</th><th "
                "scope=\"col\">Water</th></tr></thead>\n<tbody>\n",
                page->of_attainable ? "attainable area" : "surface");
    size_t most = most_nozzles(page);
    double area = 0;
    sp_page_point best;
    for (size_t count = 1; count <= most; ++count)
        if (best_of_few(page, count, &best) && best.area > area) {
            add_row(text, &best, whole);
            area = best.area;
        }
    sp_text_add(text, "</tbody></table>\n<p class=\"note\">Of the layouts in the chart above, the one that covers most "
                      "with so many nozzles. A number is left out where fewer nozzles cover as much.</p></section>\n");
}
