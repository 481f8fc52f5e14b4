/* How a nozzle points: its own axes in world coordinates. */
#include <sprayplan/nozzle.h>

#include <assert.h>

static const double vertical = 1e-6; /* rad; nearer to `up` than this its direction says nothing about x */

sp_frame sp_nozzle_frame(sp_vec3 axis, double roll, sp_vec3 up)
{
    sp_frame frame = {.z = sp_unit(axis)};
    sp_vec3 level = sp_cross(up, frame.z);
    if (sp_length(level) <= vertical)
        level = sp_cross(up.z != 0 ? sp_v(0, 1, 0) : sp_v(0, 0, 1), frame.z);
    sp_vec3 x = sp_unit(level), y = sp_cross(frame.z, x);
    double c = cos(roll), s = sin(roll);
    frame.x = sp_along(sp_scale(x, c), s, y);
    frame.y = sp_along(sp_scale(y, c), -s, x);
    assert(fabs(sp_dot(frame.x, frame.z)) < 1e-6 && fabs(sp_length(frame.y) - 1) < 1e-6);
    return frame;
}
