/* Typed reading of a YAML tree: each function checks one thing and reports what was found and what was expected. */
#ifndef SCENE_READ_H
#define SCENE_READ_H

#include "keys/blocks.h"
#include "scene/units.h"
#include "scene/yaml.h"

#include <sprayplan/nozzle.h>

#include <stdint.h>

typedef struct {
    const sp_units *units;
    sp_error *error;
} sp_reader;

/* A map of a scene or catalogue, and the keys that it may have. */
typedef struct {
    const sp_reader *reader;
    const sp_block *block;
    const sp_yaml *map;
} sp_fields;

/* "key: found WHAT STANDS AT node, expected ..." at the node's place. False always. */
bool sp_read_fail(const sp_reader *reader, const sp_yaml *node, const char *key, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* A free message, "key: message" at the node's place. */
bool sp_read_message(const sp_reader *reader, const sp_yaml *node, const char *key, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* The map (or nothing, if no key is required) has none but the block's keys, each once, none required missing. `key`
 * names it in errors. */
bool sp_read_block(const sp_fields *in, const char *key);
bool sp_read_is_list(const sp_reader *reader, const sp_yaml *node, const char *key, const char *of);

/* The following read what the block says of the key. They leave *value, which holds what is so without the key, as it
 * is, and succeed, where the map has no such key. */
bool sp_read_quantity(const sp_fields *in, const char *key, double *value);
/* Of a list of quantities. */
bool sp_read_quantity_at(const sp_reader *reader, const sp_yaml *node, const sp_key *key, double *value);
/* How far apart settings lie. */
bool sp_read_step(const sp_fields *in, const char *key, sp_step *step);
bool sp_read_vector(const sp_fields *in, const char *key, sp_vec3 *value);
/* Any length but 0; made a unit vector. One that is a unit vector already to the last digits stays as it is. */
bool sp_read_axis(const sp_fields *in, const char *key, sp_vec3 *value);
bool sp_read_name(const sp_fields *in, const char *key, char name[SP_NAME]);
bool sp_read_count(const sp_fields *in, const char *key, uint64_t *value);
bool sp_read_flag(const sp_fields *in, const char *key, bool *value);
/* *value is the index of the word found. */
bool sp_read_choice(const sp_fields *in, const char *key, int *value);

/* Text of a scalar, NULL with an error for anything else. */
const char *sp_read_text(const sp_reader *reader, const sp_yaml *node, const char *key, const char *expected);
bool sp_text_is(const sp_yaml *node, const char *text);

#endif
