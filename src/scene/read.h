/* Typed reading of a YAML tree: each function checks one thing and reports what was found and what was expected. */
#ifndef SCENE_READ_H
#define SCENE_READ_H

#include "scene/units.h"
#include "scene/yaml.h"

#include <sprayplan/nozzle.h>

#include <stdint.h>

typedef struct {
    const sp_units *units;
    sp_error *error;
} sp_reader;

typedef struct {
    const char *name; /* NULL ends a list of keys */
    bool required;
} sp_key;

/* The values allowed, in SI. */
typedef struct {
    double low, high;
    bool low_out, high_out; /* the ends themselves are not allowed */
} sp_range;

static inline sp_range sp_any(void)
{
    return (sp_range){-INFINITY, INFINITY, false, false};
}
static inline sp_range sp_from(double low)
{
    return (sp_range){low, INFINITY, false, false};
}
static inline sp_range sp_above(double low)
{
    return (sp_range){low, INFINITY, true, false};
}
static inline sp_range sp_between(double low, double high)
{
    return (sp_range){low, high, false, false};
}
static inline sp_range sp_above_to(double low, double high)
{
    return (sp_range){low, high, true, false};
}
static inline sp_range sp_from_below(double low, double high)
{
    return (sp_range){low, high, false, true};
}

extern const sp_dimension sp_length_unit, sp_angle_unit, sp_ratio_unit, sp_share_unit, sp_pressure_unit, sp_flow_unit,
    sp_flux_unit, sp_width_flow_unit, sp_dose_unit, sp_speed_unit, sp_density_unit, sp_viscosity_unit, sp_tension_unit,
    sp_acceleration_unit, sp_turning_unit;

/* "key: found WHAT STANDS AT node, expected ..." at the node's place. False always. */
bool sp_read_fail(const sp_reader *reader, const sp_yaml *node, const char *key, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* A free message, "key: message" at the node's place. */
bool sp_read_message(const sp_reader *reader, const sp_yaml *node, const char *key, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* The node is a map (or nothing, if no key is required) with none but these keys, each once, none required missing.
 * `key` names it in errors, `what` says what it describes ("a nozzle"). */
bool sp_read_keys(const sp_reader *reader, const sp_yaml *node, const char *key, const char *what, const sp_key *keys);
bool sp_read_is_list(const sp_reader *reader, const sp_yaml *node, const char *key, const char *of);

/* The following leave *value as it is, and succeed, where the map has no such key. */
bool sp_read_quantity(const sp_reader *reader, const sp_yaml *map, const char *key, const sp_dimension *dimension,
                      sp_range range, double *value);
bool sp_read_quantity_at(const sp_reader *reader, const sp_yaml *node, const char *key, const sp_dimension *dimension,
                         sp_range range, double *value);
/* How far apart settings lie, at least `least` in SI. */
bool sp_read_step(const sp_reader *reader, const sp_yaml *map, const char *key, const sp_dimension *dimension,
                  double least, sp_step *step);
bool sp_read_vector(const sp_reader *reader, const sp_yaml *map, const char *key, const sp_dimension *dimension,
                    sp_vec3 *value);
/* Any length but 0; made a unit vector. One that is a unit vector already to the last digits stays as it is. */
bool sp_read_axis(const sp_reader *reader, const sp_yaml *map, const char *key, sp_vec3 *value);
bool sp_read_name(const sp_reader *reader, const sp_yaml *map, const char *key, char name[SP_NAME]);
bool sp_read_count(const sp_reader *reader, const sp_yaml *map, const char *key, uint64_t low, uint64_t high,
                   uint64_t *value);
bool sp_read_flag(const sp_reader *reader, const sp_yaml *map, const char *key, bool *value);
/* `choices` ends with NULL; *value is the index of the one found. */
bool sp_read_choice(const sp_reader *reader, const sp_yaml *map, const char *key, const char *const *choices,
                    int *value);

/* Text of a scalar, NULL with an error for anything else. */
const char *sp_read_text(const sp_reader *reader, const sp_yaml *node, const char *key, const char *expected);
bool sp_text_is(const sp_yaml *node, const char *text);

#endif
