/* The drag of single drops in air at rest, and where streams become drops. */
#include <sprayplan/flight.h>

#include "nozzle/rotation.h"

#define REYNOLDS_MOST 1e300 /* beyond, the coefficient's powers overflow */

sp_drag sp_drag_of_drops(double diameter, const sp_fluid *liquid, const sp_fluid *air)
{
    if (!(air->density > 0))
        return (sp_drag){0};
    return (sp_drag){.stokes = 18 * air->viscosity / liquid->density / diameter / diameter,
                     .form = 0.4251 * 0.75 * air->density / liquid->density / diameter,
                     .reynolds = air->density * diameter / air->viscosity};
}

/* s, until a round stream has broken up. From We of 10³ to 10⁵ the power law lies within 15 % of Grant and Middleman's
 * 8.51 We^0.32 for turbulent streams in still air (AIChE Journal 12, 1966), whose We is the liquid's too. */
static double break_up(double flow, double speed, const sp_fluid *liquid)
{
    double diameter = sqrt(4 * flow / (M_PI * speed));
    double weber = liquid->density * speed * speed * diameter / liquid->surface_tension;
    return 5 * pow(weber, 0.378) * diameter / speed;
}

sp_drag sp_drag_of(const sp_nozzle *nozzle, const sp_fluid *liquid, const sp_fluid *air)
{
    const sp_nozzle_type *type = nozzle->type;
    sp_drag drag = sp_drag_of_drops(type->drop, liquid, air);
    double speed = sp_nozzle_speed(nozzle, liquid), flow = sp_nozzle_flow(nozzle, liquid) / sp_type_jets(type);
    if (sp_type_leaves_as_stream(type) && flow > 0 && speed > 0)
        drag.delay = break_up(flow, speed, liquid);
    return drag;
}

sp_vec3 sp_drag_acceleration(const sp_drag *drag, sp_vec3 velocity, sp_vec3 gravity)
{
    double speed = sp_length(velocity), reynolds = fmin(drag->reynolds * speed, REYNOLDS_MOST);
    double rate = drag->stokes > 0 ? drag->stokes * (1 + 0.1806 * pow(reynolds, 0.6459)) : 0;
    if (reynolds > 0)
        rate += drag->form * speed / (1 + 6880.95 / reynolds);
    return sp_along(gravity, -rate, velocity);
}
