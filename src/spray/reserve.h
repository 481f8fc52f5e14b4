/* How far flights are from the limit of their reach. */
#ifndef SPRAY_RESERVE_H
#define SPRAY_RESERVE_H

#include <sprayplan/vector.h>

#define SP_LIMIT_NEAR 0x1p-8 /* of v² + r·g */

/* v² + r·g - g|r|, which is 0 or more where a flight of this speed reaches the end of r. Far below a slow start it is a
 * small difference of what is large; there g|r| - r·g is taken as |r × g|²/(g|r| + r·g). */
static inline double sp_reserve(double speed, sp_vec3 r, sp_vec3 gravity)
{
    double v2 = speed * speed, fall = sp_dot(r, gravity), reach = sp_length(gravity) * sp_length(r);
    double reserve = v2 + fall - reach;
    if (fall <= 0 || fabs(reserve) > SP_LIMIT_NEAR * (v2 + fall))
        return reserve;
    sp_vec3 aside = sp_cross(r, gravity);
    return v2 - sp_dot(aside, aside) / (reach + fall);
}

#endif
