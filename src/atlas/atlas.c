#include <sprayplan/atlas.h>

#include "atlas/pack.h"
#include "atlas/texels.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define DEFAULT_PAGE_EDGE 4096u
#define LARGEST_PAGE_EDGE 65535u

/* The corner of a chart's bounding box, m. */
typedef struct {
    double x, y;
} origin;

/* Boxes around the charts: their corners in `origins`, their sizes in whole texels in `boxes`. */
static bool measure_charts(const sp_charts *charts, double texel, uint32_t limit, origin *origins, sp_rectangle *boxes,
                           sp_error *error)
{
    double(*high)[2] = malloc((charts->chart_count + !charts->chart_count) * sizeof *high);
    if (!high) {
        sp_fail_memory(error);
        return false;
    }
    for (size_t c = 0; c < charts->chart_count; c++) {
        origins[c] = (origin){INFINITY, INFINITY};
        high[c][0] = high[c][1] = -INFINITY;
    }
    for (size_t t = 0; t < charts->triangle_count; t++)
        for (int i = 0; i < 3; i++) {
            uint32_t c = charts->chart[t];
            origins[c].x = fmin(origins[c].x, charts->flat[t][i][0]);
            origins[c].y = fmin(origins[c].y, charts->flat[t][i][1]);
            high[c][0] = fmax(high[c][0], charts->flat[t][i][0]);
            high[c][1] = fmax(high[c][1], charts->flat[t][i][1]);
        }
    bool fits = true;
    for (size_t c = 0; c < charts->chart_count && fits; c++) {
        /* Less a part in 10^9, so that a chart of a whole number of texels does not take one more for round-off. */
        double width = ceil((high[c][0] - origins[c].x) / texel * (1 - 1e-9));
        double height = ceil((high[c][1] - origins[c].y) / texel * (1 - 1e-9));
        fits = width <= limit && height <= limit;
        if (fits)
            boxes[c] = (sp_rectangle){.width = (uint32_t)fmax(width, 1), .height = (uint32_t)fmax(height, 1)};
        else
            sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                    "a flat piece of the surface of %g m by %g m does not fit a page of %u texels of %g m",
                    high[c][0] - origins[c].x, high[c][1] - origins[c].y, limit, texel);
    }
    free(high);
    return fits;
}

/* Moves every triangle to its place on its page. */
static void place_triangles(sp_atlas *atlas, const sp_charts *charts, const origin *origins, const sp_rectangle *boxes)
{
    for (size_t t = 0; t < charts->triangle_count; t++) {
        uint32_t c = charts->chart[t];
        /* Just inside the box's far sides, where round-off may have left no texel. */
        double right = nextafter((double)boxes[c].x + boxes[c].width, 0);
        double top = nextafter((double)boxes[c].y + boxes[c].height, 0);
        for (int i = 0; i < 3; i++) {
            atlas->uv[t][i][0] = fmin(boxes[c].x + (charts->flat[t][i][0] - origins[c].x) / atlas->texel, right);
            atlas->uv[t][i][1] = fmin(boxes[c].y + (charts->flat[t][i][1] - origins[c].y) / atlas->texel, top);
        }
    }
    for (size_t c = 0; c < charts->chart_count; c++)
        atlas->chart_page[c] = boxes[c].page;
    memcpy(atlas->chart, charts->chart, charts->triangle_count * sizeof *atlas->chart);
}

static bool lay_out(sp_atlas *atlas, const sp_charts *charts, uint32_t limit, sp_error *error)
{
    origin *origins = malloc((charts->chart_count + !charts->chart_count) * sizeof *origins);
    sp_rectangle *boxes = malloc((charts->chart_count + !charts->chart_count) * sizeof *boxes);
    bool done = origins && boxes;
    if (!done)
        sp_fail_memory(error);
    done = done && measure_charts(charts, atlas->texel, limit, origins, boxes, error) &&
           sp_pack(boxes, charts->chart_count, limit, &atlas->page_edge, &atlas->page_count, error);
    if (done)
        place_triangles(atlas, charts, origins, boxes);
    free(origins);
    free(boxes);
    return done;
}

sp_atlas *sp_atlas_create(const sp_mesh *mesh, const sp_charts *charts, const sp_atlas_options *options,
                          sp_error *error)
{
    if (!mesh || !charts)
        return NULL;
    uint32_t limit = options->page_edge ? options->page_edge : DEFAULT_PAGE_EDGE;
    if (!(options->texel > 0) || !isfinite(options->texel) || limit > LARGEST_PAGE_EDGE) {
        sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0,
                "an atlas of texels of %g m and pages of %u texels; expected a size "
                "above 0 and pages of at most %u",
                options->texel, limit, LARGEST_PAGE_EDGE);
        return NULL;
    }
    if (charts->triangle_count != mesh->triangle_count) {
        sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "charts of %zu triangles for a mesh of %zu",
                charts->triangle_count, mesh->triangle_count);
        return NULL;
    }
    sp_atlas *atlas = calloc(1, sizeof *atlas);
    if (!atlas)
        return sp_fail_memory(error);
    atlas->texel = options->texel;
    atlas->triangle_count = charts->triangle_count;
    atlas->chart_count = charts->chart_count;
    atlas->chart = malloc((charts->triangle_count + 1) * sizeof *atlas->chart);
    atlas->uv = malloc((charts->triangle_count + 1) * sizeof *atlas->uv);
    atlas->chart_page = malloc((charts->chart_count + 1) * sizeof *atlas->chart_page);
    bool done = atlas->chart && atlas->uv && atlas->chart_page;
    if (!done)
        sp_fail_memory(error);
    done = done && lay_out(atlas, charts, limit, error) && sp_atlas_cut(atlas, mesh, error) &&
           sp_atlas_connect(atlas, mesh, error);
    if (done)
        return atlas;
    sp_atlas_destroy(atlas);
    return NULL;
}

void sp_atlas_destroy(sp_atlas *atlas)
{
    if (!atlas)
        return;
    free(atlas->chart);
    free(atlas->chart_page);
    free(atlas->uv);
    free(atlas->texel_page);
    free(atlas->texel_x);
    free(atlas->texel_y);
    free(atlas->texel_chart);
    free(atlas->texel_area);
    free(atlas->fragment_start);
    free(atlas->fragments);
    free(atlas->triangle_start);
    free(atlas->triangle_texels);
    free(atlas->neighbour_start);
    free(atlas->neighbours);
    free(atlas);
}
