/* The engineer's layout against the best found for no higher price, and against the lowest price for no less coverage.
 * The price is water alone where mounts cost nothing. */
#include "page.h"

double sp_page_price(const sp_page *page, const sp_figures *figures)
{
    return page->costly && isfinite(figures->mount_cost) ? sp_figures_price(figures) : figures->flow;
}

/* The front's points, then what was reported: the refined proposal may lie beyond the front. */
static bool point_at(const sp_page *page, size_t design, size_t i, sp_page_point *p)
{
    const sp_proposal *proposal = sp_result_proposal(page->result, design);
    if (i < proposal->front_count) {
        const sp_front_point *found = &proposal->front[i];
        *p = (sp_page_point){found->outlay, found->area, found->nozzles, found->fittings};
        return true;
    }
    size_t reported[2] = {page->greedy, design};
    i -= proposal->front_count;
    if (i >= 2)
        return false;
    const sp_figures *figures = &page->figures[reported[i] == SP_UNKNOWN ? design : reported[i]];
    *p = (sp_page_point){sp_page_price(page, figures), figures->covered_area, figures->nozzle_count, figures->fittings};
    return true;
}

void sp_page_best_points(const sp_page *page, size_t design, double price, double area, sp_page_point *same_price,
                         sp_page_point *same_area)
{
    sp_page_point p;
    *same_price = (sp_page_point){0, -1, 0, 0};
    *same_area = (sp_page_point){INFINITY, 0, 0, 0};
    for (size_t i = 0; point_at(page, design, i, &p); ++i) {
        if (p.price <= price * (1 + 1e-9) && p.area > same_price->area)
            *same_price = p;
        if (p.area >= area * (1 - 1e-9) && p.price < same_area->price)
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
    sp_markup_water(text, 6e4 * flow);
    sp_text_add(text, "&nbsp;L/min</td>");
}

/* What a row is about; `design` whose front it is, where there are several. */
static void add_head(const sp_page *page, sp_text *text, size_t design, const char *compared)
{
    sp_text_add(text, "<tr><th scope=\"row\">%s", compared);
    if (page->alternatives) {
        sp_text_add(text, "<br><span class=\"unit\">");
        sp_markup_escape(text, page->figures[design].name);
        sp_text_add(text, "</span>");
    }
    sp_text_add(text, "</th>");
}

static void add_same_price(const sp_page *page, sp_text *text, double fraction, const sp_page_point *best, double whole)
{
    add_percent(text, fraction);
    if (best->area < 0) {
        sp_text_add(text, "<td colspan=\"3\" class=\"text\">nothing found %s</td></tr>\n",
                    page->costly ? "for so low a price" : "with so little water");
        return;
    }
    add_percent(text, best->area / whole);
    sp_text_add(text, "<td>");
    sp_markup_signed(text, 100 * (best->area / whole - fraction), 1);
    sp_text_add(text, "&nbsp;points</td><td class=\"text\">%zu nozzle%s, ", best->nozzles,
                best->nozzles == 1 ? "" : "s");
    sp_markup_water(text, 6e4 * best->price);
    sp_text_add(text, "&nbsp;L/min</td></tr>\n");
}

static void add_same_area(sp_text *text, double price, const sp_page_point *best, double whole)
{
    add_flow(text, price);
    if (!isfinite(best->price)) {
        sp_text_add(text, "<td colspan=\"3\" class=\"text\">nothing found that covers as much</td></tr>\n");
        return;
    }
    add_flow(text, best->price);
    sp_text_add(text, "<td>");
    sp_markup_signed(text, 100 * (best->price / price - 1), 0);
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
    sp_page_point same_price, same_area;
    if (!is_compared(page))
        return;
    const sp_figures *manual = &page->figures[page->manual];
    sp_page_best_points(page, page->main, sp_page_price(page, manual), manual->covered_area, &same_price, &same_area);
    if (same_price.area < 0 || !isfinite(same_area.price))
        return;
    sp_text_add(text, "<p class=\"headline\">%s than the engineer&#39;s, the best layout found%s covers <strong>",
                page->costly ? "For no higher price" : "With no more water", page->alternatives ? " for it" : "");
    sp_markup_decimals(text, 100 * same_price.area / manual->clean_area, 1);
    sp_text_add(text, "&nbsp;%%</strong>; to cover no less than the engineer&#39;s, it %s <strong>",
                page->costly ? "takes, in water and what mounts cost," : "needs");
    sp_markup_water(text, 6e4 * same_area.price);
    sp_text_add(text, "&nbsp;L/min</strong> (");
    sp_markup_signed(text, 100 * (same_area.price / sp_page_price(page, manual) - 1), 0);
    sp_text_add(text, "&nbsp;%%).</p>\n");
}

void sp_page_comparison(const sp_page *page, sp_text *text)
{
    if (!is_compared(page))
        return;
    static const char *const heads[2][2] = {
        {"At the engineer&#39;s water, coverage", "At the engineer&#39;s coverage, water"},
        {"At the engineer&#39;s price, coverage", "At the engineer&#39;s coverage, price"},
    };
    const sp_figures *manual = &page->figures[page->manual];
    sp_text_add(text,
                "<section id=\"comparison\"><h2>At equal %s, at equal coverage</h2>\n<div class=\"wide\"><table "
                "class=\"numbers\"><thead><tr><th scope=\"col\">Compared</th><th scope=\"col\">Manual</th><th "
                "scope=\"col\">Best found</th><th scope=\"col\">Gain</th><th scope=\"col\" class=\"text\">With"
                "</th></tr></thead>\n<tbody>\n",
                page->costly ? "price" : "water");
    for (int k = 0; k < 2; ++k)
        for (size_t i = 0; i < page->result->design_count; ++i) {
            sp_page_point same_price, same_area;
            if (page->alternatives ? !page->result->designs[i].alternative : i != page->main)
                continue;
            sp_page_best_points(page, i, sp_page_price(page, manual), manual->covered_area, &same_price, &same_area);
            add_head(page, text, i, heads[page->costly][k]);
            if (k)
                add_same_area(text, sp_page_price(page, manual), &same_area, page->figures[i].clean_area);
            else
                add_same_price(page, text, manual->coverage, &same_price, page->figures[i].clean_area);
        }
    sp_text_add(text, "</tbody></table></div>%s</section>\n",
                page->costly ? "<p class=\"note\">The price is water and what the mounts of the nozzles cost. The "
                               "engineer&#39;s nozzles that are kept, or on no mount, cost nothing but "
                               "their water.</p>"
                             : "");
}
