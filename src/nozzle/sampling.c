/* Directions of a pattern's jets: Archimedes' map (the 2008 study, 3.1.2) from a rectangle to the sphere keeps areas,
 * so points spread evenly over the rectangle are spread evenly over the pattern. */
#include "form.h"
#include "scramble.h"

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
    return sp_form_of(spray->kind)->direction(spray, u, w);
}
