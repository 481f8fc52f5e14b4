#include "topics.h"

#include "wrapped.h"

#include <assert.h>
#include <string.h>

const cli_topic cli_topics[] = {
    {"scene", "keys of a scene: what to clean, with what, when a spot counts as clean, where nozzles may be",
     SP_TOPIC_SCENE},
    {"catalogue", "keys of a catalogue of nozzle types", SP_TOPIC_CATALOGUE},
    {"result", "keys of result.json, which --json prints too", SP_TOPIC_RESULT},
    {"files", "files that simulate and place write, and the columns and channels in them", SP_TOPIC_FILES},
    {"outputs", "keys of what check, study, atlas, bench and trace print with --json", SP_TOPIC_OUTPUTS},
    {NULL, NULL, SP_TOPIC_SCENE},
};

const cli_topic *cli_topic_named(const char *name)
{
    for (const cli_topic *topic = cli_topics; topic->name; topic++)
        if (!strcmp(topic->name, name))
            return topic;
    return NULL;
}

enum { PATH = 120, TEXT = 1200, BLOCKS = 64 };

typedef struct {
    const sp_block *done[BLOCKS];
    size_t count;
    FILE *to;
    const cli_topic_style *style;
} writer;

static bool is_done(const writer *writer, const sp_block *block)
{
    for (size_t i = 0; i < writer->count; i++)
        if (writer->done[i] == block)
            return true;
    return false;
}

static void write_key(const writer *writer, const sp_key *key)
{
    char value[SP_KEY_FORM], form[2 * SP_KEY_FORM], text[TEXT];
    const char *absent = key->standard ? key->standard : key->absent;
    sp_key_form(key, value);
    if (key->required)
        snprintf(form, sizeof form, "%s; required", value);
    else
        snprintf(form, sizeof form, "%s%s%s", value, absent ? "; default: " : "", absent ? absent : "");
    snprintf(text, sizeof text, "%s.", key->says);
    writer->style->key(writer->to, key->name, form, text);
}

static void write_block(writer *writer, const char *path, const sp_block *block)
{
    assert(writer->count < BLOCKS);
    writer->done[writer->count++] = block;
    writer->style->block(writer->to, writer->count > 1 ? path : NULL, block);
    for (const sp_key *key = block->keys; key->name; key++)
        write_key(writer, key);
    for (const sp_key *key = block->keys; key->name; key++) {
        char below[PATH];
        bool list = key->kind == SP_KEY_BLOCKS || key->kind == SP_KEY_NAMED_BLOCKS,
             outermost = writer->done[0] == block;
        if (!key->block || is_done(writer, key->block))
            continue;
        snprintf(below, sizeof below, "%s%s%s%s", outermost ? "" : path, outermost ? "" : ".", key->name,
                 list ? "[]" : "");
        write_block(writer, below, key->block);
    }
}

void cli_write_topic(FILE *to, const cli_topic *topic, const cli_topic_style *style)
{
    writer writer = {.to = to, .style = style};
    write_block(&writer, topic->name, sp_topic_block(topic->topic));
}

static void print_block(FILE *to, const char *path, const sp_block *block)
{
    if (path)
        fprintf(to, "\n%s:\n", path);
    if (block->says) {
        char text[TEXT];
        snprintf(text, sizeof text, "%s.", block->says);
        cli_print_wrapped(to, text, 0, 0);
    }
    if (!path)
        fputc('\n', to);
}

static void print_key(FILE *to, const char *name, const char *form, const char *text)
{
    cli_print_term(to, name, form);
    cli_print_term(to, "", text);
}

void cli_print_topic(FILE *to, const cli_topic *topic)
{
    static const cli_topic_style style = {print_block, print_key};
    cli_write_topic(to, topic, &style);
}
