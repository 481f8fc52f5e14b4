#include "emitter.h"

#include "nozzle/frame.h"
#include "nozzle/pattern.h"

#include <assert.h>

/* How long nothing stops a jet, as on which side of the wall it stands in a nozzle is, is round-off: until it has gone
 * off it by its speed or, where that is slow, by falling. */
static double time_in_mouth(const sp_source *source)
{
    double length = sp_stand_off(source->evaluator), g = sp_length(source->gravity);
    double time = length / source->speed;
    return g > 0 ? fmin(time, sqrt(2 * length / g)) : time;
}

sp_emitter sp_emitter_of(const sp_evaluator *evaluator, const sp_nozzle *nozzle, const sp_wavefronts *fronts)
{
    const sp_setup *setup = &evaluator->setup;
    return (sp_emitter){.source = {evaluator, nozzle->position, sp_nozzle_speed(nozzle, &setup->liquid), fronts,
                                   sp_acceleration_at(evaluator, nozzle->type->trajectory)},
                        .frame = sp_nozzle_frame(nozzle->axis, nozzle->roll, setup->up),
                        .spray = sp_spray_create(nozzle->type, sp_nozzle_angle(nozzle))};
}

sp_ray sp_emitter_jet(const sp_emitter *emitter, uint64_t index, uint64_t jets)
{
    const sp_fidelity *fidelity = &emitter->source.evaluator->fidelity;
    const sp_frame *frame = &emitter->frame;
    sp_vec3 d = sp_spray_direction(&emitter->spray, index, jets, fidelity->seed);
    sp_vec3 direction = sp_along(sp_along(sp_scale(frame->x, d.x), d.y, frame->y), d.z, frame->z);
    return (sp_ray){.origin = emitter->source.position,
                    .velocity = sp_scale(direction, emitter->source.speed),
                    .t_min = time_in_mouth(&emitter->source),
                    .t_max = INFINITY,
                    .skip = SP_NONE};
}

double sp_emitter_share(const sp_emitter *emitter, const sp_arrival *arrival)
{
    return sp_spray_share(&emitter->spray, &emitter->frame, arrival->direction, arrival->breadth);
}

double sp_emitter_flux(const sp_emitter *emitter, double flow, const sp_arrival *arrival, double share)
{
    const sp_spray *spray = &emitter->spray;
    const sp_frame *frame = &emitter->frame;
    assert(flow > 0 && spray->solid_angle > 0 && arrival->transfer >= 0);
    if (sp_spray_is_uniform(spray))
        return flow / spray->solid_angle * arrival->transfer;
    double density = share > 0 ? sp_spray_density(spray, frame, arrival->direction, arrival->breadth) / share
                               : sp_spray_intensity(spray, sp_frame_local(frame, arrival->direction));
    return flow * density * arrival->transfer;
}

bool sp_emitter_holds(const sp_emitter *emitter, sp_vec3 direction)
{
    return sp_spray_holds(&emitter->spray, &emitter->frame, direction);
}

double sp_emitter_margin(const sp_emitter *emitter, sp_vec3 direction)
{
    return sp_spray_margin(&emitter->spray, sp_frame_local(&emitter->frame, direction));
}
