/* Parabolas through the wide hierarchy. */
#ifndef SPRAYPLAN_TRACE_PARABOLA_BVH_H
#define SPRAYPLAN_TRACE_PARABOLA_BVH_H

#include "trace/bvh/bvh.h"
#include "trace/bvh/instructions.h"
#include "trace/parabola/parabola_hits.h"

/* Coordinates in the hierarchy's space up to which the fast walk goes: some more than the boxes with their padding. */
#define SP_BVH_LIMIT (1 + 0x1p-6)
/* What positions may be summed from, in that space: 2^18 SP_PARABOLA_ROUNDING is 4 units of single precision at 1. */
#define SP_BVH_SUMMED 0x1p18

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
    float later[3];    /* what to add to its way for one that is never sooner; 0 without gravity along the axis */
    float sign;        /* of the motion along the steep axis */
    bool aligned;      /* gravity is along the steep axis alone */
    float sag;         /* the most that bend is along an axis */
    float last;        /* hits have no longer way, margin included */
    uint32_t diagonal; /* which of a node's orders, twice, and 1 where it is to be reversed */
    float surely_first, surely_last; /* whatever has a way between these is within this piece */
    double start, rate;              /* way = (t - start) rate */
} sp_bvh_arc;

/* One coordinate of a flight in the hierarchy's space: place + t (speed + t acceleration/2). */
typedef struct {
    double place, speed, acceleration;
    double inverse; /* 1 / speed, where there is no acceleration */
} sp_bvh_course;

/* One flight on its way through the hierarchy, one piece of it after another: what it still has to visit is on its
 * stack. */
typedef struct {
    sp_bvh_arc arc;
    const sp_ray *asked;
    uint32_t number;   /* which ray it is */
    uint32_t triangle; /* the best so far: as the search says, or surely hit later than way `low` and before arc.last */
    float low;
    bool ending;         /* what is needed for the answer has been prefetched */
    bool parabola_ready; /* it is needed only where single precision does not decide */
    bool course_ready;   /* it is needed only for later pieces */
    bool later;          /* there is more of the flight after this piece, */
    double to, last;     /* from when on, and to when, s */
    sp_bvh_course course[3];
    double summed, speed, strength; /* the largest place and speed along an axis; of gravity */
    sp_ray_search search;
    sp_parabola parabola;
    int height;
    uint32_t child[SP_BVH_STACK + SP_BVH_WIDTH];
    float from[SP_BVH_STACK + SP_BVH_WIDTH], until[SP_BVH_STACK + SP_BVH_WIDTH]; /* when it may be in its box, ways */
} sp_parabola_flight;

/* The pieces with which flights begin, made ready many at a time, where gravity is along an axis: what
 * sp_parabola_flight_prepare and sp_bvh_arc_prepare make of them, to the last bit. By axis: steep one, and the others
 * as in sp_bvh_arc. */
enum { SP_BVH_STARTS = 16 };
typedef struct {
    uint32_t ray[SP_BVH_STARTS]; /* its number among the rays */
    int count, next;             /* next: the first that is not yet on its way */
    int64_t fits[SP_BVH_STARTS]; /* sp_bvh_fitness; SP_BVH_FAR for all that is not usual */
    int64_t later[SP_BVH_STARTS];
    double to[SP_BVH_STARTS], end[SP_BVH_STARTS]; /* sp_parabola_flight.to and .last */
    double start[SP_BVH_STARTS], rate[SP_BVH_STARTS];
    float origin[3][SP_BVH_STARTS], direction[3][SP_BVH_STARTS], inverse[3][SP_BVH_STARTS];
    float bend[SP_BVH_STARTS], sooner[SP_BVH_STARTS], behind[SP_BVH_STARTS]; /* behind: sp_bvh_arc.later */
    float last[SP_BVH_STARTS], surely_first[SP_BVH_STARTS], surely_last[SP_BVH_STARTS];
    int64_t falls[3][SP_BVH_STARTS];
} sp_bvh_starts;

/* So many flights are on their way at once, each a step at a time. */
enum { SP_PARABOLA_FLIGHTS = 8 };

/* Rays to be traced, and where their answers go: hits, or occluded where that is NULL. */
typedef struct sp_parabola_queue sp_parabola_queue;
struct sp_parabola_queue {
    const sp_bvh *bvh;
    const sp_acceleration *acceleration;
    const sp_ray *rays;
    const uint32_t *order; /* [count], numbers among the rays */
    size_t count, next;    /* next: the first not yet begun nor among the starts */
    sp_hit *hits;
    bool *occluded;
    int axis[3]; /* as in sp_bvh_arc */
    bool aligned;
    sp_bvh_starts starts;
    void (*prepare)(const sp_parabola_queue *, sp_bvh_starts *);
    void (*compute)(const sp_parabola_pairs *, sp_hit *);
    sp_parabola_pairs pairs; /* hits to be computed */
};

/* Traces the rays of these numbers, each by itself. */
void sp_bvh_trace_parabolas(const sp_bvh *bvh, sp_instructions instructions, const sp_ray *rays, const uint32_t *order,
                            size_t count, const sp_acceleration *acceleration, sp_hit *hits, bool *occluded);

/* Lets the next flight begin that has to; false where there is none. */
bool sp_parabola_queue_begin(sp_parabola_queue *queue, sp_parabola_flight *flight);
/* Called where nothing of this piece is left to visit. False where the flight is at its end. */
bool sp_parabola_flight_go_on(const sp_parabola_queue *queue, sp_parabola_flight *flight);
/* Answers for a flight that is at its end. */
void sp_parabola_queue_end(sp_parabola_queue *queue, sp_parabola_flight *flight);
/* Asks double precision about a triangle and the best so far. */
void sp_parabola_flight_settle(const sp_parabola_queue *queue, sp_parabola_flight *flight, uint32_t triangle);

typedef enum {
    SP_BVH_NOWHERE, /* the flight is nowhere in the box */
    SP_BVH_READY,
    SP_BVH_FAR, /* single precision will not do */
} sp_bvh_fitness;

/* The axes in order, gravity's largest component first. True where gravity is along that alone. */
bool sp_bvh_order_axes(const sp_acceleration *acceleration, int axis[3]);
/* Makes the flight ready and cuts from..to (s) to the box along the axes without gravity. */
sp_bvh_fitness sp_parabola_flight_prepare(const sp_bvh *bvh, const sp_acceleration *acceleration,
                                          sp_parabola_flight *flight, double *from, double *to);
/* Makes the piece of it from `from` to `to` ready, on which no coordinate turns, and cuts it to the box. */
sp_bvh_fitness sp_bvh_arc_prepare(const sp_acceleration *acceleration, sp_parabola_flight *flight, double from,
                                  double to);

/* Makes number i of the starts an arc. */
void sp_bvh_start_take(const sp_parabola_queue *queue, int i, sp_bvh_arc *arc);

/* Fills the starts in, whose rays are noted; one for each set of instructions. */
void sp_bvh_prepare_starts_portable(const sp_parabola_queue *queue, sp_bvh_starts *starts);
void sp_bvh_prepare_starts_avx2(const sp_parabola_queue *queue, sp_bvh_starts *starts);
void sp_bvh_prepare_starts_avx512(const sp_parabola_queue *queue, sp_bvh_starts *starts);
/* The kernel, likewise: all rays, flights being room for so many at once. */
void sp_bvh_parabolas_portable(sp_parabola_queue *queue, sp_parabola_flight *flights, int most);
void sp_bvh_parabolas_avx2(sp_parabola_queue *queue, sp_parabola_flight *flights, int most);
void sp_bvh_parabolas_avx512(sp_parabola_queue *queue, sp_parabola_flight *flights, int most);

#endif
