/* The report's page, section by section. */
#ifndef REPORT_PAGE_H
#define REPORT_PAGE_H

#include "false_colour.h"
#include "markup.h"

#include <sprayplan/report.h>

/* What every section sees. Roles that no design has are SP_UNKNOWN. */
typedef struct {
    const sp_result *result;
    const sp_figures *figures; /* [result->design_count] */
    size_t main;               /* what is proposed, or the only design */
    bool alternatives;         /* designs with an `alternative` are what it was chosen from */
    bool costly;               /* prices are told: layouts are held against each other by price, not by water */
    size_t manual, greedy;
    sp_colour_scale scale; /* of the pictures */
    sp_colour_scale flux;  /* as they have it where no scene asks for another */
    bool live;             /* it evaluates other layouts itself */
    size_t most_drawn;     /* triangles in all pictures that can be turned: of more the pictures are coarser */
} sp_page;

#define SP_PAGE_MOST_DRAWN 2500000 /* about 19 MB; two million triangles, a quarter of them wet on both sides */
/* html.c: sp_report_html, which draws SP_PAGE_MOST_DRAWN triangles at most. */
char *sp_page_html(const sp_result *result, size_t most_drawn, sp_error *error);

/* html.c: all before the page's first heading: title (ours, not escaped), style, the beginning of <main>. */
void sp_page_head(sp_text *text, const char *title, const char *scene, bool live);
/* A design's name for readers, as plain text. */
void sp_page_plain_name(const sp_page *page, sp_text *text, size_t design);
/* The same, escaped. */
void sp_page_name(const sp_page *page, sp_text *text, size_t design);
/* The same for a narrow column: paths may break after each folder. */
void sp_page_narrow_name(const sp_page *page, sp_text *text, size_t design);
/* html.c: what its cells have of attributes: narrow screens leave a layout before refinement out. */
const char *sp_page_aside(const sp_page *page, size_t design);
/* The same of tables with one column for each design: the main one's stays in sight where the table scrolls. */
const char *sp_page_column(const sp_page *page, size_t design);
/* html.c: the end of the designs that, from `first` on, have columns in one table: all of few, else some, so that the
 * next table goes on with it. */
size_t sp_page_fold(const sp_page *page, size_t first);
/* html.c: a heading of a column for each of these designs. */
void sp_page_columns(const sp_page *page, sp_text *text, size_t first, size_t end);
/* html.c: the coverage of the surface to be cleaned and by how much it may be off, "98.3 % ± 0.2", rounded upwards. */
void sp_page_coverage(sp_text *text, const sp_figures *figures);
/* The last of that; nothing where it was not measured. */
void sp_page_error(sp_text *text, const sp_figures *figures);
/* html.c: " (exchange, front)" of a search that was cut short there; nothing where it was not. */
void sp_page_cut(sp_text *text, const sp_proposal *proposal);
/* html.c: what the page calls what is cleaned: a vessel from within, a machine from outside, goods that move; "surface"
 * where that is not known. */
const char *sp_page_cleaned(const sp_page *page);
/* Colour of a design in charts, "#rrggbb". */
const char *sp_page_colour(const sp_page *page, size_t design);

/* attainable.c: what no allowed nozzle reaches, in a sentence; by reason and part, as a table. Nothing where it is not
 * known. */
void sp_page_out_of_reach(const sp_page *page, sp_text *text);
/* attainable.c: ", as far as the time allowed to look" of what speaks of a design and was found in a hurry; else "". */
const char *sp_page_looked(const sp_page *page, size_t design);
void sp_page_attainable(const sp_page *page, sp_text *text);
/* headline.c: the statement, the key figures and what must not be overlooked. */
void sp_page_headline(const sp_page *page, sp_text *text);
/* alternatives.c: which is proposed, and why, as the beginning of a sentence; what each gives against the first of
 * them, and what each nozzle that wants a fitting buys. Nothing without alternatives. */
void sp_page_choice(const sp_page *page, sp_text *text);
void sp_page_alternatives(const sp_page *page, sp_text *text);
/* What a layout takes, m³/s: its water, and where the page tells prices its mounts, as the outlay of a point. */
double sp_page_price(const sp_page *page, const sp_figures *figures);
/* Most area for no higher price than `price` (m³/s), lowest price that covers no less than `area` (m²), of what was
 * reported and of the front of the proposal that speaks of a design. Nothing found: area -1, price INFINITY. */
typedef struct {
    double price, area;
    size_t nozzles, fittings;
} sp_page_point;
void sp_page_best_points(const sp_page *page, size_t design, double price, double area, sp_page_point *same_price,
                         sp_page_point *same_area);
/* comparison.c: at equal price (water, where nothing else costs) and at equal coverage, as a sentence and as a table;
 * nothing where there is nothing to compare. */
void sp_page_gain(const sp_page *page, sp_text *text);
void sp_page_comparison(const sp_page *page, sp_text *text);
/* liquid.c: where it ends; nothing where that was not counted. */
void sp_page_liquid(const sp_page *page, sp_text *text);
/* film.c: what runs down the walls; nothing where no criterion asks for film. */
void sp_page_film(const sp_page *page, sp_text *text);
/* tracks.c: how far the surface is from the tracks of two-axis heads; nothing where there are none. */
void sp_page_tracks(const sp_page *page, sp_text *text);
/* parts.c: coverage of each part, the least covered first. */
void sp_page_parts(const sp_page *page, sp_text *text);
/* contributions.c: what each nozzle does alone, and what is lost without it; nothing where that is not known. */
void sp_page_contributions(const sp_page *page, sp_text *text);
/* Where mounts cost something, two more columns beside a nozzle's lost area: what its mount costs, and what is lost
 * per water and cost. */
extern const char sp_page_cost_heads[];
void sp_page_cost_cells(sp_text *text, const sp_nozzle_figures *nozzle, double whole);
/* front_chart.c: coverage against water, SVG. */
void sp_page_front_chart(const sp_page *page, sp_text *text);
/* nozzle_counts.c: coverage against number of nozzles; nothing without a front. */
void sp_page_nozzle_counts(const sp_page *page, sp_text *text);
/* certificate.c: what is proved about how good any layout could be; nothing where nothing is; and whether any is. */
void sp_page_certificate(const sp_page *page, sp_text *text);
bool sp_page_proves(const sp_page *page);
/* colour_bar.c: what the pictures' colours mean, as a drawing. */
void sp_page_colour_bar(const sp_page *page, sp_text *text);
/* pictures.c: three views of every design, with the colour bar. */
bool sp_page_pictures(const sp_page *page, sp_text *text, sp_error *error);
/* viewer/section.c: the surface to be turned and asked, its data, its script at the page's end. */
bool sp_page_viewer(const sp_page *page, sp_text *text, sp_error *error);
void sp_page_viewer_script(const sp_page *page, sp_text *text);
#define SP_PAGE_SHADOWS 10 /* largest ones that are listed */
/* differing.c: what designs side by side do not have in common besides their nozzles; nothing where they do. */
void sp_page_differing(const sp_page *page, sp_text *text);
/* same_layouts.c: which designs are the same nozzles, counted by several runs; nothing where none are. */
void sp_page_same_layouts(const sp_page *page, sp_text *text);
/* tables.c */
void sp_page_figures(const sp_page *page, sp_text *text);
void sp_page_nozzles(const sp_page *page, sp_text *text);
void sp_page_shadows(const sp_page *page, sp_text *text);
void sp_page_stages(const sp_page *page, sp_text *text);
/* spread.c: how liquid leaves the nozzles of the designs on an evaluator, within a sentence. */
void sp_page_spread(sp_text *text, const sp_result *result, const sp_evaluator *evaluator);
/* Whether a nozzle before this one, of the designs on the evaluator, is of its type too; its design is one of them. */
bool sp_page_type_repeats(const sp_result *result, const sp_evaluator *evaluator, size_t design, size_t nozzle);
/* sheet.c: what to weld, set and order of each design, the main one first. */
bool sp_page_sheets(const sp_page *page, sp_text *text, sp_error *error);
/* The id of a design's sheet. */
void sp_page_sheet_id(const sp_page *page, sp_text *text, size_t design);
/* swabs.c: the worst places of the main design; nothing where it has no evaluator. */
bool sp_page_swabs(const sp_page *page, sp_text *text, sp_error *error);
/* inputs.c: the files that were read, where they are told; version, date and command. */
void sp_page_inputs(const sp_page *page, sp_text *text);
void sp_page_foot(const sp_page *page, sp_text *text);
/* assumptions.c: physics, fidelity, criteria, liquid. */
void sp_page_assumptions(const sp_page *page, sp_text *text);

#endif
