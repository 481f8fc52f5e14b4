/* What every form of pattern answers about itself. A file like cone.c or fan.c answers for one form, and form.c lists
 * them; all that anybody asks of a pattern (pattern.h, <sprayplan/nozzle.h>) is asked there. */
#ifndef NOZZLE_FORM_H
#define NOZZLE_FORM_H

#include "outline.h"

#include <assert.h>

/* Directions are unit, in the nozzle's frame where none is given, else in the world. */
typedef struct {
    bool gaps;     /* there may be directions without liquid between others */
    bool image;    /* sprays by an image */
    bool stream;   /* leaves in one piece */
    double period; /* see sp_pattern_roll_period */
    /* Sets the angles of a pattern that is all zero but for its kind. */
    void (*open)(const sp_nozzle_type *type, double angle, sp_spray *spray);
    /* What follows from them: solid_angle, low and high at least. */
    void (*settle)(sp_spray *spray);
    double (*intensity)(const sp_spray *spray, sp_vec3 direction);
    double (*margin)(const sp_spray *spray, sp_vec3 direction);
    double (*margin_slope)(const sp_spray *spray, sp_vec3 direction, sp_vec3 *gradient);
    /* See sp_spray_latitude; NULL: it reaches all. */
    double (*latitude)(const sp_spray *spray);
    double (*share)(const sp_spray *spray, const sp_frame *frame, sp_vec3 direction, double breadth);
    /* See sp_spray_density and sp_spray_densities; NULL where the liquid is even. */
    double (*density)(const sp_spray *spray, const sp_frame *frame, sp_vec3 direction, double breadth);
    void (*densities)(const sp_spray *spray, double from, double to, double *least, double *most);
    /* Of a point of the unit square, so that equal areas get as much liquid. */
    sp_vec3 (*direction)(const sp_spray *spray, double u, double w);
    sp_vec3 (*rim)(const sp_spray *spray, int i, int count);
    /* One region with as much liquid everywhere, of an outline that sweeps know (see sp_spray_outline; all zero but
     * for `height`, and not yet in a frame): see sp_type_is_uniform. NULL: none; its poses are traced one by one. */
    void (*outline)(const sp_spray *spray, double slack, sp_outline *outline);
    /* See sp_type_angle_reaching; of forms with an outline only. */
    double (*angle_reaching)(const sp_nozzle_type *type, double polar);
    /* See sp_spray_widened: `spray` is as wide as any; of forms with an outline only. */
    void (*widen)(sp_spray *spray, const sp_spray *narrow, double turn, double roll, double slack);
} sp_form;

/* A form's margin_slope by differences of its margin. pattern.c. */
double sp_margin_differences(const sp_spray *spray, sp_vec3 direction, sp_vec3 *gradient);

extern const sp_form sp_full_cone, sp_hollow_cone, sp_solid_stream, sp_cluster_body; /* cone.c */
extern const sp_form sp_flat_fan;                                                    /* fan.c */
extern const sp_form sp_rotating;                                                    /* turned.c */
extern const sp_form sp_measured;                                                    /* measured.c */

extern const sp_form *const sp_forms[]; /* [sp_form_count], by sp_pattern */
extern const size_t sp_form_count;

static inline const sp_form *sp_form_of(sp_pattern pattern)
{
    assert(pattern < sp_form_count);
    return sp_forms[pattern];
}

#endif
