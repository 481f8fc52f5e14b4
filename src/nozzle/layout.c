/* Layouts: which nozzles there are. */
#include <sprayplan/nozzle.h>

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

double sp_layout_flow(const sp_layout *layout, const sp_fluid *liquid)
{
    double flow = 0;
    for (size_t i = 0; i < layout->count; i++)
        flow += sp_nozzle_flow(&layout->nozzles[i], liquid);
    return flow;
}
