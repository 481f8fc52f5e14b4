/* Values out of a JSON file that may come from a stranger: each is checked, and what is wrong with one is reported with
 * its place. All are false then, with the error set. */
#ifndef RESULT_JSON_READ_H
#define RESULT_JSON_READ_H

#include <sprayplan/error.h>
#include <sprayplan/vector.h>

#include <jansson.h>
#include <stdbool.h>

/* Where in the file we are, for errors. */
typedef struct {
    const char *file;
    sp_error *error;
    char place[128]; /* "layouts[2].nozzles[0]." */
} sp_json_reader;

/* The error that `found`, NULL for nothing, is not what was expected under `key`; false. */
bool sp_json_wrong(const sp_json_reader *in, const char *key, const json_t *found, const char *expected);
/* A number in [minimum, maximum] times `unit`; NAN where absent. */
bool sp_json_real(const sp_json_reader *in, const json_t *object, const char *key, double minimum, double maximum,
                  double unit, double *value);
/* SP_UNKNOWN where absent. */
bool sp_json_count(const sp_json_reader *in, const json_t *object, const char *key, size_t *value);
/* False where absent. */
bool sp_json_flag(const sp_json_reader *in, const json_t *object, const char *key, bool *value);
/* Malloc'd; "" where absent. */
bool sp_json_text(const sp_json_reader *in, const json_t *object, const char *key, char **value);
/* One of the words, the last of which may be NULL; "" where absent. */
bool sp_json_choice(const sp_json_reader *in, const json_t *object, const char *key, const char *const choices[3],
                    char value[16]);
/* NAN where absent. */
bool sp_json_vector(const sp_json_reader *in, const json_t *object, const char *key, sp_vec3 *value);
/* The list or object under `key`; absent is no error where it is not required. */
bool sp_json_part(const sp_json_reader *in, const json_t *object, const char *key, json_type type, bool required,
                  const json_t **value);
/* The reader for entry `i` of the list `key`, which must be an object. */
bool sp_json_enter(const sp_json_reader *in, const char *key, size_t i, const json_t *entry, sp_json_reader *inner);

#endif
