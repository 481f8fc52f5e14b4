/* sprayplan help: what the program does, a command, or a topic. */
#include "cli.h"

#include "topics.h"

#include <stdint.h>
#include <string.h>

int cli_help(const cli_options *options)
{
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
    for (const cli_topic *topic = cli_topics; topic->name; topic++)
        if (!strcmp(topic->name, name)) {
            topic->print(stdout);
            return EXIT_DONE;
        }
    cli_unknown_command(name);
    return EXIT_USAGE;
}
