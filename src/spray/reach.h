/* Which of the flights from one point are asked for. */
#ifndef SPRAY_REACH_H
#define SPRAY_REACH_H

#include "footprint.h"

typedef struct {
    sp_vec3 axis; /* unit */
    double least_cosine;
    bool passing;              /* only what meets the criterion's speed and incidence */
    size_t first, end;         /* of the patches; those there are */
    const uint8_t *known;      /* NULL, or bit 2 patch + arc: what arrives, so that nothing has to be traced */
    const sp_emitter *emitter; /* NULL, or: only what its spray holds, at patches where that is not narrow */
} sp_aim;

/* A cone of directions. */
sp_aim sp_aim_at(sp_vec3 axis, double half_angle);
/* All unoccluded arrivals, ascending by patch, low arc before high arc. */
sp_reach *sp_reach_create(const sp_source *source, const sp_aim *aim, sp_error *error);

#endif
