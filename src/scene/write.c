/* A scene as text: what it says, with another layout and nothing left to auto. */
#include "scene/locale.h"
#include "scene/state.h"

#include <float.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
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

/* The shortest decimal number that reads back as the same double, and its unit. */
static void put_number(writer *w, sp_yaml *parent, const char *key, double value, const char *unit)
{
    char number[40], text[60];
    for (int digits = DBL_DIG; digits <= DBL_DECIMAL_DIG; digits++) {
        snprintf(number, sizeof number, "%.*g", digits, value);
        if (strtod(number, NULL) == value)
            break;
    }
    snprintf(text, sizeof text, "%s%s%s", number, *unit ? " " : "", unit);
    put(w, parent, SP_YAML_SCALAR, key, text);
}

static void put_count(writer *w, sp_yaml *parent, const char *key, uint64_t value)
{
    char text[32];
    snprintf(text, sizeof text, "%" PRIu64, value);
    put(w, parent, SP_YAML_SCALAR, key, text);
}

static void put_vector(writer *w, sp_yaml *parent, const char *key, sp_vec3 v, const char *unit)
{
    sp_yaml *list = put(w, parent, SP_YAML_LIST, key, NULL);
    put_number(w, list, NULL, v.x, unit);
    put_number(w, list, NULL, v.y, unit);
    put_number(w, list, NULL, v.z, unit);
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
    put_vector(w, map, "position", sp_setup_outside(setup, nozzle->position), "m");
    put_vector(w, map, "axis", nozzle->axis, "");
    put_number(w, map, "roll", nozzle->roll, "rad");
    put_number(w, map, "pressure", nozzle->pressure, "Pa");
    if (says_more(nozzle->angle, type->angle, type->angle_min, type->angle_max))
        put_number(w, map, "angle", nozzle->angle, "rad");
    if (says_more(nozzle->flow, sp_type_flow(type, type->flow, nozzle->pressure, liquid), type->flow_min,
                  type->flow_max))
        put_number(w, map, "flow", nozzle->flow, "m3/s");
    if (nozzle->speed > 0)
        put_number(w, map, "speed", nozzle->speed, "m/s");
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
static sp_yaml *simulate_node(writer *w, const sp_fidelity *asked, const sp_fidelity *fidelity)
{
    bool inverse = fidelity->method == SP_METHOD_INVERSE;
    sp_yaml *map = put(w, NULL, SP_YAML_MAP, "simulate", NULL);
    put(w, map, SP_YAML_SCALAR, "trajectory", trajectory_text(asked, fidelity));
    put(w, map, SP_YAML_SCALAR, "evaluator", inverse ? "inverse" : "forward");
    put_count(w, map, "reflections", (uint64_t)fidelity->reflections);
    if (fidelity->jets > 0)
        put_count(w, map, "jets", fidelity->jets);
    put_number(w, map, "texel", fidelity->texel, "m");
    put(w, map, SP_YAML_SCALAR, "splat", fidelity->splat == SP_SPLAT_LINEAR ? "linear" : "nearest");
    put_number(w, map, "accuracy", fidelity->accuracy, "");
    put_count(w, map, "seed", fidelity->seed);
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
            put_number(w, child, "chord", cad->chord, "m");
        if (cad && !sp_yaml_get(child, "angle"))
            put_number(w, child, "angle", cad->angle, "rad");
    }
}

/* What is about to be written must load again: names twice, angles that a type cannot have, numbers that are not
 * finite. */
static bool check_readable(const sp_scene *scene, sp_yaml *tree, sp_error *error)
{
    sp_scene copy = {.tree = tree, .types = scene->types, .type_count = scene->type_count, .setup = scene->setup};
    sp_units *units = sp_units_create(error);
    sp_reader reader = {units, error};
    bool good = units && sp_scene_read_nozzles(&copy, &reader) && sp_scene_read_simulate(&copy, &reader);
    sp_layout_destroy(copy.layout);
    sp_units_destroy(units);
    return good;
}

static char *write_tree(const sp_scene *scene, sp_yaml *tree, const sp_layout *layout, const sp_fidelity *fidelity,
                        const char *directory, sp_error *error)
{
    writer w = {.error = error};
    sp_yaml *nozzles = nozzles_node(&w, layout, &scene->setup);
    sp_yaml *simulate = simulate_node(&w, &scene->setup.fidelity, fidelity);
    if (nozzles)
        sp_yaml_replace(tree, nozzles);
    if (simulate)
        sp_yaml_replace(tree, simulate);
    keep_fineness(scene, tree, &w);
    if (w.failed || !move_files(scene, tree, directory, &w) || !check_readable(scene, tree, error))
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
    if (!decided(fidelity)) {
        sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "a scene is written with settings that leave nothing to auto");
        return NULL;
    }
    sp_yaml *tree = sp_yaml_clone(scene->tree, error);
    char *text = NULL;
    if (tree && sp_locale_enter(&locale, error)) {
        text = write_tree(scene, tree, layout, fidelity, directory, error);
        sp_locale_leave(&locale);
    }
    sp_yaml_destroy(tree);
    return text;
}
