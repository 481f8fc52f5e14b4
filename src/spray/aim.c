#include "aim.h"

sp_aim sp_aim_at(sp_vec3 axis, double half_angle)
{
    double most = half_angle + sp_spray_fringe(SP_BREADTH_MOST);
    return (sp_aim){.axis = axis,
                    .half_angle = half_angle,
                    .cosine = half_angle < M_PI ? cos(half_angle) - 1e-12 : -2,
                    .outside = most < M_PI ? cos(most) - 1e-12 : -2,
                    .end = SIZE_MAX};
}

bool sp_aim_takes(const sp_aim *aim, const sp_arrival *arrival)
{
    double along = sp_dot(arrival->direction, aim->axis);
    if (along < aim->cosine) {
        double most = aim->half_angle + sp_spray_fringe(arrival->breadth);
        if (most < M_PI && along < cos(most))
            return false;
    }
    return !aim->emitter || sp_emitter_share(aim->emitter, arrival) > 0 ||
           sp_emitter_holds(aim->emitter, arrival->direction);
}
