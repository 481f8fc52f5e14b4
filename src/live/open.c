/* The evaluator of what was handed over. */
#include "live/state.h"

#include "mesh/distance.h"
#include "spray/restore.h"
#include "spray/wet/arrays.h"
#include "trace/distance.h"
#include "trace/ray/visit.h"

#include <stdlib.h>
#include <string.h>

#define EDGE_MOST 65535

sp_live *sp_live_create(void)
{
    return calloc(1, sizeof(sp_live));
}

void sp_live_destroy(sp_live *live)
{
    if (!live)
        return;
    for (size_t i = 0; i < live->nozzle_count; i++)
        sp_live_forget(&live->nozzles[i]);
    free(live->nozzles);
    sp_coverage_destroy(live->coverage);
    free(live->shadow_of);
    free(live->boxes);
    free(live->legs);
    sp_live_free_sample(&live->sample);
    sp_evaluator_destroy(live->evaluator);
    sp_live_free_types(live);
    free(live->surfaces);
    free(live->mesh.parts);
    for (size_t i = 0; i < SP_LIVE_ARRAYS; i++)
        free(live->arrays[i]);
    free(live);
}

void *sp_live_hand_over(sp_live *live, sp_live_array which, size_t bytes)
{
    if ((unsigned)which >= SP_LIVE_ARRAYS)
        return NULL;
    free(live->arrays[which]);
    live->arrays[which] = calloc(bytes + 1, 1);
    live->bytes[which] = live->arrays[which] ? bytes : 0;
    return live->arrays[which];
}

const char *sp_live_error(sp_live *live)
{
    sp_error_text(&live->error, live->text, sizeof live->text);
    return live->text;
}

static bool in_order(const sp_live *live, const double *settings)
{
    const size_t *bytes = live->bytes;
    size_t triangles = bytes[SP_LIVE_PARTS] / 4, parts = bytes[SP_LIVE_CLEAN], charts = bytes[SP_LIVE_CHART_PAGE] / 4;
    bool good = bytes[SP_LIVE_SETTINGS] == SP_LIVE_SETTING_COUNT * sizeof(double) && triangles && parts && charts &&
                bytes[SP_LIVE_TRIANGLES] == 12 * triangles && bytes[SP_LIVE_CHARTS] == 4 * triangles &&
                bytes[SP_LIVE_UV] == 48 * triangles && bytes[SP_LIVE_SIDES] == triangles &&
                bytes[SP_LIVE_CHART_TEXEL] == 8 * charts && bytes[SP_LIVE_NAMES] && triangles < SP_NONE / 3;
    const uint32_t *corners = live->arrays[SP_LIVE_TRIANGLES], *part = live->arrays[SP_LIVE_PARTS];
    const uint32_t *chart = live->arrays[SP_LIVE_CHARTS], *page = live->arrays[SP_LIVE_CHART_PAGE];
    const double *uv = live->arrays[SP_LIVE_UV];
    double edge = good ? settings[SP_LIVE_PAGE_EDGE] : 0, pages = good ? settings[SP_LIVE_PAGE_COUNT] : 0;
    good = good && edge >= 1 && edge <= EDGE_MOST && pages >= 1 && pages <= EDGE_MOST;
    for (size_t i = 0; good && i < 3 * triangles; i++)
        good = corners[i] < bytes[SP_LIVE_VERTICES] / 24 && part[i / 3] < parts && chart[i / 3] < charts;
    for (size_t i = 0; good && i < charts; i++)
        good = page[i] < pages && ((const double *)live->arrays[SP_LIVE_CHART_TEXEL])[i] > 0;
    for (size_t i = 0; good && i < 6 * triangles; i++)
        good = uv[i] >= 0 && uv[i] < edge;
    return good;
}

static bool make_mesh(sp_live *live)
{
    size_t parts = live->bytes[SP_LIVE_CLEAN], triangles = live->bytes[SP_LIVE_PARTS] / 4;
    const uint8_t *clean = live->arrays[SP_LIVE_CLEAN];
    char *name = live->arrays[SP_LIVE_NAMES], *end = name + live->bytes[SP_LIVE_NAMES]; /* where a 0 is */
    free(live->surfaces); /* of what could not be opened before */
    free(live->mesh.parts);
    live->surfaces = calloc(parts, sizeof *live->surfaces);
    live->mesh = (sp_mesh){.vertex_count = live->bytes[SP_LIVE_VERTICES] / 24,
                           .vertices = live->arrays[SP_LIVE_VERTICES],
                           .triangle_count = triangles,
                           .triangles = live->arrays[SP_LIVE_TRIANGLES],
                           .part = live->arrays[SP_LIVE_PARTS],
                           .source_triangle_count = triangles,
                           .part_count = parts,
                           .parts = calloc(parts, sizeof *live->mesh.parts)};
    for (size_t i = 0; live->surfaces && live->mesh.parts && i < parts; i++) {
        live->surfaces[i] = (sp_surface){.clean = clean[i] != 0, .rebound = 1};
        live->mesh.parts[i].name = name;
        name += name < end ? strlen(name) + 1 : 0;
        name = name < end ? name : end;
    }
    return (live->surfaces && live->mesh.parts) || sp_fail_memory(&live->error);
}

static sp_setup make_setup(const sp_live *live, const double *n)
{
    sp_setup setup = sp_setup_default();
    setup.mesh = &live->mesh;
    setup.surfaces = live->surfaces;
    setup.cavity = (sp_cavity_kind)n[SP_LIVE_CAVITY];
    setup.cavity_point = sp_v(n[SP_LIVE_CAVITY_X], n[SP_LIVE_CAVITY_Y], n[SP_LIVE_CAVITY_Z]);
    setup.origin = sp_v(n[SP_LIVE_ORIGIN_X], n[SP_LIVE_ORIGIN_Y], n[SP_LIVE_ORIGIN_Z]);
    setup.liquid.density = n[SP_LIVE_DENSITY];
    setup.up = n[SP_LIVE_UP_IS_Y] != 0 ? sp_v(0, 1, 0) : sp_v(0, 0, 1);
    setup.gravity = n[SP_LIVE_GRAVITY];
    setup.criterion = (sp_criterion){.flux = n[SP_LIVE_FLUX],
                                     .impact_speed = n[SP_LIVE_IMPACT_SPEED],
                                     .incidence = n[SP_LIVE_INCIDENCE],
                                     .combine = n[SP_LIVE_SINGLE] != 0 ? SP_COMBINE_SINGLE : SP_COMBINE_SUM};
    setup.fidelity.trajectory = n[SP_LIVE_PARABOLA] != 0 ? SP_TRAJECTORY_PARABOLA : SP_TRAJECTORY_LINE;
    setup.fidelity.method = SP_METHOD_INVERSE;
    setup.fidelity.reflections = 0;
    setup.fidelity.texel = n[SP_LIVE_TEXEL];
    return setup;
}

/* A copy: the atlas owns what it has. */
static void *copy_of(const sp_live *live, sp_live_array which)
{
    void *copy = malloc(live->bytes[which] + 1);
    if (copy)
        memcpy(copy, live->arrays[which], live->bytes[which]);
    return copy;
}

static sp_atlas *make_atlas(sp_live *live, const double *n)
{
    sp_atlas *atlas = calloc(1, sizeof *atlas);
    if (!atlas)
        return sp_fail_memory(&live->error);
    atlas->texel = n[SP_LIVE_TEXEL];
    atlas->triangle_count = live->mesh.triangle_count;
    atlas->chart_count = live->bytes[SP_LIVE_CHART_PAGE] / 4;
    atlas->page_count = (size_t)n[SP_LIVE_PAGE_COUNT];
    atlas->page_edge = (uint32_t)n[SP_LIVE_PAGE_EDGE];
    atlas->chart = copy_of(live, SP_LIVE_CHARTS);
    atlas->chart_page = copy_of(live, SP_LIVE_CHART_PAGE);
    atlas->chart_texel = copy_of(live, SP_LIVE_CHART_TEXEL);
    atlas->uv = copy_of(live, SP_LIVE_UV);
    if (atlas->chart && atlas->chart_page && atlas->chart_texel && atlas->uv)
        return atlas;
    sp_atlas_destroy(atlas);
    return sp_fail_memory(&live->error);
}

bool sp_live_open(sp_live *live)
{
    const double *settings = live->arrays[SP_LIVE_SETTINGS];
    live->error = (sp_error){0};
    if (live->evaluator || !in_order(live, settings))
        return sp_fail(&live->error, SP_ERROR_ARGUMENT, NULL, 0, 0, "what was handed over does not belong together");
    if (!make_mesh(live) || !sp_live_make_types(live))
        return false;
    const sp_wet_arrays arrays = {.sides = live->arrays[SP_LIVE_SIDES],
                                  .nodes = live->arrays[SP_LIVE_NODES],
                                  .node_count = live->bytes[SP_LIVE_NODES],
                                  .cuts = live->arrays[SP_LIVE_CUTS],
                                  .cut_count = live->bytes[SP_LIVE_CUTS] / sizeof(double[3])};
    sp_wet *wet = sp_wet_restore(&live->mesh, &arrays, &live->error);
    sp_atlas *atlas = wet ? make_atlas(live, settings) : NULL;
    if (!atlas) {
        sp_wet_destroy(wet);
        return false;
    }
    sp_setup setup = make_setup(live, settings);
    live->evaluator = sp_evaluator_restore(&setup, atlas, wet, &live->error);
    return live->evaluator != NULL;
}

size_t sp_live_boxes(sp_live *live)
{
    const sp_tracer *tracer = sp_evaluator_tracer(live->evaluator);
    size_t count = sp_tracer_leaves(tracer, NULL);
    free(live->boxes);
    live->boxes = malloc((count + 1) * sizeof *live->boxes);
    if (!live->boxes)
        return 0;
    sp_tracer_leaves(tracer, live->boxes);
    return count;
}

const double *sp_live_foot(sp_live *live, uint32_t part, double x, double y, double z)
{
    sp_vec3 point = sp_v(x, y, z);
    uint32_t triangle = sp_tracer_nearest_triangle(sp_evaluator_tracer(live->evaluator), part, point);
    if (triangle == SP_NONE)
        return NULL;
    sp_vec3 foot = sp_triangle_nearest(&live->mesh, triangle, point);
    sp_vec3 normal = sp_triangle_normal(&live->mesh, triangle);
    unsigned wet = sp_evaluator_wet(live->evaluator, triangle);
    bool back = wet == 2 || (wet == 3 && sp_dot(sp_sub(point, foot), normal) < 0);
    normal = back ? sp_scale(normal, -1) : normal;
    memcpy(live->foot, (double[]){foot.x, foot.y, foot.z, normal.x, normal.y, normal.z}, sizeof live->foot);
    return live->foot;
}
