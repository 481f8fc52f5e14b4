/* What is written over a picture, as SVG in the picture's pixels: each label beside what is there already, as far as
 * there is room. */
#ifndef REPORT_LABELS_H
#define REPORT_LABELS_H

#include "listed_shadows.h"
#include "render.h"

#define SP_LABELS 1024 /* names of nozzles beyond them are left out; other labels are not kept clear of */
typedef struct {
    double width, height; /* of the picture that they are to stay in; 0: of none */
    double sample;        /* edge of one of the shot's samples there; 0: no shot is labelled */
    size_t count;
    double box[SP_LABELS][4]; /* left, top, right, bottom */
} sp_labels;

/* A dot for every nozzle, and its name where there is room. */
void sp_labels_nozzles(sp_labels *labels, sp_text *text, const sp_camera *camera, const sp_layout *layout);
/* The number of every shadow, on a spot of it that the picture shows; of what is hidden there is none. */
void sp_labels_shadows(sp_labels *labels, sp_text *text, const sp_shot *shot, const sp_listed_shadows *shadows);

#endif
