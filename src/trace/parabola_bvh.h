/* Parabolas through the wide hierarchy. */
#ifndef SPRAYPLAN_TRACE_PARABOLA_BVH_H
#define SPRAYPLAN_TRACE_PARABOLA_BVH_H

#include "trace/bvh.h"
#include "trace/instructions.h"
#include "trace/parabola.h"

/* A piece of a flight in the hierarchy's space, on which no coordinate turns and none leaves -1.02..1.02 by much:
 * x(way) = origin + direction way + bend way² for 0 <= way <= last <= 4.2, at no time faster than 1 along an axis. In
 * that span every coordinate is between its chord and the parallel that touches it. */
typedef struct {
    float origin[3], direction[3], bend[3];
    int axis[3]; /* steep, then the others: steep is the one of gravity's largest component */
    /* All by place in `axis`: */
    uint32_t near[3]; /* where in a node the bounds begin that are passed first, bytes */
    float inverse[3]; /* of the chord's slope, at most 2^60 */
    float sooner[3];  /* where a line of that slope begins that is never later at a plane than the flight */
    float later[3];   /* what to add to its way for one that is never sooner */
    float sign;       /* of the motion along the steep axis */
    float last;       /* hits have no longer way, margin included */
    float surely_first, surely_last; /* whatever has a way between these is within the time asked for */
    double start, rate;              /* way = (t - start) rate */
} sp_bvh_arc;

typedef struct {
    const sp_bvh *bvh;
    const sp_ray *ray;
    const sp_pull *pull;
    sp_search *search;
    sp_bvh_arc arc;
    bool ready; /* `parabola` is: it is needed only where single precision does not decide */
    sp_parabola parabola;
} sp_bvh_jet;

/* Searches what the flight passes. */
void sp_parabola_search_bvh(const sp_bvh *bvh, const sp_ray *ray, const sp_pull *pull, sp_instructions instructions,
                            sp_search *search);

/* Puts a hit at time t, and what comes after it, out of the search's reach. */
static inline void sp_bvh_arc_shorten(sp_bvh_arc *arc, double limit)
{
    arc->last = (float)sp_lesser(arc->last, (limit - arc->start) * arc->rate + SP_BVH_PAD);
}
/* The test in double precision. */
void sp_bvh_jet_test(sp_bvh_jet *jet, uint32_t triangle);

/* Makes ready the piece of the flight from `from` to `to` (s), on which the coordinate does not turn along any axis;
 * cuts it to the box. 1 when it is ready, 0 when it is nowhere in the box, -1 when single precision will not do. */
int sp_bvh_arc_prepare(sp_bvh_arc *arc, const sp_bvh *bvh, const sp_ray *ray, const sp_pull *pull, double from,
                       double to);

/* The kernel, one for each set of instructions. */
void sp_bvh_parabola_portable(sp_bvh_jet *jet);
void sp_bvh_parabola_avx2(sp_bvh_jet *jet);
void sp_bvh_parabola_avx512(sp_bvh_jet *jet);

#endif
