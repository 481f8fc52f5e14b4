/* The kd-tree by the surface area heuristic (Havran 2000; study, 3.2.2.1): of all planes through a vertex of a triangle's box
 * the one with the least expected cost, and none where a leaf costs less. */
#include "trace/kd_tree.h"

#include <stdlib.h>

#define TRAVERSE 3.0
#define INTERSECT 4.0
enum { FEW = 2 };

/* Where triangles begin and end along one axis, clipped to the cell, each ascending. */
typedef struct {
    double *starts, *ends, *flats; /* flats: of triangles that lie within a plane */
    size_t count, flat_count;
} kd_events;

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void collect(const kd_box *boxes, const kd_cell *cell, uint32_t axis, kd_events *events)
{
    events->count = cell->count;
    events->flat_count = 0;
    for (size_t i = 0; i < cell->count; i++) {
        const double(*box)[3] = boxes[cell->triangles[i]];
        double start = fmax(box[0][axis], cell->low[axis]), end = fmin(box[1][axis], cell->high[axis]);
        events->starts[i] = start;
        events->ends[i] = end;
        if (start == end)
            events->flats[events->flat_count++] = start;
    }
    qsort(events->starts, events->count, sizeof(double), compare);
    qsort(events->ends, events->count, sizeof(double), compare);
    qsort(events->flats, events->flat_count, sizeof(double), compare);
}

/* Half the surface area of the cell cut to [low, high] along `axis`. */
static double half_area(const kd_cell *cell, uint32_t axis, double low, double high)
{
    double along = high - low;
    uint32_t b = (axis + 1) % 3, c = (axis + 2) % 3;
    double across = cell->high[b] - cell->low[b], up = cell->high[c] - cell->low[c];
    return along * (across + up) + across * up;
}

/* Study, 3.19. */
static double split_cost(const kd_cell *cell, uint32_t axis, double position, size_t left, size_t right)
{
    double whole = half_area(cell, axis, cell->low[axis], cell->high[axis]);
    double before = half_area(cell, axis, cell->low[axis], position);
    double behind = half_area(cell, axis, position, cell->high[axis]);
    return TRAVERSE + INTERSECT * (before * (double)left + behind * (double)right) / whole;
}

static void sweep(const kd_cell *cell, uint32_t axis, const kd_events *events, double *best, kd_plane *plane)
{
    size_t started = 0, ended = 0, flat = 0;
    while (started < events->count || ended < events->count) {
        double position = started < events->count ? fmin(events->starts[started], events->ends[ended])
                                                  : events->ends[ended];
        size_t began_before = started, flat_here = 0;
        for (; started < events->count && events->starts[started] == position; started++)
            continue;
        for (; ended < events->count && events->ends[ended] == position; ended++)
            continue;
        for (; flat < events->flat_count && events->flats[flat] == position; flat++)
            flat_here++;
        if (!(position > cell->low[axis] && position < cell->high[axis]))
            continue;
        double cost = split_cost(cell, axis, position, began_before + flat_here, events->count - ended);
        if (cost < *best) {
            *best = cost;
            *plane = (kd_plane){position, axis};
        }
    }
}

static bool choose_cheapest(const kd_box *boxes, const kd_cell *cell, kd_plane *plane)
{
    plane->axis = KD_LEAF;
    if (cell->count <= FEW)
        return true;
    double *room = malloc(3 * cell->count * sizeof *room);
    if (!room)
        return false;
    kd_events events = {.starts = room, .ends = room + cell->count, .flats = room + 2 * cell->count};
    double best = INTERSECT * (double)cell->count;
    for (uint32_t axis = 0; axis < 3; axis++) {
        collect(boxes, cell, axis, &events);
        sweep(cell, axis, &events, &best, plane);
    }
    free(room);
    return true;
}

bool kd_tree_sah(const sp_mesh *mesh, kd_tree *tree) { return kd_tree_build(mesh, choose_cheapest, tree); }
