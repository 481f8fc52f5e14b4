/* Which of the flights from one point are asked for. */
#ifndef SPRAY_AIM_H
#define SPRAY_AIM_H

#include "emitter.h"
#include "watch.h"

#define SP_BESIDE 1.5e-9 /* rad: whatever edge is 1e-9 off lies within it on one of four sides */

typedef struct {
    sp_vec3 axis;              /* unit */
    double half_angle, cosine; /* rad; of it */
    double outside;            /* the cosine below which nothing counts, however broad its patch looks */
    bool passing;              /* only what meets the criterion's speed and incidence */
    size_t first, end;         /* of the patches; those there are */
    const uint8_t *known;      /* NULL, or bit 2 patch + arc: what arrives, so that nothing has to be traced */
    const sp_emitter *emitter; /* NULL, or: only patches that its spray has a share of */
    const bool *among;         /* NULL, or [patches]: only these */
    bool blocked;              /* what something blocks as well, and says so */
    unsigned beside;           /* 0, or 1 to 4: flights are traced so many SP_BESIDE off, each to another of four sides;
                                  what is said of them besides is as if they were not */
    sp_watch *watch;           /* NULL, or: who asks whether to go on, of patches */
} sp_aim;

/* A cone of directions, half_angle in rad; what of a patch beyond its edge may still lie in it counts too. */
sp_aim sp_aim_at(sp_vec3 axis, double half_angle);
/* Whether an arrival leaves within the cone, a hair wider than asked, so that round-off never takes a jet of
 * the edge away, or not farther beyond than a patch's share may lie; and where an emitter is given, into its spray. */
bool sp_aim_takes(const sp_aim *aim, const sp_arrival *arrival);

#endif
