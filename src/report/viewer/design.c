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

/* A design while it is encoded: what its nozzles bring by themselves, then what they bring together. */
typedef struct {
    const sp_design *design;
    const sp_neighbours *neighbours;
    const sp_shown_quantities *quantities;
    sp_coder *coder;
    uint8_t *bytes, *off;              /* [patches], of what is in hand */
    uint8_t *flux, *speed, *incidence; /* [patches], encoded */
    uint8_t *most, *second;            /* [patches], the largest of what nozzles bring */
    sp_patch_guess guess;              /* [patches] */
} encoder;

static bool make_room(encoder *t, size_t patches)
{
    uint8_t **all[] = {&t->bytes, &t->off,    &t->flux,           &t->speed,     &t->incidence,
                       &t->most,  &t->second, &t->guess.expected, &t->guess.hint};
    bool done = true;
    for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
        *all[i] = calloc(patches + 1, 1);
        done = done && *all[i];
    }
    return done;
}

static void free_room(encoder *t)
{
    uint8_t *all[] = {t->bytes, t->off,    t->flux,           t->speed,     t->incidence,
                      t->most,  t->second, t->guess.expected, t->guess.hint};
    for (size_t i = 0; i < sizeof all / sizeof *all; ++i)
        free(all[i]);
}

static bool encode(encoder *t, const uint8_t *values)
{
    return sp_patches_encode(t->neighbours, values, &t->guess, t->off, t->coder);
}

/* By neighbours alone. */
static bool encode_alone(encoder *t, const uint8_t *values)
{
    for (size_t i = 0; i < t->neighbours->count; ++i) {
        t->guess.expected[i] = sp_patch_expected(t->neighbours, values, NULL, i);
        t->guess.hint[i] = 0;
    }
    return encode(t, values);
}

/* Of patches that liquid reaches, by those that it reaches too, and by how far off what was encoded before is. */
static bool encode_reached(encoder *t, const uint8_t *values)
{
    for (size_t i = 0; i < t->neighbours->count; ++i) {
        bool reached = t->flux[i] > 0;
        t->guess.expected[i] = reached ? sp_patch_expected(t->neighbours, values, t->flux, i) : 0;
        t->guess.hint[i] = (uint8_t)(reached ? 1 + sp_patch_size(t->off[i]) : 0);
    }
    return encode(t, values);
}

static void take_bytes(encoder *t, int quantity, uint8_t *bytes)
{
    const sp_deposits *deposits = &t->design->coverage->deposits;
    const double *values = sp_shown_values(deposits, quantity);
    double asked = sp_shown_asked(t->design, quantity);
    for (size_t i = 0; i < deposits->count; ++i)
        bytes[i] = deposits->flux[i] > 0 ? sp_shown_byte(&t->quantities->of[quantity], asked, values[i]) : 0;
}

#define APART 4 /* steps between the two largest that are told from each other */

/* All that nozzles bring is the most that one does, or little more. */
static bool encode_flux(encoder *t)
{
    take_bytes(t, SP_SHOWN_FLUX, t->flux);
    if (!t->design->contributions)
        return encode_alone(t, t->flux);
    for (size_t i = 0; i < t->neighbours->count; ++i) {
        int apart = (t->most[i] - t->second[i]) / APART;
        t->guess.expected[i] = t->most[i];
        t->guess.hint[i] = (uint8_t)(!t->most[i]            ? 0
                                     : !t->second[i]        ? 1
                                     : apart < SP_HINTS - 3 ? 2 + apart
                                                            : SP_HINTS - 1);
    }
    return encode(t, t->flux);
}

/* The pressure follows the flux, where speed and incidence stay. */
static bool encode_impact(encoder *t)
{
    take_bytes(t, SP_SHOWN_IMPACT, t->bytes);
    for (size_t i = 0; i < t->neighbours->count; ++i)
        t->bytes[i] = (uint8_t)(t->bytes[i] - t->flux[i]);
    return encode_reached(t, t->bytes);
}

static bool encode_covered(encoder *t)
{
    const sp_deposits *deposits = &t->design->coverage->deposits;
    for (size_t i = 0; i < deposits->count; ++i) {
        long share = lrint(255 * fmin(fmax(deposits->share[i], 0), 1));
        t->bytes[i] =
            (uint8_t)(deposits->covered[i] ? (share < HALF ? HALF : share) : (share < HALF ? share : HALF - 1));
    }
    if (!encode_reached(t, t->bytes))
        return false;
    for (size_t i = 0; i < deposits->count; ++i)
        t->bytes[i] = deposits->by_film[i];
    return encode_alone(t, t->bytes);
}

/* Where the page has them. */
static bool encode_jets(encoder *t)
{
    if (t->quantities->count <= SP_SHOWN_JETS)
        return true;
    take_bytes(t, SP_SHOWN_JETS, t->bytes);
    return encode_reached(t, t->bytes);
}

static bool encode_deposits(encoder *t)
{
    if (!encode_flux(t))
        return false;
    take_bytes(t, SP_SHOWN_SPEED, t->speed);
    take_bytes(t, SP_SHOWN_INCIDENCE, t->incidence);
    return encode_reached(t, t->speed) && encode_reached(t, t->incidence) && encode_impact(t) && encode_jets(t) &&
           encode_covered(t);
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
static json_t *encode_shadows(encoder *t, sp_error *error)
{
    const sp_patches *patches = sp_evaluator_patches(t->design->evaluator);
    sp_listed_shadows listed = {0};
    if (!sp_listed_shadows_find(&listed, t->design, error))
        return NULL;
    outlook seen[SP_PAGE_SHADOWS];
    for (size_t i = 0; i < listed.count; ++i)
        seen[i] = (outlook){{0}, sp_v(INFINITY, INFINITY, INFINITY), sp_v(-INFINITY, -INFINITY, -INFINITY)};
    for (uint32_t k = 0; k < patches->count; ++k) {
        t->bytes[k] = (uint8_t)listed.number[k];
        if (t->bytes[k])
            look_at(&seen[t->bytes[k] - 1], patches, k);
    }
    json_t *list = json_array();
    for (size_t i = 0; i < listed.count; ++i) {
        sp_vec3 facing = sp_length(seen[i].facing) > 0 ? sp_unit(seen[i].facing) : sp_v(0, 0, 1);
        json_array_append_new(list,
                              json_pack("{s:o, s:o, s:f}", "at", vector_json(listed.shadow[i].centroid), "towards",
                                        vector_json(facing), "extent", sp_distance(seen[i].low, seen[i].high)));
    }
    sp_listed_shadows_free(&listed);
    if (encode_alone(t, t->bytes))
        return list;
    json_decref(list);
    return sp_fail_memory(error);
}

/* What one nozzle brings by itself. */
static bool encode_brought(encoder *t, size_t index)
{
    const sp_contributions *does = t->design->contributions;
    double asked = sp_shown_asked(t->design, SP_SHOWN_FLUX);
    for (size_t i = 0; i < does->patches; ++i) {
        double brought = (double)does->flux[index * does->patches + i];
        uint8_t byte = brought > 0 ? sp_shown_byte(&t->quantities->of[SP_SHOWN_FLUX], asked, brought) : 0;
        t->bytes[i] = byte;
        t->second[i] = byte > t->most[i] ? t->most[i] : byte > t->second[i] ? byte : t->second[i];
        t->most[i] = byte > t->most[i] ? byte : t->most[i];
    }
    return encode_alone(t, t->bytes);
}

/* What one nozzle brings where that is known, and its sprays. */
static json_t *encode_nozzle(encoder *t, size_t index, sp_packed *packed, sp_error *error)
{
    const sp_nozzle *nozzle = &t->design->layout->nozzles[index];
    bool known = t->design->contributions != NULL;
    if (known && !encode_brought(t, index))
        return sp_fail_memory(error);
    char *name = sp_text_utf8(nozzle->name);
    json_t *object =
        name ? json_pack("{s:s, s:b, s:o}", "name", name, "known", (int)known, "at", vector_json(nozzle->position))
             : NULL;
    free(name);
    if (!object)
        return sp_fail_memory(error);
    if (sp_viewer_sprays(t->design->evaluator, nozzle, object, packed, error))
        return object;
    json_decref(object);
    return NULL;
}

static json_t *encode_nozzles(encoder *t, sp_packed *packed, sp_error *error)
{
    json_t *list = json_array();
    for (size_t i = 0; list && i < t->design->layout->count; ++i) {
        json_t *nozzle = encode_nozzle(t, i, packed, error);
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
    sp_text_add(&quote, "%.1f %% with ", 100 * page->figures[design].coverage);
    sp_markup_water(&quote, 6e4 * page->figures[design].flow);
    sp_text_add(&quote, " L/min");
    json_t *object = NULL, *asked = json_array();
    for (int k = 0; k < SP_SHOWN_QUANTITIES; ++k)
        json_array_append_new(asked, json_real(sp_shown_asked(&page->result->designs[design], k)));
    if (!name.failed && !quote.failed)
        object = json_pack("{s:O, s:I, s:s, s:s, s:b, s:b}", "asked", asked, "index", (json_int_t)design, "name",
                           name.text, "quote", quote.text, "manual", (int)(design == page->manual), "first",
                           (int)(design != page->greedy));
    json_decref(asked);
    free(name.text);
    free(quote.text);
    return object;
}

/* Into the design's JSON; false on error. */
static bool encode_all(encoder *t, json_t *object, sp_packed *packed, sp_error *error)
{
    json_t *nozzles = encode_nozzles(t, packed, error);
    if (!nozzles || json_object_set_new(object, "nozzles", nozzles) != 0)
        return nozzles ? sp_fail_memory(error) != NULL : false;
    if (!encode_deposits(t))
        return sp_fail_memory(error) != NULL;
    json_t *shadows = encode_shadows(t, error);
    return shadows && (json_object_set_new(object, "shadows", shadows) == 0 || sp_fail_memory(error));
}

json_t *sp_viewer_design(const sp_page *page, size_t index, const sp_shown_quantities *quantities,
                         const sp_neighbours *neighbours, sp_coder *coder, sp_packed *packed, sp_error *error)
{
    encoder t = {
        .design = &page->result->designs[index], .neighbours = neighbours, .quantities = quantities, .coder = coder};
    json_t *object = head_json(page, index);
    bool room = make_room(&t, neighbours->count) && object;
    if (!room)
        sp_fail_memory(error);
    if (!room || !encode_all(&t, object, packed, error)) {
        json_decref(object);
        object = NULL;
    }
    free_room(&t);
    return object;
}
