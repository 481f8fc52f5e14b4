/* Pinhole cameras on a vessel. */
#ifndef REPORT_CAMERA_H
#define REPORT_CAMERA_H

#include <sprayplan/result.h>

typedef struct {
    const char *caption;       /* "From the front" */
    double azimuth, elevation; /* rad: about up from the front, above the horizon */
} sp_viewpoint;

#define SP_VIEWPOINTS 3
extern const sp_viewpoint sp_viewpoints[SP_VIEWPOINTS];

typedef struct {
    sp_vec3 eye;                /* m */
    sp_vec3 right, up, forward; /* unit */
    double reach_x, reach_y;    /* half the picture's breadth and height where the forward component is 1 */
    double shift_x, shift_y;    /* its middle there, to the right and upwards */
    double distance;            /* m, from the eye to `centre` */
    int width, height;          /* pixels */
    bool cut;       /* what lies in front of the plane through `centre` across the line of sight is taken off */
    sp_vec3 centre; /* m, of the box around what is shown */
    double size;    /* m, the box's diagonal */
} sp_camera;

/* Holds everything wet that is to be cleaned (without a result: everything) and the nozzles that the result's designs
 * of this evaluator have about it, and nothing around, on the scale of a picture of `pixels` about the middle. Cut
 * where no cavity says which sides to look through and the geometry encloses its middle. */
sp_camera sp_camera_create(const sp_evaluator *evaluator, const sp_result *result, const sp_viewpoint *viewpoint,
                           int pixels);
/* Direction (not unit, forward component 1) through a point of the picture, in pixels from its top left. */
sp_vec3 sp_camera_direction(const sp_camera *camera, double x, double y);
/* Where a point appears, in pixels; false behind the eye. */
bool sp_camera_project(const sp_camera *camera, sp_vec3 point, double xy[2]);
/* The same; false outside the picture too. */
bool sp_camera_shows(const sp_camera *camera, sp_vec3 point, double xy[2]);

#endif
