/* Whether a point lies in the space that the wet sides face. */
#include "spray/wet/wet.h"

#define SIGHTS 32

/* Spherical Fibonacci points (Swinbank and Purser 2006): equal steps in height, the golden angle in longitude. */
sp_vec3 sp_sphere_direction(int index, int count)
{
    static const double golden = 0.61803398874989484820;
    double height = 1 - (2 * index + 1.0) / count, radius = sqrt(1 - height * height);
    double turns = index * golden, longitude = 2 * M_PI * (turns - floor(turns));
    return sp_v(radius * cos(longitude), radius * sin(longitude), height);
}

sp_ray sp_sphere_sight(sp_vec3 point, int index, int count)
{
    return (sp_ray){.origin = point, .velocity = sp_sphere_direction(index, count), .t_max = INFINITY, .skip = SP_NONE};
}

bool sp_evaluator_inside(const sp_evaluator *evaluator, sp_vec3 point)
{
    if (evaluator->setup.cavity == SP_CAVITY_NONE)
        return true;
    if (sp_wet_is_material(evaluator->wet, point))
        return false;
    int votes = 0, sights = SIGHTS;
    for (int i = 0; i < SIGHTS; i++) {
        sp_ray sight = sp_sphere_sight(point, i, SIGHTS);
        sp_hit hit = sp_trace_nearest(evaluator->tracer, &sight, sp_v(0, 0, 0));
        if (sp_caps_block(&evaluator->setup, &sight, hit.t)) {
            sights--;
            continue;
        }
        if (hit.triangle == SP_NONE) {
            votes += evaluator->setup.cavity == SP_CAVITY_OUTSIDE;
            continue;
        }
        bool back = sp_dot(sp_triangle_normal(evaluator->setup.mesh, hit.triangle), sight.velocity) > 0;
        votes += (sp_wet_at(evaluator->wet, hit.triangle, hit.u, hit.v) >> back) & 1;
    }
    return 2 * votes > sights;
}
