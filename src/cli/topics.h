/* What `sprayplan help` tells besides commands. */
#ifndef CLI_TOPICS_H
#define CLI_TOPICS_H

#include <stdio.h>

typedef struct {
    const char *name;
    const char *summary;
    void (*print)(FILE *to);
} cli_topic;

extern const cli_topic cli_topics[]; /* the last has no name */

#endif
