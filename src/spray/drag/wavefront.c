/* What the table says of a front. */
#include "wavefronts.h"

#define SLACK 1e-6 /* beyond what the table may be off */

#define PAIRS (SP_FRONT_DATA / 2)
typedef double pair __attribute__((vector_size(16), aligned(8), may_alias));

/* A moment's data and their slopes by the elevation: Chebyshev's sums, and the derivatives of their polynomials. */
typedef struct {
    pair value[PAIRS], slope[PAIRS];
} sums;

/* The polynomial in hand, and its derivative; the one before. */
typedef struct {
    double at, now, before, slope_now, slope_before;
} polynomial;

static polynomial first_polynomial(double elevation)
{
    double at = elevation / (0.5 * M_PI); /* the polynomial -1 is the first */
    return (polynomial){.at = at, .now = 1, .before = at, .slope_now = 0, .slope_before = 1};
}

static inline void advance(polynomial *p)
{
    double next = 2 * p->at * p->now - p->before, slope_next = 2 * p->now + 2 * p->at * p->slope_now - p->slope_before;
    p->before = p->now;
    p->slope_before = p->slope_now;
    p->now = next;
    p->slope_now = slope_next;
}

static inline void add(sums *own, const double sum[SP_FRONT_DATA], const polynomial *p)
{
    for (int k = 0; k < PAIRS; k++) {
        pair data = *(const pair *)(sum + 2 * k);
        own->value[k] += p->now * data;
        own->slope[k] += p->slope_now * data;
    }
}

static inline void finish(sums *own)
{
    for (int k = 0; k < PAIRS; k++)
        own->slope[k] /= 0.5 * M_PI;
}

sp_drop_wavefront sp_wavefront_at_moment(const sp_wavefronts *fronts, size_t i, unsigned terms, double elevation)
{
    const double(*sum)[SP_FRONT_DATA] = (const double(*)[SP_FRONT_DATA])fronts->sum + i * fronts->most;
    polynomial p = first_polynomial(elevation);
    sums own = {0};
    for (unsigned n = 0; n < terms; n++, advance(&p))
        add(&own, sum[n], &p);
    finish(&own);
    const double *value = (const double *)own.value, *slope = (const double *)own.slope;
    return (sp_drop_wavefront){value[0], value[1], slope[0], value[3], value[4], slope[3]};
}

/* Of moments i and i + 1, by the same polynomials. */
static void sum_up(const sp_wavefronts *fronts, size_t i, double elevation, sums both[2])
{
    const double(*from)[SP_FRONT_DATA] = (const double(*)[SP_FRONT_DATA])fronts->sum + i * fronts->most;
    const double(*to)[SP_FRONT_DATA] = from + fronts->most;
    unsigned terms[2] = {fronts->terms[i], fronts->terms[i + 1]}, common = terms[0] < terms[1] ? terms[0] : terms[1];
    polynomial p = first_polynomial(elevation);
    sums first = {0}, second = {0};
    unsigned n = 0;
    for (; n < common; n++, advance(&p)) {
        add(&first, from[n], &p);
        add(&second, to[n], &p);
    }
    for (; n < terms[0]; n++, advance(&p))
        add(&first, from[n], &p);
    for (; n < terms[1]; n++, advance(&p))
        add(&second, to[n], &p);
    finish(&first);
    finish(&second);
    both[0] = first;
    both[1] = second;
}

/* The polynomials of order 5 that give value, first and second derivative at either end of a step of length 1. */
static void quintic(double x, double weight[6])
{
    double x2 = x * x, x3 = x2 * x;
    weight[3] = x3 * (10 - 15 * x + 6 * x2);
    weight[4] = x3 * (-4 + 7 * x - 3 * x2);
    weight[5] = x3 * (0.5 - x + 0.5 * x2);
    weight[0] = 1 - weight[3];
    weight[1] = x + x3 * (-6 + 8 * x - 3 * x2);
    weight[2] = 0.5 * x2 + x3 * (-1.5 + 1.5 * x - 0.5 * x2);
}

static void quintic_slope(double x, double weight[6])
{
    double x2 = x * x;
    weight[3] = x2 * (30 - 60 * x + 30 * x2);
    weight[4] = x2 * (-12 + 28 * x - 15 * x2);
    weight[5] = x2 * (1.5 - 4 * x + 2.5 * x2);
    weight[0] = -weight[3];
    weight[1] = 1 + x2 * (-18 + 32 * x - 15 * x2);
    weight[2] = x + x2 * (-4.5 + 6 * x - 2.5 * x2);
}

static double blend(const double weight[6], double step, const double *from, const double *to)
{
    return weight[0] * from[0] + weight[3] * to[0] +
           step * (weight[1] * from[1] + weight[4] * to[1] + step * (weight[2] * from[2] + weight[5] * to[2]));
}

sp_drop_wavefront sp_wavefront_between(const sp_wavefronts *fronts, size_t i, double time, double elevation)
{
    double step = fronts->time[i + 1] - fronts->time[i], x = (time - fronts->time[i]) / step;
    double weight[6], change[6];
    sums both[2];
    sum_up(fronts, i, elevation, both);
    const double *from = (const double *)both[0].value, *to = (const double *)both[1].value;
    const double *turn_from = (const double *)both[0].slope, *turn_to = (const double *)both[1].slope;
    quintic(x, weight);
    quintic_slope(x, change);
    return (sp_drop_wavefront){.q = blend(weight, step, from, to),
                               .q_time = blend(change, step, from, to) / step,
                               .q_turn = blend(weight, step, turn_from, turn_to),
                               .d = blend(weight, step, from + 3, to + 3),
                               .d_time = blend(change, step, from + 3, to + 3) / step,
                               .d_turn = blend(weight, step, turn_from + 3, turn_to + 3)};
}

size_t sp_wavefront_moment_before(const sp_wavefronts *fronts, double time)
{
    size_t low = 0, high = fronts->count - 1;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if (fronts->time[middle] <= time)
            low = middle;
        else
            high = middle;
    }
    return low;
}

void sp_wavefront_polynomials(const sp_wavefronts *fronts, double elevation, double *polynomials)
{
    double at = elevation / (0.5 * M_PI);
    polynomials[0] = 1;
    polynomials[1] = at;
    for (unsigned n = 2; n < fronts->most; n++)
        polynomials[n] = 2 * at * polynomials[n - 1] - polynomials[n - 2];
}

static void data_at(const sp_wavefronts *fronts, size_t i, const double *polynomials, double data[SP_FRONT_DATA])
{
    const double(*sum)[SP_FRONT_DATA] = (const double(*)[SP_FRONT_DATA])fronts->sum + i * fronts->most;
    for (int k = 0; k < SP_FRONT_DATA; k++)
        data[k] = 0;
    for (unsigned n = 0; n < fronts->terms[i]; n++)
        for (int k = 0; k < SP_FRONT_DATA; k++)
            data[k] += polynomials[n] * sum[n][k];
}

sp_wavefront_place sp_wavefront_place_between(const sp_wavefronts *fronts, double time, const double *polynomials)
{
    size_t i = sp_wavefront_moment_before(fronts, time);
    double step = fronts->time[i + 1] - fronts->time[i];
    double from[SP_FRONT_DATA], to[SP_FRONT_DATA], weight[6];
    data_at(fronts, i, polynomials, from);
    data_at(fronts, i + 1, polynomials, to);
    quintic((time - fronts->time[i]) / step, weight);
    return (sp_wavefront_place){blend(weight, step, from, to), blend(weight, step, from + 3, to + 3)};
}

/* A front that is out by more than it has sunk and an end is far has all of the end's ball within it: low arcs have
 * come there by then, and high arcs have not. Of a high arc q ≤ far + |d| later on, and q is no less than then. */
bool sp_wavefronts_sinking(const sp_wavefronts *fronts, double far, double *low, double *high)
{
    const sp_wavefront_bound *bound = fronts->bound;
    size_t first = 0, last = fronts->count;
    while (first < fronts->count && !(bound[first].out - bound[first].sunk >= far))
        first++;
    while (last > first && !(bound[last - 1].out - bound[last - 1].sunk >= far))
        last--;
    if (last == first)
        return false;
    *low = bound[first].sunk * (1 + SLACK);
    *high = sp_length(fronts->gravity) > 0 ? (bound[last - 1].out - far) * (1 - SLACK) : INFINITY;
    return true;
}
