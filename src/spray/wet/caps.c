/* Lids for the flood alone. */
#include "spray/wet/flood_fill.h"

bool sp_cap_blocks(const sp_cap *cap, const sp_ray *line, double t)
{
    double along = sp_dot(line->velocity, cap->normal);
    double meets = sp_dot(sp_sub(cap->point, line->origin), cap->normal) / along;
    return along != 0 && meets > line->t_min && meets < t &&
           sp_distance(sp_along(line->origin, meets, line->velocity), cap->point) <= cap->radius;
}

bool sp_caps_block(const sp_setup *setup, const sp_ray *line, double t)
{
    for (size_t i = 0; i < setup->cap_count; i++)
        if (sp_cap_blocks(&setup->caps[i], line, t))
            return true;
    return false;
}
