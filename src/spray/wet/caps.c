/* Lids for the flood alone. */
#include "spray/wet/flood_fill.h"

bool sp_caps_block(const sp_setup *setup, const sp_ray *line, double t)
{
    for (size_t i = 0; i < setup->cap_count; i++) {
        const sp_cap *cap = &setup->caps[i];
        double along = sp_dot(line->velocity, cap->normal);
        double meets = sp_dot(sp_sub(cap->point, line->origin), cap->normal) / along;
        if (along == 0 || !(meets > line->t_min && meets < t))
            continue;
        if (sp_distance(sp_along(line->origin, meets, line->velocity), cap->point) <= cap->radius)
            return true;
    }
    return false;
}
