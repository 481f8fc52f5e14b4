/* What is drawn over a picture, as SVG in the picture's pixels. */
#ifndef REPORT_OVERLAY_H
#define REPORT_OVERLAY_H

#include "camera.h"
#include "markup.h"

#define SP_OUTLINE 32 /* points on a spray's rim */
/* The rim of a pattern's spray a little way along, of what is `size` (m) large: points in the setup's coordinates,
 * around it in turn. */
void sp_overlay_outline(const sp_evaluator *evaluator, const sp_nozzle *pattern, double size, sp_vec3 rim[SP_OUTLINE]);

/* The outline of every nozzle's spray, a little way along; of a cluster that of each pattern. */
void sp_overlay_sprays(sp_text *text, const sp_camera *camera, const sp_evaluator *evaluator, const sp_layout *layout);

#define SP_SCALE_STRIP 92 /* pixels below the picture */
/* scale_bar.c: a bar of a round length at the depth of the camera's centre, and the axes x, y, z, in that strip. */
void sp_overlay_scale(sp_text *text, const sp_camera *camera);

#endif
