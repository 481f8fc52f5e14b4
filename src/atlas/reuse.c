/* Takes an atlas from a file, and believes nothing of it. */
#include "atlas/reuse.h"

#include "atlas/adjacent.h"
#include "atlas/overlap.h"
#include "atlas/texels/texels.h"
#include "mesh/file.h"
#include "mesh/texture.h"

#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define STRAIN 0.05          /* that of at most as much of the area may be exceeded */
#define LARGEST_PAGE 65535.0 /* pixels */
#define USUAL_TEXELS 1048576.0
#define EMPTIEST 64.0  /* pixels for every texel of surface */
#define SMALL 16777216 /* pixels that are no matter */

typedef struct {
    const sp_mesh *mesh;
    const char *path, *text;
    sp_texture texture;
    sp_atlas *atlas;
    sp_error *error;
} reuse;

static bool refuse(const reuse *r, uint32_t triangle, const char *found)
{
    return sp_fail(r->error, SP_ERROR_INPUT, r->path, r->texture.line[r->mesh->source[triangle]], 0,
                   "found %s; expected texture coordinates as atlas writes them", found);
}

/* Finite, on the page, and not turned over. */
static bool check_corners(const reuse *r)
{
    for (uint32_t t = 0; t < r->mesh->triangle_count; t++) {
        const double(*uv)[2] = (const double(*)[2])r->texture.uv[r->mesh->source[t]];
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 2; k++) {
                if (isnan(uv[i][k]))
                    return refuse(r, t, "a corner without texture coordinates");
                if (!(uv[i][k] >= 0 && uv[i][k] <= 1))
                    return refuse(r, t, "a texture coordinate off the page, which is from 0 to 1");
            }
        double twice = (uv[1][0] - uv[0][0]) * (uv[2][1] - uv[0][1]) - (uv[1][1] - uv[0][1]) * (uv[2][0] - uv[0][0]);
        if (twice < 0)
            return refuse(r, t, "a triangle that is turned over on the page");
    }
    return true;
}

/* How many metres a page's edge spans, so that the area is kept. */
static double scale_of(const reuse *r)
{
    double flat = 0;
    for (uint32_t t = 0; t < r->mesh->triangle_count; t++) {
        const double(*uv)[2] = (const double(*)[2])r->texture.uv[r->mesh->source[t]];
        flat += 0.5 * ((uv[1][0] - uv[0][0]) * (uv[2][1] - uv[0][1]) - (uv[1][1] - uv[0][1]) * (uv[2][0] - uv[0][0]));
    }
    return sqrt(sp_mesh_area(r->mesh) / flat);
}

/* What sp_atlas_obj noted in the file's first line; false where it did not. */
static bool read_mark(const reuse *r, double *page_edge, double *texel)
{
    const char *text = r->text;
    if (strncmp(text, SP_ATLAS_MARK, sizeof SP_ATLAS_MARK - 1) != 0)
        return false;
    char *end;
    *page_edge = strtod(text + sizeof SP_ATLAS_MARK - 1, &end);
    *texel = strtod(end, &end);
    return *page_edge >= 1 && *page_edge <= LARGEST_PAGE && *page_edge == floor(*page_edge) && *texel > 0 &&
           isfinite(*texel);
}

/* A texel asked for is not enlarged, and whole texels go into a page. */
static bool choose_texel(const reuse *r, double asked)
{
    double page_edge, texel;
    bool marked = read_mark(r, &page_edge, &texel);
    if (!marked || asked > 0) {
        double scale = marked ? page_edge * texel : scale_of(r);
        double wanted = asked > 0 ? asked : sqrt(sp_mesh_area(r->mesh) / USUAL_TEXELS);
        page_edge = fmax(1, ceil(scale / wanted * (1 - 1e-12)));
        texel = scale / page_edge;
        if (!isfinite(scale) || !(texel > 0) || !(page_edge <= LARGEST_PAGE))
            return sp_fail(r->error, SP_ERROR_INPUT, r->path, 0, 0,
                           "found a page of %g m, expected one of at most %g texels of %g m", scale, LARGEST_PAGE,
                           wanted);
    }
    r->atlas->page_edge = (uint32_t)page_edge;
    r->atlas->texel = texel;
    return true;
}

/* The coordinate in pixels that gives the file's own number when it is divided by the page's edge again. */
static double in_pixels(double coordinate, double page_edge)
{
    double pixels = coordinate * page_edge;
    const double near[5] = {pixels, nextafter(pixels, 0), nextafter(pixels, INFINITY),
                            nextafter(nextafter(pixels, 0), 0), nextafter(nextafter(pixels, INFINITY), INFINITY)};
    for (int i = 0; i < 5; i++)
        if (near[i] / page_edge == coordinate)
            return fmin(near[i], nextafter(page_edge, 0));
    return fmin(pixels, nextafter(page_edge, 0));
}

static void take_coordinates(reuse *r)
{
    sp_atlas *atlas = r->atlas;
    for (uint32_t t = 0; t < atlas->triangle_count; t++) {
        atlas->chart[t] = t;
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 2; k++)
                atlas->uv[t][i][k] = in_pixels(r->texture.uv[r->mesh->source[t]][i][k], atlas->page_edge);
    }
}

static uint32_t root_of(uint32_t *chart, uint32_t t)
{
    while (chart[t] != t)
        t = chart[t] = chart[chart[t]];
    return t;
}

/* A chart is what is joined along edges that lie on each other. */
static bool find_charts(reuse *r)
{
    sp_half_edges edges = {0};
    sp_atlas *atlas = r->atlas;
    const sp_mesh *mesh = r->mesh;
    uint32_t *root = malloc((atlas->triangle_count + 1) * sizeof *root);
    bool done = root ? sp_adjacent_create(mesh, &edges, r->error) : (bool)sp_fail_memory(r->error);
    for (uint32_t t = 0; done && t < atlas->triangle_count; t++) {
        root[t] = t;
        atlas->chart[t] = r->texture.page[mesh->source[t]]; /* only what lies on one page can be joined */
    }
    for (uint32_t h = 0; done && h < 3 * atlas->triangle_count; h++) {
        uint32_t other = edges.opposite[h];
        if (other == SP_NONE || other < h || sp_edge_is_cut(atlas, mesh, h, other))
            continue;
        uint32_t a = root_of(root, h / 3), b = root_of(root, other / 3);
        root[a > b ? a : b] = a > b ? b : a;
    }
    sp_half_edges_destroy(&edges);
    for (uint32_t t = 0; done && t < atlas->triangle_count; t++)
        if (root_of(root, t) == t) { /* the lowest of its chart, so that the chart's others come later */
            size_t page = atlas->chart[t];
            atlas->chart_page[atlas->chart_count] = (uint32_t)page;
            atlas->chart_texel[atlas->chart_count] = atlas->texel;
            atlas->page_count = page >= atlas->page_count ? page + 1 : atlas->page_count;
            atlas->chart[t] = (uint32_t)atlas->chart_count++;
        } else {
            atlas->chart[t] = atlas->chart[root[t]];
        }
    free(root);
    return done;
}

static bool check_lengths(const reuse *r)
{
    double strained = 0, area = 0, most = 0;
    uint32_t worst = 0;
    for (uint32_t t = 0; t < r->mesh->triangle_count; t++) {
        double strain = sp_strain_of(r->atlas, r->mesh, t), here = sp_triangle_area(r->mesh, t);
        area += here;
        strained += strain <= STRAIN * (1 + 1e-6) ? 0 : here;
        if (!(strain <= most)) {
            most = strain;
            worst = t;
        }
    }
    if (strained <= STRAIN * (1 + 1e-6) * area)
        return true;
    return refuse(r, worst, "more than 5 % of the area with lengths that are not kept within 5 %, worst here");
}

static bool check_overlaps(const reuse *r)
{
    sp_overlaps found;
    if (!sp_find_overlaps(r->atlas, r->mesh, 1, &found, r->error))
        return false;
    return !found.count || refuse(r, found.triangle, "a triangle that overlaps another of its chart");
}

/* Whether other charts than `chart` are painted on [x, end) of a row. */
static bool is_foreign(const uint32_t *row, size_t x, size_t end, uint32_t chart)
{
    for (; x < end; x++)
        if (row[x] && row[x] != chart)
            return true;
    return false;
}

/* Paints one page, each pixel with its chart's number from 1, and looks for others in it and around it. */
static bool check_page(const reuse *r, uint32_t page, uint32_t *paint, sp_cover *cover)
{
    const sp_atlas *atlas = r->atlas;
    size_t edge = atlas->page_edge;
    memset(paint, 0, edge * edge * sizeof *paint);
    for (uint32_t t = 0; t < atlas->triangle_count; t++) {
        uint32_t chart = atlas->chart[t] + 1;
        if (atlas->chart_page[atlas->chart[t]] != page)
            continue;
        sp_atlas_cover(atlas, t, SP_COVER_PIXELS, cover); /* needs no memory */
        while (sp_cover_next(cover)) {
            size_t from = cover->x ? cover->x - 1 : 0, end = cover->x + (size_t)cover->count + 1;
            end = end < edge ? end : edge;
            for (size_t y = cover->y ? cover->y - 1 : 0; y < cover->y + 2 && y < edge; y++)
                if (is_foreign(paint + y * edge, from, end, chart))
                    return refuse(r, t, "a chart that lies on another or without a pixel between");
            for (size_t x = cover->x; x < (size_t)cover->x + cover->count; x++)
                paint[cover->y * edge + x] = chart;
        }
    }
    return true;
}

static bool check_gaps(const reuse *r)
{
    size_t edge = r->atlas->page_edge;
    uint32_t *paint = malloc(edge * edge * sizeof *paint);
    sp_cover cover = {0};
    bool done = paint || sp_fail_memory(r->error);
    for (uint32_t page = 0; done && page < r->atlas->page_count; page++)
        done = check_page(r, page, paint, &cover);
    free(paint);
    sp_cover_free(&cover);
    return done;
}

/* No page is left out, and pages are not so empty that checking them takes more memory than what they hold. */
static bool check_pages(const reuse *r)
{
    const sp_atlas *atlas = r->atlas;
    double pixels = (double)atlas->page_edge * atlas->page_edge * (double)atlas->page_count;
    double texels = sp_mesh_area(r->mesh) / (atlas->texel * atlas->texel);
    if (atlas->page_count <= atlas->chart_count && pixels <= EMPTIEST * texels + SMALL)
        return true;
    return sp_fail(r->error, SP_ERROR_INPUT, r->path, 0, 0,
                   "found %zu pages of %u texels for %g texels of surface; expected fewer", atlas->page_count,
                   atlas->page_edge, texels);
}

static bool build(reuse *r, double texel)
{
    const sp_mesh *mesh = r->mesh;
    sp_atlas *atlas = r->atlas;
    if (r->texture.triangle_count != mesh->source_triangle_count)
        return sp_fail(r->error, SP_ERROR_ARGUMENT, r->path, 0, 0, "found %zu triangles, expected the mesh's %zu",
                       r->texture.triangle_count, mesh->source_triangle_count);
    atlas->triangle_count = mesh->triangle_count;
    atlas->chart = malloc((mesh->triangle_count + 1) * sizeof *atlas->chart);
    atlas->uv = malloc((mesh->triangle_count + 1) * sizeof *atlas->uv);
    atlas->chart_page = malloc((mesh->triangle_count + 1) * sizeof *atlas->chart_page);
    atlas->chart_texel = malloc((mesh->triangle_count + 1) * sizeof *atlas->chart_texel);
    if (!atlas->chart || !atlas->uv || !atlas->chart_page || !atlas->chart_texel)
        return sp_fail_memory(r->error);
    if (!check_corners(r) || !choose_texel(r, texel))
        return false;
    take_coordinates(r);
    return find_charts(r) && check_pages(r) && check_lengths(r) && check_gaps(r) && check_overlaps(r) &&
           sp_atlas_cut(atlas, mesh, r->error);
}

sp_atlas *sp_atlas_read(const sp_mesh *mesh, const char *path, const char *text, size_t size, double texel,
                        sp_error *error)
{
    reuse r = {.mesh = mesh, .path = path, .text = text, .error = error};
    if (!sp_texture_read(path, text, size, &r.texture, error))
        return NULL;
    r.atlas = calloc(1, sizeof *r.atlas);
    bool done = r.atlas ? build(&r, texel) : (bool)sp_fail_memory(error);
    sp_texture_free(&r.texture);
    if (done)
        return r.atlas;
    sp_atlas_destroy(r.atlas);
    return NULL;
}

sp_atlas *sp_atlas_reuse(const sp_mesh *mesh, const char *path, double texel, sp_error *error)
{
    size_t size;
    if (!mesh)
        return NULL;
    char *text = sp_read_file(path, &size, error);
    locale_t c = text ? newlocale(LC_ALL_MASK, "C", (locale_t)0) : (locale_t)0;
    sp_atlas *atlas = NULL;
    if (c != (locale_t)0) {
        locale_t before = uselocale(c);
        atlas = sp_atlas_read(mesh, path, text, size, texel, error);
        uselocale(before);
        freelocale(c);
    } else if (text) {
        sp_fail_memory(error);
    }
    free(text);
    return atlas;
}
