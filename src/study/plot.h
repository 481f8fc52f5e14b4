/* A plot of points on two axes, as SVG. */
#ifndef STUDY_PLOT_H
#define STUDY_PLOT_H

#include "result/growing_text.h"

typedef struct {
    double x, y;
    double low, high; /* a bar through the point; NAN: none */
} sp_plot_point;

/* Points of one kind: one colour and one shape, with a name in the legend. */
typedef struct {
    char name[96];
    const char *colour; /* "#rrggbb" */
    int shape;          /* 0 disc, 1 square, 2 diamond, 3 triangle, 4 ring, 5 large diamond; -1 none */
    bool joined;        /* by a line */
    bool stepped;       /* by steps: what holds until the next point */
    size_t count;
    sp_plot_point *points; /* those that are not finite, or not above 0 on a logarithmic axis, are left out */
} sp_plot_series;

typedef struct {
    const char *label; /* for who cannot see it */
    const char *x_title, *y_title;
    bool log_x, log_y;
    size_t count;
    const sp_plot_series *series; /* later ones lie above */
} sp_plot;

void sp_plot_draw(sp_text *text, const sp_plot *plot);

#endif
