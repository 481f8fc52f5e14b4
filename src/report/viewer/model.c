#include "model.h"

#include "boxes.h"
#include "design.h"
#include "exact.h"
#include "live.h"
#include "report/camera.h"
#include "report/coarse.h"
#include "shown.h"

#include <sprayplan/image.h>

#include <stdlib.h>
#include <string.h>

static json_t *vector_json(sp_vec3 v)
{
    return json_pack("[fff]", v.x, v.y, v.z);
}

static json_t *colour_json(const uint8_t rgb[3])
{
    return json_pack("[iii]", rgb[0], rgb[1], rgb[2]);
}

/* All 256 colours of the bar, six hexadecimal digits each. */
static json_t *palette_json(sp_colours colours)
{
    char digits[6 * 256 + 1];
    for (int i = 0; i < 256; ++i) {
        uint8_t rgb[3];
        sp_colour_of(colours, i / 255.0, rgb);
        snprintf(digits + 6 * i, 7, "%02x%02x%02x", rgb[0], rgb[1], rgb[2]);
    }
    return json_string(digits);
}

static json_t *quantities_json(const sp_shown_quantities *shown)
{
    json_t *list = json_array();
    for (int k = 0; k < shown->count; ++k) {
        const sp_shown_quantity *q = &shown->of[k];
        json_t *steps = json_array();
        for (int i = 0; i < q->step_count; ++i)
            json_array_append_new(steps, json_real(q->steps[i]));
        json_array_append_new(list,
                              json_pack("{s:s, s:s, s:s, s:f, s:f, s:f, s:b, s:b, s:b, s:[ff], s:o}", "key", q->key,
                                        "name", q->name, "unit", q->unit, "toUnit", q->to_unit, "low", q->low, "high",
                                        q->high, "log", (int)q->log, "whole", (int)q->whole, "atMost", (int)q->at_most,
                                        "shown", q->shown[0], q->shown[1], "steps", steps));
    }
    return list;
}

static json_t *parts_json(const sp_mesh *mesh)
{
    json_t *list = json_array();
    for (size_t i = 0; i < mesh->part_count; ++i) {
        char *name = sp_text_utf8(mesh->parts[i].name);
        json_array_append_new(list, json_pack("{s:s}", "name", name ? name : ""));
        free(name);
    }
    return list;
}

static json_t *ranges_json(const sp_drawn_surface *surface)
{
    json_t *list = json_array();
    for (size_t i = 0; i < surface->range_count; ++i) {
        const sp_drawn_range *r = &surface->ranges[i];
        json_array_append_new(list, json_pack("{s:I, s:I, s:i, s:I, s:I}", "part", (json_int_t)r->part, "page",
                                              r->page == SP_NONE ? (json_int_t)-1 : (json_int_t)r->page, "layer",
                                              r->layer, "first", (json_int_t)r->first, "count", (json_int_t)r->count));
    }
    return list;
}

#define FULL 65535.0

/* m, in the setup's coordinates: what x, y and z of 0 and of FULL mean. */
typedef struct {
    double low[3], high[3];
} box;

static void point_of(const sp_evaluator *evaluator, const sp_drawn_vertex *vertex, double xyz[3])
{
    sp_vec3 point = sp_evaluator_setup(evaluator)->mesh->vertices[vertex->at];
    xyz[0] = point.x;
    xyz[1] = point.y;
    xyz[2] = point.z;
}

static box box_of(const sp_evaluator *evaluator, const sp_drawn_surface *surface)
{
    box around = {{0, 0, 0}, {0, 0, 0}};
    for (size_t i = 0; i < surface->vertex_count; ++i) {
        double point[3];
        point_of(evaluator, &surface->vertices[i], point);
        for (int k = 0; k < 3; ++k) {
            around.low[k] = i ? fmin(around.low[k], point[k]) : point[k];
            around.high[k] = i ? fmax(around.high[k], point[k]) : point[k];
        }
    }
    return around;
}

static uint16_t in_parts(double value, double low, double high)
{
    return high > low ? (uint16_t)lrint(FULL * fmin(fmax((value - low) / (high - low), 0), 1)) : 0;
}

/* Places, then texture coordinates in parts of a page's edge, then corners. */
static bool pack_surface(const sp_evaluator *evaluator, const sp_drawn_surface *surface, const box *around,
                         sp_packed *packed, sp_error *error)
{
    uint16_t *numbers = malloc((surface->vertex_count + 1) * sizeof *numbers);
    if (!numbers)
        return sp_fail_memory(error);
    for (int k = 0; k < 5; ++k) {
        for (size_t i = 0; i < surface->vertex_count; ++i) {
            double point[3];
            point_of(evaluator, &surface->vertices[i], point);
            numbers[i] = k < 3 ? in_parts(point[k], around->low[k], around->high[k])
                               : in_parts((double)surface->vertices[i].uv[k - 3], 0, 1);
        }
        sp_packed_shorts(packed, numbers, surface->vertex_count, true);
    }
    free(numbers);
    return sp_packed_corners(packed, surface->corners[0], 3 * surface->triangle_count) || sp_fail_memory(error);
}

/* Where the pages' pixels are, and which patch each of them shows. */
static bool pack_pages(const sp_layers *layers, sp_packed *packed, sp_error *error)
{
    const sp_atlas *atlas = sp_evaluator_atlas(layers->evaluator);
    size_t room = atlas->run_count > atlas->pixel_count ? atlas->run_count : atlas->pixel_count;
    uint32_t *words = malloc((room + 1) * sizeof *words);
    uint16_t *shorts = malloc((room + 1) * sizeof *shorts);
    if (words && shorts) {
        for (size_t i = 0; i < atlas->run_count; ++i)
            words[i] = atlas->runs[i].row;
        sp_packed_words(packed, words, atlas->run_count, true);
        for (size_t i = 0; i < atlas->run_count; ++i)
            shorts[i] = atlas->runs[i].x;
        sp_packed_shorts(packed, shorts, atlas->run_count, false);
        for (size_t i = 0; i < atlas->run_count; ++i)
            shorts[i] = atlas->runs[i].count;
        sp_packed_shorts(packed, shorts, atlas->run_count, false);
        for (int layer = 0; layer < (layers->has_back ? 2 : 1); ++layer) {
            for (size_t i = 0; i < atlas->pixel_count; ++i)
                words[i] = layers->patch[layer][i] + 1; /* SP_NONE: 0 */
            sp_packed_words(packed, words, atlas->pixel_count, true);
        }
    }
    bool done = words && shorts;
    free(words);
    free(shorts);
    return done || sp_fail_memory(error);
}

/* The designs of one evaluator, their arrays behind those of its surface. */
static json_t *designs_json(const sp_page *page, const sp_evaluator *evaluator, const sp_shown_quantities *quantities,
                            const sp_neighbours *neighbours, sp_coder *coder, sp_packed *packed, sp_error *error)
{
    json_t *list = json_array();
    for (size_t i = 0; list && i < page->result->design_count; ++i) {
        if (sp_viewer_evaluator(page, i) != evaluator)
            continue;
        json_t *design = sp_viewer_design(page, i, quantities, neighbours, coder, packed, error);
        if (!design || json_array_append_new(list, design) != 0) {
            json_decref(list);
            list = NULL;
        }
    }
    return list ? list : sp_fail_memory(error);
}

/* The surface as it is drawn, or to the last bit where layouts are evaluated on it; *about of the latter alone. */
static bool pack_either(const sp_page *page, const sp_evaluator *evaluator, const sp_drawn_surface *surface,
                        const box *around, sp_coder *coder, sp_packed *packed, json_t **about, sp_error *error)
{
    *about = NULL;
    if (!page->live || evaluator != sp_page_live_evaluator(page))
        return pack_surface(evaluator, surface, around, packed, error);
    *about = sp_viewer_exact(evaluator, surface, coder, error);
    return *about != NULL;
}

static json_t *surface_json(const sp_layers *layers, const sp_drawn_surface *surface, const box *around)
{
    const sp_evaluator *evaluator = layers->evaluator;
    const sp_atlas *atlas = sp_evaluator_atlas(evaluator);
    const sp_setup *setup = sp_evaluator_setup(evaluator);
    return json_pack("{s:o, s:o, s:o, s:b, s:I, s:I, s:I, s:i, s:I, s:I, s:I, s:I, s:o, s:o}", "low",
                     vector_json(sp_v(around->low[0], around->low[1], around->low[2])), "high",
                     vector_json(sp_v(around->high[0], around->high[1], around->high[2])), "origin",
                     vector_json(setup->origin), "twoSided", (int)layers->two_sided, "vertices",
                     (json_int_t)surface->vertex_count, "triangles", (json_int_t)surface->triangle_count, "edge",
                     (json_int_t)atlas->page_edge, "layers", layers->has_back ? 2 : 1, "pages",
                     (json_int_t)atlas->page_count, "runs", (json_int_t)atlas->run_count, "pixels",
                     (json_int_t)atlas->pixel_count, "patches", (json_int_t)sp_evaluator_patches(evaluator)->count,
                     "parts", parts_json(setup->mesh), "draws", ranges_json(surface));
}

static json_t *described(const sp_page *page, const sp_layers *layers, const sp_shown_quantities *quantities,
                         sp_coder *coder, sp_packed *packed, sp_error *error)
{
    sp_neighbours neighbours;
    json_t *designs = sp_neighbours_find(&neighbours, layers)
                          ? designs_json(page, layers->evaluator, quantities, &neighbours, coder, packed, error)
                          : sp_fail_memory(error);
    sp_neighbours_free(&neighbours);
    return designs;
}

/* As it is drawn: no more than its share of the triangles, unless layouts are evaluated on it. */
static bool make_surface(const sp_page *page, const sp_layers *layers, sp_drawn_surface *surface,
                         sp_viewer_drawn *drawn, sp_error *error)
{
    if (!sp_drawn_surface_create(surface, layers, error))
        return false;
    double cell = 0;
    size_t all = surface->triangle_count, most = page->most_drawn / drawn->models;
    bool exact = page->live && layers->evaluator == sp_page_live_evaluator(page);
    if (!exact && !sp_drawn_surface_coarsen(surface, layers->evaluator, most, &cell, error))
        return false;
    drawn->all += all;
    drawn->triangles += surface->triangle_count;
    drawn->cell = fmax(drawn->cell, cell);
    return true;
}

/* What the page has besides its JSON: deflated, and coded. */
static bool add_data(json_t *object, const sp_packed *packed, sp_coder *coder, sp_error *error)
{
    sp_coder_end(coder);
    char *data = sp_packed_finish(packed, error);
    char *coded = !data || coder->bytes.failed
                      ? NULL
                      : sp_packed_letters((const uint8_t *)coder->bytes.text, coder->bytes.length, error);
    bool done = coded && json_object_set_new(object, "data", json_string_nocheck(data)) == 0 &&
                json_object_set_new(object, "coded", json_string_nocheck(coded)) == 0;
    free(data);
    free(coded);
    return done;
}

static json_t *model_json(const sp_page *page, const sp_evaluator *evaluator, const sp_shown_quantities *quantities,
                          sp_viewer_drawn *drawn, sp_error *error)
{
    sp_layers layers = {0};
    sp_drawn_surface surface = {0};
    sp_packed packed = {0};
    sp_coder coder;
    json_t *object = NULL, *designs = NULL, *exact = NULL;
    sp_coder_start(&coder);
    if (sp_layers_create(&layers, evaluator, error) && make_surface(page, &layers, &surface, drawn, error)) {
        box around = box_of(evaluator, &surface);
        if (pack_either(page, evaluator, &surface, &around, &coder, &packed, &exact, error) &&
            pack_pages(&layers, &packed, error))
            designs = described(page, &layers, quantities, &coder, &packed, error);
        object = designs ? surface_json(&layers, &surface, &around) : NULL;
        sp_camera camera = sp_camera_create(evaluator, page->result, &sp_viewpoints[0], 1);
        if (!object || json_object_set(object, "designs", designs) != 0 ||
            json_object_set_new(object, "cut", json_boolean(camera.cut)) != 0 ||
            (exact && json_object_set(object, "exact", exact) != 0) ||
            (!page->live && !sp_viewer_boxes(evaluator, object, &packed, error)) ||
            !add_data(object, &packed, &coder, error)) {
            json_decref(object);
            object = sp_fail_memory(error);
        }
    }
    json_decref(designs);
    json_decref(exact);
    free(packed.text);
    free(coder.bytes.text);
    sp_drawn_surface_free(&surface);
    sp_layers_free(&layers);
    return object;
}

/* Whether the surface of a design was not that of one before. */
static bool begins_model(const sp_page *page, size_t design)
{
    const sp_evaluator *evaluator = sp_viewer_evaluator(page, design);
    bool begins = evaluator != NULL;
    for (size_t i = 0; begins && i < design; ++i)
        begins = sp_viewer_evaluator(page, i) != evaluator;
    return begins;
}

/* One for each surface that the designs have. */
static json_t *models_json(const sp_page *page, const sp_shown_quantities *quantities, sp_viewer_drawn *drawn,
                           sp_error *error)
{
    json_t *list = json_array();
    *drawn = (sp_viewer_drawn){0};
    for (size_t i = 0; i < page->result->design_count; ++i)
        drawn->models += begins_model(page, i);
    for (size_t i = 0; list && i < page->result->design_count; ++i) {
        if (!begins_model(page, i))
            continue;
        json_t *model = model_json(page, sp_viewer_evaluator(page, i), quantities, drawn, error);
        if (!model || json_array_append_new(list, model) != 0) {
            json_decref(list);
            return sp_fail_memory(error);
        }
    }
    return list;
}

bool sp_viewer_model(const sp_page *page, sp_text *text, sp_viewer_drawn *drawn, sp_error *error)
{
    const sp_shown_quantities quantities = sp_shown_quantities_of(page);
    json_t *models = models_json(page, &quantities, drawn, error);
    if (!models)
        return false;
    sp_vec3 up = sp_v(0, 0, 1);
    for (size_t i = page->result->design_count; i-- > 0;)
        if (page->result->designs[i].evaluator)
            up = sp_evaluator_setup(page->result->designs[i].evaluator)->up;
    json_t *all = json_pack("{s:o, s:o, s:o, s:o, s:o, s:o}", "up", vector_json(up), "palette",
                            palette_json(page->scale.style.colours), "grey", colour_json(sp_colour_obstacle), "film",
                            colour_json(sp_colour_film), "quantities", quantities_json(&quantities), "models", models);
    char *json = all ? json_dumps(all, JSON_COMPACT | JSON_REAL_PRECISION(7)) : NULL;
    if (json)
        sp_markup_json(text, json);
    free(json);
    json_decref(all);
    return json || sp_fail_memory(error);
}
