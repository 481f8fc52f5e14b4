/* Lines of one origin that fly close together, and are searched together. */
#ifndef SPRAYPLAN_TRACE_LINE_PACKET_H
#define SPRAYPLAN_TRACE_LINE_PACKET_H

#include "trace/bvh/bvh.h"
#include "trace/bvh/direction_order.h"
#include "trace/bvh/instructions.h"

#include <stdalign.h>

enum { SP_LINE_PACKET = 32 };

/* A line is where it is at depth 1, seen from the origin along its longest axis. Lanes beyond `count` want nothing.
 * Depths are along axis z, times `sign`. */
typedef struct {
    alignas(64) double velocity[3][SP_LINE_PACKET]; /* of the rays along x, y, z, m/s */
    float slope_u[SP_LINE_PACKET], slope_v[SP_LINE_PACKET];
    float u[SP_LINE_PACKET], v[SP_LINE_PACKET];        /* the slopes from the centre */
    float first[SP_LINE_PACKET], last[SP_LINE_PACKET]; /* the depths that were asked for */
    float low[SP_LINE_PACKET],
        high[SP_LINE_PACKET];          /* the best hit is between these; nothing beyond `high` is wanted */
    uint32_t triangle[SP_LINE_PACKET]; /* the best so far */
    uint32_t skip[SP_LINE_PACKET], ray[SP_LINE_PACKET]; /* ray: its number among `rays` */
    int count;
    int x, y, z;
    float sign;
    float origin[3];          /* along x, y, z */
    double place[3];          /* the origin, not rounded */
    float centre[2], half[2]; /* the range of u, v */
    float blur;               /* how far rounding may move a sheared corner */
    float farthest;           /* the largest `high` */
    bool any;
    const sp_bvh *bvh;
    const sp_ray *rays;
} sp_line_packet;

/* Rays of one origin. */
typedef struct {
    const sp_bvh *bvh;
    const sp_ray *rays;
    size_t count;
    sp_direction_entry *order[2]; /* [count]; the first is sorted */
    double place[3];              /* of the origin, in the hierarchy's space */
    float blur;                   /* as a packet's */
} sp_common_origin;

/* What double precision makes of a line and two triangles, of which the second may be SP_NONE. */
sp_hit sp_line_packet_ask(const sp_line_packet *packet, int lane, uint32_t triangle, uint32_t other);
/* Decides between a triangle and the best so far. */
void sp_line_packet_settle(sp_line_packet *packet, int lane, uint32_t triangle);

/* The kernels, one for each set of instructions. */
typedef struct {
    /* The rays' places in the order of directions; false where some are none that a packet takes. */
    bool (*keys)(const sp_bvh *bvh, const sp_ray *rays, size_t count, sp_direction_entry *order);
    /* Puts the lines from the given one on into a packet, those of one side; returns how many. */
    size_t (*fill)(const sp_common_origin *common, size_t from, sp_line_packet *packet);
    void (*search)(sp_line_packet *packet);
    /* The hits that the search found. */
    void (*answer)(const sp_line_packet *packet, sp_hit *hits);
} sp_line_packet_kernel;
extern const sp_line_packet_kernel sp_line_packet_portable, sp_line_packet_avx2, sp_line_packet_avx512;

/* Room for sorting rays of one origin, kept from one call to the next. Begins as zeros. */
typedef struct {
    sp_direction_entry *order;
    size_t count;
} sp_common_origin_room;
void sp_common_origin_room_clear(sp_common_origin_room *room);

/* Traces rays of one origin, none of which may begin before time 0: `hits`, or where that is NULL `occluded`, get an
 * answer for each. False where single precision or memory do not suffice; nothing is written then. */
bool sp_common_origin_trace(const sp_bvh *bvh, sp_instructions instructions, const sp_ray *rays, size_t count,
                            sp_common_origin_room *room, sp_hit *hits, bool *occluded);
/* The same for rays that are far apart, of any kind: each by itself, but neighbours one after another. False where
 * memory does not suffice; nothing is written then. */
bool sp_common_origin_trace_singly(const sp_bvh *bvh, sp_instructions instructions, const sp_ray *rays, size_t count,
                                   sp_common_origin_room *room, sp_hit *hits, bool *occluded);

#endif
