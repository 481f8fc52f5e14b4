/* Directions of a pattern's jets: Archimedes' map (the 2008 study, 3.1.2) from a rectangle to the sphere keeps areas,
 * so points spread evenly over the rectangle are spread evenly over the pattern. */
#include "patternation.h"
#include "scramble.h"
#include "turned.h"

#include <assert.h>

/* Point i of the golden lattice (i/n, i φ mod 1) under a shift drawn from the seed (Cranley and Patterson 1976). φ is
 * the number worst approximated by fractions, so the lattice stays even however the rectangle is stretched: a thin fan
 * is filled as evenly as a cone. i φ is taken in integers: no digit is lost for large i. */
static void lattice(uint64_t i, uint64_t n, uint64_t seed, double *u, double *w)
{
    uint64_t first = sp_scramble(seed), second = sp_scramble(first);
    *u = ((double)i + sp_fraction(first)) / (double)n;
    *w = sp_fraction(i * 0x9e3779b97f4a7c15u + second);
}

sp_vec3 sp_spray_direction(const sp_spray *spray, uint64_t i, uint64_t n, uint64_t seed)
{
    double u, w;
    assert(i < n);
    lattice(i, n, seed, &u, &w);
    if (spray->kind == SP_PATTERN_ROTATING) {
        double polar = sp_turned_polar(spray, u), azimuth = 2 * M_PI * w;
        return sp_v(sin(polar) * cos(azimuth), sin(polar) * sin(azimuth), cos(polar));
    }
    if (spray->kind == SP_PATTERN_MEASURED)
        return sp_patternation_direction(spray->measured, u, w);
    if (spray->kind == SP_PATTERN_FLAT_FAN) {
        double longitude = (2 * u - 1) * spray->half_width;
        double y = (2 * w - 1) * sin(spray->half_thickness);
        double level = sqrt(1 - y * y);
        return sp_v(level * sin(longitude), y, level * cos(longitude));
    }
    /* h = 1 - cos(polar angle), so that narrow streams keep their digits */
    double a = sin(0.5 * spray->inner), b = sin(0.5 * spray->outer);
    double h = 2 * (a * a + u * (b * b - a * a));
    double level = sqrt(h * (2 - h)), azimuth = 2 * M_PI * w;
    return sp_v(level * cos(azimuth), level * sin(azimuth), 1 - h);
}
