/* JSON Schema of scenes, catalogues and results, for editors that check and complete. */
#include "keys/blocks.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* jansson's functions that set and append take what they are given, NULL as well, which fails. */
static bool set(json_t *object, const char *key, json_t *value)
{
    return json_object_set_new(object, key, value) == 0;
}

static json_t *of_type(const char *type)
{
    return json_pack("{s:s}", "type", type);
}

static json_t *list_of(json_t *items)
{
    return json_pack("{s:s, s:o}", "type", "array", "items", items);
}

static json_t *list_of_so_many(json_t *items, int count)
{
    return json_pack("{s:s, s:o, s:i, s:i}", "type", "array", "items", items, "minItems", count, "maxItems", count);
}

static json_t *block_reference(const sp_block *block)
{
    return json_pack("{s:s+}", "$ref", "#/$defs/", block->name);
}

static json_t *either(json_t *a, json_t *b)
{
    return json_pack("{s:[o, o]}", "anyOf", a, b);
}

/* A text with a number in front and, unless a number will do alone, a unit behind. */
static json_t *quantity(const sp_dimension *dimension)
{
    static const char *const number = "^[-+]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][-+]?[0-9]+)? *";
    bool bare = dimension->bare;
    json_t *text = json_pack("{s:s, s:s+, s:[s]}", "type", "string", "pattern", number, bare ? "" : "[^0-9 .].*$",
                             "examples", dimension->example);
    return bare ? either(of_type("number"), text) : text;
}

static json_t *whole_number(sp_range range)
{
    json_t *schema = of_type("integer");
    bool done = !isfinite(range.low) || set(schema, "minimum", json_integer((json_int_t)range.low));
    done = done && (!(range.high < 9e18) || set(schema, "maximum", json_integer((json_int_t)range.high)));
    if (done)
        return schema;
    json_decref(schema);
    return NULL;
}

/* `other`, where it is not NULL, is a choice too. */
static json_t *choice(const char *const *words, json_t *other)
{
    json_t *list = json_array();
    bool done = list != NULL;
    for (int i = 0; done && words[i]; i++)
        done = json_array_append_new(list, json_string(words[i])) == 0;
    json_t *schema = json_pack("{s:o}", "enum", list);
    return other ? either(schema, other) : schema;
}

static json_t *plain_value(const sp_key *key)
{
    switch (key->kind) {
    case SP_KEY_QUANTITY:
        return quantity(key->dimension);
    case SP_KEY_QUANTITIES:
        return either(quantity(key->dimension), list_of(quantity(key->dimension)));
    case SP_KEY_LIMITS:
        return list_of_so_many(quantity(key->dimension), 2);
    case SP_KEY_VECTOR:
        return list_of_so_many(quantity(key->dimension), 3);
    case SP_KEY_DIRECTION:
        return list_of_so_many(quantity(&sp_ratio_unit), 3);
    case SP_KEY_COUNT:
        return whole_number(key->range);
    case SP_KEY_COUNTS:
        return list_of_so_many(whole_number(key->range), 2);
    case SP_KEY_FLAG:
        return of_type("boolean");
    case SP_KEY_TEXTS:
        return list_of(of_type("string"));
    case SP_KEY_BLOCK:
        return block_reference(key->block);
    case SP_KEY_BLOCKS:
        return list_of(block_reference(key->block));
    case SP_KEY_NAMED_BLOCKS:
        return list_of(either(of_type("string"), block_reference(key->block)));
    case SP_KEY_NUMBER:
        return of_type("number");
    case SP_KEY_NUMBERS:
        return list_of(of_type("number"));
    default:
        return of_type("string");
    }
}

static json_t *value_of(const sp_key *key)
{
    char text[2000];
    json_t *schema = key->kind == SP_KEY_CHOICE ? choice(key->words, NULL) : plain_value(key);
    if (key->words && key->kind != SP_KEY_CHOICE)
        schema = choice(key->words, schema);
    const char *absent = key->standard ? key->standard : key->absent;
    snprintf(text, sizeof text, "%s.%s%s%s", key->says, absent ? " Default: " : "", absent ? absent : "",
             absent ? "." : "");
    if (schema && set(schema, "description", json_string(text)))
        return schema;
    json_decref(schema);
    return NULL;
}

/* A mount has just one of its keys. */
static bool add_limits(json_t *schema, const sp_block *block)
{
    return block != &sp_block_mount ||
           (set(schema, "minProperties", json_integer(1)) && set(schema, "maxProperties", json_integer(1)));
}

static bool add_block(json_t *blocks, const sp_block *block)
{
    if (json_object_get(blocks, block->name))
        return true;
    json_t *properties = json_object(), *required = json_array();
    json_t *schema = json_pack("{s:s, s:b, s:o, s:o}", "type", "object", "additionalProperties", false, "properties",
                               properties, "required", required);
    bool done = set(blocks, block->name, schema) && add_limits(schema, block);
    for (const sp_key *key = block->keys; done && key->name; key++)
        done = set(properties, key->name, value_of(key)) &&
               (!key->required || json_array_append_new(required, json_string(key->name)) == 0) &&
               (!key->block || add_block(blocks, key->block));
    return done;
}

char *sp_topic_schema(sp_topic topic, sp_error *error)
{
    const sp_block *block = topic >= SP_TOPIC_FILES ? NULL : sp_topic_block(topic);
    if (!block) {
        sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "there are schemas of scenes, catalogues and results alone");
        return NULL;
    }
    json_t *blocks = json_object();
    bool done = add_block(blocks, block);
    json_t *root = json_pack("{s:s, s:s+, s:s+, s:o}", "$schema", "https://json-schema.org/draft/2020-12/schema",
                             "title", "sprayplan: ", block->what, "$ref", "#/$defs/", block->name, "$defs", blocks);
    char *text = done && root ? json_dumps(root, JSON_INDENT(1)) : NULL;
    size_t size = text ? strlen(text) : 0;
    json_decref(root);
    char *ended = text ? realloc(text, size + 2) : NULL;
    if (!ended) {
        free(text);
        return sp_fail_memory(error);
    }
    memcpy(ended + size, "\n", 2);
    return ended;
}
