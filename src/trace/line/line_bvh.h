/* Lines through the wide hierarchy. */
#ifndef SPRAYPLAN_TRACE_LINE_BVH_H
#define SPRAYPLAN_TRACE_LINE_BVH_H

#include "trace/bvh/bvh.h"
#include "trace/bvh/direction_order.h"
#include "trace/bvh/instructions.h"
#include "trace/ray/line.h"

/* Lines that come from farther away, in the hierarchy's space, than single precision is good for begin near the box. */
#define SP_BVH_NEAR_ENOUGH 7.0
/* No way within the box is longer, for an origin that is near enough. */
#define SP_BVH_LONGEST 16.0

/* A line in the hierarchy's space: x(way) = origin + direction way, where direction is ±1 along its longest axis. */
typedef struct {
    float origin[3];
    float inverse[3];  /* 1 / direction, at most 2^60 */
    uint32_t near[3];  /* where in a node the bounds begin that the line passes first along each axis, bytes */
    uint32_t diagonal; /* which of a node's orders, twice, and 1 where it is to be reversed */
    uint32_t x, y, z;  /* axes as of sp_line */
    float direction[3];
    float sign;                      /* of the direction along z */
    float blur;                      /* how far rounding may move a sheared corner */
    float first, last;               /* hits have a way between these, margins included */
    float surely_first, surely_last; /* whatever has a way between these is within the time asked for */
    double start, rate;              /* way = (t - start) rate */
    uint32_t number;                 /* which ray it is */
    uint32_t skip;
} sp_bvh_line;

/* What is to be known of a block's triangles: those that may be hit, and those that surely are. */
typedef struct {
    uint32_t maybe, surely;
    float low[8], high[8]; /* of those surely hit: where */
} sp_bvh_verdict;

/* One line on its way through the hierarchy: what it still has to visit is on its stack. */
typedef struct {
    sp_bvh_line ray;
    uint32_t current;  /* what it visits */
    uint32_t triangle; /* the best so far, surely hit */
    float low;         /* no sooner than here; and no later than ray.last */
    int height;
    sp_bvh_verdict found;
    bool in_doubt; /* double precision has been asked: the next two are ready */
    sp_line line;
    sp_ray_search search;
    uint32_t child[SP_BVH_STACK + SP_BVH_WIDTH];
    float way[SP_BVH_STACK + SP_BVH_WIDTH]; /* where the line enters */
} sp_line_flight;

/* Rays to be traced, in this order or another, and where their answers go: hits, or occluded where that is NULL. */
typedef struct {
    const sp_bvh *bvh;
    const sp_ray *rays;
    const sp_direction_entry *order; /* [count], or NULL */
    size_t count, next;              /* next: the first not yet begun */
    sp_hit *hits;
    bool *occluded;
} sp_line_queue;

/* For a line from afar, or that begins before time 0: where it comes near the box, in the hierarchy's space, and at
 * what time; false where it never does. Infinitely far where single precision would not do there either. */
bool sp_bvh_line_begin(const sp_bvh *bvh, const sp_ray *ray, double place[3], double *start);
/* Traces a line in double precision. */
sp_hit sp_bvh_line_walk(const sp_bvh *bvh, const sp_ray *ray, bool any);
/* What double precision makes of a line and a triangle. */
sp_hit sp_bvh_line_ask(const sp_bvh *bvh, const sp_ray *ray, uint32_t triangle);
/* Asks double precision about a triangle and the best so far. */
void sp_line_flight_settle(const sp_line_queue *queue, sp_line_flight *flight, uint32_t triangle);

/* Traces rays, each by itself; `order` as in sp_line_queue. */
void sp_bvh_trace_lines(const sp_bvh *bvh, sp_instructions instructions, const sp_ray *rays,
                        const sp_direction_entry *order, size_t count, sp_hit *hits, bool *occluded);

/* The kernels, one for each set of instructions: sixteen lines at a time, and one at a time. */
void sp_bvh_lines_portable(sp_line_queue *queue);
void sp_bvh_lines_avx2(sp_line_queue *queue);
void sp_bvh_lines_avx512(sp_line_queue *queue);
void sp_bvh_lines_single_portable(sp_line_queue *queue);
void sp_bvh_lines_single_avx2(sp_line_queue *queue);
void sp_bvh_lines_single_avx512(sp_line_queue *queue);

#endif
