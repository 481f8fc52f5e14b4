/* A design as the viewer shows it. */
#ifndef REPORT_VIEWER_DESIGN_H
#define REPORT_VIEWER_DESIGN_H

#include "packed.h"
#include "quantities.h"

#include <jansson.h>

/* Adds its arrays: quantities, share, film, shadows, and every nozzle's flux alone where that is known, [patches] bytes
 * each. Returns its JSON, NULL on error. */
json_t *sp_viewer_design(const sp_page *page, size_t design, const sp_shown_quantity quantities[SP_SHOWN_QUANTITIES],
                         sp_packed *packed, sp_error *error);

#endif
