/* What the targets of scenes and catalogues share. */
#ifndef TESTS_FUZZ_SCENE_H
#define TESTS_FUZZ_SCENE_H

#include "scene/state.h"
#include "target.h"

/* A scene as it is before a tree is read, with the files of seeds/../files beside it. */
static inline sp_scene *scene_in_files(void)
{
    sp_scene *scene = calloc(1, sizeof *scene);
    REQUIRE(scene);
    scene->setup = sp_setup_default();
    scene->place = sp_place_options_default();
    scene->path = strdup(FILES "/strange");
    scene->directory = strdup(FILES);
    REQUIRE(scene->path && scene->directory);
    return scene;
}

/* Reading the database of units takes longer than any scene. */
static inline const sp_units *units_of_all_inputs(void)
{
    static sp_units *units;
    sp_error error = {0};
    if (!units)
        units = sp_units_create(&error);
    REQUIRE(units);
    return units;
}

/* As require_located; also in one of the files beside it. */
static inline void require_located_in_files(const sp_error *error, const uint8_t *data, size_t size)
{
    bool other = strncmp(error->file, FILES, sizeof FILES - 1) == 0;
    sp_error own = *error;
    if (other)
        own.line = own.column = 0;
    require_located(&own, other ? error->file : "strange", data, size);
}

/* What a tree with known keys says it says again when it is written and read. */
static inline void require_same_tree(const sp_yaml *a, const sp_yaml *b)
{
    REQUIRE(a->kind == b->kind && a->count == b->count && !a->key == !b->key);
    REQUIRE(!a->key || strcmp(a->key, b->key) == 0);
    REQUIRE(a->kind != SP_YAML_SCALAR || (strcmp(a->text, b->text) == 0 && a->empty == b->empty));
    for (const sp_yaml *x = a->first, *y = b->first; x; x = x->next, y = y->next)
        require_same_tree(x, y);
}

static inline void require_written_tree(const sp_yaml *tree)
{
    sp_error error = {0};
    char *text = sp_yaml_text(tree, "written", &error);
    REQUIRE(text || error.kind == SP_ERROR_INPUT);
    if (!text) /* no UTF-8 */
        return;
    sp_yaml *again = sp_yaml_parse("again", text, strlen(text), &error);
    if (!again)
        fprintf(stderr, "%d: %s in\n%s", error.line, error.message, text);
    REQUIRE(again);
    require_same_tree(tree, again);
    sp_yaml_destroy(again);
    free(text);
}

#endif
