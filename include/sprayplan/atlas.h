/* The texture atlas: the surface unfolded into charts and cut into texels of known area. */
#ifndef SPRAYPLAN_ATLAS_H
#define SPRAYPLAN_ATLAS_H

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

/* Grows charts by isometric unfolding over the half-edges (study 3.3.2.1), cutting at non-manifold and open edges,
 * where a triangle would overlap its chart and where the chart would exceed `extent` (m, INFINITY for no limit).
 * Deterministic. */
sp_charts *sp_charts_create(const sp_mesh *mesh, double extent, sp_error *error);
void sp_charts_destroy(sp_charts *charts);

typedef struct {
    uint32_t triangle;
    double area; /* m², of the part of the triangle inside the texel, on the surface */
} sp_fragment;

/* A texel is a square of the page that holds some surface of exactly one chart. Only such texels are numbered; memory
 * follows the surface, not the pages. Texel i covers [x, x+1] × [y, y+1] of its page. Read-only. */
typedef struct {
    double texel; /* edge length, m */
    size_t triangle_count, chart_count, page_count;
    uint32_t page_edge;   /* every page is page_edge × page_edge texels */
    uint32_t *chart;      /* [triangle_count] */
    uint32_t *chart_page; /* [chart_count] */
    double (*uv)[3][2];   /* [triangle_count], corners on the page, in texels */
    size_t texel_count;
    uint32_t *texel_page, *texel_x, *texel_y, *texel_chart; /* [texel_count], ordered by page, then y, then x */
    double *texel_area;                                     /* [texel_count], m²; sums to the surface's area */
    uint32_t *fragment_start;  /* [texel_count + 1]; fragments of texel i are [start[i], start[i+1]) */
    sp_fragment *fragments;    /* ordered by texel, then triangle */
    uint32_t *triangle_start;  /* [triangle_count + 1]; each triangle's own texels, at least one, are */
    uint32_t *triangle_texels; /* [start[t], start[t + 1]), ascending */
    uint32_t *neighbour_start; /* [texel_count + 1] */
    uint32_t *neighbours;      /* texels that touch along an edge in the chart or across a seam; symmetric, ascending */
} sp_atlas;

typedef struct {
    double texel;       /* edge length, m, > 0 */
    uint32_t page_edge; /* largest page in texels; 0: 4096 */
} sp_atlas_options;

/* Packs the charts by a skyline of bounding boxes, largest diagonal first (study 3.3.2.2), a gap of one texel between
 * charts, as many pages as needed, and measures every texel by clipping. Fails with SP_ERROR_INPUT where a chart is
 * larger than a page at this texel: with an extent of page_edge texels that happens only to single triangles. charts
 * and mesh are only read. */
sp_atlas *sp_atlas_create(const sp_mesh *mesh, const sp_charts *charts, const sp_atlas_options *options,
                          sp_error *error);
void sp_atlas_destroy(sp_atlas *atlas);

/* The texel that holds the point (1-u-v, u, v) of a triangle; always one of that triangle's own texels. */
uint32_t sp_atlas_texel(const sp_atlas *atlas, uint32_t triangle, double u, double v);

#define SP_FRAGMENT_POINTS 7 /* a triangle clipped by a square has at most this many corners */
/* The corners on the surface (m) of one fragment of `texel`, `fragment` being an index into fragments; returns how many
 * (0 where round-off left nothing). */
int sp_atlas_fragment_polygon(const sp_atlas *atlas, const sp_mesh *mesh, uint32_t texel, uint32_t fragment,
                              sp_vec3 polygon[SP_FRAGMENT_POINTS]);

/* The `atlas` command's figures. */
typedef struct {
    size_t triangles, charts, charts_le4, pages, texels;
    double seam_over_sqrt_area;               /* length of the cuts, between charts and inside them, over √area */
    double strain_mean, strain95, strain_max; /* max(σ1-1, 1-σ2) of each triangle's map, weighted by area */
    double utilisation;                       /* flat area over the area of the pages */
    size_t shared_texels, overlaps;           /* texels with two charts; pairs of triangles that overlap in a chart */
    double area_error;                        /* |Σ texel area − surface| / surface */
} sp_atlas_figures;
bool sp_atlas_measure(const sp_atlas *atlas, const sp_mesh *mesh, sp_atlas_figures *figures, sp_error *error);

/* The mesh with its UVs as OBJ text: every source triangle in order, groups as they came, `v` and `vt` with 17
 * significant digits, usemtl page_0, page_1, ... Malloc'd, terminated; the caller frees. */
char *sp_atlas_obj(const sp_atlas *atlas, const sp_mesh *mesh, sp_error *error);

#ifdef __cplusplus
}
#endif
#endif
