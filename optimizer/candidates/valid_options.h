/* Whether options that a caller made hold what <sprayplan/place.h> says of them. */
#ifndef CANDIDATES_VALID_OPTIONS_H
#define CANDIDATES_VALID_OPTIONS_H

#include <sprayplan/place.h>

/* False, with SP_ERROR_ARGUMENT, where mounts are missing or a number, type or word in one is none. */
bool sp_mounts_are_valid(const sp_place_options *options, sp_error *error);
/* The same of all options; that there are any mounts, types or pressures is asked elsewhere. */
bool sp_options_are_valid(const sp_place_options *options, sp_error *error);

#endif
