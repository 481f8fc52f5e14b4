/* The report's tables. */
#include "page.h"

#include <string.h>

#define L_MIN 6e4 /* L/min per m³/s, and L/min/m² per m/s */
#define L 1e3     /* L/m² per m³/m² */
#define MANY 10.0 /* times as much and more is said so, not in per cent */

typedef double measure(const sp_figures *figures);

static double of_clean(const sp_figures *f)
{
    return 100 * f->coverage;
}
static double of_attainable(const sp_figures *f)
{
    return 100 * f->of_attainable;
}
static double covered(const sp_figures *f)
{
    return f->covered_area;
}
static double uncovered(const sp_figures *f)
{
    return f->clean_area - f->covered_area;
}
static double water(const sp_figures *f)
{
    return L_MIN * f->flow;
}
static double ratio(const sp_figures *f)
{
    return f->area_per_water / L_MIN;
}
static double mounts(const sp_figures *f)
{
    return L_MIN * f->mount_cost;
}
static double price(const sp_figures *f)
{
    return L_MIN * sp_figures_price(f);
}
static double per_price(const sp_figures *f)
{
    return f->covered_area / price(f);
}
static double nozzles(const sp_figures *f)
{
    return (double)f->nozzle_count;
}
static double fittings(const sp_figures *f)
{
    return f->fittings == SP_UNKNOWN ? NAN : (double)f->fittings;
}
static double flux_mean(const sp_figures *f)
{
    return L_MIN * f->flux_mean;
}
static double flux_p05(const sp_figures *f)
{
    return L_MIN * f->flux_p05;
}
static double flux_max(const sp_figures *f)
{
    return L_MIN * f->flux_max;
}
static double dose_mean(const sp_figures *f)
{
    return L * f->pass * f->flux_mean;
}
static double dose_p05(const sp_figures *f)
{
    return L * f->pass * f->flux_p05;
}
static double dose_max(const sp_figures *f)
{
    return L * f->pass * f->flux_max;
}
static double largest(const sp_figures *f)
{
    return !f->shadows_known ? NAN : f->shadow_count ? f->shadows[0].area : 0;
}

typedef struct {
    const char *title, *unit;
    measure *value;
    enum {
        DECIMALS,
        SIGNIFICANT,
        WATER
    } format;    /* percentages and counts with decimals, most with significant digits */
    int digits;  /* of the first two */
    bool points; /* differences in percentage points */
} row;

static const row rows[] = {
    {"Coverage of the surface to be cleaned", "%", of_clean, DECIMALS, 1, true},
    {"Share of the attainable area covered", "%", of_attainable, DECIMALS, 1, true},
    {"Covered area", "m\xc2\xb2", covered, SIGNIFICANT, 4, false},
    {"Area left uncovered", "m\xc2\xb2", uncovered, SIGNIFICANT, 3, false},
    {"Largest uncovered region", "m\xc2\xb2", largest, SIGNIFICANT, 3, false},
    {"Water", "L/min", water, WATER, 0, false},
    {"Covered area per water", "m\xc2\xb2 per L/min", ratio, SIGNIFICANT, 3, false},
    {"Cost of mounts", "L/min", mounts, WATER, 0, false},
    {"Price: water and mounts", "L/min", price, WATER, 0, false},
    {"Price: water and mounts", "", sp_figures_money, SIGNIFICANT, 4, false},
    {"Covered area per price", "m\xc2\xb2 per L/min", per_price, SIGNIFICANT, 3, false},
    {"Nozzles", "", nozzles, DECIMALS, 0, false},
    {"New fittings", "", fittings, DECIMALS, 0, false},
    {"Liquid flux, mean", "L/min per m\xc2\xb2", flux_mean, SIGNIFICANT, 3, false},
    {"Liquid flux, 5th percentile", "L/min per m\xc2\xb2", flux_p05, SIGNIFICANT, 3, false},
    {"Liquid flux, highest", "L/min per m\xc2\xb2", flux_max, SIGNIFICANT, 3, false},
    {"Dose, mean", "L/m\xc2\xb2", dose_mean, SIGNIFICANT, 3, false},
    {"Dose, 5th percentile", "L/m\xc2\xb2", dose_p05, SIGNIFICANT, 3, false},
    {"Dose, highest", "L/m\xc2\xb2", dose_max, SIGNIFICANT, 3, false},
};

static void add_value(const sp_page *page, sp_text *text, const row *r, size_t design)
{
    const sp_figures *figures = &page->figures[design];
    sp_text_add(text, "<td%s>", sp_page_column(page, design));
    if (r->format == WATER)
        sp_markup_water(text, r->value(figures));
    else if (r->format == DECIMALS)
        sp_markup_decimals(text, r->value(figures), r->digits);
    else
        sp_markup_significant(text, r->value(figures), r->digits);
    if (r->value == sp_figures_money && isfinite(r->value(figures)))
        sp_text_add(text, "&nbsp;%s", figures->water_cost.currency);
    if (r->value == of_clean)
        sp_page_error(text, figures);
    sp_text_add(text, "</td>");
}

static void add_difference(sp_text *text, const row *r, double from, double to)
{
    sp_text_add(text, "<td>");
    if (!isfinite(from) || !isfinite(to) || (!r->points && !(from > 0))) {
        sp_markup_decimals(text, NAN, 0);
    } else if (!r->points && to >= MANY * from) {
        sp_text_add(text, "&times;&thinsp;");
        sp_markup_significant(text, to / from, 3);
    } else {
        sp_markup_signed(text, r->points ? to - from : 100 * (to / from - 1), r->points ? 1 : 0);
        sp_text_add(text, r->points ? "&nbsp;points" : "&nbsp;%%");
    }
    sp_text_add(text, "</td>");
}

/* The proposal is held against the manual layout in a column of its own. */
static bool shows_difference(const sp_page *page)
{
    return page->main != SP_UNKNOWN && page->manual != SP_UNKNOWN && page->main != page->manual;
}

/* Of the designs from `first` to `end`. */
static void add_row(const sp_page *page, sp_text *text, size_t first, size_t end, const row *r)
{
    bool known = false;
    for (size_t i = first; i < end; ++i)
        known |= isfinite(r->value(&page->figures[i]));
    if (!known)
        return;
    sp_text_add(text, "<tr><th scope=\"row\">%s%s%s%s</th>", r->title, r->unit[0] ? " <span class=\"unit\">" : "",
                r->unit, r->unit[0] ? "</span>" : "");
    for (size_t i = first; i < end; ++i)
        add_value(page, text, r, i);
    if (shows_difference(page) && end == page->result->design_count)
        add_difference(text, r, r->value(&page->figures[page->manual]), r->value(&page->figures[page->main]));
    sp_text_add(text, "</tr>\n");
}

static void add_figures(const sp_page *page, sp_text *text, size_t first, size_t end)
{
    sp_text_add(text, "<div class=\"wide\"><table class=\"numbers\">\n<thead><tr><th scope=\"col\">Measure</th>");
    sp_page_columns(page, text, first, end);
    if (shows_difference(page) && end == page->result->design_count)
        sp_text_add(text, "<th scope=\"col\">Proposed against manual</th>");
    sp_text_add(text, "</tr></thead>\n<tbody>\n");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i)
        add_row(page, text, first, end, &rows[i]);
    sp_text_add(text, "</tbody></table></div>");
}

void sp_page_figures(const sp_page *page, sp_text *text)
{
    sp_text_add(text, "<section id=\"figures\"><h2>Figures</h2>\n");
    for (size_t first = 0; first < page->result->design_count; first = sp_page_fold(page, first))
        add_figures(page, text, first, sp_page_fold(page, first));
    sp_page_same_layouts(page, text);
    sp_text_add(text, "</section>\n");
}

static void add_numbers(sp_text *text, const double *values, const int *decimals, size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        sp_text_add(text, "<td>");
        sp_markup_decimals(text, values[i], decimals[i]);
        sp_text_add(text, "</td>");
    }
}

static void add_text_cell(sp_text *text, const char *tag, const char *value)
{
    sp_text_add(text, "<%s>", tag);
    sp_markup_escape(text, value);
    sp_text_add(text, "</%.2s>", tag);
}

/* The type's name, which leads to its page where that is known. */
static void add_type(sp_text *text, const sp_nozzle_figures *n)
{
    sp_text_add(text, "<td class=\"text\">");
    if (n->url[0]) {
        sp_text_add(text, "<a href=\"");
        sp_markup_escape(text, n->url);
        sp_text_add(text, "\" rel=\"noopener noreferrer\">");
    }
    sp_markup_escape(text, n->type);
    sp_text_add(text, "%s</td>", n->url[0] ? "</a>" : "");
}

static void add_nozzle(sp_text *text, const sp_figures *figures, const sp_nozzle_figures *n, bool codes)
{
    const double deg = 180 / M_PI;
    const double values[] = {n->position.x, n->position.y,  n->position.z,     n->axis.x,       n->axis.y, n->axis.z,
                             n->roll * deg, n->angle * deg, n->pressure / 1e5, n->flow * L_MIN, n->speed};
    const int place = sp_place_decimals(figures, 3);
    const int decimals[] = {place, place, place, 3, 3, 3, 1, 1, 2, sp_told_decimals(L_MIN * n->flow, 2, 3), 1};
    sp_text_add(text, "<tr>");
    add_text_cell(text, "th scope=\"row\"", n->name);
    add_type(text, n);
    if (codes)
        add_text_cell(text, "td class=\"text\"", n->order_code);
    add_numbers(text, values, decimals, sizeof values / sizeof *values);
    sp_text_add(text, "</tr>\n");
}

static bool has_codes(const sp_figures *figures)
{
    bool any = false;
    for (size_t k = 0; k < figures->nozzle_count; ++k)
        any |= figures->nozzles[k].order_code[0] != 0;
    return any;
}

/* What cannot be built as it is. */
static void add_overlaps(sp_text *text, const sp_figures *figures)
{
    size_t listed = 0;
    for (size_t i = 0; i < figures->nozzle_count; ++i) {
        if (!figures->nozzles[i].overlap[0])
            continue;
        sp_text_add(text, listed++ ? "; " : "<p class=\"warning\">");
        sp_markup_escape(text, figures->nozzles[i].overlap);
    }
    if (listed)
        sp_text_add(text, ".</p>\n");
}

void sp_page_nozzles(const sp_page *page, sp_text *text)
{
    sp_text_add(text, "<section id=\"nozzles\"><h2>Nozzles</h2>\n");
    for (size_t i = 0; i < page->result->design_count; ++i) {
        const sp_figures *figures = &page->figures[i];
        bool codes = has_codes(figures);
        sp_text_add(text, "<div class=\"wide\"><table class=\"numbers small\" data-design=\"%zu\"><caption>", i);
        sp_page_name(page, text, i);
        sp_text_add(text, ": %zu nozzle%s, ", figures->nozzle_count, figures->nozzle_count == 1 ? "" : "s");
        sp_markup_water(text, L_MIN * figures->flow);
        sp_text_add(
            text,
            "&nbsp;L/min</caption>\n<thead><tr><th scope=\"col\">Name</th><th scope=\"col\" "
            "class=\"text\">Type</th>%s<th scope=\"col\">x&nbsp;m</th><th scope=\"col\">y&nbsp;m</th><th "
            "scope=\"col\">z&nbsp;m</th><th scope=\"col\">axis&nbsp;x</th><th scope=\"col\">axis&nbsp;y</th><th "
            "scope=\"col\">axis&nbsp;z</th><th scope=\"col\">roll&nbsp;&deg;</th><th scope=\"col\">angle&nbsp;&deg;"
            "</th><th scope=\"col\">bar</th><th scope=\"col\">L/min</th><th scope=\"col\">m/s</th></tr></thead>\n"
            "<tbody>\n",
            codes ? "<th scope=\"col\" class=\"text\">Order code</th>" : "");
        for (size_t k = 0; k < figures->nozzle_count; ++k)
            add_nozzle(text, figures, &figures->nozzles[k], codes);
        sp_text_add(text, "</tbody></table></div>\n");
        add_overlaps(text, figures);
    }
    sp_text_add(text, "</section>\n");
}

/* Why it is dry, and who brings it most. */
static void add_lack(sp_text *text, const sp_shadow_figures *shadow)
{
    const char *lack = sp_lack_text(shadow->lack);
    sp_text_add(text, "<td class=\"text\">%s", lack ? lack : "\xe2\x80\x93");
    sp_text_add(text, "</td><td class=\"text\">");
    sp_markup_escape(text, shadow->nozzle[0] ? shadow->nozzle : "\xe2\x80\x93");
    sp_text_add(text, "</td>");
}

static bool any_remedy(const sp_figures *figures)
{
    return figures->shadow_count && figures->shadows[0].remedy.known;
}

/* What one more nozzle would do, and where it would sit. */
static void add_remedy(sp_text *text, const sp_figures *figures, const sp_shadow_figures *shadow)
{
    const sp_remedy_figures *remedy = &shadow->remedy;
    sp_text_add(text, "<td class=\"text\">");
    if (!remedy->known) {
        sp_text_add(text, "\xe2\x80\x93</td>");
        return;
    }
    if (!remedy->type[0] || !(remedy->area > 0)) {
        sp_text_add(text, "none</td>");
        return;
    }
    sp_markup_escape(text, remedy->type);
    if (remedy->port[0]) {
        sp_text_add(text, " in ");
        sp_markup_escape(text, remedy->port);
    }
    const double place[] = {remedy->position.x, remedy->position.y, remedy->position.z};
    for (int k = 0; k < 3; k++) {
        sp_text_add(text, k ? ", " : " at ");
        sp_markup_decimals(text, place[k], sp_place_decimals(figures, 2));
    }
    sp_text_add(text, "&nbsp;m: %.0f&nbsp;%% for %.3g&nbsp;L/min</td>", 100 * remedy->area / shadow->area,
                6e4 * remedy->flow);
}

static void add_shadow(sp_text *text, const sp_figures *figures, size_t index)
{
    const sp_shadow_figures *shadow = &figures->shadows[index];
    const double cm2 = 1e4 * shadow->area, share = 100 * shadow->area / figures->clean_area;
    const double values[] = {cm2, share, shadow->centroid.x, shadow->centroid.y, shadow->centroid.z};
    const int place = sp_place_decimals(figures, 2);
    /* as all of the surface is told, and a small region of a large one is more than nothing */
    const int decimals[] = {sp_told_decimals(cm2, sp_told_decimals(1e4 * figures->clean_area, 0, 4), 1),
                            sp_told_decimals(share, 2, 1), place, place, place};
    const char *reachable = shadow->reachable < 0 ? "\xe2\x80\x93" : shadow->reachable ? "yes" : "no";
    sp_text_add(text, "<tr><th scope=\"row\">%zu</th>", index + 1);
    add_text_cell(text, "td class=\"text\"", shadow->part);
    add_numbers(text, values, decimals, 5);
    add_lack(text, shadow);
    const char *reason = shadow->reachable == 0 ? sp_reason_text(figures, shadow->reason) : NULL;
    sp_text_add(text, "<td class=\"text\">%s%s%s</td>", reachable, reason ? ": " : "", reason ? reason : "");
    if (any_remedy(figures))
        add_remedy(text, figures, shadow);
    sp_text_add(text, "</tr>\n");
}

static void add_shadows(const sp_page *page, sp_text *text, size_t design)
{
    const sp_figures *figures = &page->figures[design];
    size_t shown = figures->shadow_count < SP_PAGE_SHADOWS ? figures->shadow_count : SP_PAGE_SHADOWS;
    sp_text_add(text, "<div class=\"wide\"><table class=\"numbers small\" data-design=\"%zu\"><caption>", design);
    sp_page_name(page, text, design);
    if (shown == 0) {
        sp_text_add(text, ": %s</caption></table></div>\n",
                    figures->shadows_known ? "no uncovered region" : "uncovered regions are not told");
        return;
    }
    if (shown == 1)
        sp_text_add(text, ": the largest uncovered region");
    else
        sp_text_add(text, ": the %zu largest uncovered regions", shown);
    sp_text_add(text,
                "</caption>\n<thead><tr><th scope=\"col\">No.</th><th scope=\"col\" "
                "class=\"text\">Part</th><th "
                "scope=\"col\">cm\xc2\xb2</th><th scope=\"col\">%% of the surface</th><th scope=\"col\">x&nbsp;m</th>"
                "<th scope=\"col\">y&nbsp;m</th><th scope=\"col\">z&nbsp;m</th><th scope=\"col\" class=\"text\">"
                "Lacks</th><th scope=\"col\" class=\"text\">Most from</th><th scope=\"col\" class=\"text\">"
                "Attainable</th>%s</tr></thead>\n<tbody>\n",
                any_remedy(figures) ? "<th scope=\"col\" class=\"text\">One more nozzle</th>" : "");
    for (size_t i = 0; i < shown; ++i)
        add_shadow(text, figures, i);
    sp_text_add(text, "</tbody></table></div>\n");
}

/* What of the columns some design's table has, or has no answers in. */
typedef struct {
    bool remedies; /* one more nozzle was looked for */
    bool no_most;  /* what each nozzle brings was not worked out */
} shadow_columns;

static shadow_columns columns_of(const sp_page *page)
{
    shadow_columns columns = {0};
    for (size_t i = 0; i < page->result->design_count; ++i) {
        const sp_figures *figures = &page->figures[i];
        columns.remedies |= any_remedy(figures);
        columns.no_most |= figures->shadow_count && figures->nozzle_count && !isfinite(figures->nozzles[0].lost);
    }
    return columns;
}

/* What the columns mean, of those that are there. */
static void add_shadow_notes(const sp_page *page, sp_text *text)
{
    shadow_columns columns = columns_of(page);
    sp_text_add(text, "<p>Connected regions that do not meet the criterion, with the middle of each, numbered as in "
                      "the pictures. What most of a region lacks: a nozzle of the layout in reach (nothing arrives "
                      "there), or what arrives is too slow, too slanted or too little. Most from: the nozzle that by "
                      "itself brings the region most liquid, and is nearest to mending it");
    if (columns.no_most)
        sp_text_add(text, "; a dash: none does, or what each nozzle brings was not worked out");
    sp_text_add(text,
                ". A region that is not attainable is out of reach of every allowed nozzle at the mounting points "
                "looked at, within the limits of number and water%s",
                sp_page_looked(page, page->main));
    if (!sp_page_looked(page, page->main)[0])
        sp_text_add(text, ": a matter of the %s, the mounts or these limits, not of the layout", sp_page_cleaned(page));
    sp_text_add(text, ". ");
    if (columns.remedies)
        sp_text_add(text, "One more nozzle: of the candidates looked at the one that, beside the layout's own, covers "
                          "most of the region, how much of it and for how much water, whatever number and water are "
                          "allowed. ");
    sp_text_add(text, "All that result.json lists are in that file.</p>\n");
}

void sp_page_shadows(const sp_page *page, sp_text *text)
{
    sp_text_add(text, "<section id=\"shadows\"><h2>Spray shadows</h2>\n");
    add_shadow_notes(page, text);
    for (size_t i = 0; i < page->result->design_count; ++i)
        add_shadows(page, text, i);
    sp_text_add(text, "</section>\n");
}

static void add_stage(sp_text *text, const sp_stage *stage)
{
    sp_text_add(text, "<tr>");
    add_text_cell(text, "th scope=\"row\"", stage->name);
    sp_text_add(text, "<td>%.1f</td></tr>\n", stage->seconds);
}

/* All stages of each alternative together. */
static void add_searches(const sp_page *page, sp_text *text)
{
    for (size_t i = 0; i < page->result->design_count; ++i) {
        const sp_proposal *alternative = page->result->designs[i].alternative;
        double seconds = 0;
        for (size_t k = 0; alternative && k < alternative->stage_count; ++k)
            seconds += alternative->stages[k].seconds;
        if (!alternative)
            continue;
        sp_text_add(text, "<tr><th scope=\"row\">search, ");
        sp_markup_escape(text, page->figures[i].name);
        sp_text_add(text, "</th><td>%.1f</td></tr>\n", seconds);
    }
}

/* What of all this was not carried out whole. */
static void add_left_out(const sp_page *page, sp_text *text)
{
    const sp_result *result = page->result;
    const sp_proposal *proposal = page->alternatives ? NULL : result->proposal;
    size_t cut = proposal ? proposal->cut_count : 0;
    for (size_t i = 0; i < cut + result->left_out_count; ++i) {
        sp_text_add(text, i ? ", " : "<p class=\"note\">Cut short or left out: ");
        sp_markup_escape(text, i < cut ? proposal->cut[i] : result->left_out[i - cut]);
    }
    if (cut + result->left_out_count > 0)
        sp_text_add(text, ".</p>\n");
}

void sp_page_stages(const sp_page *page, sp_text *text)
{
    const sp_result *result = page->result;
    if (result->stage_count == 0 && (!result->proposal || result->proposal->stage_count == 0))
        return;
    sp_text_add(text,
                "<section id=\"stages\"><h2>Computing time</h2>\n<table class=\"numbers small narrow\"><thead><tr><th "
                "scope=\"col\">Stage</th><th scope=\"col\">Seconds</th></tr></thead>\n<tbody>\n");
    for (size_t i = 0; i < result->stage_count; ++i)
        add_stage(text, &result->stages[i]);
    if (page->alternatives)
        add_searches(page, text);
    for (size_t i = 0; !page->alternatives && result->proposal && i < result->proposal->stage_count; ++i)
        add_stage(text, &result->proposal->stages[i]);
    sp_text_add(text, "</tbody></table>\n");
    add_left_out(page, text);
    sp_text_add(text, "</section>\n");
}
