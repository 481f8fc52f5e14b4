/* Makes an atlas of what files lay flat, and believes nothing of it. */
#include "mesh/adjacent.h"
#include "atlas/overlap.h"
#include "atlas/texels/texels.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define STRAIN 0.05          /* that of at most as much of the area may be exceeded */
#define LARGEST_PAGE 65535.0 /* pixels */
#define USUAL_TEXELS 1048576.0
#define EMPTIEST 64.0  /* pixels for every texel of surface */
#define SMALL 16777216 /* pixels that are no matter */

/* What is known of one file. */
typedef struct {
    const sp_unfolding *from;
    size_t first;       /* of its triangles, in the mesh's source */
    uint32_t page;      /* its first, of the atlas */
    double area, flat;  /* m²; square edges of a page */
    double edge, texel; /* of its pages, which fill the lower left of the atlas's: texels; m */
} sheet;

typedef struct {
    const sp_mesh *mesh;
    size_t sheet_count;
    sheet *sheets;   /* [sheet_count] */
    uint32_t *sheet; /* [triangle_count], of each triangle of the mesh */
    sp_atlas *atlas;
    bool crowded; /* it failed since charts come too close to each other: on shorter texels they may not */
    sp_error *error;
} reuse;

static const sheet *sheet_of(const reuse *r, uint32_t triangle)
{
    return &r->sheets[r->sheet[triangle]];
}

static size_t in_file(const reuse *r, uint32_t triangle)
{
    return r->mesh->source[triangle] - sheet_of(r, triangle)->first;
}

static const double (*uv_of(const reuse *r, uint32_t triangle))[2]
{
    return (const double(*)[2])sheet_of(r, triangle)->from->uv[in_file(r, triangle)];
}

static bool refuse(const reuse *r, uint32_t triangle, const char *found)
{
    const sp_unfolding *from = sheet_of(r, triangle)->from;
    return sp_fail(r->error, SP_ERROR_INPUT, from->path, from->line[in_file(r, triangle)], 0,
                   "found %s; expected texture coordinates as atlas writes them", found);
}

static double twice_flat(const double uv[3][2])
{
    return (uv[1][0] - uv[0][0]) * (uv[2][1] - uv[0][1]) - (uv[1][1] - uv[0][1]) * (uv[2][0] - uv[0][0]);
}

/* Finite, on the page, and not turned over. */
static bool check_corners(const reuse *r)
{
    for (uint32_t t = 0; t < r->mesh->triangle_count; t++) {
        const double(*uv)[2] = uv_of(r, t);
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 2; k++) {
                if (isnan(uv[i][k]))
                    return refuse(r, t, "a corner without texture coordinates");
                if (!(uv[i][k] >= 0 && uv[i][k] <= 1))
                    return refuse(r, t, "a texture coordinate off the page, which is from 0 to 1");
            }
        if (twice_flat(uv) < 0)
            return refuse(r, t, "a triangle that is turned over on the page");
    }
    return true;
}

static void measure_sheets(reuse *r)
{
    for (uint32_t t = 0; t < r->mesh->triangle_count; t++) {
        sheet *s = &r->sheets[r->sheet[t]];
        s->area += sp_triangle_area(r->mesh, t);
        s->flat += 0.5 * twice_flat(uv_of(r, t));
    }
}

static bool is_marked(const sp_unfolding *from)
{
    return from->page_edge >= 1 && from->page_edge <= LARGEST_PAGE && from->page_edge == floor(from->page_edge) &&
           from->texel > 0 && isfinite(from->texel);
}

double sp_unfolding_texel(const sp_unfolding *const *files, size_t count, const sp_mesh *mesh)
{
    double texel = INFINITY;
    for (size_t i = 0; i < count; i++)
        texel = fmin(texel, is_marked(files[i]) ? files[i]->texel : sqrt(sp_mesh_area(mesh) / USUAL_TEXELS));
    return texel;
}

/* A texel asked for is not enlarged, and whole texels go into a page. */
static bool choose_texel(const reuse *r, sheet *s, double asked)
{
    bool marked = is_marked(s->from);
    s->edge = s->from->page_edge;
    s->texel = s->from->texel;
    if (!marked || asked > 0) {
        /* how many metres a page's edge spans, so that the area is kept */
        double scale = marked ? s->edge * s->texel : sqrt(s->area / s->flat);
        double wanted = asked > 0 ? asked : sqrt(sp_mesh_area(r->mesh) / USUAL_TEXELS);
        s->edge = fmax(1, ceil(scale / wanted * (1 - 1e-12)));
        s->texel = scale / s->edge;
        if (!isfinite(scale) || !(s->texel > 0) || !(s->edge <= LARGEST_PAGE))
            return sp_fail(r->error, SP_ERROR_INPUT, s->from->path, 0, 0,
                           "found a page of %g m, expected one of at most %g texels of %g m", scale, LARGEST_PAGE,
                           wanted);
    }
    return true;
}

static bool choose_texels(const reuse *r, double asked)
{
    for (size_t i = 0; i < r->sheet_count; i++) {
        sheet *s = &r->sheets[i];
        if (s->area > 0 && !choose_texel(r, s, asked)) /* a file may hold nothing that has an area */
            return false;
        r->atlas->page_edge = (uint32_t)fmax(r->atlas->page_edge, s->edge);
        r->atlas->texel = fmax(r->atlas->texel, s->texel);
    }
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
                atlas->uv[t][i][k] = in_pixels(uv_of(r, t)[i][k], sheet_of(r, t)->edge);
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
        /* only what lies on one page can be joined */
        atlas->chart[t] = sheet_of(r, t)->page + sheet_of(r, t)->from->page[in_file(r, t)];
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
            atlas->chart_texel[atlas->chart_count] = sheet_of(r, t)->texel;
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
static bool check_page(reuse *r, uint32_t page, uint32_t *paint, sp_raster *raster)
{
    const sp_atlas *atlas = r->atlas;
    size_t edge = atlas->page_edge;
    memset(paint, 0, edge * edge * sizeof *paint);
    for (uint32_t t = 0; t < atlas->triangle_count; t++) {
        uint32_t chart = atlas->chart[t] + 1;
        if (atlas->chart_page[atlas->chart[t]] != page)
            continue;
        sp_atlas_rasterize(atlas, t, SP_RASTER_PIXELS, raster); /* needs no memory */
        while (sp_raster_next(raster)) {
            size_t from = raster->x ? raster->x - 1 : 0, end = raster->x + (size_t)raster->count + 1;
            end = end < edge ? end : edge;
            for (size_t y = raster->y ? raster->y - 1 : 0; y < raster->y + 2 && y < edge; y++)
                if ((r->crowded = is_foreign(paint + y * edge, from, end, chart)))
                    return refuse(r, t, "a chart that lies on another or without a pixel between");
            for (size_t x = raster->x; x < (size_t)raster->x + raster->count; x++)
                paint[raster->y * edge + x] = chart;
        }
    }
    return true;
}

static bool check_gaps(reuse *r)
{
    size_t edge = r->atlas->page_edge;
    uint32_t *paint = malloc(edge * edge * sizeof *paint);
    sp_raster raster = {0};
    bool done = paint || sp_fail_memory(r->error);
    for (uint32_t page = 0; done && page < r->atlas->page_count; page++)
        done = check_page(r, page, paint, &raster);
    free(paint);
    sp_raster_free(&raster);
    return done;
}

/* No page is left out, and pages are not so empty that checking them takes more memory than what they hold. */
static bool check_pages(const reuse *r)
{
    const sp_atlas *atlas = r->atlas;
    double pixels = (double)atlas->page_edge * atlas->page_edge * (double)atlas->page_count, texels = 0;
    for (size_t i = 0; i < r->sheet_count; i++)
        texels += r->sheets[i].area > 0 ? r->sheets[i].area / (r->sheets[i].texel * r->sheets[i].texel) : 0;
    if (atlas->page_count <= atlas->chart_count && pixels <= EMPTIEST * texels + SMALL)
        return true;
    return sp_fail(r->error, SP_ERROR_INPUT, r->sheets[0].from->path, 0, 0,
                   "found %zu pages of %u texels for %g texels of surface; expected fewer", atlas->page_count,
                   atlas->page_edge, texels);
}

/* Which file each triangle is of, and where its pages are. */
static bool find_sheets(reuse *r, const sp_unfolding *const *files)
{
    const sp_mesh *mesh = r->mesh;
    size_t first = 0, i = 0;
    uint32_t page = 0;
    for (size_t k = 0; k < r->sheet_count; k++) {
        r->sheets[k] = (sheet){.from = files[k], .first = first, .page = page};
        for (size_t t = 0; t < files[k]->triangle_count; t++)
            page = (uint32_t)fmax(page, r->sheets[k].page + files[k]->page[t] + 1.0);
        first += files[k]->triangle_count;
    }
    if (first != mesh->source_triangle_count)
        return sp_fail(r->error, SP_ERROR_ARGUMENT, files[0]->path, 0, 0,
                       "found %zu triangles, expected the mesh's %zu", first, mesh->source_triangle_count);
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        while (i + 1 < r->sheet_count && mesh->source[t] >= r->sheets[i + 1].first)
            i++;
        r->sheet[t] = (uint32_t)i;
    }
    return true;
}

static bool make_room(reuse *r)
{
    size_t count = r->mesh->triangle_count + 1;
    sp_atlas *atlas = r->atlas;
    atlas->triangle_count = r->mesh->triangle_count;
    atlas->chart = malloc(count * sizeof *atlas->chart);
    atlas->uv = malloc(count * sizeof *atlas->uv);
    atlas->chart_page = malloc(count * sizeof *atlas->chart_page);
    atlas->chart_texel = malloc(count * sizeof *atlas->chart_texel);
    return (atlas->chart && atlas->uv && atlas->chart_page && atlas->chart_texel) || sp_fail_memory(r->error);
}

static bool build(reuse *r, const sp_unfolding *const *files, double texel)
{
    if (!find_sheets(r, files) || !make_room(r) || !check_corners(r))
        return false;
    measure_sheets(r);
    if (!choose_texels(r, texel))
        return false;
    take_coordinates(r);
    return find_charts(r) && check_pages(r) && check_lengths(r) && check_gaps(r) && check_overlaps(r) &&
           sp_atlas_cut(r->atlas, r->mesh, r->error);
}

/* On such texels, or shorter ones by less than it takes for whole ones to go into a page. */
static sp_atlas *lay(const sp_mesh *mesh, const sp_unfolding *const *files, size_t count, double texel, bool *crowded,
                     sp_error *error)
{
    reuse r = {.mesh = mesh, .sheet_count = count, .error = error};
    r.atlas = calloc(1, sizeof *r.atlas);
    r.sheets = calloc(count + 1, sizeof *r.sheets);
    r.sheet = malloc((mesh->triangle_count + 1) * sizeof *r.sheet);
    bool done = (r.atlas && r.sheets && r.sheet) || sp_fail_memory(error);
    done = done && build(&r, files, texel);
    free(r.sheets);
    free(r.sheet);
    *crowded = r.crowded;
    if (done)
        return r.atlas;
    sp_atlas_destroy(r.atlas);
    return NULL;
}

sp_atlas *sp_atlas_of_files(const sp_mesh *mesh, const sp_unfolding *const *files, size_t count, double texel,
                            sp_error *error)
{
    if (!mesh || !files)
        return NULL;
    for (size_t i = 0; i < count; i++)
        if (!files[i])
            return NULL;
    double own = sp_unfolding_texel(files, count, mesh);
    for (;;) {
        sp_error failure = {0};
        bool crowded = false;
        sp_atlas *atlas = lay(mesh, files, count, texel, &crowded, &failure);
        if (!atlas && crowded && texel > own) {
            texel = fmax(0.5 * texel, own);
            continue;
        }
        if (!atlas && error && error->kind == SP_OK)
            *error = failure;
        return atlas;
    }
}

sp_charts *sp_charts_of_atlas(const sp_atlas *atlas, sp_error *error)
{
    if (!atlas)
        return NULL;
    sp_charts *charts = calloc(1, sizeof *charts);
    if (!charts)
        return sp_fail_memory(error);
    charts->triangle_count = atlas->triangle_count;
    charts->chart_count = atlas->chart_count;
    charts->chart = malloc((atlas->triangle_count + 1) * sizeof *charts->chart);
    charts->flat = malloc((atlas->triangle_count + 1) * sizeof *charts->flat);
    charts->extent = INFINITY;
    if (!charts->chart || !charts->flat) {
        sp_charts_destroy(charts);
        return sp_fail_memory(error);
    }
    for (uint32_t t = 0; t < atlas->triangle_count; t++) {
        charts->chart[t] = atlas->chart[t];
        for (int i = 0; i < 6; i++)
            charts->flat[t][i / 2][i % 2] = atlas->uv[t][i / 2][i % 2] * sp_atlas_texel_length(atlas, t);
    }
    return charts;
}
