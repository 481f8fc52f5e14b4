/* What caps are good for: one that was mistyped shuts nothing, and says so nowhere else. */
#include "spray/wet/opening_size.h"
#include "spray/wet/wet.h"

#include <stdlib.h>

#define POINTS 1024    /* of a cap, evenly spread */
#define RIM_POINTS 64  /* about it */
#define BESIDE 1e-3    /* of its radius: so far from a cap is looked, and outside of its rim */
#define ROUND 1e-2     /* of its radius: half of the way round its rim that must be clear */
#define GOLDEN 2.39996 /* rad, from point to point */

typedef struct {
    const sp_evaluator *evaluator;
    const sp_cap *cap;
    sp_vec3 x, y, z; /* z is its normal */
} lid;

static sp_vec3 point_of(const lid *lid, double radius, double turn, double height)
{
    sp_vec3 point = sp_along(lid->cap->point, height * lid->cap->radius, lid->z);
    point = sp_along(point, radius * lid->cap->radius * cos(turn), lid->x);
    return sp_along(point, radius * lid->cap->radius * sin(turn), lid->y);
}

/* Whether liquid is on either side of the cap's plane. */
static bool is_wet(const lid *lid, double radius, double turn, double height)
{
    return sp_evaluator_inside(lid->evaluator, point_of(lid, radius, turn, height)) ||
           sp_evaluator_inside(lid->evaluator, point_of(lid, radius, turn, -height));
}

static bool is_passed(const lid *lid, const sp_flood *flood, double turn)
{
    return sp_opening_is_clear(flood, point_of(lid, 1 + BESIDE, turn, ROUND),
                               point_of(lid, 1 + BESIDE, turn, -ROUND)) &&
           is_wet(lid, 1 + BESIDE, turn, ROUND);
}

sp_cap_use sp_evaluator_cap_use(const sp_evaluator *evaluator, size_t cap)
{
    const sp_flood flood = {.setup = &evaluator->setup, .tracer = evaluator->tracer};
    lid lid = {.evaluator = evaluator, .cap = &evaluator->setup.caps[cap]};
    lid.z = sp_unit(lid.cap->normal);
    lid.x = sp_unit(sp_cross(fabs(lid.z.x) < 0.5 ? sp_v(1, 0, 0) : sp_v(0, 1, 0), lid.z));
    lid.y = sp_cross(lid.z, lid.x);
    int passed = 0;
    for (int i = 0; i < RIM_POINTS; i++)
        passed += is_passed(&lid, &flood, 2 * M_PI * i / RIM_POINTS);
    if (2 * passed > RIM_POINTS)
        return SP_CAP_PASSED;
    for (int i = 0; i < POINTS; i++)
        if (is_wet(&lid, sqrt((i + 0.5) / POINTS), GOLDEN * i, BESIDE))
            return SP_CAP_SHUTS;
    return SP_CAP_DRY;
}

bool sp_evaluator_beyond_caps(const sp_evaluator *evaluator, double *area, sp_error *error)
{
    if (!evaluator)
        return false;
    const sp_wet *wet = evaluator->wet;
    sp_setup open = evaluator->setup;
    open.cap_count = 0;
    *area = 0;
    if (evaluator->setup.cap_count == 0 || open.cavity == SP_CAVITY_NONE)
        return true;
    sp_flooded flooded = {.liquid = calloc(2 * wet->faces.count + 1, sizeof *flooded.liquid)};
    if (!flooded.liquid)
        return sp_fail_memory(error);
    bool done = sp_flood_faces(&open, evaluator->tracer, &wet->faces, &wet->shells, &flooded, error);
    for (size_t side = 0; done && side < 2 * wet->faces.count; side++)
        *area += flooded.liquid[side] && !wet->flooded.liquid[side] ? wet->faces.area[side / 2] : 0;
    free(flooded.liquid);
    return done;
}
