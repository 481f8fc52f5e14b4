/* What the files of sp_visibility share: visibility_create.c begins and ends it, visibility_survey.c traces all views
 * for the first time, view_buffers.c works out again those that are not kept, visibility_fit.c chooses patches that
 * time allows. */
#ifndef OPTIMIZER_VISIBILITY_WORK_H
#define OPTIMIZER_VISIBILITY_WORK_H

#include "scoring/visibility.h"

#define SP_PRINT 16.0       /* bytes of a patch's part of a footprint, and of the footprint itself */
#define SP_PRINTS_SHARE 0.5 /* of the memory, that all footprints may take */

/* Bytes for all views and footprints. */
double sp_visibility_memory(const sp_place_options *options);
/* Of poses that no pattern kernel sums, each of which is traced by itself, the patterns; and how many such poses there
 * are. */
double sp_visibility_patterns(const sp_sites *sites, const sp_candidates *candidates, double *poses);
/* What is in sight in view `at`, [sight_bytes]. */
uint8_t *sp_visibility_sights(const sp_visibility *visibility, size_t at);
/* Traces view `at`, or works it out again; false also where there is nothing to see: then error stays as it is. */
bool sp_visibility_trace(const sp_visibility *visibility, size_t at, sp_sightings *sightings, sp_error *error);
/* Traces all views as far as time allows, keeps as many as there is room for, and makes buffers for the others. */
bool sp_visibility_survey(sp_visibility *visibility, sp_deadline *deadline, sp_error *error);
/* Makes visibility->buffer_count buffers, each for the largest view. */
bool sp_view_buffers_create(sp_visibility *visibility, bool any_marked, sp_error *error);
void sp_view_buffers_destroy(sp_view_buffers *buffers, int count);

#endif
