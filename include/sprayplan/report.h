/* The report: pictures, model and page that a customer is handed. */
#ifndef SPRAYPLAN_REPORT_H
#define SPRAYPLAN_REPORT_H

#include <sprayplan/result.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Writes the design's coverage on the atlas pages as one PNG, its deposits as multi-part EXR (channels of DESIGN §4, a
 * part for each page and side), its false-colour model as GLB. */
bool sp_report_coverage_png(const sp_design *design, const char *path, sp_error *error);
bool sp_report_deposits_exr(const sp_design *design, const char *path, sp_error *error);
bool sp_report_model_glb(const sp_design *design, const char *path, sp_error *error);
/* The self-contained page as HTML text (pictures inside it). Malloc'd, the caller frees. */
char *sp_report_html(const sp_result *result, sp_error *error);
/* Everything that DESIGN §4 lists, except layout.yaml, into `output`: result.json, report.html, nozzles.csv, and
 * pictures and model for each design with the suffixes -manual and -greedy where it is not the main one. */
bool sp_report_write(const sp_result *result, sp_output *output, sp_error *error);

/* Writes a picture of what is wet as PNG: blue what is cleaned and counted, orange the wet sides of obstacles, grey
 * what is dry; from the front, from behind and from above, cut open at the middle (upper row) and whole. */
bool sp_report_wet_png(const sp_evaluator *evaluator, const char *path, sp_error *error);

/* A picture of the charts of one page, one colour a chart, malloc'd RGB of page_edge² pixels. */
uint8_t *sp_report_charts(const sp_atlas *atlas, size_t page, sp_error *error);

#ifdef __cplusplus
}
#endif
#endif
