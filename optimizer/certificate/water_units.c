#include "certificate/water_units.h"

#include <assert.h>
#include <math.h>

#define UNITS_MOST 4096    /* of a budget */
#define PARTS_MOST 16      /* of a common measure, for flows that refinement set */
#define MEASURE_LEAST 1e-3 /* of the smallest flow: a smaller one is no common measure but rounding */
#define SLACK 1e-4         /* of a unit, for a whole layout */

/* The largest flow that all are whole multiples of, by Euclid's algorithm; 0 where there is none worth the name. */
static double common_measure(const double *flows, size_t count)
{
    double measure = flows[0], smallest = flows[0];
    for (size_t i = 1; i < count; i++)
        smallest = fmin(smallest, flows[i]);
    assert(smallest > 0);
    for (size_t i = 1; i < count; i++) {
        double a = flows[i], b = measure;
        while (b > MEASURE_LEAST * smallest) {
            double rest = fmod(a, b);
            if (b - rest < MEASURE_LEAST * smallest)
                rest = 0;
            a = b;
            b = rest;
        }
        measure = a;
    }
    return measure;
}

static bool measures_all(const double *flows, size_t count, double unit, double slack)
{
    for (size_t i = 0; i < count; i++)
        if (fabs(flows[i] / unit - round(flows[i] / unit)) > 0.5 * slack)
            return false;
    return true;
}

sp_water_units sp_water_units_create(const double *flows, size_t count, double least, size_t nozzles, double most)
{
    sp_water_units units = {.unit = fmin(most / UNITS_MOST, least), .slack = SLACK / (double)(nozzles + 1)};
    assert(units.unit > 0 && isfinite(units.unit));
    double measure = count ? common_measure(flows, count) : 0;
    if (!(measure > 0) || most / measure > UNITS_MOST)
        return units;
    measure = flows[0] / round(flows[0] / measure);
    double parts = fmax(ceil(measure / least), fmin(PARTS_MOST, floor(UNITS_MOST * measure / most)));
    if (measures_all(flows, count, measure / parts, units.slack))
        units.unit = measure / parts;
    return units;
}

uint32_t sp_water_weight(const sp_water_units *units, double flow)
{
    return (uint32_t)fmin(fmax(1, floor(flow / units->unit + units->slack)), 1e9);
}

size_t sp_water_budget(const sp_water_units *units, double flow)
{
    return flow > 0 ? (size_t)floor(flow / units->unit + SLACK) : 0;
}

double sp_water_least(const sp_water_units *units, size_t budget)
{
    return fmax(0, (double)budget - 2 * SLACK) * units->unit;
}
