#include "live.h"

#include "live/live.h"
#include "live/numbers.h"
#include "nozzle/layers.h"
#include "packed.h"
#include "script.h"
#include "spray/restore.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

#define MOST_TRIANGLES 300000 /* a page of about 10 MB, opened within some seconds */
#define MOST_PATCHES 500000

const sp_evaluator *sp_page_live_evaluator(const sp_page *page)
{
    return page->main == SP_UNKNOWN ? NULL : page->result->designs[page->main].evaluator;
}

/* A measured pattern does not travel with the page, and drops that air holds back are not known to what does. */
static bool stays_behind(const sp_nozzle_type *type)
{
    return sp_type_needs_images(type) || type->trajectory == SP_TRAJECTORY_DRAG;
}

static bool any_stays_behind(const sp_page *page)
{
    for (size_t i = 0; i < page->result->design_count; i++) {
        const sp_layout *layout = page->result->designs[i].layout;
        for (size_t k = 0; layout && k < layout->count; k++)
            if (stays_behind(layout->nozzles[k].type))
                return true;
    }
    return false;
}

static const char *too_much(const sp_evaluator *evaluator)
{
    const sp_setup *setup = sp_evaluator_setup(evaluator);
    const sp_fidelity *fidelity = sp_evaluator_fidelity(evaluator);
    if (fidelity->method != SP_METHOD_INVERSE)
        return "they were evaluated by jets, which takes too long for it";
    if (setup->criterion.film > 0)
        return "it does not know what runs down the walls";
    if (setup->sweep.speed > 0)
        return "it does not know goods that move";
    if (!sp_evaluator_is_simple(evaluator))
        return "it does not know drops that air holds back";
    if (setup->mesh->triangle_count > MOST_TRIANGLES || sp_evaluator_patches(evaluator)->count > MOST_PATCHES)
        return "the geometry is too large to travel with it";
    return NULL;
}

const char *sp_page_not_live(const sp_page *page)
{
    const sp_evaluator *evaluator = sp_page_live_evaluator(page);
    if (!page->result->editing || !evaluator)
        return "";
    if (!sp_live_is_built)
        return "this build of sprayplan has no evaluator for pages";
    if (any_stays_behind(page))
        return "a nozzle's measured pattern, or drops of its own that air holds back, do not travel with it";
    return too_much(evaluator);
}

static json_t *numbers_json(const double *values, size_t count)
{
    json_t *list = json_array();
    for (size_t i = 0; i < count; i++)
        json_array_append_new(list, json_real(values[i]));
    return list;
}

static json_t *vector_json(sp_vec3 v)
{
    return numbers_json((double[]){v.x, v.y, v.z}, 3);
}

/* Whatever bytes it has. */
static json_t *text_json(const char *text)
{
    char *valid = sp_text_utf8(text);
    json_t *json = json_string(valid ? valid : "");
    free(valid);
    return json;
}

/* In the order of sp_live_setting. */
static json_t *settings_json(const sp_evaluator *evaluator)
{
    const sp_setup *setup = sp_evaluator_setup(evaluator);
    const sp_fidelity *fidelity = sp_evaluator_fidelity(evaluator);
    const sp_criterion *criterion = &setup->criterion;
    const sp_atlas *atlas = sp_evaluator_atlas(evaluator);
    const double settings[SP_LIVE_SETTING_COUNT] = {
        [SP_LIVE_DENSITY] = setup->liquid.density,
        [SP_LIVE_UP_IS_Y] = setup->up.y > 0,
        [SP_LIVE_GRAVITY] = setup->gravity,
        [SP_LIVE_FLUX] = criterion->flux,
        [SP_LIVE_IMPACT_SPEED] = criterion->impact_speed,
        [SP_LIVE_INCIDENCE] = criterion->incidence,
        [SP_LIVE_SINGLE] = criterion->combine == SP_COMBINE_SINGLE,
        [SP_LIVE_PARABOLA] = fidelity->trajectory == SP_TRAJECTORY_PARABOLA,
        [SP_LIVE_TEXEL] = fidelity->texel,
        [SP_LIVE_CAVITY] = setup->cavity,
        [SP_LIVE_CAVITY_X] = setup->cavity_point.x,
        [SP_LIVE_CAVITY_Y] = setup->cavity_point.y,
        [SP_LIVE_CAVITY_Z] = setup->cavity_point.z,
        [SP_LIVE_ORIGIN_X] = setup->origin.x,
        [SP_LIVE_ORIGIN_Y] = setup->origin.y,
        [SP_LIVE_ORIGIN_Z] = setup->origin.z,
        [SP_LIVE_PAGE_EDGE] = atlas->page_edge,
        [SP_LIVE_PAGE_COUNT] = (double)atlas->page_count,
    };
    return numbers_json(settings, SP_LIVE_SETTING_COUNT);
}

/* Types by the rows that they are written to: those to choose from and those in use, then those of their members. */
typedef struct {
    size_t count, room;
    const sp_nozzle_type **types;
    size_t named; /* of them, to choose from */
    json_t *members;
    size_t member_count;
} type_rows;

static size_t row_of(type_rows *rows, const sp_nozzle_type *type)
{
    for (size_t i = 0; i < rows->count; i++)
        if (rows->types[i] == type)
            return i;
    if (rows->count < rows->room)
        rows->types[rows->count++] = type;
    return rows->count - 1;
}

static bool list_types(const sp_page *page, type_rows *rows)
{
    const sp_result *result = page->result;
    const sp_place_options *options = &result->editing->options;
    size_t room = options->type_count;
    for (size_t i = 0; i < result->design_count; i++)
        room += result->designs[i].layout ? result->designs[i].layout->count : 0;
    for (size_t i = 0; i < options->mount_count; i++)
        room += options->mounts[i].type_count;
    rows->room = room * (SP_MEMBERS + 1);
    rows->types = malloc((rows->room + 1) * sizeof *rows->types);
    rows->members = json_array();
    for (size_t i = 0; rows->types && i < options->type_count; i++)
        if (!stays_behind(options->types[i]))
            row_of(rows, options->types[i]);
    for (size_t i = 0; rows->types && i < options->mount_count; i++)
        for (size_t k = 0; k < options->mounts[i].type_count; k++)
            if (!stays_behind(options->mounts[i].types[k]))
                row_of(rows, options->mounts[i].types[k]);
    for (size_t i = 0; rows->types && i < result->design_count; i++)
        for (size_t k = 0; result->designs[i].layout && k < result->designs[i].layout->count; k++)
            row_of(rows, result->designs[i].layout->nozzles[k].type);
    rows->named = rows->count;
    return rows->types && rows->members;
}

static json_t *types_json(type_rows *rows)
{
    json_t *list = json_array();
    for (size_t i = 0; i < rows->named; i++) /* members' rows come behind these */
        for (size_t k = 0; k < rows->types[i]->member_count; k++) {
            double numbers[SP_LIVE_MEMBER_NUMBERS];
            sp_live_write_member(&rows->types[i]->members[k], row_of(rows, &rows->types[i]->members[k].type), numbers);
            json_array_append_new(rows->members, numbers_json(numbers, SP_LIVE_MEMBER_NUMBERS));
        }
    for (size_t i = 0; i < rows->count; i++) {
        double numbers[SP_LIVE_TYPE_NUMBERS];
        sp_live_write_type(rows->types[i], rows->member_count, numbers);
        rows->member_count += rows->types[i]->member_count;
        json_array_append_new(
            list, json_pack("{s:o, s:o, s:f}", "name", text_json(i < rows->named ? rows->types[i]->name : ""),
                            "numbers", numbers_json(numbers, SP_LIVE_TYPE_NUMBERS), "body", rows->types[i]->body));
    }
    return list;
}

static json_t *layout_json(const sp_page *page, size_t design, type_rows *rows)
{
    const sp_layout *layout = page->result->designs[design].layout;
    json_t *list = json_array();
    for (size_t i = 0; i < layout->count; i++) {
        const sp_nozzle *nozzle = &layout->nozzles[i];
        double numbers[SP_LIVE_NOZZLE_NUMBERS];
        sp_live_write_nozzle(nozzle, row_of(rows, nozzle->type), numbers);
        double cost = page->figures[design].nozzles[i].cost;
        json_array_append_new(list, json_pack("{s:o, s:o, s:b, s:I, s:f}", "name", text_json(nozzle->name), "numbers",
                                              numbers_json(numbers, SP_LIVE_NOZZLE_NUMBERS), "keep", (int)nozzle->keep,
                                              "jets", (json_int_t)nozzle->jets, "cost", isfinite(cost) ? cost : 0.0));
    }
    return list;
}

static json_t *designs_json(const sp_page *page, type_rows *rows)
{
    json_t *list = json_array();
    for (size_t i = 0; i < page->result->design_count; i++) {
        const sp_design *design = &page->result->designs[i];
        if (design->evaluator == sp_page_live_evaluator(page))
            json_array_append_new(list, json_pack("{s:I, s:f, s:b, s:o}", "index", (json_int_t)i, "coverage",
                                                  design->coverage->fraction, "main", (int)(i == page->main), "nozzles",
                                                  layout_json(page, i, rows)));
    }
    return list;
}

/* `types` are the rows that fit, of all that may be chosen. Limits differ from one alternative to the next: with these
 * none is told of how many nozzles the mount takes, which is one for ports. */
static json_t *mount_json(const sp_mount *mount, const type_rows *rows, bool limits)
{
    static const char *const kinds[] = {"port", "surface", "line", "box"};
    json_t *types = json_array();
    for (size_t i = 0; i < rows->named; i++)
        if (sp_mount_takes(mount, rows->types[i]))
            json_array_append_new(types, json_integer((json_int_t)i));
    size_t most = mount->kind == SP_MOUNT_PORT ? 1 : limits ? mount->most : 0;
    return json_pack("{s:s, s:o, s:o, s:o, s:f, s:[ff], s:I, s:I, s:f, s:f, s:o, s:o, s:o, s:I}", "kind",
                     kinds[mount->kind], "name", text_json(mount->name), "position", vector_json(mount->position),
                     "axis", vector_json(mount->axis), "tilt", mount->tilt, "depth", mount->depth_from, mount->depth_to,
                     "geometry", (json_int_t)mount->geometry, "part",
                     mount->part == SP_NONE ? (json_int_t)-1 : (json_int_t)mount->part, "standoff", mount->standoff,
                     "cost", mount->cost, "from", vector_json(mount->from), "to", vector_json(mount->to), "types",
                     types, "most", (json_int_t)most);
}

static json_t *parts_json(const sp_setup *setup)
{
    json_t *list = json_array();
    for (size_t i = 0; i < setup->mesh->part_count; i++)
        json_array_append_new(list, json_pack("{s:o, s:b, s:I}", "name", text_json(setup->mesh->parts[i].name), "clean",
                                              (int)setup->surfaces[i].clean, "geometry",
                                              (json_int_t)setup->mesh->parts[i].geometry));
    return list;
}

/* "costly" where prices are told, and what water is worth, per m³/s, where money is. */
static void add_price(const sp_page *page, json_t *all)
{
    const sp_figures *main = &page->figures[page->main];
    if (!isfinite(main->mount_cost))
        return;
    json_object_set_new(all, "costly", json_true());
    if (main->water_cost.money > 0) {
        json_object_set_new(all, "money", json_real(main->water_cost.money));
        json_object_set_new(all, "currency", json_string(main->water_cost.currency));
    }
}

static json_t *datum_json(const sp_datum *datum)
{
    return json_pack("{s:o, s:o}", "axis", vector_json(datum->axis), "zero", vector_json(datum->zero));
}

static json_t *editing_json(const sp_page *page, type_rows *rows)
{
    const sp_evaluator *evaluator = sp_page_live_evaluator(page);
    const sp_place_options *options = &page->result->editing->options;
    bool limits = !sp_result_has_alternatives(page->result);
    json_t *mounts = json_array(), *designs = designs_json(page, rows);
    for (size_t i = 0; i < options->mount_count; i++)
        json_array_append_new(mounts, mount_json(&options->mounts[i], rows, limits));
    json_t *lacks = json_array();
    for (sp_lack lack = 0; lack < SP_LACKS; lack++)
        json_array_append_new(lacks, json_string(sp_lack_text(lack) ? sp_lack_text(lack) : ""));
    json_t *all =
        json_pack("{s:o, s:o, s:o, s:o, s:o, s:s, s:I}", "settings", settings_json(evaluator), "parts",
                  parts_json(sp_evaluator_setup(evaluator)), "designs", designs, "mounts", mounts, "lacks", lacks,
                  "scene", page->result->editing->scene, "most", (json_int_t)(limits ? options->max_nozzles : 0));
    if (all)
        json_object_set_new(all, "datum", datum_json(&sp_evaluator_setup(evaluator)->datum));
    if (all) /* after all rows are known */
        json_object_set_new(all, "types", types_json(rows));
    if (all)
        json_object_set(all, "members", rows->members);
    if (all)
        add_price(page, all);
    return all;
}

static bool add_editing(const sp_page *page, sp_text *text, sp_error *error)
{
    type_rows rows = {0};
    json_t *all = list_types(page, &rows) ? editing_json(page, &rows) : NULL;
    char *json = all ? json_dumps(all, JSON_COMPACT | JSON_REAL_PRECISION(17)) : NULL;
    if (json) {
        sp_text_add(text, "<script type=\"application/json\" id=\"live-model\">");
        sp_markup_json(text, json);
        sp_text_add(text, "</script>\n");
    }
    bool done = json != NULL;
    free(json);
    json_decref(all);
    json_decref(rows.members);
    free(rows.types);
    return done || sp_fail_memory(error);
}

/* Deflated, behind `id`; takes what is packed. */
static bool add_deflated(sp_text *text, const char *id, sp_packed *packed, sp_error *error)
{
    char *data = sp_packed_finish(packed, error);
    free(packed->text);
    if (!data)
        return false;
    sp_text_add(text, "<script type=\"text/plain\" id=\"%s\">", id);
    sp_text_append(text, data, strlen(data));
    sp_text_add(text, "</script>\n");
    free(data);
    return true;
}

static bool add_script(sp_text *text, const char *id, const char *script, const char *end, sp_error *error)
{
    sp_packed packed = {0};
    sp_page_script(&packed, script, end);
    return add_deflated(text, id, &packed, error);
}

/* What none but a page that evaluates needs comes deflated, its scripts too: a third of the bytes. */
static bool add_module(sp_text *text, sp_error *error)
{
    sp_packed packed = {0};
    sp_text_append(&packed, sp_live_module, (size_t)(sp_live_module_end - sp_live_module));
    return add_deflated(text, "live-module", &packed, error) &&
           add_script(text, "live-worker", sp_live_worker, sp_live_worker_end, error) &&
           add_script(text, "live-script", sp_live_script, sp_live_script_end, error);
}

bool sp_page_live(const sp_page *page, sp_text *text, sp_error *error)
{
    return add_editing(page, text, error) && add_module(text, error);
}
