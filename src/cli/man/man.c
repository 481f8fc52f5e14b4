/* Writes sprayplan(1) on standard output, from the texts that --help prints. Built for that, and not installed. */
#include "roff.h"

#include "../usage.h"

static void print_options(FILE *to, unsigned commands, bool common)
{
    for (size_t i = 0; i < cli_option_count; i++) {
        const cli_option *option = &cli_options_known[i];
        char syntax[CLI_SYNTAX];
        if (!(option->commands & commands) || cli_option_is_common(option) != common)
            continue;
        cli_option_syntax(option, syntax);
        roff_tagged(to, syntax, option->text);
    }
}

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
    print_options(to, 1u << id, false);
    roff_example(to, command->example);
}

int main(int count, char **arguments)
{
    if (count != 2) {
        fprintf(stderr, "usage: sprayplan-man DATE\n");
        return 2;
    }
    FILE *to = stdout;
    roff_title(to, "SPRAYPLAN", 1, arguments[1], "User Commands");
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
    print_options(to, ~0u, true);
    roff_section(to, "EXIT STATUS");
    print_terms(to, cli_statuses);
    roff_section(to, "FILES");
    roff_paragraphs(to, "Of what `simulate` and `place` write into the folder of -o all appears, or nothing:");
    print_terms(to, cli_files);
    roff_section(to, "ENVIRONMENT");
    print_terms(to, cli_environment);
    return fflush(to) != 0 || ferror(to) ? 1 : 0;
}
