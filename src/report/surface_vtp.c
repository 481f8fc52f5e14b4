/* The drawn triangles with the means of what lies on each, for ParaView. */
#include "surface.h"
#include "vtp.h"

#include "result/design.h"

#include <sprayplan/report.h>

#include <stdlib.h>
#include <string.h>

/* Sums over the parts of patches that lie on one side of a triangle. */
typedef struct {
    double area;             /* m², counted */
    double covered;          /* m² */
    double liquid;           /* m³/s */
    double speed, incidence; /* times liquid */
} sums;

typedef struct {
    const sp_evaluator *evaluator;
    sp_drawn_surface surface;
    sums *sums[2];  /* [triangle_count of the mesh], by layer of sp_layers */
    uint8_t *layer; /* [surface.triangle_count] */
    size_t point_count;
    uint32_t *points;       /* [point_count], vertices of the mesh that are drawn */
    uint32_t (*corners)[3]; /* [surface.triangle_count], as points */
    bool two_sided;
} drawing;

/* The fragments of a texel share in what its patch has by their areas, as far as that side of them is cleaned. */
static void share_out(drawing *d, const sp_layers *layers, const sp_deposits *deposits, const sp_fragments *fragments,
                      uint32_t texel, int layer)
{
    uint32_t patch = layers->patch[layer][texel];
    double whole = 0;
    if (patch == SP_NONE)
        return;
    for (uint32_t i = fragments->start[texel]; i < fragments->start[texel + 1]; ++i)
        if (sp_layers_clean(layers, fragments->items[i].triangle, layer))
            whole += fragments->items[i].area;
    for (uint32_t i = fragments->start[texel]; i < fragments->start[texel + 1]; ++i) {
        const sp_fragment *fragment = &fragments->items[i];
        if (!(fragment->area > 0) || !sp_layers_clean(layers, fragment->triangle, layer))
            continue;
        double area = sp_evaluator_patches(d->evaluator)->area[patch] * fragment->area / whole;
        double liquid = deposits->flux[patch] * area;
        sums *s = &d->sums[layer][fragment->triangle];
        s->area += area;
        s->covered += deposits->share[patch] * area;
        s->liquid += liquid;
        s->speed += deposits->speed[patch] * liquid;
        s->incidence += deposits->incidence[patch] * liquid;
    }
}

static bool sum_up(drawing *d, const sp_layers *layers, const sp_deposits *deposits, sp_error *error)
{
    const sp_mesh *mesh = sp_evaluator_setup(d->evaluator)->mesh;
    const sp_atlas *atlas = sp_evaluator_atlas(d->evaluator);
    sp_fragments fragments = {0};
    for (int layer = 0; layer < 2; ++layer) {
        d->sums[layer] = calloc(mesh->triangle_count + 1, sizeof *d->sums[layer]);
        if (!d->sums[layer])
            return sp_fail_memory(error);
    }
    if (!sp_fragments_create(&fragments, atlas, mesh, error))
        return false;
    for (uint32_t texel = 0; texel < atlas->texel_count; ++texel)
        for (int layer = 0; layer < 2; ++layer)
            share_out(d, layers, deposits, &fragments, texel, layer);
    sp_fragments_destroy(&fragments);
    return true;
}

/* Corners as vertices of the mesh that are drawn, numbered as they come: seams of the atlas are none of the surface. */
static bool number_points(drawing *d, sp_error *error)
{
    const sp_drawn_surface *s = &d->surface;
    size_t most = sp_evaluator_setup(d->evaluator)->mesh->vertex_count;
    uint32_t *number = malloc((most + 1) * sizeof *number);
    d->points = malloc((most + 1) * sizeof *d->points);
    d->corners = malloc((s->triangle_count + 1) * sizeof *d->corners);
    d->layer = malloc(s->triangle_count + 1);
    bool done = number && d->points && d->corners && d->layer;
    if (done)
        memset(number, 0xff, (most + 1) * sizeof *number);
    for (size_t i = 0; done && i < s->range_count; ++i)
        memset(d->layer + s->ranges[i].first, s->ranges[i].layer, s->ranges[i].count);
    for (size_t i = 0; done && i < s->triangle_count; ++i)
        for (int k = 0; k < 3; ++k) {
            uint32_t at = s->vertices[s->corners[i][k]].at;
            if (number[at] == SP_NONE) {
                number[at] = (uint32_t)d->point_count;
                d->points[d->point_count++] = at;
            }
            d->corners[i][k] = number[at];
        }
    free(number);
    return done || sp_fail_memory(error);
}

static double place_of(const void *of, int which, size_t point, int component)
{
    const drawing *d = of;
    const sp_setup *setup = sp_evaluator_setup(d->evaluator);
    sp_vec3 place = sp_setup_outside(setup, setup->mesh->vertices[d->points[point]]);
    (void)which;
    return component == 0 ? place.x : component == 1 ? place.y : place.z;
}

static double part_of(const void *of, int which, size_t cell, int component)
{
    const drawing *d = of;
    (void)which;
    (void)component;
    return sp_evaluator_setup(d->evaluator)->mesh->part[d->surface.triangles[cell]];
}

static double side_of(const void *of, int which, size_t cell, int component)
{
    const drawing *d = of;
    (void)which;
    (void)component;
    return d->two_sided ? SP_SIDE_BOTH : d->layer[cell] ? SP_SIDE_BACK : SP_SIDE_FRONT;
}

enum { AREA, COVERED, FLUX, SPEED, INCIDENCE };

static double mean_of(const void *of, int which, size_t cell, int component)
{
    const drawing *d = of;
    const sums *s = &d->sums[d->layer[cell]][d->surface.triangles[cell]];
    (void)component;
    if (which == AREA)
        return s->area;
    if (which == COVERED || which == FLUX)
        return s->area > 0 ? (which == FLUX ? s->liquid : s->covered) / s->area : NAN;
    if (s->liquid > 0)
        return (which == SPEED ? s->speed : s->incidence) / s->liquid;
    return s->area > 0 ? 0 : NAN;
}

static bool write(const drawing *d, const char *path, sp_error *error)
{
    static const sp_vtp_array arrays[] = {{"part", SP_VTP_INT32, 1, part_of, 0},
                                          {"side", SP_VTP_UINT8, 1, side_of, 0},
                                          {"area", SP_VTP_FLOAT32, 1, mean_of, AREA},
                                          {"covered", SP_VTP_FLOAT32, 1, mean_of, COVERED},
                                          {"flux", SP_VTP_FLOAT32, 1, mean_of, FLUX},
                                          {"speed", SP_VTP_FLOAT32, 1, mean_of, SPEED},
                                          {"incidence", SP_VTP_FLOAT32, 1, mean_of, INCIDENCE}};
    sp_vtp vtp = {.point_count = d->point_count,
                  .point = place_of,
                  .triangle_count = d->surface.triangle_count,
                  .triangles = (const uint32_t(*)[3])d->corners,
                  .array_count = sizeof arrays / sizeof *arrays,
                  .arrays = arrays,
                  .mesh = sp_evaluator_setup(d->evaluator)->mesh,
                  .of = d};
    return sp_vtp_write(&vtp, path, error);
}

bool sp_report_surface_vtp(const sp_design *design, const char *path, sp_error *error)
{
    if (!sp_design_is_evaluated(design) || !path)
        return false;
    sp_layers layers = {0};
    drawing d = {.evaluator = design->evaluator};
    bool done = sp_layers_create(&layers, design->evaluator, error);
    d.two_sided = layers.two_sided;
    done = done && sp_drawn_surface_create(&d.surface, &layers, error) &&
           sum_up(&d, &layers, &design->coverage->deposits, error) && number_points(&d, error) &&
           write(&d, path, error);
    for (int layer = 0; layer < 2; ++layer)
        free(d.sums[layer]);
    free(d.layer);
    free(d.points);
    free(d.corners);
    sp_drawn_surface_free(&d.surface);
    sp_layers_free(&layers);
    return done;
}
