/* Patches so near to where liquid leaves, or to the limits of its reach, that it arrives very differently over one of
 * them: they are judged at more than one point. */
#ifndef SPRAY_NEAR_PATCHES_H
#define SPRAY_NEAR_PATCHES_H

#include "arrival.h"

/* Whether the patch behind this target is to be cut: where it looks broader than SP_BREADTH_MOST, or where
 * flights bend by as much as tells within it since it lies at the parabola of safety. */
bool sp_target_is_near(const sp_source *source, const sp_target *target);
/* The same with drag, where the flights to the target have been found, with what sp_wavefronts_reach says of its
 * margin. */
bool sp_target_is_near_by(const sp_source *source, const sp_target *target, const sp_flight *flights, int count,
                          double margin);

/* A cell of a patch: where it is judged, and which share of the patch's area it is. */
typedef void sp_near_visitor(void *user, const sp_target *target, double part);
/* Cuts a patch until its cells are not near themselves; their shares come to 1, but for what is out of reach. How it is
 * cut depends on the patch and the source alone; visited are the cells that flights within `half_angle` (rad) of the
 * unit `axis` may come to, and perhaps others. False where memory ran out. */
bool sp_patch_cut(const sp_source *source, uint32_t patch, sp_vec3 axis, double half_angle, sp_near_visitor *visit,
                  void *user);

#endif
