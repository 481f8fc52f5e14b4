/* The study's page, section by section. */
#ifndef STUDY_PAGE_H
#define STUDY_PAGE_H

#include "words.h"

/* findings.c: what lines, texels, jets and reflections come to, in sentences. */
void sp_study_findings(sp_text *text, const sp_study *study);
/* run_plots.c: error and misjudged area against seconds, texel and jets. */
void sp_study_run_plots(sp_text *text, const sp_study *study);
/* run_tables.c: every run, and the orders. */
void sp_study_run_tables(sp_text *text, const sp_study *study);
/* place_page.c: water and coverage of the placements, as plots and as a table. */
void sp_study_place_page(sp_text *text, const sp_study *study);

#endif
