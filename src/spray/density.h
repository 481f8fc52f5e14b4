/* How fine the texels of each chart are: finer than asked on thin parts, coarser on what is not cleaned. */
#ifndef SPRAY_DENSITY_H
#define SPRAY_DENSITY_H

#include "state.h"

typedef struct {
    double *texel;  /* [chart_count], m */
    double finest;  /* m, of those of charts with anything to be cleaned */
    double texels;  /* about how many there will be in all */
    double longest; /* texels, the longest side of a chart's box */
} sp_density;

/* A chart with anything to be cleaned gets texels of `texel` (m) or, if that is less, an eighth of its girth, so that
 * what a texel holds turns by 45 degrees at most; but none below `least` (m), none below what puts its chart on a page
 * of `page` texels, and, where they became too many, longer ones. All others share no more texels than these have, and
 * fit the page. Needs the wet sides. */
bool sp_density_create(const sp_evaluator *evaluator, const sp_charts *charts, double texel, double least, double page,
                       sp_density *density, sp_error *error);
void sp_density_free(sp_density *density);

#endif
