#include "scene/read.h"

#include "mesh/soup.h"
#include "scene/edit_distance.h"

#include <assert.h>
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TEXT = 400 };

/* What stands at a node, as an error message says it. */
static void describe(const sp_yaml *node, char text[TEXT])
{
    if (node->kind == SP_YAML_LIST && node->count == 0)
        snprintf(text, TEXT, "an empty list");
    else if (node->kind == SP_YAML_LIST)
        snprintf(text, TEXT, "a list of %zu", node->count);
    else if (node->kind == SP_YAML_MAP)
        snprintf(text, TEXT, "a block of keys");
    else if (node->empty)
        snprintf(text, TEXT, "nothing");
    else
        snprintf(text, TEXT, strlen(node->text) > 80 ? "'%.80s...'" : "'%.80s'", node->text);
}

bool sp_read_fail(const sp_reader *reader, const sp_yaml *node, const char *key, const char *format, ...)
{
    char found[TEXT], expected[TEXT];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(expected, sizeof expected, format, arguments);
    va_end(arguments);
    describe(node, found);
    return sp_fail(reader->error, SP_ERROR_INPUT, node->file, node->line, node->column, "%s: found %s, expected %s",
                   key, found, expected);
}

bool sp_read_message(const sp_reader *reader, const sp_yaml *node, const char *key, const char *format, ...)
{
    char message[TEXT];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    return sp_fail(reader->error, SP_ERROR_INPUT, node->file, node->line, node->column, "%s: %s", key, message);
}

static void append(char text[TEXT], const char *more)
{
    size_t used = strlen(text);
    snprintf(text + used, TEXT - used, "%s", more);
}

static bool fail_unknown(const sp_fields *in, const sp_yaml *child)
{
    char text[TEXT] = "";
    size_t least = SIZE_MAX;
    const sp_key *keys = in->block->keys;
    for (const sp_key *key = keys; key->name; key++) {
        size_t slips = sp_edit_distance(child->key, key->name);
        if (slips < least)
            snprintf(text, sizeof text, "'%s'", key->name);
        least = slips < least ? slips : least;
    }
    for (const sp_key *key = keys; key->name && least == SIZE_MAX; key++) {
        append(text, text[0] ? ", " : keys[1].name ? "one of " : "");
        append(text, key->name);
    }
    return sp_fail(in->reader->error, SP_ERROR_INPUT, child->file, child->key_line, child->key_column,
                   "%.80s: found a key that %s does not have, expected %s", child->key, in->block->what, text);
}

static bool check_child(const sp_fields *in, const sp_yaml *child)
{
    const sp_key *key = in->block->keys;
    while (key->name && strcmp(key->name, child->key) != 0)
        key++;
    if (!key->name)
        return fail_unknown(in, child);
    const sp_yaml *first = sp_yaml_get(in->map, child->key);
    return first == child || sp_fail(in->reader->error, SP_ERROR_INPUT, child->file, child->key_line, child->key_column,
                                     "%s: found a second time, expected once", child->key);
}

bool sp_read_block(const sp_fields *in, const char *key)
{
    const sp_yaml *node = in->map;
    bool nothing = node->kind == SP_YAML_SCALAR && node->empty;
    if (node->kind != SP_YAML_MAP && !nothing)
        return sp_read_fail(in->reader, node, key, "the keys of %s", in->block->what);
    for (const sp_yaml *child = node->first; child; child = child->next)
        if (!check_child(in, child))
            return false;
    for (const sp_key *wanted = in->block->keys; wanted->name; wanted++)
        if (wanted->required && !sp_yaml_get(node, wanted->name))
            return sp_read_message(in->reader, node, wanted->name, "found nothing, expected this key in %s",
                                   in->block->what);
    return true;
}

bool sp_read_is_list(const sp_reader *reader, const sp_yaml *node, const char *key, const char *of)
{
    if (node->kind == SP_YAML_LIST || (node->kind == SP_YAML_SCALAR && node->empty))
        return true;
    return sp_read_fail(reader, node, key, "a list of %s", of);
}

static bool in_range(sp_range range, double *value)
{
    /* 360 deg may come out a rounding above 2 pi. */
    if (*value > range.high && *value <= range.high * (1 + 1e-12))
        *value = range.high;
    return (range.low_out ? *value > range.low : *value >= range.low) &&
           (range.high_out ? *value < range.high : *value <= range.high);
}

#ifndef NDEBUG
/* Whether the table's words for an absent key mean this value. Asserted wherever a key is absent, so that the table
 * cannot say anything else than what is so. */
static bool is_standard(const sp_fields *in, const sp_key *key, double value)
{
    double standard = 0;
    char why[TEXT];
    for (const char *const *word = key->words; word && key->standard && *word; word++)
        if (strcmp(*word, key->standard) == 0)
            return true;
    return !key->standard || (sp_units_read(in->reader->units, key->standard, key->dimension, &standard, why, TEXT) &&
                              fabs(standard - value) <= 1e-12 * fabs(standard));
}

static bool is_standard_vector(const sp_key *key, sp_vec3 value)
{
    sp_vec3 standard;
    return !key->standard || (sscanf(key->standard, "[%lf, %lf, %lf]", &standard.x, &standard.y, &standard.z) == 3 &&
                              value.x == standard.x && value.y == standard.y && value.z == standard.z);
}
#endif

bool sp_read_quantity_at(const sp_reader *reader, const sp_yaml *node, const sp_key *key, double *value)
{
    char expected[SP_KEY_FORM], why[TEXT] = "";
    sp_quantity_form(key, expected);
    if (node->kind != SP_YAML_SCALAR)
        return sp_read_fail(reader, node, key->name, "%s", expected);
    double read = 0;
    if (!sp_units_read(reader->units, node->text, key->dimension, &read, why, sizeof why))
        return sp_read_fail(reader, node, key->name, why[0] ? "%s (%s)" : "%s%s", expected, why);
    if (!in_range(key->range, &read))
        return sp_read_fail(reader, node, key->name, "%s", expected);
    *value = read;
    return true;
}

bool sp_read_quantity(const sp_fields *in, const char *name, double *value)
{
    const sp_key *key = sp_key_of(in->block, name);
    const sp_yaml *node = sp_yaml_get(in->map, name);
    assert(key->kind == SP_KEY_QUANTITY || key->kind == SP_KEY_QUANTITIES);
    assert(node || is_standard(in, key, *value));
    return !node || sp_read_quantity_at(in->reader, node, key, value);
}

bool sp_read_step(const sp_fields *in, const char *name, sp_step *step)
{
    const sp_yaml *node = sp_yaml_get(in->map, name);
    double size;
    char why[TEXT];
    if (!node)
        return true;
    const sp_key *key = sp_key_of(in->block, name);
    if (!sp_read_quantity_at(in->reader, node, key, &size))
        return false;
    step->count = strtod(node->text, NULL);
    return sp_units_of(in->reader->units, node->text, key->dimension, &step->unit, why, sizeof why);
}

/* Three values, each as `key` says. */
static bool read_three(const sp_reader *reader, const sp_yaml *node, const sp_key *key, sp_vec3 *value)
{
    if (node->kind != SP_YAML_LIST || node->count != 3)
        return sp_read_fail(reader, node, key->name, "a list of three values such as [0, 0, 1]");
    double v[3];
    const sp_yaml *child = node->first;
    for (int i = 0; i < 3; i++, child = child->next)
        if (!sp_read_quantity_at(reader, child, key, &v[i]))
            return false;
    *value = sp_v(v[0], v[1], v[2]);
    return true;
}

bool sp_read_vector(const sp_fields *in, const char *name, sp_vec3 *value)
{
    const sp_key *key = sp_key_of(in->block, name);
    const sp_yaml *node = sp_yaml_get(in->map, name);
    const sp_key each = {.name = name, .dimension = key->dimension, .range = SP_ANY};
    assert(key->kind == SP_KEY_VECTOR && (node || is_standard_vector(key, *value)));
    if (node && !read_three(in->reader, node, &each, value))
        return false;
    /* of what lies farther away double precision holds no distance */
    return sp_coordinates_allowed(*value) ||
           sp_read_message(in->reader, node, name, "found a coordinate beyond 1e30 m, expected less");
}

bool sp_read_axis(const sp_fields *in, const char *name, sp_vec3 *value)
{
    const sp_yaml *node = sp_yaml_get(in->map, name);
    const sp_key each = {.name = name, .dimension = &sp_ratio_unit, .range = SP_ANY};
    sp_vec3 read = *value;
    assert(sp_key_of(in->block, name)->kind == SP_KEY_DIRECTION);
    assert(node || is_standard_vector(sp_key_of(in->block, name), *value));
    if (!node)
        return true;
    if (!read_three(in->reader, node, &each, &read))
        return false;
    double largest = fmax(fabs(read.x), fmax(fabs(read.y), fabs(read.z)));
    if (!(largest > 0))
        return sp_read_message(in->reader, node, name,
                               "found a vector of length 0, expected a direction such as [0, 0, -1]");
    if (fabs(sp_dot(read, read) - 1) > 1e-14)
        read = sp_unit(sp_v(read.x / largest, read.y / largest, read.z / largest));
    *value = read;
    return true;
}

const char *sp_read_text(const sp_reader *reader, const sp_yaml *node, const char *key, const char *expected)
{
    if (node->kind == SP_YAML_SCALAR && node->text[0])
        return node->text;
    sp_read_fail(reader, node, key, "%s", expected);
    return NULL;
}

bool sp_text_is(const sp_yaml *node, const char *text)
{
    return node && node->kind == SP_YAML_SCALAR && strcmp(node->text, text) == 0;
}

bool sp_read_name(const sp_fields *in, const char *key, char name[SP_NAME])
{
    const sp_yaml *node = sp_yaml_get(in->map, key);
    assert(sp_key_of(in->block, key)->kind == SP_KEY_TEXT);
    if (!node)
        return true;
    const char *text = sp_read_text(in->reader, node, key, "a name");
    if (!text)
        return false;
    if (strlen(text) >= SP_NAME)
        return sp_read_fail(in->reader, node, key, "a name of at most %d bytes", SP_NAME - 1);
    for (const char *c = text; *c; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f)
            return sp_read_message(in->reader, node, key,
                                   "found a name with a control character, expected printable text");
    snprintf(name, SP_NAME, "%s", text);
    return true;
}

bool sp_read_count(const sp_fields *in, const char *name, uint64_t *value)
{
    const sp_key *key = sp_key_of(in->block, name);
    const sp_yaml *node = sp_yaml_get(in->map, name);
    assert(key->kind == SP_KEY_COUNT);
    assert(node || key->words || !key->standard || strtoull(key->standard, NULL, 10) == *value);
    if (!node)
        return true;
    bool digits = node->kind == SP_YAML_SCALAR && node->text[0] && !node->text[strspn(node->text, "0123456789")];
    errno = 0;
    unsigned long long read = digits ? strtoull(node->text, NULL, 10) : 0;
    uint64_t low = (uint64_t)key->range.low, high = isfinite(key->range.high) ? (uint64_t)key->range.high : UINT64_MAX;
    if (!digits || errno || read < low || read > high)
        return sp_read_fail(in->reader, node, name, "a whole number from %llu to %llu", (unsigned long long)low,
                            (unsigned long long)high);
    *value = read;
    return true;
}

bool sp_read_flag(const sp_fields *in, const char *name, bool *value)
{
    const sp_yaml *node = sp_yaml_get(in->map, name);
    assert(sp_key_of(in->block, name)->kind == SP_KEY_FLAG);
    assert(node || strcmp(sp_key_of(in->block, name)->standard, *value ? "true" : "false") == 0);
    if (!node)
        return true;
    if (!sp_text_is(node, "true") && !sp_text_is(node, "false"))
        return sp_read_fail(in->reader, node, name, "true or false");
    *value = sp_text_is(node, "true");
    return true;
}

bool sp_read_choice(const sp_fields *in, const char *name, int *value)
{
    const sp_key *key = sp_key_of(in->block, name);
    const sp_yaml *node = sp_yaml_get(in->map, name);
    char words[SP_KEY_FORM];
    assert(key->kind == SP_KEY_CHOICE);
    assert(node || !key->standard || strcmp(key->standard, key->words[*value]) == 0);
    if (!node)
        return true;
    for (int i = 0; key->words[i]; i++)
        if (sp_text_is(node, key->words[i])) {
            *value = i;
            return true;
        }
    sp_words_form(key->words, words);
    return sp_read_fail(in->reader, node, name, "%s", words);
}
