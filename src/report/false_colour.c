#include "false_colour.h"

#include <sprayplan/image.h>

#include <string.h>

const uint8_t sp_colour_hatch[2][3] = {{250, 248, 245}, {196, 38, 54}};
const uint8_t sp_colour_obstacle[3] = {172, 178, 184};
const uint8_t sp_colour_film[3] = {152, 203, 243};

#define BINS 1000
#define BINS_A_DECADE 50.0
#define LOWEST -14.0 /* log10 of the flux at bin 0, m/s */

/* The flux below which `share` of the covered area lies, to a fiftieth of a decade. */
static double percentile(const double bins[BINS], double total, double share)
{
    double below = 0;
    for (int i = 0; i < BINS; ++i) {
        below += bins[i];
        if (below >= share * total)
            return pow(10, LOWEST + (i + 0.5) / BINS_A_DECADE);
    }
    return pow(10, LOWEST + BINS / BINS_A_DECADE);
}

/* 1, 2 or 5 times a power of ten, next to `value` downwards or upwards. */
static double rounded(double value, bool upwards)
{
    const double steps[] = {1, 2, 5, 10};
    double power = pow(10, floor(log10(value)));
    double best = power;
    for (int i = 0; i < 4; ++i) {
        bool far_enough = steps[i] * power >= value * (1 - 1e-9);
        if (upwards && far_enough)
            return steps[i] * power;
        if (steps[i] * power <= value * (1 + 1e-9))
            best = steps[i] * power;
    }
    return best;
}

sp_flux_scale sp_flux_scale_of(const sp_design *designs, size_t count)
{
    double bins[BINS] = {0}, total = 0, criterion = 0;
    for (size_t i = 0; i < count; ++i) {
        if (!designs[i].evaluator)
            continue;
        const sp_patches *patches = sp_evaluator_patches(designs[i].evaluator);
        const sp_deposits *deposits = &designs[i].coverage->deposits;
        criterion = fmax(criterion, sp_evaluator_setup(designs[i].evaluator)->criterion.flux);
        for (size_t k = 0; k < patches->count; ++k) {
            if (!deposits->covered[k] || deposits->by_film[k] || !(deposits->flux[k] > 0))
                continue;
            double bin = fmin(fmax((log10(deposits->flux[k]) - LOWEST) * BINS_A_DECADE, 0), BINS - 1);
            bins[(int)bin] += patches->area[k];
            total += patches->area[k];
        }
    }
    const double l_min = 1 / 6e4; /* round figures in the unit that the reader sees */
    if (!(total > 0))
        return (sp_flux_scale){l_min, 100 * l_min};
    double high = rounded(6e4 * percentile(bins, total, 0.99), true);
    double low = rounded(6e4 * (criterion > 0 ? criterion : percentile(bins, total, 0.01)), false);
    low = fmax(low, high / 1000);
    if (high < 5 * low)
        high = rounded(5 * low, true);
    return (sp_flux_scale){low * l_min, high * l_min};
}

double sp_flux_scale_place(sp_flux_scale scale, double flux)
{
    if (!(flux > scale.low))
        return 0;
    return fmin(log(flux / scale.low) / log(scale.high / scale.low), 1);
}

void sp_false_colour(sp_flux_scale scale, const sp_deposits *deposits, uint32_t patch, int stripe, uint8_t rgb[3])
{
    if (deposits->by_film[patch])
        memcpy(rgb, sp_colour_film, 3);
    else if (deposits->covered[patch])
        sp_viridis(sp_flux_scale_place(scale, deposits->flux[patch]), rgb);
    else
        memcpy(rgb, sp_colour_hatch[stripe], 3);
}
