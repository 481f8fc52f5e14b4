#include "outline.h"

#include "frame.h"

static void narrow(sp_vec3 v, float out[3])
{
    out[0] = (float)v.x;
    out[1] = (float)v.y;
    out[2] = (float)v.z;
}

sp_rim sp_rim_at(double angle, double beyond)
{
    double chord = fmax(0, 2 * sin(0.5 * fmin(angle, M_PI)) + beyond), edge2 = angle >= M_PI ? 4 : chord * chord;
    double sine2 = fmax(edge2 * (1 - edge2 / 4), 1e-30);
    return (sp_rim){(float)edge2, (float)(1 / (2 * SP_SPRAY_BLUR * sqrt(sine2)))};
}

void sp_outline_turn(sp_outline *outline, const sp_frame *frame)
{
    narrow(frame->z, outline->z);
    if (!outline->flat)
        return;
    narrow(frame->y, outline->y);
    sp_vec3 along = sp_scale(frame->z, (double)outline->end_sine);
    narrow(sp_along(along, -(double)outline->end_cosine, frame->x), outline->end[0]);
    narrow(sp_along(along, (double)outline->end_cosine, frame->x), outline->end[1]);
}
