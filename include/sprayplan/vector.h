/* Points and vectors in three dimensions, double precision. Metres unless a name says otherwise. */
#ifndef SPRAYPLAN_VECTOR_H
#define SPRAYPLAN_VECTOR_H

#include <math.h>

typedef struct {
    double x, y, z;
} sp_vec3;

static inline sp_vec3 sp_v(double x, double y, double z)
{
    sp_vec3 made = {x, y, z};
    return made;
}
static inline sp_vec3 sp_add(sp_vec3 a, sp_vec3 b)
{
    return sp_v(a.x + b.x, a.y + b.y, a.z + b.z);
}
static inline sp_vec3 sp_sub(sp_vec3 a, sp_vec3 b)
{
    return sp_v(a.x - b.x, a.y - b.y, a.z - b.z);
}
static inline sp_vec3 sp_scale(sp_vec3 a, double s)
{
    return sp_v(a.x * s, a.y * s, a.z * s);
}
/* a + s b */
static inline sp_vec3 sp_along(sp_vec3 a, double s, sp_vec3 b)
{
    return sp_v(a.x + s * b.x, a.y + s * b.y, a.z + s * b.z);
}
static inline double sp_dot(sp_vec3 a, sp_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline sp_vec3 sp_cross(sp_vec3 a, sp_vec3 b)
{
    return sp_v(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
static inline double sp_length(sp_vec3 a)
{
    return sqrt(sp_dot(a, a));
}
static inline double sp_distance(sp_vec3 a, sp_vec3 b)
{
    return sp_length(sp_sub(a, b));
}
/* Of length 1; the zero vector stays zero. */
static inline sp_vec3 sp_unit(sp_vec3 a)
{
    double length = sp_length(a);
    return length > 0 ? sp_scale(a, 1 / length) : a;
}

#endif
