/* What `sprayplan help` tells besides commands: keys of files, from the tables that these are read by. */
#ifndef CLI_TOPICS_H
#define CLI_TOPICS_H

#include <sprayplan/keys.h>

#include <stdio.h>

typedef struct {
    const char *name;
    const char *summary;
    sp_topic topic;
} cli_topic;

extern const cli_topic cli_topics[]; /* the last has no name */

/* NULL where none is called that. */
const cli_topic *cli_topic_named(const char *name);

/* How a topic is written: its blocks from the outermost on, each once, and after each block its keys. */
typedef struct {
    /* `path`: where in the file it stands, "place.mounts[].port"; NULL of the outermost. */
    void (*block)(FILE *to, const char *path, const sp_block *block);
    /* `form`: what it may be and what is so without it; `text`: what it means. */
    void (*key)(FILE *to, const char *name, const char *form, const char *text);
} cli_topic_style;
void cli_write_topic(FILE *to, const cli_topic *topic, const cli_topic_style *style);

/* For a terminal. */
void cli_print_topic(FILE *to, const cli_topic *topic);

#endif
