#include "discs.h"

#include "film/laminar.h"

#include <stdlib.h>

/* A disc in the making. */
typedef struct {
    const sp_patches *cells;
    double radius;   /* m */
    uint32_t *queue; /* [cells] */
    uint32_t *seen;  /* [cells], the last disc that each was looked at for, its middle + 1 */
    double *share;   /* [cells], by queue */
} disc;

/* How much of the cell lies in the disc about the middle, as area; at the edge as if it were a square across the way
 * there. */
static double part_of(const disc *own, uint32_t middle, uint32_t cell)
{
    double far = sp_distance(own->cells->point[middle], own->cells->point[cell]), edge = own->cells->length[cell];
    return own->cells->area[cell] * fmin(1, fmax(0, (own->radius - far) / edge + 0.5));
}

/* Spreads a flow over the disc, cell by neighbouring cell, so that it does not come through a wall. */
static void spread(disc *own, uint32_t middle, double flow, double *arriving)
{
    const sp_patches *cells = own->cells;
    double all = own->share[0] = cells->area[middle];
    own->queue[0] = middle;
    own->seen[middle] = middle + 1;
    size_t count = 1;
    for (size_t i = 0; i < count; i++)
        for (size_t k = cells->neighbour_start[own->queue[i]]; k < cells->neighbour_start[own->queue[i] + 1]; k++) {
            uint32_t cell = cells->neighbours[k];
            double part = own->seen[cell] == middle + 1 ? 0 : part_of(own, middle, cell);
            own->seen[cell] = middle + 1;
            if (!(part > 0))
                continue;
            own->queue[count] = cell;
            own->share[count++] = part;
            all += part;
        }
    for (size_t i = 0; i < count; i++)
        arriving[own->queue[i]] += flow * own->share[i] / all;
}

bool sp_discs_add(const sp_evaluator *walls, const sp_layout *stream, double *arriving, sp_error *error)
{
    const sp_patches *cells = &walls->patches;
    const sp_fluid *liquid = &walls->setup.liquid;
    size_t room = cells->count + 1;
    disc own = {.cells = cells,
                .radius = sp_film_jet_radius(liquid, sp_nozzle_flow(&stream->nozzles[0], liquid)),
                .queue = malloc(room * sizeof *own.queue),
                .seen = calloc(room, sizeof *own.seen),
                .share = malloc(room * sizeof *own.share)};
    sp_coverage *hit = sp_evaluate_inverse(walls, stream, error);
    bool done = hit && ((own.queue && own.seen && own.share) || sp_fail_memory(error));
    for (uint32_t i = 0; done && i < cells->count; i++)
        if (hit->deposits.flux[i] > 0)
            spread(&own, i, hit->deposits.flux[i] * cells->area[i], arriving);
    sp_coverage_destroy(hit);
    free(own.queue);
    free(own.seen);
    free(own.share);
    return done;
}
