/* A design as the viewer shows it. */
#ifndef REPORT_VIEWER_DESIGN_H
#define REPORT_VIEWER_DESIGN_H

#include "packed.h"
#include "patch_code.h"
#include "quantities.h"

#include <jansson.h>

/* Tells the bytes of its patches: of every nozzle its flux alone, where that is known, then flux, speed, incidence,
 * impact, share, film and shadows; and adds the nozzles' sprays (sprays.h). Returns its JSON, NULL on error. */
json_t *sp_viewer_design(const sp_page *page, size_t design, const sp_shown_quantities *quantities,
                         const sp_neighbours *neighbours, sp_coder *coder, sp_packed *packed, sp_error *error);

#endif
