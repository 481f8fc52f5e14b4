#include "design.h"

#include "report/listed_shadows.h"
#include "sprays.h"

#include <stdlib.h>
#include <string.h>

#define HALF 128 /* bytes from here on: covered */

static json_t *vector_json(sp_vec3 v)
{
    return json_pack("[fff]", v.x, v.y, v.z);
}

static void pack_quantity(const sp_deposits *deposits, const sp_shown_quantity *quantity, const double *values,
                          uint8_t *bytes, const uint32_t *beside, sp_packed *packed)
{
    for (size_t i = 0; i < deposits->count; ++i)
        bytes[i] = deposits->flux[i] > 0 ? sp_shown_byte(quantity, values[i]) : 0;
    sp_packed_beside(packed, bytes, beside, deposits->count);
}

static void pack_covered(const sp_deposits *deposits, uint8_t *bytes, const uint32_t *beside, sp_packed *packed)
{
    for (size_t i = 0; i < deposits->count; ++i) {
        long share = lrint(255 * fmin(fmax(deposits->share[i], 0), 1));
        bytes[i] = (uint8_t)(deposits->covered[i] ? (share < HALF ? HALF : share) : (share < HALF ? share : HALF - 1));
    }
    sp_packed_beside(packed, bytes, beside, deposits->count);
    for (size_t i = 0; i < deposits->count; ++i)
        bytes[i] = deposits->by_film[i];
    sp_packed_beside(packed, bytes, beside, deposits->count);
}

/* The way that a shadow faces, and the box around its points. */
typedef struct {
    sp_vec3 facing, low, high;
} outlook;

static void look_at(outlook *shadow, const sp_patches *patches, uint32_t patch)
{
    sp_vec3 p = patches->point[patch];
    shadow->facing = sp_along(shadow->facing, patches->area[patch], patches->normal[patch]);
    shadow->low = sp_v(fmin(shadow->low.x, p.x), fmin(shadow->low.y, p.y), fmin(shadow->low.z, p.z));
    shadow->high = sp_v(fmax(shadow->high.x, p.x), fmax(shadow->high.y, p.y), fmax(shadow->high.z, p.z));
}

/* The shadows that the page's table lists. */
static json_t *pack_shadows(const sp_design *design, uint8_t *bytes, const uint32_t *beside, sp_packed *packed,
                            sp_error *error)
{
    const sp_patches *patches = sp_evaluator_patches(design->evaluator);
    sp_listed_shadows listed = {0};
    if (!sp_listed_shadows_find(&listed, design, error))
        return NULL;
    outlook seen[SP_PAGE_SHADOWS];
    for (size_t i = 0; i < listed.count; ++i)
        seen[i] = (outlook){{0}, sp_v(INFINITY, INFINITY, INFINITY), sp_v(-INFINITY, -INFINITY, -INFINITY)};
    for (uint32_t k = 0; k < patches->count; ++k) {
        bytes[k] = (uint8_t)listed.number[k];
        if (bytes[k])
            look_at(&seen[bytes[k] - 1], patches, k);
    }
    json_t *list = json_array();
    for (size_t i = 0; i < listed.count; ++i) {
        sp_vec3 facing = sp_length(seen[i].facing) > 0 ? sp_unit(seen[i].facing) : sp_v(0, 0, 1);
        json_array_append_new(list,
                              json_pack("{s:o, s:o, s:f}", "at", vector_json(listed.shadow[i].centroid), "towards",
                                        vector_json(facing), "extent", sp_distance(seen[i].low, seen[i].high)));
    }
    sp_packed_beside(packed, bytes, beside, patches->count);
    sp_listed_shadows_free(&listed);
    return list;
}

/* What one nozzle brings by itself, where that is known, and its sprays. */
static json_t *pack_nozzle(const sp_design *design, size_t index, const sp_shown_quantity *flux, uint8_t *bytes,
                           const uint32_t *beside, sp_packed *packed, sp_error *error)
{
    const sp_nozzle *nozzle = &design->layout->nozzles[index];
    const sp_contributions *does = design->contributions;
    for (size_t i = 0; does && i < does->patches; ++i) {
        double brought = (double)does->flux[index * does->patches + i];
        bytes[i] = brought > 0 ? sp_shown_byte(flux, brought) : 0;
    }
    if (does)
        sp_packed_beside(packed, bytes, beside, does->patches);
    char *name = sp_text_utf8(nozzle->name);
    json_t *object = name ? json_pack("{s:s, s:b, s:o}", "name", name, "known", (int)(does != NULL), "at",
                                      vector_json(nozzle->position))
                          : NULL;
    free(name);
    if (!object)
        return sp_fail_memory(error);
    if (sp_viewer_sprays(design->evaluator, nozzle, object, packed, error))
        return object;
    json_decref(object);
    return NULL;
}

static json_t *pack_nozzles(const sp_design *design, const sp_shown_quantity *flux, uint8_t *bytes,
                            const uint32_t *beside, sp_packed *packed, sp_error *error)
{
    json_t *list = json_array();
    for (size_t i = 0; list && i < design->layout->count; ++i) {
        json_t *nozzle = pack_nozzle(design, i, flux, bytes, beside, packed, error);
        if (!nozzle || json_array_append_new(list, nozzle) != 0) {
            json_decref(list);
            return nozzle ? sp_fail_memory(error) : NULL;
        }
    }
    return list;
}

static json_t *head_json(const sp_page *page, size_t design)
{
    sp_text name = {0}, quote = {0};
    sp_page_plain_name(page, &name, design);
    sp_text_add(&quote, "%.1f %% with %.1f L/min", 100 * page->figures[design].coverage,
                6e4 * page->figures[design].flow);
    json_t *object = NULL;
    if (!name.failed && !quote.failed)
        object = json_pack("{s:I, s:s, s:s, s:b, s:b}", "index", (json_int_t)design, "name", name.text, "quote",
                           quote.text, "manual", (int)(design == page->manual), "first", (int)(design != page->greedy));
    free(name.text);
    free(quote.text);
    return object;
}

uint32_t *sp_viewer_beside(const sp_layers *layers)
{
    const sp_atlas *atlas = sp_evaluator_atlas(layers->evaluator);
    const sp_patches *patches = sp_evaluator_patches(layers->evaluator);
    uint32_t *beside = malloc((patches->count + 1) * sizeof *beside);
    for (size_t i = 0; beside && i < patches->count; ++i) {
        uint32_t texel = patches->texel[i];
        const uint32_t *layer = layers->patch[patches->side[i] == SP_SIDE_BACK];
        beside[i] = SP_NONE;
        if (texel >= atlas->pixel_count)
            continue;
        sp_texel_place at = sp_atlas_place(atlas, texel);
        uint32_t above = at.y ? sp_atlas_pixel(atlas, at.page, at.x, at.y - 1) : SP_NONE;
        uint32_t left = at.x ? sp_atlas_pixel(atlas, at.page, at.x - 1, at.y) : SP_NONE;
        beside[i] = above == SP_NONE ? SP_NONE : layer[above];
        if (beside[i] == SP_NONE && left != SP_NONE)
            beside[i] = layer[left];
    }
    return beside;
}

json_t *sp_viewer_design(const sp_page *page, size_t index, const sp_shown_quantity quantities[SP_SHOWN_QUANTITIES],
                         const uint32_t *beside, sp_packed *packed, sp_error *error)
{
    const sp_design *design = &page->result->designs[index];
    const sp_deposits *deposits = &design->coverage->deposits;
    uint8_t *bytes = malloc(deposits->count + 1);
    json_t *object = bytes ? head_json(page, index) : NULL;
    if (!object) {
        free(bytes);
        return sp_fail_memory(error);
    }
    for (int k = 0; k < SP_SHOWN_QUANTITIES; ++k)
        pack_quantity(deposits, &quantities[k], sp_shown_values(deposits, k), bytes, beside, packed);
    pack_covered(deposits, bytes, beside, packed);
    json_t *shadows = pack_shadows(design, bytes, beside, packed, error);
    json_t *nozzles = shadows ? pack_nozzles(design, &quantities[SP_SHOWN_FLUX], bytes, beside, packed, error) : NULL;
    bool good =
        json_object_set_new(object, "shadows", shadows) == 0 && json_object_set_new(object, "nozzles", nozzles) == 0;
    free(bytes);
    if (good)
        return object;
    json_decref(object);
    return sp_fail_memory(error);
}
