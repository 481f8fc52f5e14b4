/* Thresholds that no nozzle brings to a wall, as where another unit is meant: 1 m/s is a flux, 60000 L/min/m2. */
#include "cli.h"

/* In the unit that they are written in. Cleaning asks for a few L/min/m2, a washer's pass for a few L/m2, and a film of
 * some 10 L/min/m holds together. */
#define MOST_FLUX 500
#define MOST_DOSE 500
#define MOST_FILM 1000

bool cli_warn_of_large_threshold(const sp_setup *setup, char text[CLI_LARGE_THRESHOLD])
{
    const double pass = sp_sweep_duration(&setup->sweep);
    const struct {
        const char *key, *unit;
        double asked, most;
    } thresholds[] = {
        {"flux", "L/min/m2", pass > 0 ? 0 : 6e4 * setup->criterion.flux, MOST_FLUX},
        {"dose", "L/m2", 1e3 * pass * setup->criterion.flux, MOST_DOSE},
        {"film", "L/min/m", 6e4 * setup->criterion.film, MOST_FILM},
    };
    for (size_t i = 0; i < sizeof thresholds / sizeof *thresholds; i++)
        if (thresholds[i].asked > thresholds[i].most) {
            snprintf(text, CLI_LARGE_THRESHOLD,
                     "criterion: %s is %.6g %s, more than nozzles bring to a wall; is another unit meant?",
                     thresholds[i].key, thresholds[i].asked, thresholds[i].unit);
            return true;
        }
    return false;
}
