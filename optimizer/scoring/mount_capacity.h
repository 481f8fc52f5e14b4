/* Whether a layout may take one more nozzle: as many as are asked for, and what a mount holds. Two nozzles never share
 * a port; water is sp_affords' matter. */
#ifndef OPTIMIZER_MOUNT_CAPACITY_H
#define OPTIMIZER_MOUNT_CAPACITY_H

#include "scoring/search.h"

/* Nozzles that a mount takes, besides kept ones elsewhere than in ports. */
static inline size_t sp_mount_capacity(const sp_mount *mount)
{
    return mount->kind == SP_MOUNT_PORT ? 1 : mount->most ? mount->most : SIZE_MAX;
}

/* The same of one of the search's mounts: none where a kept nozzle is in the port. */
static inline size_t sp_mount_left(const sp_search *search, uint32_t mount)
{
    return search->port_taken[mount] ? 0 : sp_mount_capacity(&search->options->mounts[mount]);
}

/* True where one more than `placed`, and the kept ones, are allowed. */
static inline bool sp_number_allows(const sp_search *search, size_t placed)
{
    size_t most = search->options->max_nozzles;
    return !most || search->kept_count + placed < most;
}

#endif
