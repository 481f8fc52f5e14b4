/* Report files with a scale shared between designs. */
#ifndef REPORT_SCALED_FILES_H
#define REPORT_SCALED_FILES_H

#include "false_colour.h"

bool sp_model_glb(const sp_design *design, const sp_colour_scale *scale, const char *path, sp_error *error);
bool sp_coverage_png(const sp_design *design, const sp_colour_scale *scale, const char *path, sp_error *error);

#endif
