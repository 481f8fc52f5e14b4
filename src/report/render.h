/* Pictures of the vessel. */
#ifndef REPORT_RENDER_H
#define REPORT_RENDER_H

#include "depth_buffer.h"

/* What is seen through every quarter of every pixel; found once, coloured as often as is wanted. */
typedef struct {
    uint32_t look;
    float shade; /* brightness, 0 to 1 */
} sp_seen_sample;

typedef struct {
    int width, height;       /* pixels; samples are 2 width × 2 height */
    sp_seen_sample *samples; /* owned */
} sp_shot;

/* Same samples whatever the number of threads, which are the evaluator's setup's. `look` is called from all of them. */
/* With `wireframe` the edges of all triangles are drawn, fainter than those of the body. */
bool sp_shot_create(sp_shot *shot, const sp_evaluator *evaluator, const sp_camera *camera, bool wireframe,
                    sp_look_at *look, const void *user, sp_error *error);
void sp_shot_free(sp_shot *shot);

/* The colour of a look but for nothing, which is white. `stripe` picks a hatch's colour, 0 or 1. */
typedef void sp_look_colour(const void *user, uint32_t look, int stripe, uint8_t rgb[3]);
/* Malloc'd RGB, width × height. */
uint8_t *sp_shot_picture(const sp_shot *shot, sp_look_colour *colour, const void *user, sp_error *error);

#endif
