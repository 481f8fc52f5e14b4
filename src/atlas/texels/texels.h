/* The steps that make an atlas, each filling its own part of it. Each returns false with an error. */
#ifndef ATLAS_TEXELS_H
#define ATLAS_TEXELS_H

#include "atlas/texels/raster.h"
#include "mesh/half_edge.h"

#include <sprayplan/atlas.h>

/* texels.c: pixels, their patches, areas and seams, in this order. Needs uv and the pages. */
bool sp_atlas_cut(sp_atlas *atlas, const sp_mesh *mesh, sp_error *error);

/* pixels.c: which pixels are used, and by which chart: runs, row_start and pixel_count. */
bool sp_atlas_find_pixels(sp_atlas *atlas, sp_error *error);
/* share.c: the pixels where several unconnected patches cross: shared, behind and texel_count. */
bool sp_atlas_share_pixels(sp_atlas *atlas, const sp_mesh *mesh, const sp_half_edges *edges, sp_error *error);
/* seams.c: which texels touch across cuts. */
bool sp_atlas_find_seams(sp_atlas *atlas, const sp_mesh *mesh, const sp_half_edges *edges, sp_error *error);

/* share.c: counts the texels of more than one connected patch, from all of their fragments. */
bool sp_atlas_count_shared(const sp_atlas *atlas, const sp_mesh *mesh, size_t *shared, sp_error *error);

/* measure.c: max(σ1-1, 1-σ2) of a triangle's map from the surface to the page, in true length. */
double sp_strain_of(const sp_atlas *atlas, const sp_mesh *mesh, uint32_t triangle);

/* texel_of.c: the run that holds pixel (x, row); NULL where nothing lies. */
const sp_texel_run *sp_atlas_run(const sp_atlas *atlas, size_t row, uint32_t x);
/* texel_of.c: to which texel a triangle belongs in the pixel whose first texel is `pixel`. */
uint32_t sp_atlas_resolve(const sp_atlas *atlas, uint32_t pixel, uint32_t triangle);
/* texel_of.c: the first of atlas->shared at that pixel or a later one. */
size_t sp_atlas_shared_from(const sp_atlas *atlas, uint32_t pixel);
/* texel_of.c: begins with a triangle's pixels on its page. */
bool sp_atlas_rasterize(const sp_atlas *atlas, uint32_t triangle, sp_raster_kind kind, sp_raster *raster);
/* texel_of.c: the first texel of the row in hand; its pixels have the next ones, but for shared pixels. */
uint32_t sp_atlas_row_texel(const sp_atlas *atlas, uint32_t triangle, const sp_raster *raster);

/* pieces.c: what one triangle has in each of its texels. */
typedef struct {
    uint32_t texel;
    double area; /* m² on the surface; they sum to the triangle's */
} sp_texel_piece;
typedef struct {
    sp_texel_piece *items;
    size_t count, capacity;
    sp_raster raster;
} sp_pieces;
/* Ordered by row, then x. Returns false when memory runs out. */
bool sp_pieces_of(sp_pieces *pieces, const sp_atlas *atlas, const sp_mesh *mesh, uint32_t triangle);
/* Visits the triangle's own texels that share the side of a pixel: a triangle is convex, so it passes through that
 * side. a lies at x, y, b at the next x, or y where `above`. `pieces` is room to work in. False where memory runs out
 * or the visitor returns false. */
typedef bool sp_pieces_visitor(void *user, uint32_t a, uint32_t b, uint32_t x, uint32_t y, bool above);
bool sp_pieces_sides(sp_pieces *pieces, const sp_atlas *atlas, uint32_t triangle, sp_pieces_visitor *visit, void *user);
void sp_pieces_free(sp_pieces *pieces);

/* polygon.c: the area on the surface (m²) of a triangle's part of pixel (x, y) of its page; all of it where the
 * triangle has no area on the page. */
double sp_piece_area(const sp_atlas *atlas, const sp_mesh *mesh, uint32_t triangle, uint32_t x, uint32_t y);

/* edges.c: where the segment from p to q crosses the borders of pixels, as parts of it, ascending from 0 to 1, both
 * included. */
typedef struct {
    double *items;
    size_t count, capacity;
} sp_crossings;
bool sp_crossings_of(sp_crossings *crossings, const double p[2], const double q[2]);
/* edges.c: a point at `part` of a half-edge, as weights of its triangle's second and third corner and on the page. */
void sp_edge_weights(uint32_t half_edge, double part, double *u, double *v);
void sp_edge_point(const sp_atlas *atlas, uint32_t half_edge, double part, double point[2]);
/* edges.c: true where two half-edges of one edge do not lie on each other on the page. */
bool sp_edge_is_cut(const sp_atlas *atlas, const sp_mesh *mesh, uint32_t a, uint32_t b);
/* edges.c: true where the surface turns by more than 75 degrees across an edge, as at those of a box: two faces meet. a
 * and b are each other's opposite. */
bool sp_edge_is_crease(const sp_mesh *mesh, uint32_t a, uint32_t b);
/* edges.c: true where half-edges of one edge run against each other. */
bool sp_edge_is_opposite(const sp_mesh *mesh, uint32_t a, uint32_t b);

/* seams.c: both sides of an edge, step by step: between `from` and `to`, parts of the way along it, either side stays
 * in one texel. Starts as {0}. */
typedef struct {
    double from, to;
    uint32_t texel_a, texel_b;
    uint32_t a, b;
    double way[2][2]; /* parts of half-edge a and of b, from where to where */
    size_t at_a, at_b;
    sp_crossings crossings[2];
} sp_edge_walk;
bool sp_edge_walk_begin(sp_edge_walk *walk, const sp_atlas *atlas, const sp_mesh *mesh, uint32_t a, uint32_t b);
/* The same along parts of two half-edges, of one edge or of two that lie side by side. */
bool sp_edge_walk_begin_on(sp_edge_walk *walk, const sp_atlas *atlas, uint32_t a, const double on_a[2], uint32_t b,
                           const double on_b[2]);
bool sp_edge_walk_next(sp_edge_walk *walk, const sp_atlas *atlas);
void sp_edge_walk_free(sp_edge_walk *walk);

#endif
