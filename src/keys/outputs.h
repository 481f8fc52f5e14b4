/* How the tables of what commands print are written. */
#ifndef KEYS_OUTPUTS_H
#define KEYS_OUTPUTS_H

#include "keys/blocks.h"

/* The keys that every such object begins with. */
#define OUTPUT_HEAD(name_of_command)                                                                                   \
    {.name = "sprayplan", .kind = SP_KEY_TEXT, .says = "The program's version"},                                       \
    {                                                                                                                  \
        .name = "command", .kind = SP_KEY_TEXT, .says = "`" name_of_command "`"                                        \
    }

#define COUNT(key, what)                                                                                               \
    {                                                                                                                  \
        .name = key, .kind = SP_KEY_COUNT, .range = SP_FROM(0), .says = what                                           \
    }
#define NUMBER(key, what)                                                                                              \
    {                                                                                                                  \
        .name = key, .kind = SP_KEY_NUMBER, .says = what                                                               \
    }
#define NUMBERS(key, what)                                                                                             \
    {                                                                                                                  \
        .name = key, .kind = SP_KEY_NUMBERS, .says = what                                                              \
    }
#define FLAG(key, what)                                                                                                \
    {                                                                                                                  \
        .name = key, .kind = SP_KEY_FLAG, .says = what                                                                 \
    }
#define BLOCKS(key, of, what)                                                                                          \
    {                                                                                                                  \
        .name = key, .kind = SP_KEY_BLOCKS, .block = &of, .says = what                                                 \
    }

#endif
