/* Which surface every sample of a picture shows. */
#ifndef REPORT_DEPTH_BUFFER_H
#define REPORT_DEPTH_BUFFER_H

#include "camera.h"

/* What is seen at a point of the surface, given by the weights of the triangle's second and third corner, from its
 * front or back: a number that a colour is known for, or SP_LOOK_NOTHING where it is looked through. */
#define SP_LOOK_NOTHING SP_NONE
typedef uint32_t sp_look_at(const void *user, uint32_t triangle, double u, double v, int back);

typedef struct {
    double depth;      /* m along the forward axis; INFINITY: nothing is seen */
    uint32_t triangle; /* of the same depth the lowest number; SP_NONE */
    uint32_t look;     /* SP_LOOK_NOTHING */
} sp_depth_sample;

/* What four samples a pixel, 2 width × 2 height rows from the top left, show first that is not looked through.
 * `samples` is the caller's; the same whatever the number of threads, from all of which `look` is called. */
bool sp_depth_buffer_fill(sp_depth_sample *samples, const sp_mesh *mesh, const sp_camera *camera, sp_look_at *look,
                          const void *user, int threads, sp_error *error);

#endif
