/* Whether what the program prints is what its help tells of it. */
#ifndef CLI_EXPLAINED_H
#define CLI_EXPLAINED_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <sprayplan/keys.h>

#include <jansson.h>
#include <string.h>

static inline bool is_word(const json_t *value, const char *const *words)
{
    const char *text = json_string_value(value);
    for (; text && *words; words++)
        if (!strcmp(text, *words))
            return true;
    return false;
}

static inline bool are_numbers(const json_t *list)
{
    for (size_t i = 0; i < json_array_size(list); i++)
        if (!json_is_number(json_array_get(list, i)) && !are_numbers(json_array_get(list, i)))
            return false;
    return json_is_array(list);
}

/* Or null, where it says so. */
static inline bool is_null_for(const sp_key *key, const json_t *value)
{
    return json_is_null(value) && strstr(key->says, "null ");
}

static inline bool is_of_kind(const sp_key *key, const json_t *value)
{
    if (is_null_for(key, value))
        return true;
    if (key->words && is_word(value, key->words))
        return true;
    switch (key->kind) {
    case SP_KEY_NUMBER:
        return json_is_number(value);
    case SP_KEY_NUMBERS:
        return are_numbers(value);
    case SP_KEY_COUNT:
        return json_is_integer(value);
    case SP_KEY_FLAG:
        return json_is_boolean(value);
    case SP_KEY_CHOICE:
        return false; /* none of its words */
    case SP_KEY_BLOCK:
        return json_is_object(value);
    case SP_KEY_BLOCKS:
    case SP_KEY_TEXTS:
        return json_is_array(value);
    default:
        return json_is_string(value);
    }
}

/* Nothing is there but what `sprayplan help` says of the topic, where it says it. */
static inline void require_explained(const sp_block *block, json_t *object)
{
    const char *name;
    json_t *value;
    json_object_foreach(object, name, value)
    {
        const sp_key *key = block->keys;
        while (key->name && strcmp(key->name, name))
            key++;
        if (!key->name || !is_of_kind(key, value))
            fail_msg("%s of %s is not as explained", name, block->what);
        if (key->kind == SP_KEY_BLOCK && !json_is_null(value))
            require_explained(key->block, value);
        for (size_t i = 0; key->kind == SP_KEY_BLOCKS && i < json_array_size(value); i++) {
            json_t *entry = json_array_get(value, i);
            assert_true(json_is_object(entry) || is_null_for(key, entry));
            if (json_is_object(entry))
                require_explained(key->block, entry);
        }
    }
}

/* A result, or what another command prints with --json. */
static inline void require_output_explained(json_t *object)
{
    const char *command = json_string_value(json_object_get(object, "command"));
    if (json_object_get(object, "layouts"))
        require_explained(sp_topic_block(SP_TOPIC_RESULT), object);
    for (const sp_key *key = sp_topic_block(SP_TOPIC_OUTPUTS)->keys; command && key->name; key++)
        if (!strcmp(key->name, command))
            require_explained(key->block, object);
}

#endif
