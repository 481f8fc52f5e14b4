/* The corners of one triangle's part of one texel. */
#include "atlas/texels/clip.h"
#include "atlas/texels/texels.h"

#include <math.h>

/* Weights of the second and third corner of a point in the pixel's plane. */
static void weights(const double t[3][2], const double point[2], double *u, double *v)
{
    double bx = t[1][0] - t[0][0], by = t[1][1] - t[0][1], cx = t[2][0] - t[0][0], cy = t[2][1] - t[0][1];
    double px = point[0] - t[0][0], py = point[1] - t[0][1], twice = bx * cy - by * cx;
    *u = fmin(1, fmax(0, (px * cy - py * cx) / twice));
    *v = fmin(1 - *u, fmax(0, (bx * py - by * px) / twice));
}

/* The triangle from the corner of the pixel (x, y), which loses nothing, and its part of that pixel. */
static void clip_to_pixel(const sp_atlas *atlas, uint32_t triangle, uint32_t x, uint32_t y, double corner[3][2],
                          sp_polygon *part)
{
    sp_polygon strip;
    for (int i = 0; i < 3; i++) {
        corner[i][0] = atlas->uv[triangle][i][0] - x;
        corner[i][1] = atlas->uv[triangle][i][1] - y;
    }
    sp_clip_row((const double(*)[2])corner, 0, &strip);
    sp_clip_column(&strip, 0, part);
}

double sp_piece_area(const sp_atlas *atlas, const sp_mesh *mesh, uint32_t triangle, uint32_t x, uint32_t y)
{
    double corner[3][2];
    sp_polygon part, whole = {.count = 3};
    clip_to_pixel(atlas, triangle, x, y, corner, &part);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++)
            whole.point[i][k] = corner[i][k];
    double flat = sp_polygon_area(&whole), surface = sp_triangle_area(mesh, triangle);
    return flat > 0 ? fmin(1, fmax(0, sp_polygon_area(&part) / flat)) * surface : surface;
}

static bool lies_in_one_pixel(const sp_atlas *atlas, uint32_t triangle)
{
    sp_raster raster = {0};
    sp_atlas_rasterize(atlas, triangle, SP_RASTER_PIXELS, &raster); /* needs no memory */
    return sp_raster_next(&raster) && raster.count == 1 && !sp_raster_next(&raster);
}

int sp_atlas_fragment_polygon(const sp_atlas *atlas, const sp_mesh *mesh, uint32_t texel, uint32_t triangle,
                              sp_vec3 polygon[SP_FRAGMENT_POINTS])
{
    sp_texel_place place = sp_atlas_place(atlas, texel);
    double corner[3][2];
    sp_polygon part;
    if (lies_in_one_pixel(atlas, triangle)) {
        for (int i = 0; i < 3; i++) /* the whole triangle, even where it has no area on the page */
            polygon[i] = mesh->vertices[mesh->triangles[triangle][i]];
        return 3;
    }
    clip_to_pixel(atlas, triangle, place.x, place.y, corner, &part);
    if (part.count > SP_FRAGMENT_POINTS || !(sp_polygon_area(&part) > 0))
        return 0;
    for (int i = 0; i < part.count; i++) {
        double u, v;
        weights((const double(*)[2])corner, part.point[i], &u, &v);
        polygon[i] = sp_triangle_point(mesh, triangle, u, v);
    }
    return part.count;
}
