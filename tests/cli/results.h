/* What runs in the workplace gave. */
#ifndef CLI_RESULTS_H
#define CLI_RESULTS_H

#include "workplace.h"

/* Where what is asserted holds of any texels, and finer ones take long. */
#define COARSE "--set simulate.texel=100mm"

static inline double number(const json_t *object, const char *key)
{
    assert_true(json_is_number(json_object_get(object, key)));
    return json_number_value(json_object_get(object, key));
}

static inline json_t *json_file(const char *name)
{
    char *text = read_file(name, NULL);
    assert_non_null(text);
    json_t *object = json_loads(text, 0, NULL);
    assert_non_null(object);
    require_output_explained(object);
    free(text);
    return object;
}

/* The entry of that name in a list of objects. */
static inline json_t *named(const json_t *object, const char *list, const char *name)
{
    json_t *entries = json_object_get(object, list);
    for (size_t i = 0; i < json_array_size(entries); i++)
        if (!strcmp(json_string_value(json_object_get(json_array_get(entries, i), "name")), name))
            return json_array_get(entries, i);
    fail_msg("no %s in %s", name, list);
    return NULL;
}

static inline json_t *layout_named(const json_t *result, const char *name)
{
    return named(result, "layouts", name);
}

/* Of the whole set of files one run serves several tests. */
static inline void ensure(const char *folder, const char *arguments)
{
    char text[256];
    snprintf(text, sizeof text, "%s/result.json", folder);
    char *there = read_file(text, NULL);
    free(there);
    if (there)
        return;
    snprintf(text, sizeof text, "%s -o %s --quiet", arguments, folder);
    outcome result = run_program(text);
    assert_true(result.status == 0 || result.status == 4);
    assert_string_equal(result.out, "");
    forget(&result);
}

/* The room with another text in place of a part of its scene. */
static inline void write_room_with(const char *name, const char *part, const char *instead)
{
    char scene[sizeof room_yaml + 256];
    const char *at = strstr(room_yaml, part);
    assert_non_null(at);
    snprintf(scene, sizeof scene, "%.*s%s%s", (int)(at - room_yaml), room_yaml, instead, at + strlen(part));
    write_file(name, scene);
}

/* The line of a folder's report that begins with `title`. */
static inline void row_of(const char *folder, const char *title, char row[512])
{
    char path[128];
    snprintf(path, sizeof path, "%s/report.html", folder);
    char *page = read_file(path, NULL);
    const char *at = page ? strstr(page, title) : NULL;
    assert_non_null(at);
    snprintf(row, 512, "%.*s", (int)strcspn(at, "\n"), at);
    free(page);
}

/* The room with mounting points as far apart as `spacing` says; with 40 mm, thousands of them, place takes longer than
 * any test. `evaluator` is how that of the scene begins, as "evaluator: forward, ", or "". */
static inline void write_long_scene(const char *name, const char *evaluator, const char *spacing)
{
    char *scene = malloc(sizeof room_yaml + 512);
    const char *settings = strstr(room_yaml, "texel: ");
    assert_non_null(scene);
    assert_non_null(settings);
    sprintf(scene, "%.*s%s%s    - box: {min: [0.1, 0.1, 0.1], max: [0.9, 0.9, 0.9], spacing: %s, tilt: 180 deg}\n",
            (int)(settings - room_yaml), room_yaml, evaluator, settings, spacing);
    write_file(name, scene);
    free(scene);
}

#endif
