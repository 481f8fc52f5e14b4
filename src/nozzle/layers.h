/* Types that spray by images: of liquid alone, or of its speed too, which are clusters of layers of one speed each. */
#ifndef NOZZLE_LAYERS_H
#define NOZZLE_LAYERS_H

#include "form.h"

/* Whether a type has one image alone. */
static inline bool sp_type_is_measured(const sp_nozzle_type *type)
{
    return sp_form_of(type->pattern)->image;
}
/* Whether it is such a cluster. */
static inline bool sp_type_has_layers(const sp_nozzle_type *type)
{
    return type->pattern == SP_PATTERN_CLUSTER && type->image[0];
}
/* Whether any pattern of it is measured: it is more than numbers. */
bool sp_type_needs_images(const sp_nozzle_type *type);
/* Makes such a cluster of a measured type, whose members are [count], the caller's to free. False where memory runs
 * out. The patternations stay borrowed. */
bool sp_type_take_layers(sp_nozzle_type *type, const sp_speed_layer *layers, size_t count, sp_error *error);

#endif
