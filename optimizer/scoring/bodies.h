/* Nozzles whose bodies would overlap do not make a layout. Where types do not say how wide their bodies are, nothing is
 * known of that: any mount but a port then holds several in one place. */
#ifndef OPTIMIZER_BODIES_H
#define OPTIMIZER_BODIES_H

#include "scoring/partial.h"

/* Whether one of this type at `position` keeps clear of the kept nozzles. */
bool sp_clear_of_kept(const sp_search *search, const sp_nozzle_type *type, sp_vec3 position);
/* Whether one more of this type at `position` keeps clear of the partial layout's and the kept ones. */
bool sp_bodies_clear(const sp_search *search, const sp_partial *partial, const sp_nozzle_type *type, sp_vec3 position);
/* The same of a candidate. */
bool sp_bodies_clear_at(const sp_search *search, const sp_partial *partial, const sp_pose *pose);
/* Whether all of the partial layout's keep clear of each other and of the kept ones. */
bool sp_bodies_all_clear(const sp_search *search, const sp_partial *partial);

#endif
