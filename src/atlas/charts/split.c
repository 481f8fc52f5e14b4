#include "atlas/charts/split.h"

#include "atlas/charts/regions.h"

#include <math.h>
#include <stdlib.h>

/* Distances are compared on a grid of this many steps, so that of equal ones the first is taken, however they round. */
#define STEPS 0x1p20

static sp_vec3 middle_of(const sp_mesh *mesh, uint32_t triangle)
{
    return sp_triangle_point(mesh, triangle, 1.0 / 3, 1.0 / 3);
}

/* The middle of the triangle that lies farthest from `from`. */
static sp_vec3 farthest(const sp_mesh *mesh, const sp_sheet *sheet, sp_vec3 from)
{
    double most = 0, best = -1;
    sp_vec3 found = from;
    for (size_t i = 0; i < sheet->triangle_count; i++)
        most = fmax(most, sp_distance(middle_of(mesh, sheet->triangle[i]), from));
    for (size_t i = 0; i < sheet->triangle_count; i++) {
        sp_vec3 middle = middle_of(mesh, sheet->triangle[i]);
        double steps = most > 0 ? rint(STEPS * sp_distance(middle, from) / most) : 0;
        if (steps > best) {
            best = steps;
            found = middle;
        }
    }
    return found;
}

/* By the side of a plane through the middle and across the length. */
static void split_by_plane(const sp_mesh *mesh, const sp_sheet *sheet, uint32_t *region, uint32_t below, uint32_t above)
{
    sp_vec3 centre = sp_v(0, 0, 0);
    for (size_t i = 0; i < sheet->triangle_count; i++)
        centre = sp_along(centre, 1 / (double)sheet->triangle_count, middle_of(mesh, sheet->triangle[i]));
    sp_vec3 end = farthest(mesh, sheet, centre), axis = sp_sub(farthest(mesh, sheet, end), end);
    for (size_t i = 0; i < sheet->triangle_count; i++) {
        double along = sp_dot(sp_sub(middle_of(mesh, sheet->triangle[i]), centre), axis);
        region[sheet->triangle[i]] = along > sp_dot(axis, axis) / STEPS ? above : below;
    }
}

/* Gives the first `most` triangles around `seed` in region `from`, breadth first, to region `to`; returns the last. */
static uint32_t spread(const sp_sheets *sheets, uint32_t *region, uint32_t from, uint32_t to, uint32_t seed,
                       size_t most, uint32_t *queue)
{
    size_t count = 0;
    queue[count++] = seed;
    region[seed] = to;
    for (size_t i = 0; i < count; i++)
        for (uint32_t h = 3 * queue[i]; h < 3 * queue[i] + 3 && count < most; h++) {
            uint32_t twin = sheets->twin[h];
            if (twin == SP_NONE || region[twin / 3] != from)
                continue;
            region[twin / 3] = to;
            queue[count++] = twin / 3;
        }
    return queue[count - 1];
}

/* In the order in which triangles are reached from one end: in a strip of needles their middles lie to and fro, and a
 * plane would part every one from the next. */
static bool split_by_steps(const sp_sheets *sheets, const sp_sheet *sheet, uint32_t *region, uint32_t below,
                           uint32_t above)
{
    size_t count = sheet->triangle_count;
    uint32_t *queue = malloc((count + 1) * sizeof *queue);
    if (!queue)
        return false;
    for (size_t i = 0; i < count; i++)
        region[sheet->triangle[i]] = below;
    uint32_t end = spread(sheets, region, below, above, sheet->triangle[0], count, queue);
    spread(sheets, region, above, below, end, count / 2, queue);
    free(queue);
    return true;
}

/* The length of the border, made straight, in steps of the sheet's size; infinite where there are no two sides. */
static double border_of(const sp_sheets *sheets, const sp_sheet *sheet, uint32_t *region, uint32_t below)
{
    double length = 0;
    size_t counts[2] = {0, 0};
    sp_regions_straighten(sheets->mesh, sheets->twin, sheet->triangle, sheet->triangle_count, below, region);
    for (size_t i = 0; i < sheet->triangle_count; i++) {
        uint32_t t = sheet->triangle[i];
        counts[region[t] == below]++;
        for (uint32_t h = 3 * t; region[t] == below && h < 3 * t + 3; h++)
            if (sheets->twin[h] != SP_NONE && region[sheets->twin[h] / 3] == below + 1)
                length += sp_edge_length(sheets, h);
    }
    return counts[0] && counts[1] ? rint(STEPS * length / sqrt(sheet->area)) : INFINITY;
}

bool sp_split(const sp_sheets *sheets, const sp_sheet *sheet, uint32_t *region, uint32_t below)
{
    uint32_t above = below + 1;
    if (!split_by_steps(sheets, sheet, region, below, above))
        return false;
    double by_steps = border_of(sheets, sheet, region, below);
    split_by_plane(sheets->mesh, sheet, region, below, above);
    double by_plane = border_of(sheets, sheet, region, below);
    if (by_plane <= by_steps && by_plane < INFINITY)
        return true;
    if (!split_by_steps(sheets, sheet, region, below, above))
        return false;
    if (by_steps < INFINITY)
        sp_regions_straighten(sheets->mesh, sheets->twin, sheet->triangle, sheet->triangle_count, below, region);
    return true;
}
