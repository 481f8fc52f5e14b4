/* Nozzles that stand where others do. */
#include <sprayplan/nozzle.h>
#include <sprayplan/vector.h>

#include <stdio.h>

#define ONE_PLACE 1e-6 /* m: nobody mounts two nozzles so near */
#define ROUND_OFF 1e-9 /* of the bodies, by which those that touch may seem to overlap */

/* m, from tip to tip, of bodies that touch. */
static double reach(const sp_nozzle *a, const sp_nozzle *b)
{
    return (1 - ROUND_OFF) * (a->type->body + b->type->body) / 2;
}

size_t sp_layout_overlap(const sp_layout *layout, size_t i, char text[SP_OVERLAP_TEXT])
{
    const sp_nozzle *own = &layout->nozzles[i];
    text[0] = '\0';
    for (size_t earlier = 0; earlier < i; earlier++) {
        const sp_nozzle *other = &layout->nozzles[earlier];
        double apart = sp_distance(own->position, other->position);
        if (apart <= ONE_PLACE)
            snprintf(text, SP_OVERLAP_TEXT, "%s and %s stand in one place: their bodies overlap", other->name,
                     own->name);
        else if (apart < reach(own, other))
            snprintf(text, SP_OVERLAP_TEXT,
                     "%s and %s stand %.3g mm apart: their bodies of %.4g mm and %.4g mm overlap", other->name,
                     own->name, 1e3 * apart, 1e3 * other->type->body, 1e3 * own->type->body);
        else
            continue;
        return earlier;
    }
    return SIZE_MAX;
}
