/* With how many decimals a layout is written for a fitter. */
#ifndef RESULT_FITTING_DECIMALS_H
#define RESULT_FITTING_DECIMALS_H

#include <sprayplan/fitting.h>

/* Of a whole layout (see sp_layout_is_valid) of the setup; `mounts` may be NULL for none. */
sp_fitting_decimals sp_fitting_decimals_of(const sp_layout *layout, const sp_setup *setup, const sp_mount *mounts,
                                           size_t mount_count);

#endif
