/* Parabolas through the wide hierarchy. */
#ifndef SPRAYPLAN_TRACE_PARABOLA_BVH_H
#define SPRAYPLAN_TRACE_PARABOLA_BVH_H

#include "trace/bvh.h"
#include "trace/instructions.h"
#include "trace/parabola.h"

/* A piece of a flight in the hierarchy's space, on which no coordinate turns and none leaves -1.02..1.02 by much:
 * x(way) = origin + direction way + bend way² for 0 <= way <= last, at no time faster than 1 along an axis, and
 * speed last is at most 4.2, speed being what it is at its fastest. In that span every coordinate is between its chord
 * and the parallel that touches it. */
typedef struct {
    float origin[3], direction[3], bend[3];
    int axis[3]; /* steep, then the others: steep is the one of gravity's largest component */
    /* All by place in `axis`: */
    uint32_t near[3], far[3]; /* where in a node the bounds begin that are passed first and last, bytes */
    float inverse[3];         /* of the chord's slope, at most 2^60 */
    float sooner[3];          /* where a line of that slope begins that is never later at a plane than the flight */
    float later[3]; /* what to add to its way for one that is never sooner; 0 without gravity along the axis */
    float sign;     /* of the motion along the steep axis */
    bool aligned;   /* gravity is along the steep axis alone */
    float sag;      /* the most that bend is along an axis */
    float last;     /* hits have no longer way, margin included */
    float surely_first, surely_last; /* whatever has a way between these is within the time asked for */
    double start, rate;              /* way = (t - start) rate */
} sp_bvh_arc;

/* One coordinate of a flight in the hierarchy's space: place + t (speed + t pull/2). */
typedef struct {
    double place, speed, pull;
    double inverse; /* 1 / speed, where there is no pull */
} sp_bvh_course;

typedef struct {
    const sp_bvh *bvh;
    const sp_ray *ray;
    const sp_pull *pull;
    sp_search *search;
    sp_bvh_course course[3];
    double summed, speed, strength; /* the largest place and speed along an axis; of gravity */
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
    arc->last = (float)sp_lesser(arc->last, (limit - arc->start) * arc->rate + 0x1p-20);
}
/* The test in double precision. */
void sp_bvh_jet_test(sp_bvh_jet *jet, uint32_t triangle);

typedef enum {
    SP_BVH_NOWHERE, /* the flight is nowhere in the box */
    SP_BVH_READY,
    SP_BVH_FAR, /* single precision will not do */
} sp_bvh_fitness;

/* Makes the flight ready and cuts from..to (s) to the box along the axes without gravity. */
sp_bvh_fitness sp_bvh_jet_prepare(sp_bvh_jet *jet, double *from, double *to);
/* Makes the piece of it from `from` to `to` ready, on which no coordinate turns, and cuts it to the box. */
sp_bvh_fitness sp_bvh_arc_prepare(sp_bvh_jet *jet, double from, double to);

/* The kernel, one for each set of instructions. */
void sp_bvh_parabola_portable(sp_bvh_jet *jet);
void sp_bvh_parabola_avx2(sp_bvh_jet *jet);
void sp_bvh_parabola_avx512(sp_bvh_jet *jet);

#endif
