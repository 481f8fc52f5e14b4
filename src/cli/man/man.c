/* Writes a manual page on standard output, from the texts that --help and `help TOPIC` print: sprayplan(1), or of a
 * topic sprayplan-TOPIC(5). Built for that, and not installed. */
#include "roff.h"

#include "../topics.h"
#include "../usage.h"

#include <ctype.h>
#include <string.h>

static void print_terms(FILE *to, const cli_term *terms)
{
    for (; terms->term; terms++)
        roff_tagged(to, terms->term, terms->text);
}

static void print_synopsis(FILE *to)
{
    roff_section(to, "SYNOPSIS");
    for (int i = 0; i < CLI_COMMANDS; i++) {
        char line[200];
        snprintf(line, sizeof line, "`sprayplan %s` [OPTION]... %s", cli_commands[i].name, cli_commands[i].arguments);
        roff_text(to, line);
        if (i + 1 < CLI_COMMANDS)
            fprintf(to, ".br\n");
    }
}

static void print_command(FILE *to, cli_command_id id)
{
    const cli_command *command = &cli_commands[id];
    char title[200];
    snprintf(title, sizeof title, "%s %s", command->name, command->arguments);
    roff_subsection(to, title);
    roff_paragraphs(to, command->description);
    cli_each_option(to, 1u << id, false, roff_tagged);
    roff_example(to, command->example);
}

static void print_program(FILE *to, const char *date)
{
    roff_title(to, "SPRAYPLAN", 1, date, "User Commands");
    roff_section(to, "NAME");
    fprintf(to, "sprayplan \\- propose where to put spray nozzles\n");
    print_synopsis(to);
    roff_section(to, "DESCRIPTION");
    roff_paragraphs(to, cli_purpose);
    fprintf(to, ".PP\n");
    roff_paragraphs(to, cli_conventions);
    roff_section(to, "COMMANDS");
    for (int i = 0; i < CLI_COMMANDS; i++)
        print_command(to, (cli_command_id)i);
    roff_section(to, "OPTIONS");
    roff_paragraphs(to, "All commands take:");
    cli_each_option(to, ~0u, true, roff_tagged);
    roff_section(to, "EXIT STATUS");
    print_terms(to, cli_statuses);
    roff_section(to, "FILES");
    roff_paragraphs(to, "Of what `simulate` and `place` write into the folder of -o all appears, or nothing:");
    print_terms(to, cli_files);
    roff_section(to, "ENVIRONMENT");
    print_terms(to, cli_environment);
    roff_section(to, "SEE ALSO");
    for (const cli_topic *topic = cli_topics; topic->name; topic++)
        fprintf(to, "%s.BR sprayplan\\-%s (5)", topic == cli_topics ? "" : ",\n", topic->name);
    fputc('\n', to);
}

static void print_block(FILE *to, const char *path, const sp_block *block)
{
    if (path)
        roff_subsection(to, path);
    if (block->says) {
        char text[1200];
        snprintf(text, sizeof text, "%s.", block->says);
        roff_text(to, text);
    }
}

static void print_key(FILE *to, const char *name, const char *form, const char *text)
{
    roff_tagged(to, name, form);
    fprintf(to, ".br\n");
    roff_text(to, text);
}

static void print_topic(FILE *to, const cli_topic *topic, const char *date)
{
    static const cli_topic_style style = {print_block, print_key};
    char title[40];
    snprintf(title, sizeof title, "SPRAYPLAN-%s", topic->name);
    for (char *at = title; *at; at++)
        *at = (char)toupper((unsigned char)*at);
    roff_title(to, title, 5, date, "File Formats");
    roff_section(to, "NAME");
    fprintf(to, "sprayplan\\-%s \\- %s\n", topic->name, topic->summary);
    roff_section(to, "DESCRIPTION");
    cli_write_topic(to, topic, &style);
    roff_section(to, "SEE ALSO");
    fprintf(to, ".BR sprayplan (1)\n");
}

int main(int count, char **arguments)
{
    const cli_topic *topic = count == 3 ? cli_topic_named(arguments[2]) : NULL;
    if (count != 2 && !topic) {
        fprintf(stderr, "usage: sprayplan-man DATE [TOPIC]\n");
        return 2;
    }
    if (topic)
        print_topic(stdout, topic, arguments[1]);
    else
        print_program(stdout, arguments[1]);
    return fflush(stdout) != 0 || ferror(stdout) ? 1 : 0;
}
