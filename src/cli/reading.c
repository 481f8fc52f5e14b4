/* What is read: files by their paths, and standard input, which `-` stands for. */
#include "cli.h"

#include <errno.h>
#include <string.h>

bool cli_is_standard_input(const char *path)
{
    return path && !strcmp(path, "-");
}

const char *cli_input_name(const char *path)
{
    return cli_is_standard_input(path) ? "standard input" : path;
}

const char *cli_input_path(const char *path)
{
    return cli_is_standard_input(path) ? "/dev/stdin" : path;
}

bool cli_reads_once(const cli_options *options)
{
    int times = options->command == CLI_TRACE && cli_is_standard_input(options->rays);
    for (int i = 0; i < options->input_count; i++)
        times += cli_is_standard_input(options->inputs[i]);
    if (times > 1)
        fprintf(stderr, "sprayplan: %s: found - %d times, expected it once: standard input can be read once\n",
                cli_commands[options->command].name, times);
    else if (times && options->reuse)
        fprintf(stderr, "sprayplan: atlas: --reuse: found -, expected a file: it is read again\n");
    return times == 0 || (times == 1 && !options->reuse);
}

sp_scene *cli_load_scene(const char *path, const cli_options *options, const sp_run *run, sp_error *error)
{
    const char *const *overrides = options->overrides;
    size_t count = options->override_count;
    return cli_is_standard_input(path) ? sp_scene_load_stream(stdin, cli_input_name(path), overrides, count, run, error)
                                       : sp_scene_load_with(path, overrides, count, run, error);
}

sp_mesh *cli_load_mesh(const cli_options *options, sp_error *error)
{
    const char *path = options->inputs[0];
    return cli_is_standard_input(path) ? sp_mesh_load_stream(stdin, cli_input_name(path), options->unit, error)
                                       : sp_mesh_load(path, options->unit, error);
}

FILE *cli_open(const char *path, sp_error *error)
{
    FILE *file = cli_is_standard_input(path) ? stdin : fopen(path, "rb");
    if (!file)
        sp_fail(error, SP_ERROR_INPUT, path, 0, 0, "cannot be opened: %s", strerror(errno));
    return file;
}
