/* What runs in the workplace gave. */
#ifndef CLI_RESULTS_H
#define CLI_RESULTS_H

#include "workplace.h"

#include <sprayplan/keys.h>

/* Where what is asserted holds of any texels, and finer ones take long. */
#define COARSE "--set simulate.texel=100mm"

static inline double number(const json_t *object, const char *key)
{
    assert_true(json_is_number(json_object_get(object, key)));
    return json_number_value(json_object_get(object, key));
}

static inline bool is_word(const json_t *value, const char *const *words)
{
    const char *text = json_string_value(value);
    for (; text && *words; words++)
        if (!strcmp(text, *words))
            return true;
    return false;
}

static inline bool are_numbers(const json_t *list)
{
    for (size_t i = 0; i < json_array_size(list); i++)
        if (!json_is_number(json_array_get(list, i)))
            return false;
    return json_is_array(list);
}

static inline bool is_of_kind(const sp_key *key, const json_t *value)
{
    switch (key->kind) {
    case SP_KEY_NUMBER:
        return json_is_number(value);
    case SP_KEY_NUMBERS:
        return are_numbers(value);
    case SP_KEY_COUNT:
        return json_is_integer(value);
    case SP_KEY_FLAG:
        return json_is_boolean(value);
    case SP_KEY_CHOICE:
        return is_word(value, key->words);
    case SP_KEY_BLOCK:
        return json_is_object(value);
    case SP_KEY_BLOCKS:
    case SP_KEY_TEXTS:
        return json_is_array(value);
    default:
        return json_is_string(value);
    }
}

/* Nothing is there but what `sprayplan help result` says, where it says it. */
static inline void require_explained(const sp_block *block, json_t *object)
{
    const char *name;
    json_t *value;
    json_object_foreach(object, name, value)
    {
        const sp_key *key = block->keys;
        while (key->name && strcmp(key->name, name))
            key++;
        if (!key->name || !is_of_kind(key, value))
            fail_msg("%s of %s is not as explained", name, block->what);
        if (key->kind == SP_KEY_BLOCK)
            require_explained(key->block, value);
        for (size_t i = 0; key->kind == SP_KEY_BLOCKS && i < json_array_size(value); i++)
            require_explained(key->block, json_array_get(value, i));
    }
}

static inline json_t *json_file(const char *name)
{
    char *text = read_file(name, NULL);
    assert_non_null(text);
    json_t *object = json_loads(text, 0, NULL);
    assert_non_null(object);
    if (json_object_get(object, "layouts"))
        require_explained(sp_topic_block(SP_TOPIC_RESULT), object);
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
