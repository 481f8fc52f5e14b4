/* Layouts: which nozzles there are. */
#include <sprayplan/nozzle.h>
#include <sprayplan/vector.h>

#include <stdlib.h>
#include <string.h>

sp_layout *sp_layout_create(const sp_nozzle *nozzles, size_t count, sp_error *error)
{
    sp_layout *layout = calloc(1, sizeof *layout);
    sp_nozzle *copies = calloc(count ? count : 1, sizeof *copies);
    if (!layout || !copies) {
        free(layout);
        free(copies);
        return sp_fail_memory(error);
    }
    if (nozzles && count)
        memcpy(copies, nozzles, count * sizeof *copies);
    layout->count = count;
    layout->nozzles = copies;
    return layout;
}

void sp_layout_destroy(sp_layout *layout)
{
    if (!layout)
        return;
    free(layout->nozzles);
    free(layout);
}

bool sp_nozzles_spray_alike(const sp_nozzle *a, const sp_nozzle *b)
{
    return a->type == b->type && sp_distance(a->position, b->position) <= 0 && sp_distance(a->axis, b->axis) <= 0 &&
           !(fabs(a->roll - b->roll) > 0) && !(fabs(a->pressure - b->pressure) > 0) &&
           !(fabs(a->angle - b->angle) > 0) && !(fabs(a->flow - b->flow) > 0) && !(fabs(a->speed - b->speed) > 0);
}

bool sp_layout_repeats(const sp_layout *layout, size_t i)
{
    for (size_t earlier = 0; earlier < i; earlier++)
        if (sp_nozzles_spray_alike(&layout->nozzles[earlier], &layout->nozzles[i]))
            return true;
    return false;
}

double sp_layout_flow(const sp_layout *layout, const sp_fluid *liquid)
{
    double flow = 0;
    for (size_t i = 0; i < layout->count; i++)
        flow += sp_nozzle_flow(&layout->nozzles[i], liquid);
    return flow;
}
