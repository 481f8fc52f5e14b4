/* Whether types and nozzles that a caller made hold what <sprayplan/nozzle.h> says of them. */
#ifndef NOZZLE_VALID_H
#define NOZZLE_VALID_H

#include <sprayplan/nozzle.h>

/* Each false with an error that names the type or the nozzle; see sp_type_is_valid. */

/* Its flow and exit speed follow from a pressure. */
bool sp_type_is_rated(const sp_nozzle_type *type, sp_error *error);
/* What of its type it does not use, as it says it itself, may be anything. */
bool sp_nozzle_is_valid(const sp_nozzle *nozzle, sp_error *error);
/* Its nozzles have types, whatever else they hold. */
bool sp_layout_has_types(const sp_layout *layout, sp_error *error);
bool sp_layout_is_valid(const sp_layout *layout, sp_error *error);

#endif
