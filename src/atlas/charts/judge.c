#include "atlas/charts/judge.h"

#include "atlas/charts/orient.h"
#include "atlas/charts/outline.h"

#include <math.h>
#include <stdlib.h>

/* Twice the area of a triangle that counts as anticlockwise, over its longest edge and the size of the sheet: turning
 * or moving the sheet as a whole cannot turn it over by round-off. */
#define LEAST_HEIGHT 1e-13
#define LEAST_FILLED 0.36 /* of its box, by a sheet that may be cut */
#define SMALL 0.2         /* of the square's edge: what sheets leave empty that are smaller is of no account */

static double strain_of(const double shape[3], const double p[2], const double q[2], const double r[2], double *twice)
{
    double bx = q[0] - p[0], by = q[1] - p[1], cx = r[0] - p[0], cy = r[1] - p[1];
    *twice = bx * cy - by * cx;
    /* The map's matrix, and its singular values in closed form: mean ± difference. */
    double a = bx / shape[0], b = by / shape[0];
    double c = (cx - a * shape[1]) / shape[2], d = (cy - b * shape[1]) / shape[2];
    double mean = 0.5 * sqrt((a + d) * (a + d) + (b - c) * (b - c));
    double difference = 0.5 * sqrt((a - d) * (a - d) + (b + c) * (b + c));
    return difference + fabs(mean - 1);
}

static void size_of(const sp_sheet *sheet, double size[2])
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (size_t v = 0; v < sheet->vertex_count; v++)
        for (int k = 0; k < 2; k++) {
            low[k] = sheet->at[v][k] < low[k] ? sheet->at[v][k] : low[k];
            high[k] = sheet->at[v][k] > high[k] ? sheet->at[v][k] : high[k];
        }
    for (int k = 0; k < 2; k++)
        size[k] = high[k] - low[k];
}

sp_strain sp_measure_strain(const sp_sheets *sheets, const sp_sheet *sheet)
{
    sp_strain found = {0};
    double over = 0, size[2];
    size_of(sheet, size);
    double least = LEAST_HEIGHT * (size[0] + size[1]);
    for (size_t i = 0; i < sheet->triangle_count; i++) {
        const double *shape = sheets->shape[sheet->triangle[i]];
        const uint32_t *c = sheet->corner[i];
        double twice, strain = strain_of(shape, sheet->at[c[0]], sheet->at[c[1]], sheet->at[c[2]], &twice);
        double beyond = 2 * (shape[0] + fabs(shape[1]) + shape[2]); /* of the longest edge, which takes a root */
        found.flipped += !(twice > least * beyond) && !(twice > least * fmax(shape[0], hypot(shape[1], shape[2])));
        found.most = strain > found.most ? strain : found.most;
        over += strain <= SP_STRAIN_BOUND ? 0 : 0.5 * shape[0] * shape[2];
    }
    found.share = over / sheet->area;
    return found;
}

sp_verdict sp_judge_box(const sp_sheets *sheets, const sp_sheet *sheet, double extent)
{
    bool strained = sheet->strain > SP_DEVELOPABLE_STRAIN;
    double size[2], square = sheets->square;
    size_of(sheet, size);
    if (strained)
        extent = fmin(extent, square);
    if (hypot(size[0], size[1]) <= (strained ? fmin(extent, SMALL * square) : extent))
        return SP_SHEET_FITS;
    sp_least_box box = sp_find_least_box(sheet, extent);
    if (!box.memory)
        return SP_SHEET_MEMORY;
    bool filled = !strained || sheet->area >= LEAST_FILLED * box.width * box.height;
    return box.fits && filled ? SP_SHEET_FITS : SP_SHEET_UNFIT;
}

/* Boundary edges of a sheet; NULL when memory runs out. */
static sp_segment *boundary_of(const sp_sheets *sheets, const sp_sheet *sheet, size_t *count)
{
    size_t capacity = 64;
    sp_segment *segments = malloc(capacity * sizeof *segments);
    *count = 0;
    for (size_t i = 0; segments && i < 3 * sheet->triangle_count; i++) {
        uint32_t k = (uint32_t)(i % 3), h = 3 * sheet->triangle[i / 3] + k;
        if (sp_across(sheets, h) != SP_NONE)
            continue;
        if (*count == capacity) {
            capacity *= 2;
            sp_segment *grown = realloc(segments, capacity * sizeof *segments);
            if (!grown)
                free(segments);
            segments = grown;
            if (!segments)
                break;
        }
        uint32_t from = sheet->corner[i / 3][k], to = sheet->corner[i / 3][(k + 1) % 3];
        segments[(*count)++] = (sp_segment){from, to, sheet->at[from], sheet->at[to]};
    }
    return segments;
}

sp_verdict sp_judge_overlap(const sp_sheets *sheets, uint32_t number)
{
    const sp_sheet *sheet = &sheets->items[number];
    size_t count;
    sp_segment *segments = boundary_of(sheets, sheet, &count);
    sp_boundary_test outline =
        segments ? sp_test_boundary(segments, count, sheet->vertex_count) : (sp_boundary_test){0};
    free(segments);
    if (!outline.memory)
        return SP_SHEET_MEMORY;
    return outline.simple ? SP_SHEET_FITS : SP_SHEET_UNFIT;
}
