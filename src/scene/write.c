/* A scene as text: what it says, with another layout and nothing left to auto. */
#include "nozzle/valid.h"
#include "scene/locale.h"
#include "scene/state.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    const sp_units *units;
    sp_error *error;
    bool failed;
} writer;

static sp_yaml *put(writer *w, sp_yaml *parent, sp_yaml_kind kind, const char *key, const char *text)
{
    sp_yaml *node = w->failed ? NULL : sp_yaml_create(kind, key, text, w->error);
    if (node && parent)
        sp_yaml_append(parent, node);
    w->failed = !node;
    return node;
}

/* Units as people write them, SI where these have no number for it; what reads back exactly. */
static void put_quantity(writer *w, sp_yaml *parent, const char *key, double value, const sp_dimension *dimension,
                         const char *unit)
{
    char number[SP_UNITS_NUMBER], text[SP_UNITS_NUMBER + 20], why[200];
    double factor = 1;
    if (*unit && !sp_units_factor(w->units, unit, dimension, &factor, why, sizeof why)) {
        sp_fail(w->error, SP_ERROR_FILE, NULL, 0, 0, "the units database of udunits2 is not sound: %s", why);
        w->failed = true;
        return;
    }
    if (!sp_units_number(value, factor, number)) {
        unit = dimension->unit;
        sp_units_number(value, 1, number);
    }
    snprintf(text, sizeof text, "%s%s%s", number, *unit ? " " : "", unit);
    put(w, parent, SP_YAML_SCALAR, key, text);
}

static void put_length(writer *w, sp_yaml *parent, const char *key, double value)
{
    put_quantity(w, parent, key, value, &sp_length_unit, "m");
}

static void put_angle(writer *w, sp_yaml *parent, const char *key, double value)
{
    put_quantity(w, parent, key, value, &sp_angle_unit, "deg");
}

static void put_count(writer *w, sp_yaml *parent, const char *key, uint64_t value)
{
    char text[32];
    snprintf(text, sizeof text, "%" PRIu64, value);
    put(w, parent, SP_YAML_SCALAR, key, text);
}

static void put_vector(writer *w, sp_yaml *parent, const char *key, sp_vec3 v, const sp_dimension *dimension,
                       const char *unit)
{
    sp_yaml *list = put(w, parent, SP_YAML_LIST, key, NULL);
    put_quantity(w, list, NULL, v.x, dimension, unit);
    put_quantity(w, list, NULL, v.y, dimension, unit);
    put_quantity(w, list, NULL, v.z, dimension, unit);
}

/* An override that says what the type says anyway is left out: a type that is not adjustable takes none. */
static bool says_more(double value, double own, double low, double high)
{
    return value > 0 && (low < high || fabs(value - own) > 1e-9 * own);
}

static void put_nozzle(writer *w, sp_yaml *list, const sp_nozzle *nozzle, const sp_setup *setup)
{
    const sp_nozzle_type *type = nozzle->type;
    const sp_fluid *liquid = &setup->liquid;
    sp_yaml *map = put(w, list, SP_YAML_MAP, NULL, NULL);
    put(w, map, SP_YAML_SCALAR, "name", nozzle->name);
    put(w, map, SP_YAML_SCALAR, "type", type->name);
    put_vector(w, map, "position", sp_setup_outside(setup, nozzle->position), &sp_length_unit, "m");
    put_vector(w, map, "axis", nozzle->axis, &sp_ratio_unit, "");
    put_angle(w, map, "roll", nozzle->roll);
    put_quantity(w, map, "pressure", nozzle->pressure, &sp_pressure_unit, "bar");
    if (says_more(nozzle->angle, type->angle, type->angle_min, type->angle_max))
        put_angle(w, map, "angle", nozzle->angle);
    if (says_more(nozzle->flow, sp_type_flow(type, type->flow, nozzle->pressure, liquid), type->flow_min,
                  type->flow_max))
        put_quantity(w, map, "flow", nozzle->flow, &sp_flow_unit, "L/min");
    if (nozzle->speed > 0)
        put_quantity(w, map, "speed", nozzle->speed, &sp_speed_unit, "m/s");
    if (nozzle->jets > 0)
        put_count(w, map, "jets", nozzle->jets);
    if (nozzle->keep)
        put(w, map, SP_YAML_SCALAR, "keep", "true");
}

static sp_yaml *nozzles_node(writer *w, const sp_layout *layout, const sp_setup *setup)
{
    sp_yaml *list = put(w, NULL, SP_YAML_LIST, "nozzles", NULL);
    for (size_t i = 0; i < layout->count && !w->failed; i++)
        put_nozzle(w, list, &layout->nozzles[i], setup);
    return list;
}

/* Lines that auto took stay open: what is simulated again is then measured against parabolas still, and as nothing
 * else is open, auto takes them again. */
static const char *trajectory_text(const sp_fidelity *asked, const sp_fidelity *fidelity)
{
    if (fidelity->trajectory != SP_TRAJECTORY_LINE)
        return fidelity->trajectory == SP_TRAJECTORY_DRAG ? "drag" : "parabola";
    return asked->trajectory == SP_TRAJECTORY_AUTO ? "auto" : "line";
}

/* `jets` may stay 0 where no jets are traced. */
static sp_yaml *simulate_node(writer *w, const sp_scene *scene, const sp_fidelity *fidelity)
{
    const sp_fidelity *asked = &scene->setup.fidelity;
    bool inverse = fidelity->method == SP_METHOD_INVERSE;
    sp_yaml *map = put(w, NULL, SP_YAML_MAP, "simulate", NULL);
    put(w, map, SP_YAML_SCALAR, "trajectory", trajectory_text(asked, fidelity));
    put(w, map, SP_YAML_SCALAR, "evaluator", inverse ? "inverse" : "forward");
    put_count(w, map, "reflections", (uint64_t)fidelity->reflections);
    if (fidelity->jets > 0)
        put_count(w, map, "jets", fidelity->jets);
    put_length(w, map, "texel", fidelity->texel);
    put(w, map, SP_YAML_SCALAR, "splat", fidelity->splat == SP_SPLAT_LINEAR ? "linear" : "nearest");
    put_quantity(w, map, "accuracy", fidelity->accuracy, &sp_share_unit, "");
    put_count(w, map, "seed", fidelity->seed);
    if (scene->reuse)
        put(w, map, SP_YAML_SCALAR, "atlas", "reuse");
    return map;
}

/* The file named by `node`, seen from `directory` instead of from the scene. */
static bool move_file(const sp_scene *scene, sp_yaml *parent, const char *key, const char *directory, writer *w)
{
    const sp_yaml *node = sp_yaml_get(parent, key);
    if (!node)
        return true;
    char *path = sp_path_join(scene->directory, node->text, w->error);
    char *moved = path ? sp_path_relative(path, directory, w->error) : NULL;
    sp_yaml *file = moved ? sp_yaml_create(SP_YAML_SCALAR, key, moved, w->error) : NULL;
    if (file)
        sp_yaml_replace(parent, file);
    free(path);
    free(moved);
    return file != NULL;
}

static bool move_files(const sp_scene *scene, sp_yaml *tree, const char *directory, writer *w)
{
    for (sp_yaml *child = sp_yaml_get(tree, "geometry")->first; child; child = child->next)
        if (!move_file(scene, child, "file", directory, w))
            return false;
    return move_file(scene, tree, "catalogue", directory, w);
}

/* How finely a CAD file was cut follows from the texel, which may have been chosen since: the same triangles again. */
static void keep_fineness(const sp_scene *scene, sp_yaml *tree, writer *w)
{
    size_t index = 0;
    for (sp_yaml *child = sp_yaml_get(tree, "geometry")->first; child; child = child->next, index++) {
        const sp_cad_account *cad = sp_scene_cad(scene, index);
        if (cad && !sp_yaml_get(child, "chord"))
            put_length(w, child, "chord", cad->chord);
        if (cad && !sp_yaml_get(child, "angle"))
            put_angle(w, child, "angle", cad->angle);
    }
}

/* What is about to be written must load again: names twice, angles that a type cannot have, numbers that are not
 * finite. */
static bool check_readable(const sp_scene *scene, sp_yaml *tree, const writer *w)
{
    sp_scene copy = {.tree = tree, .types = scene->types, .type_count = scene->type_count, .setup = scene->setup};
    sp_reader reader = {w->units, w->error};
    bool good = sp_scene_read_nozzles(&copy, &reader) && sp_scene_read_simulate(&copy, &reader);
    sp_layout_destroy(copy.layout);
    return good;
}

static char *write_tree(const sp_scene *scene, sp_yaml *tree, const sp_layout *layout, const sp_fidelity *fidelity,
                        const char *directory, const sp_units *units, sp_error *error)
{
    writer w = {.units = units, .error = error};
    sp_yaml *nozzles = nozzles_node(&w, layout, &scene->setup);
    sp_yaml *simulate = simulate_node(&w, scene, fidelity);
    if (nozzles)
        sp_yaml_replace(tree, nozzles);
    if (simulate)
        sp_yaml_replace(tree, simulate);
    keep_fineness(scene, tree, &w);
    if (w.failed || !move_files(scene, tree, directory, &w) || !check_readable(scene, tree, &w))
        return NULL;
    return sp_yaml_text(tree, "Written by sprayplan: a complete scene that holds this layout.", error);
}

static bool decided(const sp_fidelity *fidelity)
{
    return fidelity->trajectory != SP_TRAJECTORY_AUTO && fidelity->method != SP_METHOD_AUTO &&
           fidelity->reflections >= 0 && fidelity->texel > 0 &&
           (fidelity->jets > 0 || fidelity->method == SP_METHOD_INVERSE);
}

char *sp_scene_text(const sp_scene *scene, const sp_layout *layout, const sp_fidelity *fidelity, const char *directory,
                    sp_error *error)
{
    sp_locale locale;
    if (!scene || !layout || !fidelity || !directory)
        return NULL;
    if (!sp_layout_has_types(layout, error))
        return NULL;
    if (!decided(fidelity)) {
        sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "a scene is written with settings that leave nothing to auto");
        return NULL;
    }
    sp_yaml *tree = sp_yaml_clone(scene->tree, error);
    char *text = NULL;
    if (tree && sp_locale_enter(&locale, error)) {
        sp_units *units = sp_units_create(error);
        text = units ? write_tree(scene, tree, layout, fidelity, directory, units, error) : NULL;
        sp_units_destroy(units);
        sp_locale_leave(&locale);
    }
    sp_yaml_destroy(tree);
    return text;
}
