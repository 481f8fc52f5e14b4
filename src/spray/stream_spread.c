#include "stream_spread.h"

#include "film/laminar.h"

#include <assert.h>
#include <stdlib.h>

/* How much of the cell lies in the disc about the middle, as area; at the edge as if it were a square across the way
 * there. */
static double part_of(const sp_patches *cells, double radius, uint32_t middle, uint32_t cell)
{
    double far = sp_distance(cells->point[middle], cells->point[cell]), edge = cells->length[cell];
    return cells->area[cell] * fmin(1, fmax(0, (radius - far) / edge + 0.5));
}

/* Spreads a flow over the disc, cell by neighbouring cell, so that it does not come through a wall. */
static void spread(sp_stream_spread *own, double radius, uint32_t middle, double flow, double *arriving)
{
    const sp_patches *cells = own->cells;
    uint64_t disc = ++own->laid;
    double all = own->share[0] = cells->area[middle];
    own->queue[0] = middle;
    own->seen[middle] = disc;
    size_t count = 1;
    for (size_t i = 0; i < count; i++)
        for (size_t k = cells->neighbour_start[own->queue[i]]; k < cells->neighbour_start[own->queue[i] + 1]; k++) {
            uint32_t cell = cells->neighbours[k];
            double part = own->seen[cell] == disc ? 0 : part_of(cells, radius, middle, cell);
            own->seen[cell] = disc;
            if (!(part > 0))
                continue;
            own->queue[count] = cell;
            own->share[count++] = part;
            all += part;
        }
    assert(all > 0 && count <= cells->count);
    for (size_t i = 0; i < count; i++)
        arriving[own->queue[i]] += flow * own->share[i] / all;
}

bool sp_stream_spread_create(const sp_patches *cells, sp_stream_spread *discs, sp_error *error)
{
    size_t room = cells->count + 1;
    *discs = (sp_stream_spread){.cells = cells,
                                .queue = malloc(room * sizeof *discs->queue),
                                .seen = calloc(room, sizeof *discs->seen),
                                .share = malloc(room * sizeof *discs->share)};
    return (discs->queue && discs->seen && discs->share) || sp_fail_memory(error);
}

void sp_stream_spread_free(sp_stream_spread *discs)
{
    free(discs->queue);
    free(discs->seen);
    free(discs->share);
    *discs = (sp_stream_spread){0};
}

void sp_stream_spread_add(sp_stream_spread *discs, const sp_fluid *liquid, double flow, const double *hits,
                          double *arriving)
{
    double radius = sp_film_jet_radius(liquid, flow);
    assert(radius > 0);
    for (uint32_t i = 0; i < discs->cells->count; i++)
        if (hits[i] != 0)
            spread(discs, radius, i, hits[i], arriving);
}
