/* Bodies of nozzles: balls of their types' diameters about their tips. */
#ifndef NOZZLE_BODY_H
#define NOZZLE_BODY_H

#include <sprayplan/nozzle.h>
#include <sprayplan/vector.h>

#define SP_BODY_ROUND_OFF 1e-9 /* of the bodies, by which those that touch may seem to overlap */

typedef struct {
    const sp_nozzle_type *type;
    sp_vec3 position;
} sp_body;

/* A type that does not say how wide its body is has that of a point. */
static inline bool sp_body_overlaps(sp_body a, sp_body b)
{
    return sp_distance(a.position, b.position) < (1 - SP_BODY_ROUND_OFF) * (a.type->body + b.type->body) / 2;
}

static inline sp_body sp_nozzle_body(const sp_nozzle *nozzle)
{
    return (sp_body){nozzle->type, nozzle->position};
}

#endif
