/* The shapes that sheet metal is made of: turned, piped, cut and bent. Millimetres. */
#ifndef VESSEL_SHAPES_H
#define VESSEL_SHAPES_H

#include "model.h"

/* A vertical circle cut into `segments`; corner k lies at angle 2π k / segments. */
typedef struct {
    double x, y, r;
    int segments;
} circle;
sp_vec3 circle_corner(const circle *circle, int corner, double z);

/* Turns a profile of (radius, z) about a vertical axis through (x, y). The front is to the right of the profile's
 * direction, with the radius to the right and z upwards. Stretches longer than `step` are divided. */
void turn(model *model, double x, double y, int segments, const double (*profile)[2], int count, double step);

/* Height of a surface over a point of the plan. */
typedef struct {
    double tangent_z;              /* where the cylinder ends */
    double direction;              /* +1: a lid, bulging upwards; -1: a bottom */
    double radius, crown, knuckle; /* of the cylinder, the dome, and the torus between the two */
} head;
/* The head `offset` outside this one. */
head head_offset(const head *head, double offset);
double head_z(const head *head, double r);

/* A pipe wall between its circle on the head and its flat end at z. `inward`: the front is the bore. */
void pipe_to_head(model *model, const head *head, const circle *circle, double z, bool inward);

/* The head with round openings, triangles about `size` long, its rim cut into `segments`. `upward`: its front is its
 * upper side. Returns false when memory runs out. */
bool head_surface(model *model, const head *head, const circle *openings, int opening_count, int segments, double size,
                  bool upward);

/* A plate: outline points origin + u·p.u + v·p.v, anticlockwise about u × v, thickness t along u × v, centred on
 * origin's plane. The outline's face is given as quads of its corners. */
typedef struct {
    sp_vec3 origin, u, v;
    double thickness;
} plate;
void cut_plate(model *model, const plate *plate, const double (*outline)[2], int count, const int (*quads)[4],
               int quad_count);
/* The common case of a rectangle from (u0, v0) to (u1, v1). */
void cut_rectangle(model *model, const plate *plate, double u0, double v0, double u1, double v1);

/* A sheet without thickness: origin + u [0, 1] + v [0, 1] in columns × rows. */
void sheet(model *model, sp_vec3 origin, sp_vec3 u, sp_vec3 v, int columns, int rows);

#endif
