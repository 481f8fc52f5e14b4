/* Footprints of candidate poses, each traced when it is first looked at, and kept. */
#ifndef OPTIMIZER_FOOTPRINTS_H
#define OPTIMIZER_FOOTPRINTS_H

#include "scoring/footprint.h"
#include "deadline/deadline.h"

typedef struct sp_footprints sp_footprints;

/* For the poses of a search's candidates, on its patches; the search, or a copy of it, outlives them. Stays NULL, and
 * true, where the kernels sum all candidates. */
bool sp_footprints_create(const sp_search *search, sp_footprints **footprints, sp_error *error);
/* Accepts NULL. */
void sp_footprints_destroy(sp_footprints *footprints);
/* Traces all of them as far as time and what views leave of the options' memory allow, all poses of a variant at a site
 * or none. Those that are left out when the time ends bring nothing from then on; where memory ends it fails with
 * SP_ERROR_INPUT. */
bool sp_footprints_fill(sp_footprints *footprints, sp_deadline *deadline, sp_error *error);
/* The footprint of a pose, owned by the footprints. Safe to call from many threads. */
const sp_footprint *sp_footprints_look(sp_footprints *footprints, sp_pose pose);
/* That of a nozzle wherever it stands, owned by the footprints, too; NULL on error. For one thread at a time. */
const sp_footprint *sp_footprints_add(sp_footprints *footprints, const sp_nozzle *nozzle, sp_error *error);
/* Traces this one also where it was left out; the others of its variant at its site stay so. For one thread. */
bool sp_footprints_include(sp_footprints *footprints, sp_pose pose, sp_error *error);
/* False of a variant's poses at a site that were left out. */
bool sp_footprints_know(const sp_footprints *footprints, uint32_t site, uint32_t variant);
/* False where any were left out. Accepts NULL, which left out none. */
bool sp_footprints_whole(const sp_footprints *footprints);
/* False where a look has failed since; what was looked at then was empty. Accepts NULL. */
bool sp_footprints_sound(const sp_footprints *footprints, sp_error *error);

#endif
