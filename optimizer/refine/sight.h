/* What a nozzle can reach from a place whichever way its limits let it turn and open, traced once for each place. */
#ifndef OPTIMIZER_SIGHT_H
#define OPTIMIZER_SIGHT_H

#include "scoring/partial.h"

typedef struct {
    sp_vec3 position;
    sp_launch launch;
    sp_vec3 gravity; /* m/s², of what flies without drag */
    sp_vec3 axis;    /* what lies within half_angle about it */
    double half_angle;
    sp_reach *reach;
    size_t count;
    const sp_arrival *seen; /* [count], ascending by patch: the reach's, of what passes the criterion's speed and
                             * incidence; where film is asked for, of all */
    uint64_t used;          /* when, for the sights to forget the one that was not needed for longest */
} sp_sight;

/* Sights kept for another look: continuation, line search and compass come back to the same places. */
typedef struct {
    const sp_search *search;
    double tolerance; /* m; 0: sights from just there alone */
    uint64_t clock;
    size_t asked; /* capacity that it was created with */
    size_t capacity;
    sp_sight *items; /* [capacity], unused ones all zero */
} sp_sights;

/* Keeps the last `capacity` sights. Unless they are to be exact, what lies in the way of a nozzle that moved by less
 * than a fraction of a texel is taken to be as it was: shadows' edges are not known better anyway. So what is seen then
 * depends on what was looked at before, until it is forgotten. */
bool sp_sights_create(const sp_search *search, size_t capacity, bool exact, sp_sights *sights, sp_error *error);
/* Room for at least as many, until it forgets. */
bool sp_sights_reserve(sp_sights *sights, size_t capacity, sp_error *error);
void sp_sights_forget(sp_sights *sights);
void sp_sights_free(sp_sights *sights);
/* From the nozzle's place, or one near enough, all that refinement may turn it to; nothing of a nozzle that it does not
 * move, whose footprint is its field. Valid for the next capacity - 1 looks; NULL on error. */
const sp_sight *sp_sights_look(sp_sights *sights, const sp_placed *placed, sp_error *error);
/* Flies to a patch in sight, or its cell, from `position`, visibility as it was; false where no liquid arrives. */
bool sp_sight_fly(const sp_search *search, const sp_sight *sight, const sp_arrival *seen, sp_vec3 position,
                  sp_flight *flight, double *transfer);
/* The nozzle's field from where it is, visibility as in the sight; looking for oneself. Where a layout is given, only
 * on the patches that it leaves dry: what the nozzle adds to it is the same. */
void sp_sight_field(const sp_search *search, const sp_sight *sight, const sp_placed *placed, const sp_partial *partial,
                    float *field);
bool sp_sights_field(sp_sights *sights, const sp_placed *placed, const sp_partial *partial, float *field,
                     sp_error *error);

#endif
