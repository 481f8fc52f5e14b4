/* sprayplan: the program. */
#include "cli.h"

#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

static const cli_command commands[] = {
    {"check", "SCENE [-o DIR]", "what is in it, what is wrong with it, mesh diagnostics",
     OPTION_OUTPUT | OPTION_SET | OPTION_REPAIR, cli_check, 1, 1},
    {"simulate", "SCENE [-o DIR]", "evaluate the scene's own nozzles", OPTION_SET | OPTION_OUTPUT | OPTION_NO_LIVE,
     cli_simulate, 1, 1},
    {"place", "SCENE [-o DIR]", "propose a layout; compares with the scene's own nozzles",
     OPTION_SET | OPTION_OUTPUT | OPTION_TIME_LIMIT | OPTION_MEMORY | OPTION_PROVE | OPTION_NO_LIVE, cli_place, 1, 1},
    {"compare", "A B... [-o DIR]", "scenes or results side by side, one report", OPTION_SET | OPTION_OUTPUT,
     cli_compare, 2, 64},
    {"study", "SCENE [-o DIR]", "measure speed against accuracy for this scene",
     OPTION_SET | OPTION_OUTPUT | OPTION_TIME_LIMIT, cli_study, 1, 1},
    {"atlas", "MESH -o OUT.obj [--texel L]", "texture atlas only: mesh with UVs, chart pictures beside it, figures",
     OPTION_OUTPUT | OPTION_ATLAS, cli_atlas, 1, 1},
    {"trace", "MESH --rays FILE", "nearest hits of given lines or parabolas, as CSV", OPTION_RAYS, cli_trace, 1, 1},
    {"bench", "MESH", "build, trace and atlas timings of every accelerator on this mesh", OPTION_BENCH, cli_bench, 1,
     1},
};
enum { COMMANDS = sizeof commands / sizeof *commands };

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

static void print_usage(FILE *to)
{
    fprintf(to, "usage: sprayplan COMMAND ...\n\n");
    for (int i = 0; i < COMMANDS; i++)
        fprintf(to, "  sprayplan %-8s %-28s %s\n", commands[i].name, commands[i].arguments, commands[i].summary);
    fprintf(to,
            "\n"
            "  --json            one JSON object on standard output and nothing else there\n"
            "  --threads N       how many threads to use (default: one per core); the answer does not depend on it\n"
            "  --quiet           no progress and no summary\n"
            "  --set KEY=VALUE   override a setting, as --set simulate.jets=20000 or --set place.refine=none\n"
            "  --repair OUT.obj  check writes a mended copy of the geometry; see check --help\n"
            "  --time-limit S    place returns its best so far after S seconds, study what it has measured\n"
            "  --memory SIZE     what place may take for all that its candidates can reach, as \"2 GB\"; less takes\n"
            "                    longer, the answer does not depend on it\n"
            "  --prove           place spends the time limit on closing the gap between proposal and bound\n"
            "  --no-live         leave the evaluator, which evaluates changed layouts in the report, out of it\n"
            "  --version, --help\n"
            "\n"
            "exit status: 0 done; 2 wrong usage; 3 bad input; 4 done, but the proposal does not reach the coverage\n"
            "asked for; 130 interrupted; 1 anything else\n");
}

static void print_command_usage(FILE *to, const cli_command *command)
{
    fprintf(to, "usage: sprayplan %s %s\n%s\n", command->name, command->arguments, command->summary);
    if (command->options & OPTION_OUTPUT)
        fprintf(to, "  -o PATH                    where to write; without it nothing is written\n");
    if (command->options & OPTION_SET)
        fprintf(to, "  --set KEY=VALUE            override a setting of simulate: or place:\n");
    if (command->options & OPTION_REPAIR)
        fprintf(
            to,
            "  --repair OUT.obj           write a mended copy of the geometry, in m and placed as in the scene; of\n"
            "                             several files OUT-0.obj, OUT-1.obj, .. No file that is read is replaced.\n"
            "                             Name it in the scene instead of the file that it is of, without unit,\n"
            "                             scale, rotate, translate, chord and angle. Mended: cracks of up to 1e-4\n"
            "                             of the diagonal, edges cut more finely on one side, triangles that face\n"
            "                             the other side than most around them, single ones that are missing,\n"
            "                             there twice or without area. Left: wider openings, crossings, loose\n"
            "                             bits, which side a closed shell faces\n");
    if (command->options & OPTION_TIME_LIMIT)
        fprintf(to, "  --time-limit S             return the best so far, or what there is, after S seconds\n");
    if (command->options & OPTION_MEMORY)
        fprintf(to, "  --memory SIZE              what all that candidates can reach may take, as \"2 GB\" (default 1 "
                    "GB); less\n"
                    "                             takes longer, the answer does not depend on it\n");
    if (command->options & OPTION_PROVE)
        fprintf(to,
                "  --prove                    spend the time limit on closing the gap between proposal and bound\n");
    if (command->options & OPTION_NO_LIVE)
        fprintf(to, "  --no-live                  leave the evaluator out of the report\n");
    if (command->options & OPTION_ATLAS)
        fprintf(to, "  --texel L                  edge length of a texel, as 10mm or 0.01\n"
                    "  --pack pixels|skyline      charts in each other's hollows (default), or their boxes as in 2008\n"
                    "  --reuse                    keep the texture coordinates that an OBJ file has from here\n");
    if (command->options & OPTION_RAYS)
        fprintf(to, "  --rays FILE                lines ox,oy,oz,vx,vy,vz in m and m/s; # begins a comment\n"
                    "  --gravity gx,gy,gz         m/s2; makes parabolas\n"
                    "  --accel bvh|sah|naive|none accelerator (default bvh)\n");
    if (command->options & OPTION_BENCH)
        fprintf(to, "  --rays N                   how many rays a mode has (default 262144)\n"
                    "  --mode M                   cone, grid, incoherent or surface (default all)\n"
                    "  --trajectory T             line or parabola (default both)\n");
    fprintf(to, "  --json --threads N --quiet\n");
}

static const cli_command *find_command(const char *name)
{
    for (int i = 0; i < COMMANDS; i++)
        if (!strcmp(commands[i].name, name))
            return &commands[i];
    return NULL;
}

static int wrong_command(const char *name)
{
    fprintf(stderr, "sprayplan: unknown command \"%s\"; see sprayplan --help\n", name);
    return EXIT_USAGE;
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

static int run(int count, char **arguments)
{
    if (count < 2) {
        print_usage(stderr);
        return EXIT_USAGE;
    }
    if (!strcmp(arguments[1], "--help") || !strcmp(arguments[1], "-h")) {
        print_usage(stdout);
        return EXIT_DONE;
    }
    if (!strcmp(arguments[1], "--version")) {
        printf("sprayplan %s\n", SP_VERSION);
        return EXIT_DONE;
    }
    const cli_command *command = find_command(arguments[1]);
    if (!command)
        return wrong_command(arguments[1]);
    cli_options options;
    bool help = false;
    if (!cli_parse(command, count - 1, arguments + 1, &options, &help)) {
        print_command_usage(stderr, command);
        return EXIT_USAGE;
    }
    if (options.version) {
        printf("sprayplan %s\n", SP_VERSION);
        return EXIT_DONE;
    }
    if (help) {
        print_command_usage(stdout, command);
        return EXIT_DONE;
    }
    cli_sleep_while_waiting(arguments);
    return command->run(&options);
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
