/* Footprints: what a nozzle lays on patches across which its spray changes. Where a spray is narrower than two texels a
 * patch's one point says nothing of the patch, and the flux is integrated over it instead. */
#ifndef SPRAY_FOOTPRINT_H
#define SPRAY_FOOTPRINT_H

#include "arrival.h"

/* A nozzle as the evaluator sees it. */
typedef struct {
    sp_source source;
    sp_frame frame;
    sp_spray spray;
    double width; /* rad, the least opening of the spray */
    bool is_spot; /* a full cone: as narrow both ways */
} sp_emitter;

sp_emitter sp_emitter_of(const sp_evaluator *evaluator, const sp_nozzle *nozzle);
/* The same direction in the nozzle's frame. */
sp_vec3 sp_emitter_local(const sp_emitter *emitter, sp_vec3 direction);
/* True where the spray at this patch's distance is narrower than two texels. */
bool sp_emitter_is_narrow(const sp_emitter *emitter, uint32_t patch);

typedef struct {
    uint32_t patch;
    int arcs;         /* how many of the two flights bring liquid */
    double gain;      /* 1/m²: mean of intensity times transfer over the patch, so that the flux is Q times it */
    double passing;   /* the part of it whose speed and incidence meet the criterion */
    double speed;     /* m/s, mean by flux */
    double incidence; /* rad, mean by flux */
} sp_footprint;

/* All patches at which the spray is narrow and brings liquid, ascending. *count of them, the caller frees; NULL on
 * error. */
sp_footprint *sp_footprints(const sp_emitter *emitter, size_t *count, sp_error *error);

#endif
