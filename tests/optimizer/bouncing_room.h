/* A box whose walls throw liquid back, seen by jets. */
#ifndef BOUNCING_ROOM_H
#define BOUNCING_ROOM_H

#include "room.h"

#define BOUNCES 2

static inline void bouncing_room_open(room *r, double texel, uint64_t jets)
{
    room_builder b = {0};
    sp_error error = {0};
    room_box(&b, sp_v(-1, -0.7, 0), sp_v(1, 0.7, 1.2), "walls", "lid");
    r->setup = sp_setup_default();
    r->setup.criterion.flux = LITRES_PER_MINUTE;
    room_open(r, &b, texel);
    sp_evaluator_destroy(r->evaluator);
    for (size_t i = 0; i < r->mesh->part_count; i++) {
        r->surfaces[i].restitution = 0.5;
        r->surfaces[i].rebound = 0.6;
    }
    r->setup.fidelity.method = SP_METHOD_FORWARD;
    r->setup.fidelity.reflections = BOUNCES;
    r->setup.fidelity.jets = jets;
    r->evaluator = sp_evaluator_create(&r->setup, &error);
    assert_non_null(r->evaluator);
}

#endif
