/* Nozzles that stand where others do. */
#include "nozzle/body.h"

#include <stdio.h>

#define ONE_PLACE 1e-6 /* m: nobody mounts two nozzles so near */

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
        else if (sp_body_overlaps(sp_nozzle_body(own), sp_nozzle_body(other)))
            snprintf(text, SP_OVERLAP_TEXT,
                     "%s and %s stand %.3g mm apart: their bodies of %.4g mm and %.4g mm overlap", other->name,
                     own->name, 1e3 * apart, 1e3 * other->type->body, 1e3 * own->type->body);
        else
            continue;
        return earlier;
    }
    return SIZE_MAX;
}
