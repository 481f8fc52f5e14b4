/* A nozzle as the evaluator sees it. */
#ifndef SPRAY_EMITTER_H
#define SPRAY_EMITTER_H

#include "arrival.h"

typedef struct {
    sp_source source;
    sp_frame frame;
    sp_spray spray;
} sp_emitter;

/* `fronts`: those of its drops, borrowed; NULL: it flies without drag. */
sp_emitter sp_emitter_of(const sp_evaluator *evaluator, const sp_nozzle *nozzle, const sp_wavefronts *fronts);
/* Jet `index` of `jets`, of which each carries as much liquid. */
sp_ray sp_emitter_jet(const sp_emitter *emitter, uint64_t index, uint64_t jets);
/* The share of the arrival's patch that lies inside the spray. */
double sp_emitter_share(const sp_emitter *emitter, const sp_arrival *arrival);
/* What comes to what of the arrival's patch lies inside the spray, m³/s per m², where `share` of it does; to the
 * arrival's own point where none does, or the breadth is 0. `flow`: the nozzle's, m³/s. */
double sp_emitter_flux(const sp_emitter *emitter, double flow, const sp_arrival *arrival, double share);
/* Whether the arrival's own direction does. */
bool sp_emitter_holds(const sp_emitter *emitter, sp_vec3 direction);
/* How far (rad) inside the spray a direction lies, negative outside. */
double sp_emitter_margin(const sp_emitter *emitter, sp_vec3 direction);

#endif
