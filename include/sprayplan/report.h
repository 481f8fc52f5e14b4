/* The report: pictures, model and page that a customer is handed. */
#ifndef SPRAYPLAN_REPORT_H
#define SPRAYPLAN_REPORT_H

#include <sprayplan/export.h>
#include <sprayplan/result.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Writes the design's coverage on the atlas pages as one PNG, its deposits as multi-part EXR (a part for each
 * page and side, the channels as `sprayplan help files` has them). */
SP_API bool sp_report_coverage_png(const sp_design *design, const char *path, sp_error *error);
SP_API bool sp_report_deposits_exr(const sp_design *design, const char *path, sp_error *error);
/* Writes the design as glTF 2.0 in one file, in m, y up, all in a root that is moved to the setup's origin. Each part
 * of which something is wet is a node of its name, its wet sides in false colour that no light changes
 * (KHR_materials_unlit); each nozzle is a node of its name, whose translation is its position and whose rotation is its
 * frame: its z is the axis. */
SP_API bool sp_report_model_glb(const sp_design *design, const char *path, sp_error *error);
/* Write the design for ParaView, as VTK's XML PolyData, in m and SI units, in the coordinates that scenes are read and
 * written in. Both hold part (an index into the field array part_names, in UTF-8) and side (0 both as one, 1 front,
 * 2 back).
 *  - surface: one cell for each wet side of a triangle, anticlockwise seen from it, in the order of parts, pages of the
 *    atlas and sides. area is what of it counts (m²), which over all cells adds up to what is cleaned; covered is the
 *    share of that, flux its mean, speed and incidence are means weighted by liquid. A texel's values are spread evenly
 *    over its fragments of triangles. NaN where nothing counts; speed and incidence are 0 where nothing arrives.
 *  - texels: one point for each patch, in the order of sp_patches, where it is judged, with its normal and the channels
 *    of the EXR file under the same names and with the same values, also of those that are not the largest of a pixel.
 */
SP_API bool sp_report_surface_vtp(const sp_design *design, const char *path, sp_error *error);
SP_API bool sp_report_texels_vtp(const sp_design *design, const char *path, sp_error *error);
/* Writes a body for each nozzle of the design, a cylinder that ends in a cone, as binary STL: the cone's tip is the
 * nozzle's position and points along its axis, the length is 1/50 of the geometry's diagonal. In the coordinates and
 * the unit of the scene's first geometry file (mm for STEP and IGES, see sp_setup), so that it fits on that; the header
 * names the unit. */
SP_API bool sp_report_nozzles_stl(const sp_design *design, const char *path, sp_error *error);
/* How long the pictures of the page will take, as large as they are best, s of wall time on this machine as busy as it
 * is, judged by small ones of the first design that has an evaluator; 0 where none has. */
SP_API bool sp_report_picture_time(const sp_result *result, double *seconds, sp_error *error);
/* The self-contained page as HTML text (pictures inside it). Malloc'd, the caller frees. */
SP_API char *sp_report_html(const sp_result *result, sp_error *error);
/* All files of a result but layout.yaml into `output`: result.json, report.html; of the main design nozzles.csv,
 * swabs.csv, nozzles.stl, surface.vtp and texels.vtp; nozzles-all.csv where other designs that may be built have sheets
 * too, which those before refinement have not; and coverage.png, deposits.exr and model.glb of each design, with the
 * suffixes -manual and -greedy where it is not the main one. */
SP_API bool sp_report_write(const sp_result *result, sp_output *output, sp_error *error);

/* Writes a picture of what is wet as PNG: blue what is cleaned and counted, orange the wet sides of obstacles, grey
 * what is dry; from the front, from behind and from above, cut open at the middle (upper row) and whole. */
SP_API bool sp_report_wet_png(const sp_evaluator *evaluator, const char *path, sp_error *error);

/* A picture of the charts of one page, one colour a chart, malloc'd RGB of page_edge² pixels. */
SP_API uint8_t *sp_report_charts(const sp_atlas *atlas, size_t page, sp_error *error);

#ifdef __cplusplus
}
#endif
#endif
