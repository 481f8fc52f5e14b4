/* What no allowed nozzle reaches, and why: said before any layout is praised or blamed for it. */
#include "page.h"

#define PARTS_SHOWN 12
#define PARTS_NAMED 3
#define NEGLIGIBLE 1e-6 /* share of the surface to be cleaned */

static const char *const explanations[SP_REASONS] = {
    [SP_REASON_UNKNOWN] = "the search was stopped before it was looked into",
    [SP_REASON_NO_LINE] =
        "nothing that leaves a mounting point in an allowed direction arrives at the point that a patch is judged by",
    [SP_REASON_REFLECTION] = "only liquid that a wall throws back arrives",
    [SP_REASON_SLOW] = "what arrives is slower than the criterion asks",
    [SP_REASON_SLANTED] = "what arrives fast enough is more slanted than the criterion allows",
    [SP_REASON_FLUX] = "what arrives so is too little, within the limits of number and water",
};

/* Areas in the unit that suits all that is missing. */
typedef struct {
    double per_m2;
    int decimals;
    const char *name;
} area_unit;

static area_unit unit_for(double missing)
{
    return missing < 0.1 ? (area_unit){1e4, sp_told_decimals(1e4 * missing, 1, 2), "cm\xc2\xb2"}
                         : (area_unit){1, 4, "m\xc2\xb2"};
}

/* The figures that speak of it; NULL where it is not known. */
static const sp_figures *known(const sp_page *page)
{
    const sp_figures *figures = page->main == SP_UNKNOWN ? NULL : &page->figures[page->main];
    return figures && isfinite(figures->attainable_area) ? figures : NULL;
}

static double missing_area(const sp_figures *figures)
{
    return fmax(figures->clean_area - figures->attainable_area, 0);
}

static const char *reason_text(const sp_figures *figures, sp_reason reason)
{
    return reason == SP_REASON_UNKNOWN ? "not looked into" : sp_reason_text(figures, reason);
}

static const char *explanation(const sp_figures *figures, sp_reason reason)
{
    if (reason == SP_REASON_FLUX && sp_figures_ask_no_amount(figures))
        return "what would arrive so takes more nozzles or water than is allowed";
    return explanations[reason];
}

/* Reasons that have area, largest first; returns how many. */
static size_t rank_reasons(const sp_figures *figures, sp_reason ranked[SP_REASONS])
{
    const double *areas = figures->missing_area;
    size_t count = 0;
    for (sp_reason reason = 0; reason < SP_REASONS; reason++) {
        if (!reason_text(figures, reason) || !(areas[reason] > 0))
            continue;
        size_t at = count++;
        for (; at > 0 && areas[reason] > areas[ranked[at - 1]]; at--)
            ranked[at] = ranked[at - 1];
        ranked[at] = reason;
    }
    return count;
}

/* Some of what is missing, which has a digit however small it is. */
static void add_area(sp_text *text, const area_unit *unit, double area)
{
    sp_markup_decimals(text, unit->per_m2 * area, sp_told_decimals(unit->per_m2 * area, unit->decimals, 1));
}

/* Area, reason, the parts that it is most of, and how many more there are. */
static void add_reason(sp_text *text, const sp_figures *figures, const area_unit *unit, sp_reason reason)
{
    size_t last = SP_UNKNOWN, part;
    add_area(text, unit, figures->missing_area[reason]);
    sp_text_add(text, "&nbsp;%s %s", unit->name, reason_text(figures, reason));
    for (int i = 0; i < PARTS_NAMED && (part = sp_missing_next(figures, reason, last)) != SP_UNKNOWN; i++) {
        sp_text_add(text, i ? ", " : " (");
        sp_markup_escape(text, figures->missing[part].part);
        sp_text_add(text, "&nbsp;");
        add_area(text, unit, figures->missing[part].areas[reason]);
        last = part;
    }
    double area;
    size_t others = sp_missing_after(figures, reason, last, &area);
    if (others) {
        sp_text_add(text, ", %zu other part%s&nbsp;", others, others == 1 ? "" : "s");
        add_area(text, unit, area);
    }
    sp_text_add(text, figures->missing_count ? ")" : "");
}

/* Nozzles that the proposal was chosen from. */
static void add_allowed(const sp_page *page, sp_text *text)
{
    sp_text_add(text, "allowed nozzle");
    if (!page->alternatives)
        return;
    sp_text_add(text, " of the alternative ");
    sp_markup_escape(text, page->figures[page->main].name);
}

const char *sp_page_looked(const sp_page *page, size_t design)
{
    const sp_proposal *proposal = design == SP_UNKNOWN ? NULL : sp_result_proposal(page->result, design);
    return proposal && proposal->attainable_hurried ? ", as far as the time allowed to look" : "";
}

/* What counts as attainable for the engineer's nozzles alone, which the search had not to choose from. */
static void add_beyond(const sp_page *page, const sp_figures *figures, sp_text *text)
{
    double percent = 100 * figures->beyond_area / figures->clean_area;
    if (!(figures->beyond_area > SP_BEYOND_TOLD * figures->clean_area))
        return;
    sp_text_add(text, "<p id=\"beyond\" class=\"warning\"><strong>");
    sp_markup_decimals(text, percent, 1);
    sp_text_add(text,
                "&nbsp;%% of the surface to be cleaned is reached by the engineer&#39;s own nozzles alone</strong>, "
                "and by no ");
    add_allowed(page, text);
    const char *looked = sp_page_looked(page, page->main);
    sp_text_add(text, "%s: it counts as attainable%s.</p>\n", looked,
                looked[0] ? "" : ", and no proposal can cover it");
}

void sp_page_out_of_reach(const sp_page *page, sp_text *text)
{
    const sp_figures *figures = known(page);
    if (figures)
        add_beyond(page, figures, text);
    double missing = figures ? missing_area(figures) : 0;
    if (!figures || !(missing > NEGLIGIBLE * figures->clean_area))
        return;
    const sp_proposal *proposal = page->result->proposal;
    area_unit unit = unit_for(missing);
    sp_reason ranked[SP_REASONS];
    size_t count = rank_reasons(figures, ranked);
    sp_text_add(text, "<p id=\"out-of-reach\" class=\"%s\"><strong>",
                proposal && figures->attainable_area < proposal->asked_area ? "warning" : "note");
    double percent = 100 * missing / figures->clean_area;
    sp_markup_decimals(text, percent, percent < 1 ? 3 : 1);
    sp_text_add(text, "&nbsp;%% of the surface to be cleaned is out of reach</strong> of every ");
    add_allowed(page, text);
    sp_text_add(text, "%s%s: ", sp_page_looked(page, page->main),
                figures->missing_area[SP_REASON_UNKNOWN] > 0 ? ", or was not looked into" : "");
    for (size_t i = 0; i < count; i++) {
        sp_text_add(text, i ? "; " : "");
        add_reason(text, figures, &unit, ranked[i]);
    }
    sp_text_add(text, ". <a href=\"#attainable\">All parts</a>.</p>\n");
}

static void add_row(sp_text *text, const area_unit *unit, const sp_missing_figures *row, const sp_reason *ranked,
                    size_t count)
{
    sp_text_add(text, "<tr><th scope=\"row\">");
    sp_markup_escape(text, row->part);
    sp_text_add(text, "</th>");
    for (size_t i = 0; i < count; i++) {
        sp_text_add(text, "<td>");
        sp_markup_decimals(text, unit->per_m2 * row->areas[ranked[i]], unit->decimals);
        sp_text_add(text, "</td>");
    }
    sp_text_add(text, "<td>");
    sp_markup_decimals(text, unit->per_m2 * row->area, unit->decimals);
    sp_text_add(text, "</td></tr>\n");
}

/* The parts that miss most, all the others together, and the sum. */
static void add_rows(sp_text *text, const sp_figures *figures, const area_unit *unit, const sp_reason *ranked,
                     size_t count)
{
    sp_missing_figures others = {.part = "all other parts"}, all = {.part = "together"};
    for (size_t i = 0; i < figures->missing_count; i++) {
        const sp_missing_figures *row = &figures->missing[i];
        if (i < PARTS_SHOWN)
            add_row(text, unit, row, ranked, count);
        for (sp_reason reason = 0; reason < SP_REASONS; reason++) {
            others.areas[reason] += i < PARTS_SHOWN ? 0 : row->areas[reason];
            all.areas[reason] += row->areas[reason];
        }
        others.area += i < PARTS_SHOWN ? 0 : row->area;
        all.area += row->area;
    }
    if (others.area > 0)
        add_row(text, unit, &others, ranked, count);
    if (figures->missing_count > 1)
        add_row(text, unit, &all, ranked, count);
}

static void add_table(sp_text *text, const sp_figures *figures)
{
    sp_reason ranked[SP_REASONS];
    size_t count = rank_reasons(figures, ranked);
    area_unit unit = unit_for(missing_area(figures));
    sp_text_add(text, "<ul id=\"reasons\">\n");
    for (size_t i = 0; i < count; i++) {
        sp_text_add(text, "<li>");
        sp_markup_decimals(text, unit.per_m2 * figures->missing_area[ranked[i]], unit.decimals);
        sp_text_add(text, "&nbsp;%s %s: %s.</li>\n", unit.name, reason_text(figures, ranked[i]),
                    explanation(figures, ranked[i]));
    }
    sp_text_add(text,
                "</ul>\n<div class=\"wide\"><table class=\"numbers small narrow\"><caption>Out of reach, %s</caption>\n"
                "<thead><tr><th scope=\"col\">Part</th>",
                unit.name);
    for (size_t i = 0; i < count; i++)
        sp_text_add(text, "<th scope=\"col\">%s</th>", reason_text(figures, ranked[i]));
    sp_text_add(text, "<th scope=\"col\">all</th></tr></thead>\n<tbody>\n");
    add_rows(text, figures, &unit, ranked, count);
    sp_text_add(text, "</tbody></table></div>\n");
}

/* What more nozzles or water might reach is no fault of anything; m². */
static double add_limited(const sp_page *page, sp_text *text, const sp_figures *figures)
{
    const sp_proposal *proposal = sp_result_proposal(page->result, page->main);
    double limited = figures->missing_area[SP_REASON_FLUX];
    bool no_amount = sp_figures_ask_no_amount(figures);
    char limits[SP_LIMITS_TEXT] = "";
    if (proposal)
        sp_limits_clause(proposal, limits);
    if (!limits[0] || !(limited > NEGLIGIBLE * figures->clean_area))
        return 0;
    area_unit unit = unit_for(missing_area(figures));
    sp_text_add(text, " <strong>");
    sp_markup_decimals(text, unit.per_m2 * limited, unit.decimals);
    sp_text_add(text,
                "&nbsp;%s may be out of reach for the limits alone</strong>: liquid %s there as fast and as steep as "
                "the criterion asks, but %s with no more than %s. More than that may reach it.",
                unit.name, no_amount ? "would get" : "gets", no_amount ? "does not" : "too little of it", limits);
    return limited;
}

static void add_fault(const sp_page *page, sp_text *text, bool all)
{
    sp_text_add(text,
                " What %sis out of reach of every allowed nozzle at the mounting points looked at is a fault of the "
                "%s or of the mounts allowed, which no choice among them mends: another port, another type of "
                "nozzle, a change of the part or mounting points closer together would.",
                all ? "" : "else ", sp_page_cleaned(page));
}

/* Of alternatives each counts what its own layout covers, not what the others' do. */
static const char *covering_layouts(const sp_page *page)
{
    if (!page->alternatives)
        return "a layout of this report";
    return page->manual == SP_UNKNOWN ? "its layout" : "its layout or the engineer&#39;s own";
}

void sp_page_attainable(const sp_page *page, sp_text *text)
{
    const sp_figures *figures = known(page);
    if (!figures)
        return;
    double missing = missing_area(figures);
    sp_text_add(text, "<section id=\"attainable\"><h2>What can be reached at all</h2>\n<p>Of ");
    sp_markup_significant(text, figures->clean_area, 4);
    sp_text_add(text, "&nbsp;m\xc2\xb2 to be cleaned, ");
    sp_markup_significant(text, figures->attainable_area, 4);
    sp_text_add(text, "&nbsp;m\xc2\xb2 (");
    sp_markup_decimals(text, 100 * figures->attainable_area / figures->clean_area, 1);
    sp_text_add(text, "&nbsp;%%) are attainable%s: some ", sp_page_looked(page, page->main));
    add_allowed(page, text);
    sp_text_add(text,
                ", at a mounting point looked at and aimed in any way that its mount and type allow, not only as the "
                "candidate poses are, %s, each patch judged at one point; or %s covers them, half of a patch at least.",
                sp_result_counts_thrown_back(page->result)
                    ? "gets liquid to them, thrown back by walls or not, as much as the criterion asks or less"
                    : "reaches them as the criterion asks",
                covering_layouts(page));
    double limited = add_limited(page, text, figures);
    if (missing - limited > NEGLIGIBLE * figures->clean_area && !sp_page_looked(page, page->main)[0])
        add_fault(page, text, !limited);
    sp_text_add(text, "</p>\n");
    if (missing > NEGLIGIBLE * figures->clean_area)
        add_table(text, figures);
    sp_text_add(text, "</section>\n");
}
