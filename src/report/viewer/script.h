/* The page's scripts and style as they lie in this folder, and live.wasm. */
#ifndef REPORT_VIEWER_SCRIPT_H
#define REPORT_VIEWER_SCRIPT_H

#include "report/markup.h"

#include <stdbool.h>

/* section.c: adds a script, which ends with a 0. */
void sp_page_script(sp_text *text, const char *script, const char *end);

extern const char sp_viewer_script[], sp_viewer_script_end[];
extern const char sp_live_script[], sp_live_script_end[];
extern const char sp_live_loader[], sp_live_loader_end[];
extern const char sp_live_worker[], sp_live_worker_end[];
extern const bool sp_live_is_built; /* else the module is empty */
extern const char sp_live_module[], sp_live_module_end[];
extern const char sp_viewer_style[], sp_viewer_style_end[];

#endif
