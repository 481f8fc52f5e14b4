/* Pictures of the vessel by our own tracer. A surface seen from its dry side is looked through. */
#ifndef REPORT_RENDER_H
#define REPORT_RENDER_H

#include "camera.h"
#include "layers.h"

/* What is seen through every quarter of every pixel; traced once, coloured for as many designs as share the evaluator.
 */
typedef struct {
    uint32_t look; /* a patch, SP_LOOK_GREY or SP_LOOK_NOTHING */
    float shade;   /* brightness, 0 to 1 */
} sp_sample;

#define SP_LOOK_NOTHING SP_NONE
#define SP_LOOK_GREY (SP_NONE - 1)

typedef struct {
    int width, height;  /* pixels; samples are 2 width × 2 height */
    sp_sample *samples; /* owned */
} sp_shot;

/* Same samples whatever the number of threads (as in sp_run). */
bool sp_shot_create(sp_shot *shot, const sp_layers *layers, const sp_camera *camera, int threads, sp_error *error);
void sp_shot_free(sp_shot *shot);
/* Malloc'd RGB, width × height. */
uint8_t *sp_shot_picture(const sp_shot *shot, const sp_coverage *coverage, sp_flux_scale scale, sp_error *error);

#endif
