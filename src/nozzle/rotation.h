/* What leaves types that rotate. */
#ifndef NOZZLE_ROTATION_H
#define NOZZLE_ROTATION_H

#include "form.h"

/* What it sprays is the mean over time. */
static inline bool sp_type_rotates(const sp_nozzle_type *type)
{
    return type->pattern == SP_PATTERN_ROTATING;
}
/* Its jets draw tracks that can be told: a two-axis head. */
static inline bool sp_type_has_tracks(const sp_nozzle_type *type)
{
    return sp_type_rotates(type) && type->rotation.jets > 0;
}
/* Jets among which its flow is divided. */
static inline unsigned sp_type_jets(const sp_nozzle_type *type)
{
    return sp_type_has_tracks(type) ? type->rotation.jets : 1;
}
/* Whether what leaves at any moment is a stream, standing still or turning. */
static inline bool sp_type_leaves_as_stream(const sp_nozzle_type *type)
{
    return sp_form_of(sp_type_rotates(type) ? type->rotation.jet : type->pattern)->stream;
}
/* Whether a jet that turns may be of this pattern. */
static inline bool sp_pattern_turns(sp_pattern jet)
{
    return jet < sp_form_count && sp_form_of(jet)->outline;
}
/* Whether jets on a hub may be of this pattern: those that spray the same however they are rolled. */
static inline bool sp_pattern_fits_hub(sp_pattern jet)
{
    return sp_pattern_turns(jet) && sp_form_of(jet)->period == 0;
}

#endif
