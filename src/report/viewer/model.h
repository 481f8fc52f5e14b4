/* What the viewer shows, as JSON and packed arrays: data.js reads it. */
#ifndef REPORT_VIEWER_MODEL_H
#define REPORT_VIEWER_MODEL_H

#include "report/page.h"

/* What the pictures of all surfaces draw. */
typedef struct {
    size_t models;
    size_t triangles, all; /* drawn, and that would be drawn of everything: a triangle wet on both sides counts twice */
    double cell;           /* m: no place is farther off than this; 0 where all are drawn */
} sp_viewer_drawn;

/* Adds the JSON, safe between <script> and </script>. */
bool sp_viewer_model(const sp_page *page, sp_text *text, sp_viewer_drawn *drawn, sp_error *error);

#endif
