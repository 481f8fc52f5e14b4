/* Rows of poses and of nozzles that were found: the texels that each brings liquid to, and the shares. */
#ifndef OPTIMIZER_POSE_ROWS_H
#define OPTIMIZER_POSE_ROWS_H

#include "certificate/pose_pricing.h"

/* A field as a row into the arrays, of [2 patch_count]; how many entries it has. */
size_t sp_pose_write_field(const sp_pose_pricing *pricing, const float *field, uint32_t *texels, float *shares);
/* The same of what a pose brings by its own footprint. */
size_t sp_pose_write(const sp_pose_pricing *pricing, sp_pose pose, uint32_t *texels, float *shares);
/* Appends a field (see sp_placed) as a row. */
bool sp_pose_pricing_row(const sp_pose_pricing *pricing, const float *field, uint64_t key, size_t port, uint32_t tier,
                         sp_rows *rows, sp_error *error);
/* Appends what a nozzle of a layout that was found brings, as SP_OWN_KEY. */
bool sp_pose_pricing_found(const sp_pose_pricing *pricing, const sp_placed *placed, uint32_t tier, sp_rows *rows,
                           sp_error *error);
/* Appends the row of a pose. */
bool sp_pose_pricing_add(const sp_pose_pricing *pricing, sp_pose pose, sp_rows *rows, sp_error *error);

#endif
