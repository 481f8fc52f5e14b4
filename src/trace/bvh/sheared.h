/* Blocks as what flies along a line sees them. For the kernels, which are compiled once for each set of instructions.
 */
#ifndef SPRAYPLAN_TRACE_SHEARED_H
#define SPRAYPLAN_TRACE_SHEARED_H

#include "trace/bvh/bvh.h"
#include "trace/bvh/wide.h"

/* From where, and which way: along axis z, with that sign, by so much along x and y for each unit of it. */
typedef struct {
    int x, y, z; /* axes */
    float origin[3], slope[2], sign;
} view;

/* The corners, sheared so that the way goes straight along z; z is how far along it they are. */
typedef struct {
    wide x[3], y[3], z[3];
} sheared;

static inline sheared shear_block(const sp_bvh_block *block, view v)
{
    sheared s;
    for (int i = 0; i < 3; i++) {
        wide x = wide_subtract(wide_load(block->corner[i][v.x]), wide_set(v.origin[0]));
        wide y = wide_subtract(wide_load(block->corner[i][v.y]), wide_set(v.origin[1]));
        wide z = wide_subtract(wide_load(block->corner[i][v.z]), wide_set(v.origin[2]));
        s.z[i] = wide_multiply(z, wide_set(v.sign));
        s.x[i] = wide_subtract_product(x, wide_set(v.slope[0]), s.z[i]);
        s.y[i] = wide_subtract_product(y, wide_set(v.slope[1]), s.z[i]);
    }
    return s;
}

static inline wide least_of(const wide a[3])
{
    return wide_lesser(wide_lesser(a[0], a[1]), a[2]);
}
static inline wide largest_of(const wide a[3])
{
    return wide_greater(wide_greater(a[0], a[1]), a[2]);
}

/* The largest amount of any corner's x or y. */
static inline wide breadth_of(const sheared *s)
{
    return wide_greater_amount(
        wide_greater_amount(wide_greater_amount(s->x[0], s->y[0]), wide_greater_amount(s->x[1], s->y[1])),
        wide_greater_amount(s->x[2], s->y[2]));
}

/* The barycentric weights, not yet divided by their sum, by which the way meets the triangles, all of one sign where it
 * does, and what rounding and `blur`, by which corners may be moved, may change about them: derived in line_step.h. */
typedef struct {
    wide weight[3], least, largest, error;
    uint32_t inside; /* those that the way may meet */
} barycentric;

static inline barycentric barycentric_sheared(const sheared *s, float blur)
{
    barycentric w;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        w.weight[i] = wide_subtract_product(wide_multiply(s->x[k], s->y[j]), s->y[k], s->x[j]);
    }
    wide most = breadth_of(s);
    w.error = wide_multiply_add(most, wide_multiply_add(most, wide_set(5 * 0x1p-24f), wide_set(4 * blur)),
                                wide_set(2 * blur * blur + 0x1p-120f));
    w.least = least_of(w.weight);
    w.largest = largest_of(w.weight);
    w.inside = wide_at_most(wide_subtract(wide_set(0), w.error), w.least) | wide_at_most(w.largest, w.error);
    return w;
}

/* How far along the way meets the triangles, the inverse of the weights' sum, and which of them it surely meets. */
static inline uint32_t meet_sheared(const sheared *s, const barycentric *w, wide *depth, wide *inverse)
{
    wide sum = wide_add(wide_add(w->weight[0], w->weight[1]), w->weight[2]);
    *inverse = wide_divide(wide_set(1), sum);
    *depth = wide_multiply_add(w->weight[1], s->z[1], wide_multiply(w->weight[2], s->z[2]));
    *depth = wide_multiply(wide_multiply_add(w->weight[0], s->z[0], *depth), *inverse);
    return (wide_at_most(w->error, w->least) | wide_at_most(w->largest, wide_subtract(wide_set(0), w->error))) &
           wide_at_most(wide_multiply(w->error, wide_set(8)), wide_absolute(sum));
}

/* Of many ways whose slopes are the view's and at most `half` more or less: the triangles that some may meet, by what
 * is to the left and right of all, below and above. */
static inline uint32_t meet_breadth(const sheared *s, wide half_u, wide half_v, float blur)
{
    wide left = wide_set(-INFINITY), right = wide_set(INFINITY), below = left, above = right;
    for (int i = 0; i < 3; i++) {
        wide away = wide_absolute(s->z[i]);
        left = wide_greater(left, wide_multiply_add(half_u, away, s->x[i]));
        right = wide_lesser(right, wide_subtract_product(s->x[i], half_u, away));
        below = wide_greater(below, wide_multiply_add(half_v, away, s->y[i]));
        above = wide_lesser(above, wide_subtract_product(s->y[i], half_v, away));
    }
    wide most = wide_set(blur), least = wide_set(-blur);
    return wide_at_most(least, left) & wide_at_most(right, most) & wide_at_most(least, below) &
           wide_at_most(above, most);
}

/* The weights of ways whose slopes are u and v more than the view's: constant + by_u u + by_v v. */
typedef struct {
    float constant[3][8], by_u[3][8], by_v[3][8];
} weights;

/* `least` is at least the least of the weights of all ways whose slopes are at most `half` more or less, `largest`
 * likewise. */
static inline void form_weights(const sheared *s, wide half_u, wide half_v, weights *w, wide *least, wide *largest)
{
    *least = wide_set(INFINITY);
    *largest = wide_set(-INFINITY);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        wide constant = wide_subtract_product(wide_multiply(s->x[k], s->y[j]), s->y[k], s->x[j]);
        wide by_u = wide_subtract_product(wide_multiply(s->y[k], s->z[j]), s->z[k], s->y[j]);
        wide by_v = wide_subtract_product(wide_multiply(s->z[k], s->x[j]), s->x[k], s->z[j]);
        wide spread = wide_multiply_add(half_u, wide_absolute(by_u), wide_multiply(half_v, wide_absolute(by_v)));
        *least = wide_lesser(*least, wide_add(constant, spread));
        *largest = wide_greater(*largest, wide_subtract(constant, spread));
        wide_store(w->constant[i], constant);
        wide_store(w->by_u[i], by_u);
        wide_store(w->by_v[i], by_v);
    }
}

/* The barycentric weights of eight ways in triangle i, likewise. */
static inline void barycentric_of_ways(const weights *w, int i, wide u, wide v, wide weight[3])
{
    for (int k = 0; k < 3; k++)
        weight[k] = wide_multiply_add(u, wide_set(w->by_u[k][i]),
                                      wide_multiply_add(v, wide_set(w->by_v[k][i]), wide_set(w->constant[k][i])));
}

#endif
