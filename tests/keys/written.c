/* The tables of what is written, beside the sources that write it. */
#include "keys/blocks.h"
#include "report/channels.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAME = 64, NAMES = 400 };

typedef struct {
    char names[NAMES][NAME];
    size_t count;
} names;

static bool has(const names *names, const char *name)
{
    for (size_t i = 0; i < names->count; i++)
        if (!strcmp(names->names[i], name))
            return true;
    return false;
}

static void add(names *names, const char *name, size_t length)
{
    char copy[NAME];
    assert_true(length < NAME && names->count < NAMES);
    snprintf(copy, sizeof copy, "%.*s", (int)length, name);
    if (!has(names, copy))
        strcpy(names->names[names->count++], copy);
}

static char *read_source(const char *name)
{
    char path[1000];
    snprintf(path, sizeof path, "%s/src/%s", SOURCE_DIR, name);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    char *text = calloc(1, 200000);
    assert_true(text && fread(text, 1, 199999, file) > 0 && !fclose(file));
    return text;
}

/* Literals that stand behind `before`, whatever else is between the two in its call. */
static void add_literals(const char *source, const char *before, names *names)
{
    for (const char *at = source; (at = strstr(at, before)); at++) {
        const char *comma = strchr(at, ',');
        if (comma && comma[1] == ' ' && comma[2] == '"')
            add(names, comma + 3, strcspn(comma + 3, "\""));
    }
}

static void add_keys(const sp_block *block, names *names)
{
    for (const sp_key *key = block->keys; key->name; key++) {
        add(names, key->name, strlen(key->name));
        if (key->block)
            add_keys(key->block, names);
    }
}

/* All that result.json's writer puts into it, by its source. */
static names *written_keys(void)
{
    static names written;
    static const char *const others[] = {"coverage_bound_same_water",
                                         "water_bound_same_coverage_l_min",
                                         "coverage_bound_same_price",
                                         "price_bound_same_coverage_l_min",
                                         "name",
                                         "seconds",
                                         "processor_seconds"}; /* in tables and json_pack */
    static const char *const sources[] = {"result/json.c", "result/json_layout.c", "result/json_proposal.c"};
    char *json = calloc(1, 1), *reasons = read_source("result/reasons.c");
    for (size_t i = 0; i < sizeof sources / sizeof *sources; i++) {
        char *source = read_source(sources[i]);
        json = realloc(json, strlen(json) + strlen(source) + 1);
        assert_non_null(json);
        strcat(json, source);
        free(source);
    }
    add_literals(json, "sp_put(", &written);
    add_literals(json, "put_", &written);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        char literal[NAME + 2];
        snprintf(literal, sizeof literal, "\"%s\"", others[i]);
        assert_non_null(strstr(json, literal));
        add(&written, others[i], strlen(others[i]));
    }
    for (const char *at = reasons, *end = strstr(reasons, "lacks["); (at = strstr(at, "] = {\"")) && at < end; at++)
        add(&written, at + 6, strcspn(at + 6, "\""));
    free(json);
    free(reasons);
    return &written;
}

static void results_hold_what_is_said(void **state)
{
    static names explained;
    const names *written = written_keys();
    (void)state;
    add_keys(&sp_block_result, &explained);
    for (size_t i = 0; i < written->count; i++)
        if (!has(&explained, written->names[i]))
            fail_msg("%s is written and not explained", written->names[i]);
    for (size_t i = 0; i < explained.count; i++)
        if (!has(written, explained.names[i]))
            fail_msg("%s is explained and not written", explained.names[i]);
    assert_true(written->count > 100);
}

/* The keys as the head of a CSV file, and that it stands in its writer. */
static void require_head(const char *file, const char *source)
{
    char head[2000] = "";
    const sp_key *key = sp_key_of(&sp_block_files, file);
    for (const sp_key *column = key->block->keys; column->name; column++)
        snprintf(head + strlen(head), sizeof head - strlen(head), "%s%s", head[0] ? "," : "", column->name);
    strcat(head, "\\n");
    if (!strstr(source, head))
        fail_msg("%s is not the head of %s", head, file);
}

/* Literals over several lines, as one. */
static void join_literals(char *text)
{
    char *to = text;
    for (const char *from = text; *from;) {
        size_t gap = *from == '"' ? 1 + strspn(from + 1, " \n") : 0;
        if (gap > 1 && from[gap] == '"' && memchr(from, '\n', gap))
            from += gap + 1;
        else
            *to++ = *from++;
    }
    *to = '\0';
}

static void tables_have_these_columns(void **state)
{
    char *csv = read_source("result/csv.c");
    (void)state;
    join_literals(csv);
    require_head("nozzles.csv", csv);
    require_head("swabs.csv", csv);
    free(csv);
}

static void images_have_these_channels(void **state)
{
    const sp_key *channel = sp_key_of(&sp_block_files, "deposits.exr")->block->keys;
    (void)state;
    for (int i = 0; i < SP_CHANNELS; i++, channel++)
        assert_string_equal(channel->name, sp_channel_names[i]);
    assert_null(channel->name);
}

static void arrays_are_in(const char *file, const char *source_name)
{
    char *source = read_source(source_name);
    for (const sp_key *key = sp_key_of(&sp_block_files, file)->block->keys; key->name; key++) {
        char literal[NAME + 2];
        snprintf(literal, sizeof literal, "\"%s\"", key->name);
        if (!strstr(source, literal))
            fail_msg("no %s in %s", key->name, source_name);
    }
    free(source);
}

static void models_have_these_arrays(void **state)
{
    (void)state;
    arrays_are_in("surface.vtp", "report/surface_vtp.c");
    arrays_are_in("texels.vtp", "report/texels_vtp.c");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(results_hold_what_is_said), cmocka_unit_test(tables_have_these_columns),
        cmocka_unit_test(images_have_these_channels), cmocka_unit_test(models_have_these_arrays)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
