#include "scene/read.h"

#include "scene/slips.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TEXT = 400 };

const sp_dimension sp_length_unit = {"a length", "m", "250 mm", true};
const sp_dimension sp_angle_unit = {"an angle", "rad", "30 deg", false};
const sp_dimension sp_ratio_unit = {"a number without unit", "1", "0.5", true};
const sp_dimension sp_share_unit = {"a share", "1", "95 %", true};
const sp_dimension sp_pressure_unit = {"a pressure", "Pa", "2 bar", false};
const sp_dimension sp_flow_unit = {"a flow", "m3/s", "12 L/min", false};
const sp_dimension sp_width_flow_unit = {"a flow per width", "m2/s", "10 L/min/m", false};
const sp_dimension sp_dose_unit = {"a dose", "m3/m2", "2 L/m2", false};
const sp_dimension sp_flux_unit = {"a flux", "m3/s/m2", "1 L/min/m2", false};
const sp_dimension sp_speed_unit = {"a speed", "m/s", "1 m/s", false};
const sp_dimension sp_density_unit = {"a density", "kg/m3", "1000 kg/m3", false};
const sp_dimension sp_viscosity_unit = {"a viscosity", "Pa.s", "1 mPa.s", false};
const sp_dimension sp_tension_unit = {"a surface tension", "N/m", "72 mN/m", false};
const sp_dimension sp_acceleration_unit = {"an acceleration", "m/s2", "9.81 m/s2", false};
const sp_dimension sp_turning_unit = {"a speed of rotation", "rad/s", "3 rpm", false};

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

static bool fail_unknown(const sp_reader *reader, const sp_yaml *child, const char *what, const sp_key *keys)
{
    char text[TEXT] = "";
    size_t least = SIZE_MAX;
    for (const sp_key *key = keys; key->name; key++) {
        size_t slips = sp_text_slips(child->key, key->name);
        if (slips < least)
            snprintf(text, sizeof text, "'%s'", key->name);
        least = slips < least ? slips : least;
    }
    for (const sp_key *key = keys; key->name && least == SIZE_MAX; key++) {
        append(text, text[0] ? ", " : keys[1].name ? "one of " : "");
        append(text, key->name);
    }
    return sp_fail(reader->error, SP_ERROR_INPUT, child->file, child->key_line, child->key_column,
                   "%.80s: found a key that %s does not have, expected %s", child->key, what, text);
}

static bool check_child(const sp_reader *reader, const sp_yaml *map, const sp_yaml *child, const char *what,
                        const sp_key *keys)
{
    const sp_key *key = keys;
    while (key->name && strcmp(key->name, child->key) != 0)
        key++;
    if (!key->name)
        return fail_unknown(reader, child, what, keys);
    const sp_yaml *first = sp_yaml_get(map, child->key);
    return first == child || sp_fail(reader->error, SP_ERROR_INPUT, child->file, child->key_line, child->key_column,
                                     "%s: found a second time, expected once", child->key);
}

bool sp_read_keys(const sp_reader *reader, const sp_yaml *node, const char *key, const char *what, const sp_key *keys)
{
    bool nothing = node->kind == SP_YAML_SCALAR && node->empty;
    if (node->kind != SP_YAML_MAP && !nothing)
        return sp_read_fail(reader, node, key, "the keys of %s", what);
    for (const sp_yaml *child = node->first; child; child = child->next)
        if (!check_child(reader, node, child, what, keys))
            return false;
    for (const sp_key *wanted = keys; wanted->name; wanted++)
        if (wanted->required && !sp_yaml_get(node, wanted->name))
            return sp_read_message(reader, node, wanted->name, "found nothing, expected this key in %s", what);
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

/* "a pressure above 0 such as 2 bar" */
static void describe_expected(const sp_dimension *dimension, sp_range range, char text[TEXT])
{
    bool angle = dimension == &sp_angle_unit;
    double scale = angle ? 180 / acos(-1) : 1;
    const char *unit = angle ? " deg" : "";
    char limits[80] = "";
    if (isfinite(range.low) && isfinite(range.high))
        snprintf(limits, sizeof limits, " %s %g to %s%g%s", range.low_out ? "above" : "from", range.low * scale,
                 range.high_out ? "below " : "", range.high * scale, unit);
    else if (isfinite(range.low))
        snprintf(limits, sizeof limits, range.low_out ? " above %g%s" : " of at least %g%s", range.low * scale, unit);
    snprintf(text, TEXT, "%s%s such as %s", dimension->name, limits, dimension->example);
}

bool sp_read_quantity_at(const sp_reader *reader, const sp_yaml *node, const char *key, const sp_dimension *dimension,
                         sp_range range, double *value)
{
    char expected[TEXT], why[TEXT] = "";
    describe_expected(dimension, range, expected);
    if (node->kind != SP_YAML_SCALAR)
        return sp_read_fail(reader, node, key, "%s", expected);
    double read = 0;
    if (!sp_units_read(reader->units, node->text, dimension, &read, why, sizeof why))
        return sp_read_fail(reader, node, key, why[0] ? "%s (%s)" : "%s%s", expected, why);
    if (!in_range(range, &read))
        return sp_read_fail(reader, node, key, "%s", expected);
    *value = read;
    return true;
}

bool sp_read_quantity(const sp_reader *reader, const sp_yaml *map, const char *key, const sp_dimension *dimension,
                      sp_range range, double *value)
{
    const sp_yaml *node = sp_yaml_get(map, key);
    return !node || sp_read_quantity_at(reader, node, key, dimension, range, value);
}

bool sp_read_step(const sp_reader *reader, const sp_yaml *map, const char *key, const sp_dimension *dimension,
                  double least, sp_step *step)
{
    const sp_yaml *node = sp_yaml_get(map, key);
    double size;
    char why[TEXT];
    if (!node)
        return true;
    if (!sp_read_quantity_at(reader, node, key, dimension, sp_from(least), &size))
        return false;
    step->count = strtod(node->text, NULL);
    return sp_units_of(reader->units, node->text, dimension, &step->unit, why, sizeof why);
}

bool sp_read_vector(const sp_reader *reader, const sp_yaml *map, const char *key, const sp_dimension *dimension,
                    sp_vec3 *value)
{
    const sp_yaml *node = sp_yaml_get(map, key);
    if (!node)
        return true;
    if (node->kind != SP_YAML_LIST || node->count != 3)
        return sp_read_fail(reader, node, key, "a list of three values such as [0, 0, 1]");
    double v[3];
    const sp_yaml *child = node->first;
    for (int i = 0; i < 3; i++, child = child->next)
        if (!sp_read_quantity_at(reader, child, key, dimension, sp_any(), &v[i]))
            return false;
    *value = sp_v(v[0], v[1], v[2]);
    return true;
}

bool sp_read_axis(const sp_reader *reader, const sp_yaml *map, const char *key, sp_vec3 *value)
{
    sp_vec3 read = *value;
    if (!sp_yaml_get(map, key))
        return true;
    if (!sp_read_vector(reader, map, key, &sp_ratio_unit, &read))
        return false;
    double largest = fmax(fabs(read.x), fmax(fabs(read.y), fabs(read.z)));
    if (!(largest > 0))
        return sp_read_message(reader, sp_yaml_get(map, key), key,
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

bool sp_read_name(const sp_reader *reader, const sp_yaml *map, const char *key, char name[SP_NAME])
{
    const sp_yaml *node = sp_yaml_get(map, key);
    if (!node)
        return true;
    const char *text = sp_read_text(reader, node, key, "a name");
    if (!text)
        return false;
    if (strlen(text) >= SP_NAME)
        return sp_read_fail(reader, node, key, "a name of at most %d bytes", SP_NAME - 1);
    for (const char *c = text; *c; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f)
            return sp_read_message(reader, node, key, "found a name with a control character, expected printable text");
    snprintf(name, SP_NAME, "%s", text);
    return true;
}

bool sp_read_count(const sp_reader *reader, const sp_yaml *map, const char *key, uint64_t low, uint64_t high,
                   uint64_t *value)
{
    const sp_yaml *node = sp_yaml_get(map, key);
    if (!node)
        return true;
    bool digits = node->kind == SP_YAML_SCALAR && node->text[0] && !node->text[strspn(node->text, "0123456789")];
    errno = 0;
    unsigned long long read = digits ? strtoull(node->text, NULL, 10) : 0;
    if (!digits || errno || read < low || read > high)
        return sp_read_fail(reader, node, key, "a whole number from %llu to %llu", (unsigned long long)low,
                            (unsigned long long)high);
    *value = read;
    return true;
}

bool sp_read_flag(const sp_reader *reader, const sp_yaml *map, const char *key, bool *value)
{
    const sp_yaml *node = sp_yaml_get(map, key);
    if (!node)
        return true;
    if (!sp_text_is(node, "true") && !sp_text_is(node, "false"))
        return sp_read_fail(reader, node, key, "true or false");
    *value = sp_text_is(node, "true");
    return true;
}

bool sp_read_choice(const sp_reader *reader, const sp_yaml *map, const char *key, const char *const *choices,
                    int *value)
{
    const sp_yaml *node = sp_yaml_get(map, key);
    if (!node)
        return true;
    char text[TEXT] = "";
    for (int i = 0; choices[i]; i++) {
        if (sp_text_is(node, choices[i])) {
            *value = i;
            return true;
        }
        append(text, !text[0] ? "" : choices[i + 1] ? ", " : " or ");
        append(text, choices[i]);
    }
    return sp_read_fail(reader, node, key, "%s", text);
}
