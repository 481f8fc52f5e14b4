/* Turning charts so that their bounding boxes waste little. */
#ifndef ATLAS_ORIENT_H
#define ATLAS_ORIENT_H

#include <sprayplan/atlas.h>

/* Turns every chart in its plane so that its bounding box has the least area, its long side along x, no side longer
 * than charts->extent. Returns false when memory runs out. */
bool sp_orient_charts(sp_charts *charts, sp_error *error);

#endif
