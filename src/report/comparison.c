/* The engineer's layout against the best found with no more water, and against the least water for no less coverage. */
#include "page.h"

typedef struct {
    double flow, area;
    size_t nozzles;
} point;

/* The front's points, then what was reported: the refined proposal may lie beyond the front. */
static bool point_at(const sp_page *page, size_t i, point *p)
{
    const sp_proposal *proposal = page->result->proposal;
    if (i < proposal->front_count) {
        *p = (point){proposal->front[i].flow, proposal->front[i].area, proposal->front[i].nozzles};
        return true;
    }
    size_t reported[2] = {page->greedy, page->main};
    i -= proposal->front_count;
    if (i >= 2)
        return false;
    size_t design = reported[i] == SP_UNKNOWN ? page->main : reported[i];
    const sp_figures *figures = &page->figures[design];
    *p = (point){figures->flow, figures->covered_area, figures->nozzle_count};
    return true;
}

/* Most area with no more water; least water with no less area. Nothing found: flow 0. */
static void best_points(const sp_page *page, const sp_figures *manual, point *same_water, point *same_area)
{
    point p;
    *same_water = (point){0, -1, 0};
    *same_area = (point){INFINITY, 0, 0};
    for (size_t i = 0; point_at(page, i, &p); ++i) {
        if (p.flow <= manual->flow * (1 + 1e-9) && p.area > same_water->area)
            *same_water = p;
        if (p.area >= manual->covered_area * (1 - 1e-9) && p.flow < same_area->flow)
            *same_area = p;
    }
}

static void add_percent(sp_text *text, double fraction)
{
    sp_text_add(text, "<td>");
    sp_markup_decimals(text, 100 * fraction, 1);
    sp_text_add(text, "&nbsp;%%</td>");
}

static void add_flow(sp_text *text, double flow)
{
    sp_text_add(text, "<td>");
    sp_markup_decimals(text, 6e4 * flow, 1);
    sp_text_add(text, "&nbsp;L/min</td>");
}

static void add_same_water(sp_text *text, double fraction, const point *best, double whole)
{
    sp_text_add(text, "<tr><th scope=\"row\">At the engineer&#39;s water, coverage</th>");
    add_percent(text, fraction);
    if (best->area < 0) {
        sp_text_add(text, "<td colspan=\"3\" class=\"text\">nothing found with so little water</td></tr>\n");
        return;
    }
    add_percent(text, best->area / whole);
    sp_text_add(text, "<td>");
    sp_markup_signed(text, 100 * (best->area / whole - fraction), 1);
    sp_text_add(text, "&nbsp;points</td><td class=\"text\">%zu nozzle%s, ", best->nozzles,
                best->nozzles == 1 ? "" : "s");
    sp_markup_decimals(text, 6e4 * best->flow, 1);
    sp_text_add(text, "&nbsp;L/min</td></tr>\n");
}

static void add_same_area(sp_text *text, double flow, const point *best, double whole)
{
    sp_text_add(text, "<tr><th scope=\"row\">At the engineer&#39;s coverage, water</th>");
    add_flow(text, flow);
    if (!isfinite(best->flow)) {
        sp_text_add(text, "<td colspan=\"3\" class=\"text\">nothing found that covers as much</td></tr>\n");
        return;
    }
    add_flow(text, best->flow);
    sp_text_add(text, "<td>");
    sp_markup_signed(text, 100 * (best->flow / flow - 1), 0);
    sp_text_add(text, "&nbsp;%%</td><td class=\"text\">%zu nozzle%s, ", best->nozzles, best->nozzles == 1 ? "" : "s");
    sp_markup_decimals(text, 100 * best->area / whole, 1);
    sp_text_add(text, "&nbsp;%%</td></tr>\n");
}

static bool is_compared(const sp_page *page)
{
    return page->result->proposal && page->manual != SP_UNKNOWN && page->main != SP_UNKNOWN;
}

void sp_page_gain(const sp_page *page, sp_text *text)
{
    point same_water, same_area;
    if (!is_compared(page))
        return;
    const sp_figures *manual = &page->figures[page->manual];
    best_points(page, manual, &same_water, &same_area);
    if (same_water.area < 0 || !isfinite(same_area.flow))
        return;
    sp_text_add(
        text,
        "<p class=\"headline\">With no more water than the engineer&#39;s, the best layout found covers <strong>");
    sp_markup_decimals(text, 100 * same_water.area / manual->clean_area, 1);
    sp_text_add(text, "&nbsp;%%</strong>; to cover no less than the engineer&#39;s, it needs <strong>");
    sp_markup_decimals(text, 6e4 * same_area.flow, 1);
    sp_text_add(text, "&nbsp;L/min</strong> (");
    sp_markup_signed(text, 100 * (same_area.flow / manual->flow - 1), 0);
    sp_text_add(text, "&nbsp;%%).</p>\n");
}

void sp_page_comparison(const sp_page *page, sp_text *text)
{
    if (!is_compared(page))
        return;
    const sp_figures *manual = &page->figures[page->manual];
    double whole = manual->clean_area;
    point same_water, same_area;
    best_points(page, manual, &same_water, &same_area);
    sp_text_add(text,
                "<section id=\"comparison\"><h2>At equal water, at equal coverage</h2>\n<div class=\"wide\"><table "
                "class=\"numbers\"><thead><tr><th scope=\"col\">Compared</th><th scope=\"col\">Manual</th><th "
                "scope=\"col\">Best found</th><th scope=\"col\">Gain</th><th scope=\"col\" class=\"text\">With"
                "</th></tr></thead>\n<tbody>\n");
    add_same_water(text, manual->coverage, &same_water, whole);
    add_same_area(text, manual->flow, &same_area, whole);
    sp_text_add(text, "</tbody></table></div></section>\n");
}
