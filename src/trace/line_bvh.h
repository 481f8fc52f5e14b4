/* Lines through the wide hierarchy. */
#ifndef SPRAYPLAN_TRACE_LINE_BVH_H
#define SPRAYPLAN_TRACE_LINE_BVH_H

#include "trace/bvh.h"
#include "trace/instructions.h"
#include "trace/line.h"

/* A line in the hierarchy's space: x(way) = origin + direction way, where direction is ±1 along its longest axis. */
typedef struct {
    float origin[3];
    float inverse[3];  /* 1 / direction, at most 2^60 */
    uint32_t near[3];  /* where in a node the bounds begin that the line passes first along each axis, bytes */
    uint32_t diagonal; /* which of a node's orders, twice, and 1 where it is to be reversed */
    int x, y, z;       /* axes as of sp_line */
    float direction[3];
    float sign;                      /* of the direction along z */
    float blur;                      /* how far rounding may move a sheared corner */
    float first, last;               /* hits have a way between these, margins included */
    float surely_first, surely_last; /* whatever has a way between these is within the time asked for */
    double start, rate;              /* way = (t - start) rate */
} sp_bvh_line;

/* One line on its way through the hierarchy: what it still has to visit is on its stack. */
typedef struct {
    sp_bvh_line ray;
    const sp_ray *asked;
    size_t number;     /* which ray it is */
    uint32_t triangle; /* the best so far, surely hit */
    float low;         /* no sooner than here; and no later than ray.last */
    bool ending;       /* what is needed for the answer has been sent for */
    bool line_ready;
    sp_line line; /* for double precision, once that is needed */
    sp_search search;
    int height;
    uint32_t child[SP_BVH_STACK + SP_BVH_WIDTH];
    float way[SP_BVH_STACK + SP_BVH_WIDTH]; /* where the line enters */
} sp_bvh_flight;

/* So many lines are on their way at once, each a step at a time, so that one's step waits neither for its own last one
 * nor for memory. */
enum { SP_BVH_FLIGHTS = 8 };

/* Rays to be traced, and where their answers go: hits, or occluded where that is NULL. */
typedef struct {
    const sp_bvh *bvh;
    const sp_ray *rays;
    size_t count, next; /* next: the first not yet begun */
    sp_hit *hits;
    bool *occluded;
} sp_bvh_stream;

/* Lets the next ray of the stream begin that has to; false where there is none. */
bool sp_bvh_stream_begin(sp_bvh_stream *stream, sp_bvh_flight *flight);
/* Answers for a flight that is at its end. */
void sp_bvh_stream_end(const sp_bvh_stream *stream, sp_bvh_flight *flight);
/* Asks double precision about a triangle and the best so far. */
void sp_bvh_flight_settle(const sp_bvh *bvh, sp_bvh_flight *flight, uint32_t triangle);

/* Traces rays, each by itself. */
void sp_bvh_trace_lines(const sp_bvh *bvh, sp_instructions instructions, const sp_ray *rays, size_t count, sp_hit *hits,
                        bool *occluded);

/* The kernel, one for each set of instructions. */
void sp_bvh_lines_portable(sp_bvh_stream *stream, sp_bvh_flight *flights);
void sp_bvh_lines_avx2(sp_bvh_stream *stream, sp_bvh_flight *flights);
void sp_bvh_lines_avx512(sp_bvh_stream *stream, sp_bvh_flight *flights);

#endif
