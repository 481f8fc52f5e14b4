/* Flights with drag as chains of parabolas, each with an acceleration of its own, for the tracer. */
#ifndef SPRAY_DRAG_CHAIN_H
#define SPRAY_DRAG_CHAIN_H

#include "wavefronts.h"

typedef struct {
    sp_ray ray;           /* from its start to its end, by its own clock */
    sp_vec3 acceleration; /* m/s² */
    double start;         /* s, when it begins */
    bool last;
} sp_arc_piece;

/* A flight that was found on the fronts, while it is gone along. */
typedef struct {
    const sp_wavefronts *fronts;
    sp_vec3 from, level; /* m; unit, or 0 straight up and down */
    double sine, cosine;
    double polynomials[SP_FRONT_ORDER]; /* at its elevation */
    double time;                        /* s, that it takes */
    size_t next;                        /* joint */
    sp_vec3 at;                         /* m, where the next piece begins */
} sp_chain;

sp_chain sp_chain_of(const sp_wavefronts *fronts, sp_vec3 from, const sp_flight *flight);
/* The next piece; false behind the last. */
bool sp_chain_next(sp_chain *chain, sp_arc_piece *piece);

/* What a drop may meet. */
typedef struct {
    const sp_tracer *tracer;
    sp_vec3 offset;     /* m, from where its mesh has it */
    const sp_vec3 *box; /* [2], m, of its mesh */
    uint32_t skip;      /* triangle, or SP_NONE */
} sp_obstacle;

/* What a drop meets first, and how. */
typedef struct {
    sp_hit hit;   /* its t by the piece's own clock */
    int obstacle; /* of what may be met, the first of those that are met at once */
    sp_arc_piece piece;
    sp_vec3 velocity; /* m/s */
    double time;      /* s, since it started */
} sp_landing;

/* Flies a drop from its ray's start until it meets an obstacle, or leaves them all for good. A ray says where and from
 * when a drop can meet something. */
sp_landing sp_drag_trace(const sp_obstacle *obstacles, int count, const sp_drag *drag, const sp_ray *ray,
                         sp_vec3 gravity);
/* The same of many and one mesh, as rays say what is not met. landings: [count], the caller's. */
void sp_drag_trace_many(const sp_tracer *tracer, const sp_drag *drag, const sp_ray *rays, size_t count, sp_vec3 gravity,
                        int threads, sp_landing *landings);

#endif
