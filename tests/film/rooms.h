/* Rooms for the tests of film, and what stands in them. */
#ifndef TESTS_FILM_ROOMS_H
#define TESTS_FILM_ROOMS_H

#include "walls.h"

#define LAID 1e-4 /* m/s */

static const sp_vec3 X = {1, 0, 0}, Y = {0, 1, 0}, Z = {0, 0, 1};
static const region everywhere = {{-9, -9, -9}, {9, 9, 9}, {0, 0, 0}};

static inline double random_share(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

static inline sp_vec3 minus(sp_vec3 v)
{
    return sp_scale(v, -1);
}

/* A room of 2 × 2 × 2 m about the origin without a floor, its front inside. */
static inline shape room_without_floor(void)
{
    shape s = shape_create();
    shape_part(&s, "room");
    shape_sheet(&s, sp_v(-1, -1, 1), sp_v(0, 2, 0), sp_v(2, 0, 0), 1);
    shape_sheet(&s, sp_v(-1, -1, -1), sp_v(0, 2, 0), sp_v(0, 0, 2), 1);
    shape_sheet(&s, sp_v(-1, -1, -1), sp_v(0, 0, 2), sp_v(2, 0, 0), 1);
    shape_sheet(&s, sp_v(1, -1, -1), sp_v(0, 0, 2), sp_v(0, 2, 0), 1);
    shape_sheet(&s, sp_v(-1, 1, -1), sp_v(2, 0, 0), sp_v(0, 0, 2), 1);
    return s;
}

/* The room with a floor that falls by `slope` from all sides towards a hole of 0.4 × 0.4 m. */
static inline shape room_with_hole(double slope)
{
    shape s = room_without_floor();
    const double out[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (int i = 0; i < 4; i++) {
        const double *a = out[i], *b = out[(i + 1) % 4];
        double drop = -1 - 0.8 * slope;
        sp_vec3 p = sp_v(a[0], a[1], -1), q = sp_v(b[0], b[1], -1);
        sp_vec3 r = sp_v(0.2 * b[0], 0.2 * b[1], drop), t = sp_v(0.2 * a[0], 0.2 * a[1], drop);
        shape_triangle(&s, p, q, r);
        shape_triangle(&s, p, r, t);
    }
    return s;
}

/* A box turned about its own x axis by `roll` and then about y by `tilt`, front outwards, or only its top. */
static inline void turned_box(shape *s, sp_vec3 middle, sp_vec3 size, double roll, double tilt)
{
    sp_vec3 x = sp_v(cos(tilt), 0, -sin(tilt)), up = sp_v(sin(tilt), 0, cos(tilt));
    sp_vec3 y = sp_along(sp_scale(Y, cos(roll)), sin(roll), up), z = sp_along(sp_scale(up, cos(roll)), -sin(roll), Y);
    x = sp_scale(x, size.x);
    y = sp_scale(y, size.y);
    z = sp_scale(z, size.z);
    sp_vec3 low = sp_along(sp_along(sp_along(middle, -0.5, x), -0.5, y), -0.5, z);
    sp_vec3 high = sp_add(sp_add(sp_add(low, x), y), z);
    shape_sheet(s, low, y, x, 2);
    shape_sheet(s, low, z, y, 2);
    shape_sheet(s, low, x, z, 2);
    shape_sheet(s, high, minus(x), minus(y), 2);
    shape_sheet(s, high, minus(y), minus(z), 2);
    shape_sheet(s, high, minus(z), minus(x), 2);
}

#endif
