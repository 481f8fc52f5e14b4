#include "scoring/bodies.h"

bool sp_body_clear_of_kept(const sp_search *search, sp_body body)
{
    bool clear = true;
    for (size_t i = 0; search->bodies && clear && i < search->kept_count; i++)
        clear = !sp_body_overlaps(sp_nozzle_body(&search->kept[i]), body);
    return clear;
}

bool sp_body_clear_of_others(const sp_search *search, const sp_partial *partial, size_t i, sp_body body)
{
    bool clear = sp_body_clear_of_kept(search, body);
    for (size_t k = 0; search->bodies && clear && k < partial->count; k++)
        clear = k == i || !sp_body_overlaps(sp_nozzle_body(&partial->items[k].nozzle), body);
    return clear;
}

bool sp_body_clear(const sp_search *search, const sp_partial *partial, sp_body body)
{
    return sp_body_clear_of_others(search, partial, partial->count, body);
}

bool sp_partial_clear(const sp_search *search, const sp_partial *partial)
{
    bool clear = true;
    for (size_t i = 0; search->bodies && clear && i < partial->count; i++)
        clear = sp_body_clear_of_others(search, partial, i, sp_nozzle_body(&partial->items[i].nozzle));
    return clear;
}
