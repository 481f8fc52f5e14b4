#include "bound/valid_inequality.h"
#include "bound/rounding.h"

#include <assert.h>
#include <math.h>

/* g(f) = (f - cut)+ / (1 - n cut), at most 1: n shares that come to 1 lose n cut at most. Valid for cut < 1/n. */
static double cut_all(double f, double cut, double nozzles)
{
    return fmin(1, fmax(0, f - cut) / (1 - nozzles * cut));
}

/* Who has more than 1 - gap may suffice alone; else it takes two of more than gap / (n - 1), for all others together
 * bring no more than `gap`. */
static double two_halves(double f, double gap, double nozzles)
{
    if (f > 1 - gap)
        return 1;
    return nozzles > 1 && f * (nozzles - 1) >= gap ? 0.5 : 0;
}

/* Mixed integer rounding of Σ f x >= 1 divided by d, 1/d = parts - 1 + rest: Nemhauser and Wolsey, Integer and
 * combinatorial optimization, 1988, II.1.7. */
static double round_mixed(double f, double parts, double rest)
{
    double scaled = f * (parts - 1 + rest), whole = floor(scaled);
    return fmin(1, (whole * rest + fmin(scaled - whole, rest)) / (parts * rest));
}

static void add(sp_valid_inequalities *inequalities, const double values[SP_INEQUALITY_LEVELS + 1])
{
    size_t kind = inequalities->kinds++;
    float *own = inequalities->value[kind];
    for (size_t i = 0; i <= SP_INEQUALITY_LEVELS; i++)
        own[i] = fminf(1, (float)values[i] * (float)SP_UPWARDS_SINGLE);
    own[0] = 0;
    /* a share of 1 must count whole: all inequalities are valid by that */
    assert(inequalities->kinds <= SP_INEQUALITY_KINDS && own[SP_INEQUALITY_LEVELS] == 1);
    for (size_t i = 1; i <= SP_INEQUALITY_LEVELS; i++) {
        assert(own[i] >= own[i - 1]);
        inequalities->steep[kind] = fmaxf(inequalities->steep[kind],
                                          own[i] * (float)SP_INEQUALITY_LEVELS / (float)i * (float)SP_UPWARDS_SINGLE);
    }
}

void sp_valid_inequalities_create(size_t nozzles, sp_valid_inequalities *inequalities)
{
    static const double cuts[] = {0.25, 0.5, 0.75, 0.9, 0.999};
    static const double gaps[] = {0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.499999};
    static const double roundings[][2] = {{2, 0.05}, {2, 0.1}, {2, 0.2}, {2, 0.4}, {2, 0.7},
                                          {3, 0.1},  {3, 0.3}, {3, 0.6}, {4, 0.2}, {4, 0.5}};
    double n = (double)nozzles, values[SP_INEQUALITY_LEVELS + 1];
    size_t levels = SP_INEQUALITY_LEVELS;
    assert(nozzles > 0);
    *inequalities = (sp_valid_inequalities){.nozzles = nozzles};
    for (size_t k = 0; k < sizeof cuts / sizeof *cuts; k++) {
        for (size_t i = 0; i <= levels; i++)
            values[i] = cut_all((double)i / (double)levels, cuts[k] / n, n);
        add(inequalities, values);
    }
    for (size_t k = 0; k < sizeof gaps / sizeof *gaps; k++) {
        for (size_t i = 0; i <= levels; i++)
            values[i] = two_halves((double)i / (double)levels, gaps[k], n);
        add(inequalities, values);
    }
    for (size_t k = 0; k < sizeof roundings / sizeof *roundings; k++) {
        for (size_t i = 0; i <= levels; i++)
            values[i] = round_mixed((double)i / (double)levels, roundings[k][0], roundings[k][1]);
        add(inequalities, values);
    }
}
