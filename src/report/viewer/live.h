/* What a page needs to evaluate layouts itself. */
#ifndef REPORT_VIEWER_LIVE_H
#define REPORT_VIEWER_LIVE_H

#include "report/page.h"

/* Why the page does not, a clause of plain text; NULL where it does, "" where nobody asked for it. */
const char *sp_page_not_live(const sp_page *page);
/* Adds the section, what may be changed as JSON, the worker's script and the module. */
bool sp_page_live(const sp_page *page, sp_text *text, sp_error *error);

#endif
