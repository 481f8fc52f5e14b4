/* sprayplan help: what the program does, a command, or a topic. */
#include "cli.h"

#include "topics.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static int print_schema(const char *name)
{
    sp_error error = {0};
    const cli_topic *topic = cli_topic_named(name);
    if (!topic || topic->topic >= SP_TOPIC_FILES) {
        fprintf(stderr, "sprayplan: help: found \"%s\", expected scene, catalogue or result, which have a schema\n",
                name);
        return EXIT_USAGE;
    }
    char *schema = sp_topic_schema(topic->topic, &error);
    if (!schema)
        return cli_fail(&error);
    fputs(schema, stdout);
    free(schema);
    return EXIT_DONE;
}

int cli_help(const cli_options *options)
{
    if (options->schema || options->json) /* a schema is all of the help that is one JSON object */
        return print_schema(options->input_count ? options->inputs[0] : "scene");
    if (options->input_count == 0) {
        cli_print_usage(stdout);
        return EXIT_DONE;
    }
    const char *name = options->inputs[0];
    size_t command = cli_command_named(name);
    if (command != SIZE_MAX) {
        cli_print_command_usage(stdout, (cli_command_id)command);
        return EXIT_DONE;
    }
    const cli_topic *topic = cli_topic_named(name);
    if (topic) {
        cli_print_topic(stdout, topic);
        return EXIT_DONE;
    }
    cli_unknown_topic(name);
    return EXIT_USAGE;
}
