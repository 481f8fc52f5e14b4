/* What may stand on the command line, in one table: by it the line is read, and --help, `help COMMAND` and the man page
 * are made from it. */
#ifndef CLI_USAGE_H
#define CLI_USAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef enum {
    CLI_CHECK,
    CLI_SIMULATE,
    CLI_PLACE,
    CLI_COMPARE,
    CLI_STUDY,
    CLI_ATLAS,
    CLI_TRACE,
    CLI_BENCH,
    CLI_HELP,
    CLI_COMMANDS, /* how many */
} cli_command_id;

enum { CLI_INPUTS_MOST = 64 };

typedef struct {
    const char *name;
    const char *arguments; /* for the usage line, without options */
    const char *summary;
    const char *description; /* paragraphs, an empty line between them */
    const char *example;     /* a command line */
    int least_inputs, most_inputs;
} cli_command;

extern const cli_command cli_commands[CLI_COMMANDS];

typedef enum {
    CLI_OUTPUT,
    CLI_SET,
    CLI_REPAIR,
    CLI_TIME_LIMIT,
    CLI_MEMORY,
    CLI_PROVE,
    CLI_NO_LIVE,
    CLI_FORCE,
    CLI_UNIT,
    CLI_TEXEL,
    CLI_PACK,
    CLI_REUSE,
    CLI_RAYS,
    CLI_GRAVITY,
    CLI_ACCEL,
    CLI_MODE,
    CLI_TRAJECTORY,
    CLI_SCHEMA,
    CLI_JSON,
    CLI_THREADS,
    CLI_QUIET,
    CLI_HELP_ASKED,
    CLI_VERSION,
} cli_option_id;

/* An option with what it means to some of the commands; to others one of the same name may mean something else. */
typedef struct {
    cli_option_id id;
    char letter;       /* 0: none */
    const char *name;  /* without its dashes; NULL: none */
    const char *value; /* what is said for its value; NULL where it takes none */
    unsigned commands; /* 1 << cli_command_id, added up */
    const char *text;  /* one paragraph */
} cli_option;

extern const cli_option cli_options_known[];
extern const size_t cli_option_count;
/* Every command takes it. */
bool cli_option_is_common(const cli_option *option);

/* A row of a list of terms, as of exit statuses. */
typedef struct {
    const char *term, *text;
} cli_term;
extern const cli_term cli_statuses[], cli_environment[], cli_files[]; /* the last has no term */

/* What the program is for, one paragraph. */
extern const char cli_purpose[];
/* What holds of all command lines, one paragraph. */
extern const char cli_conventions[];

/* SIZE_MAX where no command is called that. */
size_t cli_command_named(const char *name);

/* `-o, --set KEY=VALUE`, without whatever of these the option lacks. */
enum { CLI_SYNTAX = 64 };
void cli_option_syntax(const cli_option *option, char text[CLI_SYNTAX]);

/* Of those that one of the commands (1 << cli_command_id, added up) takes, the common ones or its own. */
void cli_each_option(FILE *to, unsigned commands, bool common,
                     void (*print)(FILE *to, const char *term, const char *text));

/* usage.c: the texts. */
void cli_print_usage(FILE *to);
void cli_print_command_usage(FILE *to, cli_command_id command);

#endif
