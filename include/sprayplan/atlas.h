/* The texture atlas: the surface unfolded into charts and cut into texels of known area. */
#ifndef SPRAYPLAN_ATLAS_H
#define SPRAYPLAN_ATLAS_H

#include <sprayplan/export.h>
#include <sprayplan/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The surface cut into charts and each laid flat, in true length. Independent of any texel size. Owned by the caller.
 */
typedef struct {
    size_t triangle_count;
    uint32_t *chart; /* [triangle_count] */
    size_t chart_count;
    double (*flat)[3][2]; /* [triangle_count], corners in the chart's own plane, m, anticlockwise like the triangle */
    double extent;        /* no chart's bounding box is longer than this, m (unless one triangle alone is) */
} sp_charts;

/* Grows regions that face one way (variational shape approximation), lays each flat (study 3.3.2.1, then as rigidly as
 * possible), and joins neighbours while at most 5 % of a chart's area has more than 5 % strain, no two triangles
 * overlap and no side of a box around the chart is longer than `extent` (m, INFINITY for no limit). Developable surface
 * is laid without strain but for round-off. Cuts at open and flipped edges; where more than two triangles meet at an
 * edge, they are paired off, the two that go on in each other most smoothly first, and each pair stays together.
 * Deterministic; size, place and attitude do not matter but for their round-off. The caller destroys. */
SP_API sp_charts *sp_charts_create(const sp_mesh *mesh, double extent, sp_error *error);
SP_API void sp_charts_destroy(sp_charts *charts);
/* The girth, how far it is around the part, of what each chart lies on, m: 2π times the chart's area over how far its
 * surface turns about the direction in which it turns most, summed over the edges of the mesh in it (half of those on
 * its rim). That is exact for convex prisms and cylinders and for spheres, whatever they were cut into; the larger the
 * flatter a chart is, INFINITY where it is flat; bends of opposite sense cancel out. [chart_count]; the caller frees.
 */
SP_API double *sp_charts_girth(const sp_charts *charts, const sp_mesh *mesh, sp_error *error);

/* More texels, counted by area, are refused as a unit or a length that cannot be meant: by evaluators and the program.
 */
#define SP_ATLAS_TEXELS_MOST 1e9

/* Used pixels side by side in one row of a page. Charts keep a pixel apart, so they are of one chart. */
typedef struct {
    uint32_t texel; /* of the first pixel; the next pixels have the next texels */
    uint32_t row;   /* page * page_edge + y */
    uint32_t chart;
    uint16_t x, count;
} sp_texel_run;

/* One triangle's share in a pixel where unconnected patches cross. */
typedef struct {
    uint32_t pixel; /* the pixel's first texel */
    uint32_t triangle;
    uint32_t texel; /* to which this triangle belongs there */
} sp_shared_pixel;

/* Two texels that touch across a cut; those of one pixel that a crease parts are none. */
typedef struct {
    uint32_t texel, other;
    uint32_t edge, across; /* the edge of the mesh along which they do most, as half-edge of either's side:
                              3 triangle + its first corner there */
    float length;          /* m on the surface, along all edges */
} sp_seam;

/* Corners of a chart are whole in so many parts of a pixel, a power of two, unless one of its triangles is less than
 * SP_ATLAS_THIN pixels high: far finer than any figure shows, and a report's page is given fewer digits. */
#define SP_ATLAS_PARTS 67108864.0 /* 2^26 */
#define SP_ATLAS_THIN 1e-6

/* A texel is one connected patch of one chart inside one pixel of a page. Nearly always it is all that the pixel holds;
 * where the two lips of a cut or of a fold cross a pixel, each has a texel of its own, and so has each face where the
 * surface turns by more than 75 degrees at an edge of the mesh. Texels [0, pixel_count) are the largest patch of every
 * used pixel, ordered by page, then y, then x; further patches follow in the order of their pixels. A pixel is the
 * square [x, x+1] × [y, y+1]. Only used pixels are numbered, and what is kept for one is its area: memory follows the
 * surface, not the pages. Nothing is spread over unused pixels. Read-only. */
typedef struct {
    double texel; /* edge length of a pixel, m, unless its chart has another */
    size_t triangle_count, chart_count, page_count;
    uint32_t page_edge;   /* every page is page_edge × page_edge pixels */
    uint32_t *chart;      /* [triangle_count] */
    uint32_t *chart_page; /* [chart_count] */
    double *chart_texel;  /* [chart_count], edge length of the pixels of each chart, m */
    double (*uv)[3][2];   /* [triangle_count], corners on the page, in pixels, see SP_ATLAS_PARTS */
    size_t texel_count, pixel_count;
    double *texel_area; /* [texel_count], m², on the surface; sums to the surface's area */
    uint32_t *behind;   /* [texel_count - pixel_count], ascending: the pixel (its first texel) of each further texel */
    size_t run_count;
    sp_texel_run *runs;  /* [run_count], ordered by row, then x */
    uint32_t *row_start; /* [page_count * page_edge + 1], the runs of each row */
    size_t shared_count;
    sp_shared_pixel *shared; /* [shared_count], every triangle in every pixel of several texels; by pixel, triangle */
    size_t seam_count;
    sp_seam *seams; /* [seam_count], ordered by texel, then other; each pair in both orders */
} sp_atlas;

typedef enum {
    SP_PACKING_PIXELS,  /* charts lie in each other's hollows, quarter-turned as they fit best */
    SP_PACKING_SKYLINE, /* bounding boxes, largest diagonal first (study 3.3.2.2) */
} sp_packing;

typedef struct {
    double texel;       /* edge length, m, > 0 */
    uint32_t page_edge; /* largest page in texels; 0: 4096 */
    sp_packing packing;
    const double *chart_texel; /* [chart_count], borrowed: another length for each chart, m, > 0; NULL: texel for all */
} sp_atlas_options;

/* Packs the charts with one pixel between any two, into the smallest square page found, or as many pages as needed, and
 * measures every texel by exact coverage. Fails with SP_ERROR_INPUT where a chart is larger than a page at this texel:
 * with an extent of page_edge texels that happens only to single triangles. charts and mesh are only read. */
SP_API sp_atlas *sp_atlas_create(const sp_mesh *mesh, const sp_charts *charts, const sp_atlas_options *options,
                                 sp_error *error);
/* The atlas that an OBJ file already holds as texture coordinates, `mesh` being what sp_mesh_load made of that file.
 * The coordinates are in units of a page's edge, the pages named by usemtl page_0, ...; they are kept as they are.
 * `texel` (m) 0: the file's own where sp_atlas_obj wrote it, else one of 2^20 of the surface. Where charts have no
 * pixel between them on longer ones than that, texels half as long are tried until they have, down to that. Fails with
 * SP_ERROR_INPUT, at the face's line, for what breaks what every atlas keeps: corners without coordinates or off the
 * page, triangles that are turned over, overlaps, lengths (more than 5 % of the area strained by more than 5 %), charts
 * without a pixel between them. */
SP_API sp_atlas *sp_atlas_reuse(const sp_mesh *mesh, const char *path, double texel, sp_error *error);

/* How an OBJ file lays its triangles flat, polygons cut as in the mesh and in the file's order. Nothing of it has been
 * checked. */
typedef struct {
    char *path; /* as it was read */
    size_t triangle_count;
    double (*uv)[3][2];      /* [triangle_count], in units of a page's edge, NAN at a corner without */
    uint32_t *page;          /* [triangle_count], of usemtl page_0, ... */
    int *line;               /* [triangle_count], of the face */
    double page_edge, texel; /* as sp_atlas_obj noted them: texels, m; 0 where it did not */
} sp_unfolding;

/* Reads a file that sp_mesh_load reads; `unit`: m per unit of the file's coordinates, as the mesh has it. */
SP_API sp_unfolding *sp_unfolding_read(const char *path, double unit, sp_error *error);
SP_API void sp_unfolding_destroy(sp_unfolding *unfolding);
/* As sp_atlas_reuse, of a mesh that several files make up, in the order of its source triangles; their pages follow one
 * another, each in the lower left of pages of one size, on texels of its own that are no longer than `texel`. Errors
 * name file and line. */
SP_API sp_atlas *sp_atlas_of_files(const sp_mesh *mesh, const sp_unfolding *const *files, size_t count, double texel,
                                   sp_error *error);
/* The texel (m) where none is asked for: the shortest that the files have themselves, or as sp_atlas_reuse has it. */
SP_API double sp_unfolding_texel(const sp_unfolding *const *files, size_t count, const sp_mesh *mesh);
/* The charts of an atlas as they lie on its pages, no edge cut anew; the caller destroys. */
SP_API sp_charts *sp_charts_of_atlas(const sp_atlas *atlas, sp_error *error);
SP_API void sp_atlas_destroy(sp_atlas *atlas);

/* The texel that holds the point (1-u-v, u, v) of a triangle; always one that the triangle has a part in. */
SP_API uint32_t sp_atlas_texel(const sp_atlas *atlas, uint32_t triangle, double u, double v);

/* The length of a triangle's texels, m. */
static inline double sp_atlas_texel_length(const sp_atlas *atlas, uint32_t triangle)
{
    return atlas->chart_texel[atlas->chart[triangle]];
}

/* Where a texel lies. */
typedef struct {
    uint32_t page, x, y, chart;
} sp_texel_place;
SP_API sp_texel_place sp_atlas_place(const sp_atlas *atlas, uint32_t texel);
/* The first texel of a pixel, SP_NONE where nothing lies. x and y may lie beyond the page. */
SP_API uint32_t sp_atlas_pixel(const sp_atlas *atlas, uint32_t page, uint32_t x, uint32_t y);
/* The seams of a texel: *count of them, from the result on. */
SP_API const sp_seam *sp_atlas_seams(const sp_atlas *atlas, uint32_t texel, size_t *count);
/* Where a point at `place` on the page of a seam's texel would lie on that of the other (both in pixels), if the
 * surface went on there as it does beyond the seam: turned and moved, or mirrored where the two face opposite ways. */
SP_API void sp_atlas_across(const sp_atlas *atlas, const sp_mesh *mesh, const sp_seam *seam, const double place[2],
                            double there[2]);

/* Which triangles a texel consists of. What the evaluators need beyond the atlas; 16 bytes a piece. */
typedef struct {
    uint32_t triangle;
    double area; /* m², of the part of the triangle inside the texel, on the surface */
} sp_fragment;
typedef struct {
    uint32_t *start;    /* [texel_count + 1]; fragments of texel i are [start[i], start[i+1]) */
    sp_fragment *items; /* ordered by texel, then triangle */
} sp_fragments;
SP_API bool sp_fragments_create(sp_fragments *fragments, const sp_atlas *atlas, const sp_mesh *mesh, sp_error *error);
/* Accepts what was never created, if it is all zeros. */
SP_API void sp_fragments_destroy(sp_fragments *fragments);

#define SP_FRAGMENT_POINTS 7 /* a triangle clipped by a square has at most this many corners */
/* The corners on the surface (m) of one triangle's part of a texel; returns how many (0 where round-off left nothing).
 */
SP_API int sp_atlas_fragment_polygon(const sp_atlas *atlas, const sp_mesh *mesh, uint32_t texel, uint32_t triangle,
                                     sp_vec3 polygon[SP_FRAGMENT_POINTS]);

/* Which texels touch along an edge of a pixel in their chart, or across a cut. Symmetric. */
typedef struct {
    uint32_t *start; /* [texel_count + 1]; neighbours of texel i are items[start[i]] up to start[i+1], ascending */
    uint32_t *items;
} sp_texel_links;
SP_API bool sp_texel_links_create(sp_texel_links *links, const sp_atlas *atlas, const sp_mesh *mesh, sp_error *error);
/* Accepts what was never created, if it is all zeros. */
SP_API void sp_texel_links_destroy(sp_texel_links *links);

/* The `atlas` command's figures. */
typedef struct {
    size_t triangles, charts, charts_le4, pages, texels;
    double seam_over_sqrt_area;               /* length of the cuts, between charts and inside them, over √area */
    double strain_mean, strain95, strain_max; /* max(σ1-1, 1-σ2) of each triangle's map, weighted by area */
    double utilisation;                       /* flat area over the area of the pages */
    size_t shared_texels;                     /* texels of more than one connected patch */
    size_t overlaps;                          /* pairs of triangles that overlap in a chart */
    double area_error;                        /* |Σ texel area − surface| / surface */
} sp_atlas_figures;
SP_API bool sp_atlas_measure(const sp_atlas *atlas, const sp_mesh *mesh, sp_atlas_figures *figures, sp_error *error);

/* The mesh with its UVs as OBJ text: every source triangle in order, groups named as sp_mesh_write_obj does,
 * `v` and `vt` with 17 significant digits, usemtl page_0, page_1, ... Malloc'd, terminated; the caller frees. Only an
 * atlas of one texel length can be read back by sp_atlas_reuse. */
SP_API char *sp_atlas_obj(const sp_atlas *atlas, const sp_mesh *mesh, sp_error *error);

#ifdef __cplusplus
}
#endif
#endif
