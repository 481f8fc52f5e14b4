/* The rays of one mode, sorted or not, in the numbers that the accelerators get. */
#ifndef CLI_BENCH_SETS_H
#define CLI_BENCH_SETS_H

#include "bench.h"

/* The kd-trees and the bare loop get fewer rays, spread evenly over all: they would take most of the time. */
typedef enum { SIZE_FULL, SIZE_TREE, SIZE_LOOP, SIZES } bench_size;

typedef struct {
    size_t count;
    sp_ray *rays;        /* [count] */
    uint32_t *order;     /* [count], where each stands among all rays */
    double (*span)[2];   /* [count], s, of parabolas */
    double sort_seconds; /* median */
} bench_set;

typedef struct {
    bench_mode mode;
    bench_trajectory trajectory;
    bool sorted;
    sp_vec3 gravity;
    bench_set sets[SIZES];
} bench_case;

bool bench_case_create(bench_case *made, const bench_stage *stage, const sp_ray *rays, size_t count, bench_mode mode,
                       bench_trajectory trajectory, bool sorted);
void bench_case_clear(bench_case *made);

#endif
