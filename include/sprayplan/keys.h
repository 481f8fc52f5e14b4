/* What scenes, catalogues and results hold, key by key: the tables that scenes and catalogues are read by, and that
 * help, manual pages and schemas are made from. All of it is constant. */
#ifndef SPRAYPLAN_KEYS_H
#define SPRAYPLAN_KEYS_H

#include <sprayplan/error.h>
#include <sprayplan/export.h>

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What a value measures. */
typedef struct {
    const char *name;    /* "a pressure" */
    const char *unit;    /* SI, as udunits writes it: "Pa"; "1" without dimension, "rad" for angles */
    const char *example; /* "2 bar" */
    bool bare;           /* a number alone is in that unit */
} sp_dimension;

/* The values allowed, in SI. */
typedef struct {
    double low, high;
    bool low_out, high_out; /* the ends themselves are not allowed */
} sp_range;

typedef enum {
    SP_KEY_QUANTITY,   /* a number with a unit of `dimension`, within `range` */
    SP_KEY_QUANTITIES, /* one, or a list of them */
    SP_KEY_LIMITS,     /* a list of two, the smaller first */
    SP_KEY_VECTOR,     /* a list of three, of `dimension` */
    SP_KEY_DIRECTION,  /* a list of three numbers, of any length but 0 */
    SP_KEY_COUNT,      /* a whole number within `range` */
    SP_KEY_COUNTS,     /* a list of two */
    SP_KEY_FLAG,       /* true or false */
    SP_KEY_CHOICE,     /* one of `words` */
    SP_KEY_TEXT,
    SP_KEY_TEXTS,        /* a list of texts */
    SP_KEY_BLOCK,        /* the keys of `block` */
    SP_KEY_BLOCKS,       /* a list of these */
    SP_KEY_NAMED_BLOCKS, /* a list of these, or of texts in their place */
    SP_KEY_NUMBER,       /* of results: in the unit that the key's name ends in, a share where it has none */
    SP_KEY_NUMBERS,      /* a list of these */
    SP_KEY_FILE          /* of a name; `block` is what stands in it, or NULL */
} sp_key_kind;

typedef struct sp_block sp_block;

typedef struct {
    const char *name; /* NULL ends a list of keys */
    sp_key_kind kind;
    bool required;
    const sp_dimension *dimension; /* NULL where the kind has none */
    sp_range range;
    const char *const *words; /* of a choice, NULL at the end; of another kind what may stand in its place; or NULL */
    const sp_block *block;
    const char *standard; /* what an absent key means, as a scene would write it; NULL: see `absent` */
    const char *absent;   /* the same in words, or NULL */
    const char *says;     /* what it is: sentences without the last full stop */
} sp_key;

struct sp_block {
    const char *name; /* "port" */
    const char *what; /* "a port" */
    const char *says; /* or NULL */
    const sp_key *keys;
};

typedef enum { SP_TOPIC_SCENE, SP_TOPIC_CATALOGUE, SP_TOPIC_RESULT, SP_TOPIC_FILES, SP_TOPIC_OUTPUTS } sp_topic;

/* The outermost block of a scene file, a catalogue, result.json; or of the files that are written, whose keys are names
 * of files and what stands in them, or of what other commands print with --json, whose keys are names of these. NULL
 * for no topic. */
SP_API const sp_block *sp_topic_block(sp_topic topic);

enum { SP_KEY_FORM = 400 }; /* bytes, the terminating zero included */
/* What a value of that key looks like, in words: "a pressure above 0 such as 2 bar, or a list of them". */
SP_API void sp_key_form(const sp_key *key, char form[SP_KEY_FORM]);

/* A JSON Schema (draft 2020-12) of a scene, a catalogue or a result, for editors; it ends with a newline. Malloc'd;
 * NULL of other topics, and where memory runs out. */
SP_API char *sp_topic_schema(sp_topic topic, sp_error *error);

#ifdef __cplusplus
}
#endif

#endif
