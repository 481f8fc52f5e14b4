/* Lines of one origin that fly close together, and are searched together. */
#ifndef SPRAYPLAN_TRACE_BUNDLE_H
#define SPRAYPLAN_TRACE_BUNDLE_H

#include "trace/bvh/bvh.h"
#include "trace/bvh/direction_order.h"
#include "trace/bvh/instructions.h"

#include <stdalign.h>

enum { SP_BUNDLE = 32 };

/* A line is where it is at depth 1, seen from the origin along its longest axis. Lanes beyond `count` want nothing.
 * Depths are along axis z, times `sign`. */
typedef struct {
    alignas(64) double velocity[3][SP_BUNDLE]; /* of the rays along x, y, z, m/s */
    float slope_u[SP_BUNDLE], slope_v[SP_BUNDLE];
    float u[SP_BUNDLE], v[SP_BUNDLE];         /* the slopes from the centre */
    float first[SP_BUNDLE], last[SP_BUNDLE];  /* the depths that were asked for */
    float low[SP_BUNDLE], high[SP_BUNDLE];    /* the best hit is between these; nothing beyond `high` is wanted */
    uint32_t triangle[SP_BUNDLE];             /* the best so far */
    uint32_t skip[SP_BUNDLE], ray[SP_BUNDLE]; /* ray: its number among `rays` */
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
} sp_bundle;

/* Rays of one origin. */
typedef struct {
    const sp_bvh *bvh;
    const sp_ray *rays;
    size_t count;
    sp_direction_entry *order[2]; /* [count]; the first is sorted */
    double place[3];              /* of the origin, in the hierarchy's space */
    float blur;                   /* as a bundle's */
} sp_fan;

/* What double precision makes of a line and two triangles, of which the second may be SP_NONE. */
sp_hit sp_bundle_ask(const sp_bundle *bundle, int lane, uint32_t triangle, uint32_t other);
/* Decides between a triangle and the best so far. */
void sp_bundle_settle(sp_bundle *bundle, int lane, uint32_t triangle);

/* The kernels, one for each set of instructions. */
typedef struct {
    /* The rays' places in the order of directions; false where some are none that a bundle takes. */
    bool (*keys)(const sp_bvh *bvh, const sp_ray *rays, size_t count, sp_direction_entry *order);
    /* Puts the fan's lines from the given one on into a bundle, those of one side; returns how many. */
    size_t (*fill)(const sp_fan *fan, size_t from, sp_bundle *bundle);
    void (*search)(sp_bundle *bundle);
    /* The hits that the search found. */
    void (*answer)(const sp_bundle *bundle, sp_hit *hits);
} sp_bundle_kernel;
extern const sp_bundle_kernel sp_bundle_portable, sp_bundle_avx2, sp_bundle_avx512;

/* Room for the rays of a fan, kept from one to the next. Begins as zeros. */
typedef struct {
    sp_direction_entry *order;
    size_t count;
} sp_fan_room;
void sp_fan_room_clear(sp_fan_room *room);

/* Traces rays of one origin, none of which may begin before time 0: `hits`, or where that is NULL `occluded`, get an
 * answer for each. False where single precision or memory do not suffice; nothing is written then. */
bool sp_fan_trace(const sp_bvh *bvh, sp_instructions instructions, const sp_ray *rays, size_t count, sp_fan_room *room,
                  sp_hit *hits, bool *occluded);
/* The same for rays that are far apart, of any kind: each by itself, but neighbours one after another. False where
 * memory does not suffice; nothing is written then. */
bool sp_fan_stream(const sp_bvh *bvh, sp_instructions instructions, const sp_ray *rays, size_t count, sp_fan_room *room,
                   sp_hit *hits, bool *occluded);

#endif
