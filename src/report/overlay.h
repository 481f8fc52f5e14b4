/* What is drawn over a picture, as SVG in the picture's pixels. */
#ifndef REPORT_OVERLAY_H
#define REPORT_OVERLAY_H

#include "camera.h"
#include "markup.h"

/* Every nozzle: a dot, its name and the outline of its spray, a little way along; of a cluster that of each pattern. */
void sp_overlay_nozzles(sp_text *text, const sp_camera *camera, const sp_evaluator *evaluator, const sp_layout *layout);

#endif
