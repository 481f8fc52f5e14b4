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
    size_t manual, greedy;
    bool of_attainable; /* fractions are of the attainable area, else of the surface to be cleaned */
    sp_flux_scale scale;
} sp_page;

/* The fraction that the page speaks of. */
double sp_page_fraction(const sp_page *page, const sp_figures *figures);
/* A design's name for readers, escaped. */
void sp_page_name(const sp_page *page, sp_text *text, size_t design);
/* Colour of a design in charts, "#rrggbb". */
const char *sp_page_colour(const sp_page *page, size_t design);

/* headline.c: the statement, the key figures and what must not be overlooked. */
void sp_page_headline(const sp_page *page, sp_text *text);
/* comparison.c: at equal water and at equal coverage, as a sentence and as a table; nothing where there is nothing to
 * compare. */
void sp_page_gain(const sp_page *page, sp_text *text);
void sp_page_comparison(const sp_page *page, sp_text *text);
/* front_chart.c: coverage against water, SVG. */
void sp_page_front_chart(const sp_page *page, sp_text *text);
/* nozzle_counts.c: coverage against number of nozzles; nothing without a front. */
void sp_page_nozzle_counts(const sp_page *page, sp_text *text);
/* certificate.c: what is proved about how good any layout could be; nothing where nothing is. */
void sp_page_certificate(const sp_page *page, sp_text *text);
/* pictures.c: three views of every design, with the colour bar. */
bool sp_page_pictures(const sp_page *page, sp_text *text, sp_error *error);
/* tables.c */
void sp_page_figures(const sp_page *page, sp_text *text);
void sp_page_nozzles(const sp_page *page, sp_text *text);
void sp_page_shadows(const sp_page *page, sp_text *text);
void sp_page_stages(const sp_page *page, sp_text *text);
/* assumptions.c: attainable area, physics, fidelity, criteria, liquid. */
void sp_page_attainable(const sp_page *page, sp_text *text);
void sp_page_assumptions(const sp_page *page, sp_text *text);

#endif
