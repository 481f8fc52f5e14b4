/* All poses, and the nozzles of layouts that were found, in one list as sp_candidate_list wants them: by falling
 * weight, then variant, mount, site and axis, so that neighbours spray much the same. */
#ifndef OPTIMIZER_POSE_ORDER_H
#define OPTIMIZER_POSE_ORDER_H

#include "scoring/partial.h"
#include "bound/candidate_list.h"

/* The poses of one variant at one site, or found nozzles of one weight in one port. */
typedef struct {
    size_t start;
    uint32_t site, variant; /* variant SP_NONE: found nozzles, of which `site` is the first in own_order */
} sp_pose_block;

typedef struct {
    const sp_search *search;
    const sp_rows *own; /* the found nozzles */
    size_t *own_order;  /* [own rows] */
    size_t block_count;
    sp_pose_block *blocks;  /* [block_count + 1] */
    size_t *block_of;       /* [sites x variants], SIZE_MAX: is no candidate */
    uint32_t **axis_at;     /* [mounts x variants], axes in their order; NULL: none */
    uint32_t **rank_of;     /* the inverse */
    sp_candidate_list list; /* without the callbacks that price */
} sp_pose_order;

/* Borrows all. tier_of [mounts x variants], tiers of the cover; ports [mounts]. Poses that were not traced, or whose
 * port a kept nozzle takes, are left out. */
bool sp_pose_order_create(const sp_search *search, const sp_cover *cover, const uint32_t *tier_of, const size_t *ports,
                          const sp_rows *own, sp_pose_order *order, sp_error *error);
void sp_pose_order_free(sp_pose_order *order);
/* The block that holds a position. */
size_t sp_pose_order_block(const sp_pose_order *order, size_t position);
/* Which pose stands at a position of the block, of poses. */
sp_pose sp_pose_order_at(const sp_pose_order *order, size_t block, size_t position);
size_t sp_pose_order_position(const sp_pose_order *order, sp_pose pose);

#endif
