/* Patterns: where about its axis a nozzle sprays. Regions of the unit sphere in the nozzle's frame, whose forms answer.
 */
#include "pattern.h"

#include "frame.h"

#define STEP 1e-6      /* rad, for differences of margins */
#define ROUND_OFF 1e-6 /* share that all lacks */
#define GOLDEN 0.6180339887
#define SECTIONS 40        /* by which a range of angles becomes 4e-9 of itself */
#define SECTIONS_MISS 1e-9 /* more than that leaves of a solid angle */

void sp_spray_settle(sp_spray *spray)
{
    const sp_form *form = sp_form_of(spray->kind);
    form->settle(spray);
    spray->even = !form->density;
    assert(spray->solid_angle >= 0 && spray->inner <= spray->outer); /* 0: of a cluster, whose members spray */
}

sp_spray sp_spray_create(const sp_nozzle_type *type, double angle)
{
    sp_spray spray = {.kind = type->pattern};
    sp_form_of(type->pattern)->open(type, angle, &spray);
    sp_spray_settle(&spray);
    return spray;
}

bool sp_spray_is_same(const sp_spray *a, const sp_spray *b)
{
    return a->kind == b->kind && a->inner == b->inner && a->outer == b->outer && a->half_width == b->half_width &&
           a->half_thickness == b->half_thickness;
}

double sp_spray_reach(const sp_spray *spray)
{
    return spray->high;
}

double sp_spray_latitude(const sp_spray *spray)
{
    const sp_form *form = sp_form_of(spray->kind);
    return form->latitude ? form->latitude(spray) : M_PI / 2;
}

double sp_spray_intensity(const sp_spray *spray, sp_vec3 direction)
{
    return sp_form_of(spray->kind)->intensity(spray, direction);
}

bool sp_spray_holds(const sp_spray *spray, const sp_frame *frame, sp_vec3 direction)
{
    return sp_spray_intensity(spray, sp_frame_local(frame, direction)) > 0;
}

void sp_spray_densities(const sp_spray *spray, double from, double to, double *least, double *most)
{
    const sp_form *form = sp_form_of(spray->kind);
    *least = 0;
    *most = 1 / spray->solid_angle;
    if (form->densities)
        form->densities(spray, from, to, least, most);
}

double sp_spray_share(const sp_spray *spray, const sp_frame *frame, sp_vec3 direction, double breadth)
{
    assert(breadth >= 0 && fabs(sp_dot(direction, direction) - 1) < 1e-6);
    double share = sp_form_of(spray->kind)->share(spray, frame, direction, breadth);
    return share > 1 - ROUND_OFF ? 1 : fmax(0, share);
}

double sp_spray_density(const sp_spray *spray, const sp_frame *frame, sp_vec3 direction, double breadth)
{
    const sp_form *form = sp_form_of(spray->kind);
    return form->density ? form->density(spray, frame, direction, breadth)
                         : sp_spray_share(spray, frame, direction, breadth) / spray->solid_angle;
}

double sp_spray_fringe(double breadth)
{
    return sqrt(2) * SP_SPRAY_BLUR * breadth;
}

double sp_spray_margin(const sp_spray *spray, sp_vec3 direction)
{
    return sp_form_of(spray->kind)->margin(spray, direction);
}

/* By differences along two directions across this one. */
double sp_margin_differences(const sp_spray *spray, sp_vec3 d, sp_vec3 *gradient)
{
    double margin = sp_spray_margin(spray, d);
    if (gradient) {
        sp_vec3 a = sp_unit(sp_cross(d, fabs(d.x) < 0.5 ? sp_v(1, 0, 0) : sp_v(0, 1, 0))), b = sp_cross(d, a);
        double by_a = (sp_spray_margin(spray, sp_unit(sp_along(d, STEP, a))) - margin) / STEP;
        double by_b = (sp_spray_margin(spray, sp_unit(sp_along(d, STEP, b))) - margin) / STEP;
        *gradient = sp_along(sp_scale(a, by_a), by_b, b);
    }
    return margin;
}

sp_outline sp_spray_outline(const sp_spray *spray, const sp_frame *frame, double slack)
{
    sp_outline outline = {.height = 2};
    assert(slack >= 0 && sp_form_of(spray->kind)->outline);
    sp_form_of(spray->kind)->outline(spray, slack, &outline);
    sp_outline_turn(&outline, frame);
    return outline;
}

sp_spray sp_spray_widened(const sp_spray *narrow, const sp_spray *wide, double turn, double roll, double slack)
{
    sp_spray spray = *wide;
    assert(narrow->kind == wide->kind && sp_form_of(wide->kind)->outline);
    sp_form_of(wide->kind)->widen(&spray, narrow, turn, roll, slack);
    sp_spray_settle(&spray);
    return spray;
}

/* That of a hollow cone, whose hole is a share h of its angle, rises with the angle a as long as sin(a/2) / sin(h a/2)
 * is more than h, which falls as a rises: up to a half-space and beyond. Then it falls itself. Golden sections find
 * where; it is so flat there that what they leave of the angle makes no difference. */
double sp_type_solid_angle_most(const sp_nozzle_type *type, double low, double high)
{
    sp_spray widest = sp_spray_create(type, high);
    double most = fmax(sp_spray_create(type, low).solid_angle, widest.solid_angle);
    if (widest.inner <= 0 || high <= M_PI)
        return most;
    for (int i = 0; i < SECTIONS; i++) {
        double a = high - GOLDEN * (high - low), b = low + GOLDEN * (high - low);
        double at_a = sp_spray_create(type, a).solid_angle, at_b = sp_spray_create(type, b).solid_angle;
        most = fmax(most, fmax(at_a, at_b));
        if (at_a < at_b)
            low = a;
        else
            high = b;
    }
    return most * (1 + SECTIONS_MISS);
}

sp_vec3 sp_spray_rim(const sp_spray *spray, int i, int count)
{
    return sp_form_of(spray->kind)->rim(spray, i, count);
}
