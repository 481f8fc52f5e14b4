#include "json_read.h"

#include "figures.h"
#include "growing_text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *kind_of(const json_t *value)
{
    switch (json_typeof(value)) {
    case JSON_OBJECT:
        return "an object";
    case JSON_ARRAY:
        return "a list";
    case JSON_STRING:
        return "a text";
    case JSON_NULL:
        return "null";
    case JSON_TRUE:
    case JSON_FALSE:
        return "true or false";
    default:
        return "a number";
    }
}

bool sp_json_wrong(const sp_json_reader *in, const char *key, const json_t *found, const char *expected)
{
    if (!found)
        return sp_fail(in->error, SP_ERROR_INPUT, in->file, 0, 0, "%s%s: missing, expected %s", in->place, key,
                       expected);
    if (json_is_number(found))
        return sp_fail(in->error, SP_ERROR_INPUT, in->file, 0, 0, "%s%s: found %.17g, expected %s", in->place, key,
                       json_number_value(found), expected);
    return sp_fail(in->error, SP_ERROR_INPUT, in->file, 0, 0, "%s%s: found %s, expected %s", in->place, key,
                   kind_of(found), expected);
}

bool sp_json_real(const sp_json_reader *in, const json_t *object, const char *key, double minimum, double maximum,
                  double unit, double *value)
{
    const json_t *found = json_object_get(object, key);
    *value = NAN;
    if (!found)
        return true;
    char expected[80];
    snprintf(expected, sizeof expected, "a number from %g to %g", minimum, maximum);
    double number = json_is_number(found) ? json_number_value(found) : NAN;
    if (!(number >= minimum && number <= maximum))
        return sp_json_wrong(in, key, found, expected);
    *value = number * unit;
    return true;
}

bool sp_json_count(const sp_json_reader *in, const json_t *object, const char *key, size_t *value)
{
    const json_t *found = json_object_get(object, key);
    *value = SP_UNKNOWN;
    if (!found)
        return true;
    if (!json_is_integer(found) || json_integer_value(found) < 0)
        return sp_json_wrong(in, key, found, "a whole number, not negative");
    *value = (size_t)json_integer_value(found);
    return true;
}

bool sp_json_flag(const sp_json_reader *in, const json_t *object, const char *key, bool *value)
{
    const json_t *found = json_object_get(object, key);
    *value = found && json_is_true(found);
    return !found || json_is_boolean(found) || sp_json_wrong(in, key, found, "true or false");
}

bool sp_json_text(const sp_json_reader *in, const json_t *object, const char *key, char **value)
{
    const json_t *found = json_object_get(object, key);
    *value = NULL;
    if (found && !json_is_string(found))
        return sp_json_wrong(in, key, found, "a text");
    *value = sp_text_utf8(found ? json_string_value(found) : "");
    return *value || sp_fail_memory(in->error);
}

bool sp_json_choice(const sp_json_reader *in, const json_t *object, const char *key, const char *const choices[3],
                    char value[16])
{
    const json_t *found = json_object_get(object, key);
    const char *text = found && json_is_string(found) ? json_string_value(found) : NULL;
    value[0] = 0;
    if (!found)
        return true;
    for (int i = 0; text && i < 3 && choices[i]; i++)
        if (strcmp(text, choices[i]) == 0) {
            snprintf(value, 16, "%s", text);
            return true;
        }
    char expected[64];
    snprintf(expected, sizeof expected, choices[2] ? "\"%s\", \"%s\" or \"%s\"" : "\"%s\" or \"%s\"", choices[0],
             choices[1], choices[2]);
    return sp_json_wrong(in, key, found, expected);
}

bool sp_json_vector(const sp_json_reader *in, const json_t *object, const char *key, sp_vec3 *value)
{
    const json_t *found = json_object_get(object, key);
    *value = sp_v(NAN, NAN, NAN);
    if (!found)
        return true;
    if (!json_is_array(found) || json_array_size(found) != 3)
        return sp_json_wrong(in, key, found, "a list of three numbers");
    double parts[3];
    for (size_t i = 0; i < 3; ++i) {
        const json_t *part = json_array_get(found, i);
        parts[i] = json_is_number(part) ? json_number_value(part) : NAN;
        if (!isfinite(parts[i]))
            return sp_json_wrong(in, key, part, "a list of three numbers");
    }
    *value = sp_v(parts[0], parts[1], parts[2]);
    return true;
}

bool sp_json_part(const sp_json_reader *in, const json_t *object, const char *key, json_type type, bool required,
                  const json_t **value)
{
    *value = json_object_get(object, key);
    if (!*value ? !required : json_typeof(*value) == type)
        return true;
    return sp_json_wrong(in, key, *value, type == JSON_ARRAY ? "a list" : "an object");
}

bool sp_json_enter(const sp_json_reader *in, const char *key, size_t i, const json_t *entry, sp_json_reader *inner)
{
    *inner = *in;
    size_t used = strlen(in->place);
    snprintf(inner->place + used, sizeof inner->place - used, "%s[%zu]", key, i);
    if (!json_is_object(entry))
        return sp_json_wrong(inner, "", entry, "an object");
    used = strlen(inner->place);
    snprintf(inner->place + used, sizeof inner->place - used, ".");
    return true;
}
