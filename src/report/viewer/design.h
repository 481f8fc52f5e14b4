/* A design as the viewer shows it. */
#ifndef REPORT_VIEWER_DESIGN_H
#define REPORT_VIEWER_DESIGN_H

#include "packed.h"
#include "quantities.h"
#include "report/layers.h"

#include <jansson.h>

/* Adds its arrays: quantities, share, film, shadows, [patches] bytes each, told by those beside; of every nozzle its
 * flux alone likewise, where that is known, and its sprays (sprays.h). Returns its JSON, NULL on error. */
json_t *sp_viewer_design(const sp_page *page, size_t design, const sp_shown_quantity quantities[SP_SHOWN_QUANTITIES],
                         const uint32_t *beside, sp_packed *packed, sp_error *error);
/* Of each patch the one above it on its page, or else left of it, SP_NONE where there is neither; [patches], malloc'd,
 * NULL where memory runs out. */
uint32_t *sp_viewer_beside(const sp_layers *layers);

#endif
