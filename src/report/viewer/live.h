/* What a page needs to evaluate layouts itself. */
#ifndef REPORT_VIEWER_LIVE_H
#define REPORT_VIEWER_LIVE_H

#include "report/page.h"

/* Why the page does not, a clause of plain text; NULL where it does, "" where nobody asked for it. */
const char *sp_page_not_live(const sp_page *page);
/* The evaluator of the layouts that may be changed; NULL where there is none. */
const sp_evaluator *sp_page_live_evaluator(const sp_page *page);
/* Adds what may be changed as JSON, the worker's script and the module. */
bool sp_page_live(const sp_page *page, sp_text *text, sp_error *error);

#endif
