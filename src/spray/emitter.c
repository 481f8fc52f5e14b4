#include "emitter.h"

sp_emitter sp_emitter_of(const sp_evaluator *evaluator, const sp_nozzle *nozzle)
{
    const sp_setup *setup = &evaluator->setup;
    return (sp_emitter){.source = {evaluator, nozzle->position, sp_nozzle_speed(nozzle, &setup->liquid)},
                        .frame = sp_nozzle_frame(nozzle->axis, nozzle->roll, setup->up),
                        .spray = sp_spray_create(nozzle->type, sp_nozzle_angle(nozzle))};
}

double sp_emitter_share(const sp_emitter *emitter, const sp_arrival *arrival)
{
    return sp_spray_share(&emitter->spray, &emitter->frame, arrival->direction, arrival->breadth);
}

bool sp_emitter_holds(const sp_emitter *emitter, sp_vec3 direction)
{
    const sp_frame *frame = &emitter->frame;
    sp_vec3 local = sp_v(sp_dot(direction, frame->x), sp_dot(direction, frame->y), sp_dot(direction, frame->z));
    return sp_spray_intensity(&emitter->spray, local) > 0;
}
