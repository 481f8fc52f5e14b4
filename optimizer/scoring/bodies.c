#include "scoring/bodies.h"

#include "nozzle/body.h"

static bool clear_of(const sp_nozzle *other, const sp_nozzle_type *type, sp_vec3 position)
{
    return !sp_bodies_overlap(other->type, type, sp_distance(other->position, position));
}

bool sp_clear_of_kept(const sp_search *search, const sp_nozzle_type *type, sp_vec3 position)
{
    bool clear = true;
    for (size_t i = 0; search->bodies && clear && i < search->kept_count; i++)
        clear = clear_of(&search->kept[i], type, position);
    return clear;
}

bool sp_bodies_clear(const sp_search *search, const sp_partial *partial, const sp_nozzle_type *type, sp_vec3 position)
{
    bool clear = sp_clear_of_kept(search, type, position);
    for (size_t i = 0; search->bodies && clear && i < partial->count; i++)
        clear = clear_of(&partial->items[i].nozzle, type, position);
    return clear;
}

bool sp_bodies_clear_at(const sp_search *search, const sp_partial *partial, const sp_pose *pose)
{
    return sp_bodies_clear(search, partial, search->candidates->variants[pose->variant].type,
                           search->sites->items[pose->site].position);
}

bool sp_bodies_all_clear(const sp_search *search, const sp_partial *partial)
{
    bool clear = true;
    for (size_t i = 0; search->bodies && clear && i < partial->count; i++) {
        const sp_nozzle *own = &partial->items[i].nozzle;
        clear = sp_clear_of_kept(search, own->type, own->position);
        for (size_t k = 0; clear && k < i; k++)
            clear = clear_of(&partial->items[k].nozzle, own->type, own->position);
    }
    return clear;
}
