/* How good an atlas is: cuts, distortion, use of the pages, and checks that hold for every atlas. */
#include "mesh/adjacent.h"
#include "atlas/overlap.h"
#include "atlas/texels/texels.h"

#include <sprayplan/atlas.h>

#include <math.h>
#include <stdlib.h>

/* Compensated summation (Neumaier 1974), or rounding over a million texels would be what is measured. */
typedef struct {
    double sum, rest;
} exact_sum;

static void add(exact_sum *s, double value)
{
    double sum = s->sum + value;
    s->rest += fabs(s->sum) >= fabs(value) ? (s->sum - sum) + value : (value - sum) + s->sum;
    s->sum = sum;
}

typedef struct {
    double strain, area;
} strained;

static int by_strain(const void *a, const void *b)
{
    const strained *p = a, *q = b;
    return (p->strain > q->strain) - (p->strain < q->strain);
}

/* max(σ1 - 1, 1 - σ2) of the map from the surface to the page, in true length. */
double sp_strain_of(const sp_atlas *atlas, const sp_mesh *mesh, uint32_t triangle)
{
    const uint32_t *corner = mesh->triangles[triangle];
    sp_vec3 b = sp_sub(mesh->vertices[corner[1]], mesh->vertices[corner[0]]);
    sp_vec3 c = sp_sub(mesh->vertices[corner[2]], mesh->vertices[corner[0]]);
    /* On the surface b lies along x; the map's matrix is the laid edges times the inverse of (b, c). */
    double bx = sp_length(b), cx = sp_dot(b, c) / bx, cy = sp_length(sp_cross(b, c)) / bx;
    const double(*uv)[2] = (const double(*)[2])atlas->uv[triangle];
    double column[2][2], texel = sp_atlas_texel_length(atlas, triangle);
    for (int k = 0; k < 2; k++) {
        double laid_b = (uv[1][k] - uv[0][k]) * texel, laid_c = (uv[2][k] - uv[0][k]) * texel;
        column[0][k] = laid_b / bx;
        column[1][k] = (laid_c - column[0][k] * cx) / cy;
    }
    /* The singular values of a 2x2 matrix in closed form. */
    double half_sum = 0.5 * hypot(column[0][0] + column[1][1], column[0][1] - column[1][0]);
    double half_difference = 0.5 * hypot(column[0][0] - column[1][1], column[0][1] + column[1][0]);
    return fmax(half_sum + half_difference - 1, 1 - fabs(half_sum - half_difference));
}

static bool measure_strain(const sp_atlas *atlas, const sp_mesh *mesh, sp_atlas_figures *figures)
{
    strained *all = malloc((mesh->triangle_count + 1) * sizeof *all);
    if (!all)
        return false;
    exact_sum area = {0}, mean = {0};
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        all[t] = (strained){sp_strain_of(atlas, mesh, t), sp_triangle_area(mesh, t)};
        add(&area, all[t].area);
        add(&mean, all[t].strain * all[t].area);
        figures->strain_max = fmax(figures->strain_max, all[t].strain);
    }
    qsort(all, mesh->triangle_count, sizeof *all, by_strain);
    double below = 0, whole = area.sum + area.rest;
    for (size_t i = 0; i < mesh->triangle_count && below < 0.95 * whole; i++) {
        below += all[i].area;
        figures->strain95 = all[i].strain;
    }
    figures->strain_mean = whole > 0 ? (mean.sum + mean.rest) / whole : 0;
    free(all);
    return true;
}

static bool measure_seams(const sp_atlas *atlas, const sp_mesh *mesh, double surface, sp_atlas_figures *figures,
                          sp_error *error)
{
    sp_half_edges edges = {0};
    if (!sp_adjacent_create(mesh, &edges, error))
        return false;
    double length = 0;
    for (size_t i = 0, of_edge; i < 3 * mesh->triangle_count; i += of_edge) {
        of_edge = sp_half_edges_of_edge(mesh, &edges, i);
        uint32_t a = edges.order[i];
        double edge = sp_distance(mesh->vertices[sp_half_edge_from(mesh, a)], mesh->vertices[sp_half_edge_to(mesh, a)]);
        size_t lips = of_edge;
        for (size_t k = i; k < i + of_edge; k++) {
            uint32_t h = edges.order[k], other = edges.opposite[h];
            lips -= other != SP_NONE && h < other && !sp_edge_is_cut(atlas, mesh, h, other);
        }
        length += (double)(lips - 1) * edge;
    }
    sp_half_edges_destroy(&edges);
    figures->seam_over_sqrt_area = surface > 0 ? length / sqrt(surface) : 0;
    return true;
}

/* Texels of more than one connected patch, those that two charts share among them, and pairs of triangles that overlap
 * in a chart. */
static bool measure_conflicts(const sp_atlas *atlas, const sp_mesh *mesh, sp_atlas_figures *figures, sp_error *error)
{
    sp_overlaps found;
    if (!sp_atlas_count_shared(atlas, mesh, &figures->shared_texels, error) ||
        !sp_find_overlaps(atlas, mesh, SIZE_MAX, &found, error))
        return false;
    figures->overlaps = found.count;
    return true;
}

static bool count_small_charts(const sp_atlas *atlas, sp_atlas_figures *figures)
{
    size_t *size = calloc(atlas->chart_count + 1, sizeof *size);
    if (!size)
        return false;
    for (size_t t = 0; t < atlas->triangle_count; t++)
        size[atlas->chart[t]]++;
    for (size_t c = 0; c < atlas->chart_count; c++)
        figures->charts_le4 += size[c] <= 4;
    free(size);
    return true;
}

static double flat_area(const double uv[3][2])
{
    return 0.5 * ((uv[1][0] - uv[0][0]) * (uv[2][1] - uv[0][1]) - (uv[1][1] - uv[0][1]) * (uv[2][0] - uv[0][0]));
}

bool sp_atlas_measure(const sp_atlas *atlas, const sp_mesh *mesh, sp_atlas_figures *figures, sp_error *error)
{
    *figures = (sp_atlas_figures){0};
    if (!atlas || !mesh)
        return false;
    figures->triangles = atlas->triangle_count;
    figures->charts = atlas->chart_count;
    figures->pages = atlas->page_count;
    figures->texels = atlas->texel_count;
    exact_sum surface = {0}, texels = {0}, flat = {0};
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        add(&surface, sp_triangle_area(mesh, t));
        add(&flat, flat_area((const double(*)[2])atlas->uv[t]));
    }
    for (size_t i = 0; i < atlas->texel_count; i++)
        add(&texels, atlas->texel_area[i]);
    double whole = surface.sum + surface.rest, difference = texels.sum - surface.sum + (texels.rest - surface.rest);
    figures->area_error = whole > 0 ? fabs(difference) / whole : 0;
    double page = (double)atlas->page_edge * atlas->page_edge;
    figures->utilisation = (flat.sum + flat.rest) / (page * (double)atlas->page_count);
    if (!measure_strain(atlas, mesh, figures) || !measure_seams(atlas, mesh, whole, figures, error) ||
        !count_small_charts(atlas, figures)) {
        sp_fail_memory(error);
        return false;
    }
    return measure_conflicts(atlas, mesh, figures, error);
}
