/* Nozzles whose bodies would overlap do not make a layout. Where no type says how wide its body is, any mount but a
 * port may hold several in one place. */
#ifndef OPTIMIZER_BODIES_H
#define OPTIMIZER_BODIES_H

#include "nozzle/body.h"
#include "scoring/partial.h"

/* Of a candidate. */
static inline sp_body sp_pose_body(const sp_search *search, const sp_pose *pose)
{
    return (sp_body){search->candidates->variants[pose->variant].type, search->sites->items[pose->site].position};
}
/* Whether a body keeps clear of the kept nozzles. */
bool sp_body_clear_of_kept(const sp_search *search, sp_body body);
/* Whether one more keeps clear of these and of the partial layout's. */
bool sp_body_clear(const sp_search *search, const sp_partial *partial, sp_body body);
/* Whether item i would keep clear of all others with this body. */
bool sp_body_clear_of_others(const sp_search *search, const sp_partial *partial, size_t i, sp_body body);
/* Whether all of the partial layout's keep clear of each other and of the kept ones. */
bool sp_partial_clear(const sp_search *search, const sp_partial *partial);

#endif
