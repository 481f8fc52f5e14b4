/* What the viewer shows, as JSON and packed arrays: viewer.js reads it. */
#ifndef REPORT_VIEWER_MODEL_H
#define REPORT_VIEWER_MODEL_H

#include "report/page.h"

/* Adds the JSON, safe between <script> and </script>. */
bool sp_viewer_model(const sp_page *page, sp_text *text, sp_error *error);

#endif
