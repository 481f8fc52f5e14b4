/* Lines through the wide hierarchy. */
#ifndef SPRAYPLAN_TRACE_LINE_BVH_H
#define SPRAYPLAN_TRACE_LINE_BVH_H

#include "trace/bvh.h"
#include "trace/instructions.h"
#include "trace/line.h"

/* A line in the hierarchy's space: x(way) = origin + direction way, where direction is ±1 along its longest axis. */
typedef struct {
    float origin[3];
    float inverse[3];       /* 1 / direction, at most 2^60 */
    uint32_t near[3];       /* where in a node the bounds begin that the line passes first along each axis, bytes */
    int x, y, z;            /* axes as of sp_line */
    float shear_x, shear_y; /* as of sp_line */
    float sign;             /* of the direction along z */
    float blur;             /* how far rounding may move a sheared corner */
    float first, last;      /* hits have a way between these, margins included */
    float surely_first, surely_last; /* whatever has a way between these is within the time asked for */
    double start, rate;              /* way = (t - start) rate */
} sp_bvh_line;

typedef struct {
    const sp_bvh *bvh;
    const sp_line *line;
    sp_bvh_line ray;
    sp_search *search;
} sp_bvh_flight;

/* Searches what the line passes. */
void sp_line_search_bvh(const sp_line *line, const sp_bvh *bvh, sp_instructions instructions, sp_search *search);

/* Puts a hit at time t, and what comes after it, out of the search's reach. */
static inline void sp_bvh_line_shorten(sp_bvh_line *ray, double limit)
{
    ray->last = sp_lesser(ray->last, (float)((limit - ray->start) * ray->rate) + SP_BVH_PAD);
}

/* The kernel, one for each set of instructions. */
void sp_bvh_line_portable(sp_bvh_flight *flight);
void sp_bvh_line_avx2(sp_bvh_flight *flight);
void sp_bvh_line_avx512(sp_bvh_flight *flight);

#endif
