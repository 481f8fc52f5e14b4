/* How fine the texels of each chart are: finer than asked on thin parts, coarser on what is not cleaned. */
#ifndef SPRAY_TEXEL_SIZES_H
#define SPRAY_TEXEL_SIZES_H

#include "spray/state/state.h"

typedef struct {
    double *texel;  /* [chart_count], m */
    double finest;  /* m, of those of charts with anything to be cleaned */
    double texels;  /* about how many there will be in all */
    double longest; /* texels, the longest side of a chart's box */
} sp_texel_sizes;

typedef struct {
    double texel; /* m, on what is not thin */
    double least; /* m, no shorter ones */
    double spare; /* charts that would get the shortest texels, and together have no more than this share of what
                     is cleaned, get the shortest ones of the other charts instead */
    double page;  /* texels: no chart is longer for having shorter ones */
} sp_texel_limits;

/* A chart with anything to be cleaned gets texels as asked or, if that is less, of an eighth of its girth, so that what
 * a texel holds turns by 45 degrees at most; longer ones where they became more than twice as many as without thin
 * parts (and more than 50,000). All other charts share no more than a quarter as many as these have, and fit the page.
 * Needs the wet sides. */
bool sp_texel_sizes_create(const sp_evaluator *evaluator, const sp_charts *charts, const sp_texel_limits *limits,
                           sp_texel_sizes *texel_sizes, sp_error *error);
/* In proportion to those of a finer evaluator: what is thin there is here, and nothing else. */
bool sp_texel_sizes_like(const sp_evaluator *evaluator, const sp_charts *charts, const sp_evaluator *fine,
                         sp_texel_sizes *texel_sizes, sp_error *error);
void sp_texel_sizes_free(sp_texel_sizes *texel_sizes);

#endif
