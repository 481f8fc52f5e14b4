/* Parabolas of one origin that fly close together, and are searched together. */
#ifndef SPRAYPLAN_TRACE_VOLLEY_H
#define SPRAYPLAN_TRACE_VOLLEY_H

#include "trace/bvh/bvh.h"
#include "trace/bvh/instructions.h"
#include "trace/parabola/parabola_hits.h"

enum { SP_VOLLEY = SP_PARABOLA_HITS };

/* In the hierarchy's space jet i is at origin + direction[i] way + bend way² (along the steep axis), where the bend is
 * the same for all: they differ by straight lines. No speed along an axis is more than 1 at way 0. Lanes beyond `count`
 * want nothing. */
typedef struct {
    float direction[3][SP_VOLLEY];
    float first[SP_VOLLEY], last[SP_VOLLEY];  /* the ways that were asked for */
    float low[SP_VOLLEY], high[SP_VOLLEY];    /* the best hit is between these; nothing beyond `high` is wanted */
    uint32_t triangle[SP_VOLLEY];             /* the best so far */
    uint32_t skip[SP_VOLLEY], ray[SP_VOLLEY]; /* ray: its number among `rays` */
    int count;
    int met;   /* triangles that some may have met: each counts as often as it was looked at */
    int steep; /* the axis of gravity */
    float origin[3], bend;
    float least[3], most[3]; /* the range of direction */
    float farthest;          /* the largest `high` */
    bool any;
    double rate; /* way = t rate */
    const sp_bvh *bvh;
    const sp_ray *rays;
    const sp_pull *pull;
} sp_volley;

/* Decides between a triangle and the best so far. */
void sp_volley_settle(sp_volley *volley, int lane, uint32_t triangle);

/* The kernel, one for each set of instructions. */
void sp_volley_search_portable(sp_volley *volley);
void sp_volley_search_avx2(sp_volley *volley);
void sp_volley_search_avx512(sp_volley *volley);

/* Traces rays of one origin: `hits`, or where that is NULL `occluded`, get an answer for each but those whose numbers
 * are put into left[count], in an order in which neighbours are close; returns how many these are. */
size_t sp_volleys_trace(const sp_bvh *bvh, sp_instructions instructions, const sp_ray *rays, size_t count,
                        const sp_pull *pull, sp_hit *hits, bool *occluded, uint32_t *left);

#endif
