/* What each nozzle is worth: alone, and what is lost without it. */
#include "page.h"

#define LEAST_SHARE 0.5e-4 /* of the surface, that is told as more than 0.00 points */

static bool is_known(const sp_figures *figures)
{
    return figures->nozzle_count > 0 && isfinite(figures->nozzles[0].lost);
}

/* What is told as more than no points is told as more than no area. */
static int area_decimals(double area, const sp_figures *layout)
{
    int decimals = sp_area_decimals(layout, 3);
    return area >= LEAST_SHARE * layout->clean_area ? sp_told_decimals(area, decimals, 1) : decimals;
}

static void add_area(sp_text *text, double area, const sp_figures *layout, bool lost)
{
    sp_text_add(text, "<td>");
    sp_markup_decimals(text, area, area_decimals(area, layout));
    sp_text_add(text, "</td><td>");
    sp_markup_decimals(text, 100 * area / layout->clean_area, lost ? 2 : 1);
    sp_text_add(text, "</td>");
}

const char sp_page_cost_heads[] = "<th scope=\"col\">Cost of its mount, L/min</th><th scope=\"col\">points per L/min "
                                  "of water and cost</th>";

void sp_page_cost_cells(sp_text *text, const sp_nozzle_figures *nozzle, double whole)
{
    sp_text_add(text, "<td>");
    sp_markup_water(text, 6e4 * nozzle->cost);
    sp_text_add(text, "</td><td>");
    sp_markup_decimals(text, 100 * nozzle->lost / whole / (6e4 * (nozzle->flow + nozzle->cost)), 3);
    sp_text_add(text, "</td>");
}

static void add_nozzle(sp_text *text, const sp_nozzle_figures *nozzle, const sp_figures *layout, bool costly)
{
    sp_text_add(text, "<tr><th scope=\"row\">");
    sp_markup_escape(text, nozzle->name);
    sp_text_add(text, "</th><td>");
    sp_markup_water_beside(text, 6e4 * nozzle->flow, 6e4 * layout->flow);
    sp_text_add(text, "</td>");
    add_area(text, nozzle->alone, layout, false);
    add_area(text, nozzle->lost, layout, true);
    if (costly)
        sp_page_cost_cells(text, nozzle, layout->clean_area);
    sp_text_add(text, "</tr>\n");
}

static void add_design(const sp_page *page, sp_text *text, size_t design)
{
    const sp_figures *figures = &page->figures[design];
    sp_text_add(text, "<div class=\"wide\"><table class=\"numbers small\" data-design=\"%zu\"><caption>", design);
    sp_page_name(page, text, design);
    sp_text_add(text,
                "</caption>\n<thead><tr><th scope=\"col\">Nozzle</th><th scope=\"col\">L/min</th><th "
                "scope=\"col\">Covers alone, m\xc2\xb2</th><th scope=\"col\">%%</th><th scope=\"col\">Lost "
                "without it, m\xc2\xb2</th><th scope=\"col\">points</th>%s</tr></thead>\n<tbody>\n",
                page->costly ? sp_page_cost_heads : "");
    for (size_t i = 0; i < figures->nozzle_count; ++i)
        add_nozzle(text, &figures->nozzles[i], figures, page->costly);
    sp_text_add(text, "</tbody></table></div>\n");
}

void sp_page_contributions(const sp_page *page, sp_text *text)
{
    bool any = false;
    for (size_t i = 0; i < page->result->design_count; ++i)
        any |= is_known(&page->figures[i]);
    if (!any)
        return;
    sp_text_add(text, "<section id=\"contributions\"><h2>What each nozzle does</h2>\n");
    for (size_t i = 0; i < page->result->design_count; ++i)
        if (is_known(&page->figures[i]))
            add_design(page, text, i);
    sp_text_add(text, "<p class=\"note\">What a nozzle covers alone others may cover too; what is lost without it is "
                      "what no others of the layout, all together, cover. Shares of the surface to be cleaned.</p>"
                      "</section>\n");
}
