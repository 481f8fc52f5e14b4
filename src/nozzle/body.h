/* Bodies of nozzles: balls of their types' diameters about their tips. */
#ifndef NOZZLE_BODY_H
#define NOZZLE_BODY_H

#include <sprayplan/nozzle.h>
#include <sprayplan/vector.h>

#define SP_BODY_ROUND_OFF 1e-9 /* of the bodies, by which those that touch may seem to overlap */

/* Whether they do with their tips `apart` (m). Of types whose bodies are not given nothing is known. */
static inline bool sp_bodies_overlap(const sp_nozzle_type *a, const sp_nozzle_type *b, double apart)
{
    return apart < (1 - SP_BODY_ROUND_OFF) * (a->body + b->body) / 2;
}

#endif
