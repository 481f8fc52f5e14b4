/* sprayplan: the program. */
#include "cli.h"

#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

static int (*const run_command[CLI_COMMANDS])(const cli_options *options) = {
    [CLI_CHECK] = cli_check,     [CLI_SIMULATE] = cli_simulate, [CLI_PLACE] = cli_place,
    [CLI_COMPARE] = cli_compare, [CLI_STUDY] = cli_study,       [CLI_ATLAS] = cli_atlas,
    [CLI_TRACE] = cli_trace,     [CLI_BENCH] = cli_bench,       [CLI_HELP] = cli_help,
};

int cli_fail(const sp_error *error)
{
    char text[1400];
    cli_progress_end();
    if (!sp_ranks_fail(cli_ranks()))
        return EXIT_DONE;
    sp_error_text(error, text, sizeof text);
    fprintf(stderr, "%s\n", text);
    switch (error->kind) {
    case SP_ERROR_INPUT:
    case SP_ERROR_UNSUPPORTED:
        return EXIT_INPUT;
    case SP_ERROR_INTERRUPTED:
        return EXIT_INTERRUPTED;
    default:
        return EXIT_OTHER;
    }
}

int cli_done(void)
{
    if (!cli_interrupted())
        return EXIT_DONE;
    fprintf(stderr, "sprayplan: interrupted when all was worked out already\n");
    return EXIT_INTERRUPTED;
}

/* A file that is opened must not get the number of a standard stream and take what is printed; and what cannot be
 * written, to a reader who is gone or beyond a limit, is an error like others, which leaves the old files. */
static void keep_streams(void)
{
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    int file;
    while ((file = open("/dev/null", O_RDONLY)) >= 0 && file <= STDERR_FILENO)
        continue;
    if (file >= 0)
        close(file);
}

static void say_how_to_use(const cli_options *options)
{
    if (options->command == CLI_COMMANDS)
        fprintf(stderr, "sprayplan --help tells how it is used\n");
    else
        fprintf(stderr, "sprayplan %s --help tells how it is used\n", cli_commands[options->command].name);
}

static int run(int count, char **arguments)
{
    cli_options options;
    if (count < 2) {
        cli_print_usage(stderr);
        return EXIT_USAGE;
    }
    if (!cli_parse(count - 1, arguments + 1, &options)) {
        say_how_to_use(&options);
        return EXIT_USAGE;
    }
    if (options.version) {
        printf("sprayplan %s\n", SP_VERSION);
        return EXIT_DONE;
    }
    if (options.help && options.command == CLI_COMMANDS) {
        cli_print_usage(stdout);
        return EXIT_DONE;
    }
    if (options.help) {
        cli_print_command_usage(stdout, options.command);
        return EXIT_DONE;
    }
    if (options.command != CLI_HELP)
        cli_sleep_while_waiting(arguments);
    return run_command[options.command](&options);
}

int main(int count, char **arguments)
{
    keep_streams();
    int status = run(count, arguments);
    cli_progress_end();
    bool lost = ferror(stdout);
    if (fclose(stdout) || lost) {
        fprintf(stderr, "sprayplan: standard output could not be written\n");
        return EXIT_OTHER;
    }
    return status;
}
