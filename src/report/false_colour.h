/* What colour a patch has: viridis by flux where it is covered, hatched where not. */
#ifndef REPORT_FALSE_COLOUR_H
#define REPORT_FALSE_COLOUR_H

#include <sprayplan/result.h>

/* Flux (m³/s per m²) at the two ends of the colour map; logarithmic between. */
typedef struct {
    double low, high;
} sp_flux_scale;

/* One scale for all designs, so that their pictures compare: from the criterion's flux, or the 1st percentile of
 * covered area where there is none, to the 99th; rounded outwards to 1, 2 or 5 L/min/m² times a power of ten. */
sp_flux_scale sp_flux_scale_of(const sp_design *designs, size_t count);
/* Where on the scale, 0 to 1. */
double sp_flux_scale_place(sp_flux_scale scale, double flux);

/* Uncovered patches are hatched white and red: told from viridis by any eye, and in black and white. */
extern const uint8_t sp_colour_hatch[2][3];
extern const uint8_t sp_colour_obstacle[3];
extern const uint8_t sp_colour_film[3]; /* covered by film and not by impact */

/* `stripe` picks the hatch's colour, 0 or 1. */
void sp_false_colour(sp_flux_scale scale, const sp_deposits *deposits, uint32_t patch, int stripe, uint8_t rgb[3]);

#endif
