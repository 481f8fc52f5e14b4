/* Parabolas of one origin that fly close together, and are searched together. */
#ifndef SPRAYPLAN_TRACE_PARABOLA_PACKET_H
#define SPRAYPLAN_TRACE_PARABOLA_PACKET_H

#include "trace/bvh/bvh.h"
#include "trace/bvh/instructions.h"
#include "trace/parabola/parabola_hits.h"

enum { SP_PARABOLA_PACKET = SP_PARABOLA_HITS };

/* In the hierarchy's space parabola i is at origin + direction[i] way + bend way² (along the steep axis), where the
 * bend is the same for all: they differ by straight lines. No speed along an axis is more than 1 at way 0. Lanes beyond
 * `count` want nothing. */
typedef struct {
    float direction[3][SP_PARABOLA_PACKET];
    float first[SP_PARABOLA_PACKET], last[SP_PARABOLA_PACKET]; /* the ways that were asked for */
    float low[SP_PARABOLA_PACKET],
        high[SP_PARABOLA_PACKET];          /* the best hit is between these; nothing beyond `high` is wanted */
    uint32_t triangle[SP_PARABOLA_PACKET]; /* the best so far */
    uint32_t skip[SP_PARABOLA_PACKET], ray[SP_PARABOLA_PACKET]; /* ray: its number among `rays` */
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
    const sp_acceleration *acceleration;
} sp_parabola_packet;

/* Decides between a triangle and the best so far. */
void sp_parabola_packet_settle(sp_parabola_packet *packet, int lane, uint32_t triangle);

/* The kernel, one for each set of instructions. */
void sp_parabola_packet_search_portable(sp_parabola_packet *packet);
void sp_parabola_packet_search_avx2(sp_parabola_packet *packet);
void sp_parabola_packet_search_avx512(sp_parabola_packet *packet);

/* Traces rays of one origin: `hits`, or where that is NULL `occluded`, get an answer for each but those whose numbers
 * are put into left[count], in an order in which neighbours are close; returns how many these are. */
size_t sp_parabola_packets_trace(const sp_bvh *bvh, sp_instructions instructions, const sp_ray *rays, size_t count,
                                 const sp_acceleration *acceleration, sp_hit *hits, bool *occluded, uint32_t *left);

#endif
