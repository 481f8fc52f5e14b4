/* A layout as the evaluators see it: patterns, body by body. */
#ifndef SPRAY_NOZZLE_BODIES_H
#define SPRAY_NOZZLE_BODIES_H

#include "emitter.h"

#include <sprayplan/launch.h>

typedef struct sp_bodies {
    const sp_layout *layout; /* borrowed; its nozzles are the bodies */
    sp_layout *patterns;     /* nozzles of one pattern each */
    size_t *first;           /* [layout->count + 1]: body b has the patterns first[b] to first[b + 1] */
    sp_launch_table *table;  /* NULL without drag, and where flights are not asked for, as what follows */
    sp_launch *launches;     /* [patterns->count] */
} sp_bodies;

/* Fills in *bodies, for sp_bodies_free whatever the outcome. False, with an error, for what the evaluator does not
 * take: exit speeds out of all bounds, nozzles that are not whole. */
bool sp_bodies_create(const sp_evaluator *evaluator, const sp_layout *layout, sp_bodies *bodies, sp_error *error);
/* The same of nozzles that have this number of jets each, whatever they say. */
bool sp_bodies_create_with(const sp_evaluator *evaluator, const sp_layout *layout, uint64_t jets, sp_bodies *bodies,
                           sp_error *error);
void sp_bodies_free(sp_bodies *bodies);
/* Whether any pattern flies with drag. */
bool sp_bodies_hold_drops(const sp_evaluator *evaluator, const sp_bodies *bodies);
/* With drag finds the fronts, which emitters need that are asked for flights. */
bool sp_bodies_fly(const sp_evaluator *evaluator, sp_bodies *bodies, sp_error *error);
/* Pattern i. */
sp_emitter sp_bodies_emitter(const sp_evaluator *evaluator, const sp_bodies *bodies, size_t i);

#endif
