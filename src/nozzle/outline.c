#include "outline.h"

#include "pattern.h"

static void narrow(sp_vec3 v, float out[3])
{
    out[0] = (float)v.x;
    out[1] = (float)v.y;
    out[2] = (float)v.z;
}

static sp_rim rim_at(double angle, double beyond)
{
    double chord = fmax(0, 2 * sin(0.5 * fmin(angle, M_PI)) + beyond), edge2 = angle >= M_PI ? 4 : chord * chord;
    double sine2 = fmax(edge2 * (1 - edge2 / 4), 1e-30);
    return (sp_rim){(float)edge2, (float)(1 / (2 * SP_SPRAY_BLUR * sqrt(sine2)))};
}

sp_outline sp_outline_create(const sp_spray *spray, const sp_frame *frame, double slack)
{
    sp_outline outline = {.flat = !sp_spray_is_round(spray), .height = 2};
    assert(slack >= 0 && sp_form_of(spray->kind)->swept);
    if (outline.flat) {
        outline.height = spray->half_thickness < M_PI / 2 ? (float)(sin(spray->half_thickness) + slack) : 2;
        outline.rise = (float)(1 / (SP_SPRAY_BLUR * cos(fmin(spray->half_thickness, 0.499 * M_PI))));
        outline.wide = cos(spray->half_width) < 0;
        outline.all_round = spray->half_width >= M_PI;
        outline.end_cosine = (float)cos(spray->half_width + slack);
        outline.end_sine = (float)sin(spray->half_width + slack);
    } else {
        outline.outer = rim_at(spray->outer, slack);
        outline.inner = spray->inner > 0 ? rim_at(spray->inner, -slack) : (sp_rim){0, 0};
    }
    sp_outline_turn(&outline, frame);
    return outline;
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
