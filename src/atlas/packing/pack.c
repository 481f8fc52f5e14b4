#include "atlas/packing/pack.h"

#include "atlas/packing/nest.h"
#include "atlas/packing/skyline.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

/* The bounding boxes' places as spots. */
static bool pack_boxes(const sp_shape *shapes, size_t count, uint32_t limit, sp_spot *spots, uint32_t *page_edge,
                       size_t *page_count, sp_error *error)
{
    sp_rectangle *boxes = malloc((count + 1) * sizeof *boxes);
    if (!boxes)
        return sp_fail_memory(error);
    for (size_t i = 0; i < count; i++)
        boxes[i] = (sp_rectangle){.width = shapes[i].width, .height = shapes[i].height};
    bool done = sp_skyline(boxes, count, limit, page_edge, page_count, error);
    for (size_t i = 0; done && i < count; i++)
        spots[i] = (sp_spot){boxes[i].page, boxes[i].x, boxes[i].y, 0};
    free(boxes);
    return done;
}

/* A point of a frame after the frame was turned and put on its spot; `whole`: in parts of a pixel, to the nearest, so
 * that round-off beside round numbers tells nothing apart. */
static void place_point(const sp_shape *shape, const sp_spot *spot, const double point[2], bool whole, double uv[2])
{
    double width = shape->width, height = shape->height;
    /* off the frame by round-off alone */
    assert(point[0] > -1 && point[0] < width + 1 && point[1] > -1 && point[1] < height + 1);
    double x = fmin(fmax(point[0], 0), width), y = fmin(fmax(point[1], 0), height);
    const double turned[4][2] = {{x, y}, {height - y, x}, {width - x, height - y}, {y, width - x}};
    const double size[2] = {spot->turns % 2 ? height : width, spot->turns % 2 ? width : height};
    const double corner[2] = {spot->x, spot->y};
    for (int k = 0; k < 2; k++) { /* just inside the far sides, where round-off may have left no pixel */
        double at = corner[k] + turned[spot->turns][k], far = corner[k] + size[k];
        uv[k] = whole ? fmin(rint(at * SP_ATLAS_PARTS), far * SP_ATLAS_PARTS - 1) / SP_ATLAS_PARTS
                      : fmin(at, nextafter(far, 0));
    }
}

/* Whether a triangle is too thin to keep its shape in parts of a pixel. */
static bool is_sliver(double uv[3][2])
{
    double longest2 = 0,
           area = (uv[1][0] - uv[0][0]) * (uv[2][1] - uv[0][1]) - (uv[2][0] - uv[0][0]) * (uv[1][1] - uv[0][1]);
    for (int i = 0; i < 3; i++) {
        double x = uv[(i + 1) % 3][0] - uv[i][0], y = uv[(i + 1) % 3][1] - uv[i][1];
        longest2 = fmax(longest2, x * x + y * y);
    }
    return !(area * area > SP_ATLAS_THIN * SP_ATLAS_THIN * longest2);
}

static void place_triangle(sp_atlas *atlas, const sp_charts *charts, const sp_shape *shapes, const sp_spot *spots,
                           size_t t, bool whole)
{
    const sp_shape *shape = &shapes[charts->chart[t]];
    double texel = atlas->chart_texel[charts->chart[t]];
    for (int i = 0; i < 3; i++) {
        const double point[2] = {charts->flat[t][i][0] / texel + shape->left,
                                 charts->flat[t][i][1] / texel + shape->low};
        place_point(shape, &spots[charts->chart[t]], point, whole, atlas->uv[t][i]);
    }
}

/* Corners of charts without slivers are whole in parts of a pixel. False where memory runs out. */
static bool place_triangles(sp_atlas *atlas, const sp_charts *charts, const sp_shape *shapes, const sp_spot *spots)
{
    bool *thin = calloc(charts->chart_count + 1, sizeof *thin);
    for (size_t t = 0; thin && t < charts->triangle_count; t++) {
        place_triangle(atlas, charts, shapes, spots, t, false);
        thin[charts->chart[t]] |= is_sliver(atlas->uv[t]);
    }
    for (size_t t = 0; thin && t < charts->triangle_count; t++)
        if (!thin[charts->chart[t]])
            place_triangle(atlas, charts, shapes, spots, t, true);
    for (size_t c = 0; c < charts->chart_count; c++)
        atlas->chart_page[c] = spots[c].page;
    free(thin);
    return thin != NULL;
}

bool sp_atlas_pack(sp_atlas *atlas, const sp_charts *charts, sp_packing packing, uint32_t limit, sp_error *error)
{
    size_t count = charts->chart_count;
    sp_shape *shapes = sp_shapes_create(charts, atlas->chart_texel, limit, error);
    sp_spot *spots = malloc((count + 1) * sizeof *spots);
    bool done = shapes && (spots || sp_fail_memory(error));
    done = done && (packing == SP_PACKING_SKYLINE ? pack_boxes : sp_nest)(shapes, count, limit, spots,
                                                                          &atlas->page_edge, &atlas->page_count, error);
    done = done && (place_triangles(atlas, charts, shapes, spots) || sp_fail_memory(error));
    sp_shapes_destroy(shapes, count);
    free(spots);
    return done;
}
