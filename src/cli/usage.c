/* How the program is used, for a terminal. */
#include "usage.h"

#include "topics.h"
#include "wrapped.h"

#include <string.h>

static void print_paragraphs(FILE *to, const char *text)
{
    while (*text) {
        text = cli_print_wrapped(to, text, 0, 0);
        fputc('\n', to);
    }
}

static void print_terms(FILE *to, const char *title, const cli_term *terms)
{
    fprintf(to, "\n%s:\n", title);
    for (; terms->term; terms++)
        cli_print_term(to, terms->term, terms->text);
}

void cli_print_usage(FILE *to)
{
    fprintf(to, "usage: sprayplan COMMAND [OPTION]... FILE...\n\n");
    cli_print_wrapped(to, cli_purpose, 0, 0);
    fprintf(to,
            "\n  %-44s  # what is in it, what is wrong\n  %-44s  # what your own nozzles cover\n"
            "  %-44s  # a proposal, compared with them\n",
            cli_commands[CLI_CHECK].example, cli_commands[CLI_SIMULATE].example, cli_commands[CLI_PLACE].example);
    fprintf(to, "\ncommands:\n");
    for (int i = 0; i < CLI_COMMANDS; i++) {
        char term[64];
        snprintf(term, sizeof term, "%-8s %s", cli_commands[i].name, cli_commands[i].arguments);
        cli_print_term(to, term, cli_commands[i].summary);
    }
    fprintf(to, "\noptions of all commands:\n");
    cli_each_option(to, ~0u, true, cli_print_term);
    for (const cli_topic *topic = cli_topics; topic->name; topic++) {
        if (topic == cli_topics)
            fprintf(to, "\nsprayplan help TOPIC:\n");
        cli_print_term(to, topic->name, topic->summary);
    }
    print_terms(to, "exit status", cli_statuses);
    fprintf(to, "\n");
    cli_print_wrapped(to, cli_conventions, 0, 0);
    fprintf(to, "\n");
    cli_print_wrapped(to, "`sprayplan help COMMAND` tells what a command does and which options of its own it takes.",
                      0, 0);
}

void cli_print_command_usage(FILE *to, cli_command_id id)
{
    const cli_command *command = &cli_commands[id];
    fprintf(to, "usage: sprayplan %s [OPTION]... %s\n\n", command->name, command->arguments);
    print_paragraphs(to, command->description);
    fprintf(to, "  %s\n\noptions:\n", command->example);
    cli_each_option(to, 1u << id, false, cli_print_term);
    cli_each_option(to, 1u << id, true, cli_print_term);
}
