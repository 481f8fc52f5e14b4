/* The tables of keys: that they say something of each, and that scenes and catalogues hold what they say. */
#include "keys/blocks.h"
#include "scene/yaml.h"

#include <sprayplan/scene.h>

#include <ctype.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_BLOCKS = 100 };

typedef void visit(const sp_block *block, void *state);

/* All blocks below one, each once. */
static void visit_blocks(const sp_block *block, const sp_block **done, size_t *count, visit *each, void *state)
{
    for (size_t i = 0; i < *count; i++)
        if (done[i] == block)
            return;
    assert_true(*count < MOST_BLOCKS);
    done[(*count)++] = block;
    each(block, state);
    for (const sp_key *key = block->keys; key->name; key++)
        if (key->block)
            visit_blocks(key->block, done, count, each, state);
}

static void visit_topic(sp_topic topic, visit *each, void *state)
{
    const sp_block *done[MOST_BLOCKS];
    size_t count = 0;
    visit_blocks(sp_topic_block(topic), done, &count, each, state);
}

static void check_texts(const sp_block *block, void *state)
{
    (void)state;
    assert_true(block->name[0] && block->what[0] && block->keys[0].name);
    for (const sp_key *key = block->keys; key->name; key++) {
        char form[SP_KEY_FORM];
        size_t size = key->says ? strlen(key->says) : 0;
        sp_key_form(key, form);
        if (size < 2 || key->says[size - 1] == '.' || strlen(form) + 1 == SP_KEY_FORM)
            fail_msg("%s of %s", key->name, block->what);
        if (key->kind == SP_KEY_COUNT && !(key->range.low < key->range.high))
            fail_msg("%s of %s: no whole number is within its range", key->name, block->what);
        assert_true(!key->standard || !key->absent);
        assert_true(!key->required || (!key->standard && !key->absent));
        assert_int_equal(key->kind == SP_KEY_CHOICE, key->words && key->kind == SP_KEY_CHOICE);
        bool blocks = key->kind == SP_KEY_BLOCK || key->kind == SP_KEY_BLOCKS || key->kind == SP_KEY_NAMED_BLOCKS;
        assert_true(blocks == (key->block != NULL) || key->kind == SP_KEY_FILE);
        for (const sp_key *other = block->keys; other != key; other++)
            assert_string_not_equal(other->name, key->name);
    }
}

static void every_key_is_explained(void **state)
{
    for (sp_topic topic = SP_TOPIC_SCENE; topic <= SP_TOPIC_OUTPUTS; topic++)
        visit_topic(topic, check_texts, *state);
    assert_null(sp_topic_block(SP_TOPIC_OUTPUTS + 1));
}

/* A key that some sample has. */
typedef struct {
    const sp_key *keys[1000];
    size_t count;
} seen;

static void see(const sp_block *block, const sp_yaml *node, seen *seen)
{
    if (node->kind == SP_YAML_LIST)
        for (const sp_yaml *child = node->first; child; child = child->next)
            see(block, child, seen);
    for (const sp_yaml *child = node->first; node->kind == SP_YAML_MAP && child; child = child->next) {
        const sp_key *key = sp_key_of(block, child->key);
        assert_true(seen->count < sizeof seen->keys / sizeof *seen->keys);
        seen->keys[seen->count++] = key;
        if (key->block)
            see(key->block, child, seen);
    }
}

static void require_seen(const sp_block *block, void *state)
{
    const seen *seen = state;
    for (const sp_key *key = block->keys; key->name; key++) {
        size_t i = 0;
        while (i < seen->count && seen->keys[i] != key)
            i++;
        if (i == seen->count)
            fail_msg("no sample has %s of %s", key->name, block->what);
    }
}

static sp_yaml *load_tree(const char *name)
{
    sp_error error = {0};
    sp_yaml *tree = sp_yaml_load(name, &error);
    assert_non_null(tree);
    return tree;
}

static void see_file(const char *name, sp_topic topic, seen *seen)
{
    sp_yaml *tree = load_tree(name);
    see(sp_topic_block(topic), tree, seen);
    sp_yaml_destroy(tree);
}

static void require_loads(const char *name)
{
    sp_error error = {0};
    sp_scene *scene = sp_scene_load(name, &error);
    if (!scene)
        fail_msg("%s:%d:%d: %s", error.file, error.line, error.column, error.message);
    sp_scene_destroy(scene);
}

/* The samples hold every key of the tables, and are read: no key is there that cannot be used. */
static void every_key_is_read(void **state)
{
    static seen seen;
    (void)state;
    require_loads("scene.yaml");
    require_loads("goods.yaml");
    see_file("scene.yaml", SP_TOPIC_SCENE, &seen);
    see_file("goods.yaml", SP_TOPIC_SCENE, &seen);
    see_file("cad.yaml", SP_TOPIC_SCENE, &seen);
    see_file("catalogue.yaml", SP_TOPIC_CATALOGUE, &seen);
    visit_topic(SP_TOPIC_SCENE, require_seen, &seen);
    visit_topic(SP_TOPIC_CATALOGUE, require_seen, &seen);
}

/* The text of a tree with a scene's or catalogue's path, read. */
static void require_tree_loads(const sp_yaml *tree, const char *name, const char *scene)
{
    sp_error error = {0};
    char *text = sp_yaml_text(tree, "changed", &error);
    FILE *file = text ? fopen(name, "w") : NULL;
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0 && fclose(file) == 0);
    free(text);
    require_loads(scene);
}

/* Writes what is said to hold without a key in the place of what each key has; how often. */
static size_t write_defaults(sp_yaml *node, const sp_block *block)
{
    size_t count = 0;
    for (sp_yaml *child = node->first; node->kind == SP_YAML_LIST && child; child = child->next)
        count += write_defaults(child, block);
    for (sp_yaml *child = node->first; node->kind == SP_YAML_MAP && child; child = child->next) {
        const sp_key *key = sp_key_of(block, child->key);
        if (key->block)
            count += write_defaults(child, key->block);
        if (!key->standard)
            continue;
        sp_error error = {0};
        sp_yaml *value = sp_yaml_parse("default", key->standard, strlen(key->standard), &error);
        assert_non_null(value);
        value->key = strdup(child->key);
        sp_yaml_replace(node, value);
        child = value;
        count++;
    }
    return count;
}

static void defaults_can_be_written(void **state)
{
    (void)state;
    sp_yaml *scene = load_tree("scene.yaml"), *catalogue = load_tree("catalogue.yaml");
    assert_true(write_defaults(scene, &sp_block_scene) > 30);
    assert_true(write_defaults(catalogue, &sp_block_catalogue) > 10);
    require_tree_loads(scene, "changed.yaml", "changed.yaml");
    require_tree_loads(catalogue, "catalogue.yaml", "scene.yaml");
    sp_yaml_destroy(scene);
    sp_yaml_destroy(catalogue);
}

/* Each block there, and nothing in it: readers assert that what is so then is what the tables say. */
static void defaults_are_true(void **state)
{
    static const char text[] = "geometry: [{file: tank.obj}]\n"
                               "liquid:\nair:\ncriterion:\nsimulate:\ndatum:\nreport:\n"
                               "catalogue: small.yaml\n"
                               "nozzles: [{name: N, type: A, position: [0, 0, 0], axis: [0, 0, 1], pressure: 1 bar}]\n"
                               "place:\n"
                               "  pressure: 1 bar\n"
                               "  refine: {}\n"
                               "  mounts:\n"
                               "  - port: {name: P, position: [0, 0, 1], depth: {to: 0 mm}, step: }\n"
                               "  - surface: {geometry: 0, spacing: 1 m}\n"
                               "  - line: {from: [0, 0, 0], to: [0, 0, 0]}\n"
                               "  - box: {min: [0, 0, 0], max: [0, 0, 0]}\n";
    static const char types[] =
        "nozzles:\n"
        "- {name: A, pattern: solid_stream, flow: 1 L/min, at: 1 bar, step: }\n"
        "- {name: B, pattern: cluster, flow: 1 L/min, at: 1 bar, members: [{pattern: solid_stream,\n"
        "   ring: {count: 2, polar: 1 deg}}, {pattern: solid_stream}]}\n"
        "- {name: C, pattern: rotating, flow: 1 L/min, at: 1 bar,\n"
        "   rotation: {jet: {pattern: solid_stream}}}\n";
    (void)state;
#ifdef NDEBUG
#error "this test needs assertions"
#endif
    FILE *scene = fopen("empty.yaml", "w"), *catalogue = fopen("small.yaml", "w");
    assert_true(scene && catalogue);
    assert_true(fputs(text, scene) >= 0 && fputs(types, catalogue) >= 0 && !fclose(scene) && !fclose(catalogue));
    require_loads("empty.yaml");
}

/* A copy of the samples, to be changed. */
static int enter_copy(void **state)
{
    static char folder[] = "/tmp/sprayplan-keys-XXXXXX";
    char command[1000];
    (void)state;
    if (!mkdtemp(folder))
        return -1;
    snprintf(command, sizeof command, "cp %s/tests/keys/every_key/* %s", SOURCE_DIR, folder);
    return system(command) || chdir(folder);
}

static int remove_copy(void **state)
{
    (void)state;
    return system("rm -r \"$PWD\"");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_key_is_explained), cmocka_unit_test(every_key_is_read),
                                       cmocka_unit_test(defaults_can_be_written), cmocka_unit_test(defaults_are_true)};
    return cmocka_run_group_tests(tests, enter_copy, remove_copy);
}
