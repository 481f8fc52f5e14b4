/* Which files were read, with their digests. */
#include "cli.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static bool is_known(const cli_inputs *inputs, const char *path)
{
    bool known = false;
    for (size_t i = 0; !known && i < inputs->count; i++)
        known = !strcmp(inputs->list[i].path, path);
    return known;
}

/* Takes a copy; its path is not yet known. */
static bool append(cli_inputs *inputs, const sp_input *input, sp_error *error)
{
    sp_input *grown = realloc(inputs->list, (inputs->count + 1) * sizeof *grown);
    char *path = strdup(input->path);
    inputs->list = grown ? grown : inputs->list;
    if (!grown || !path) {
        free(path);
        return sp_fail_memory(error);
    }
    grown[inputs->count] = *input;
    grown[inputs->count++].path = path;
    return true;
}

bool cli_inputs_add(cli_inputs *inputs, const char *path, sp_error *error)
{
    struct stat status;
    sp_input input = {.path = path};
    if (is_known(inputs, path) || (stat(path, &status) == 0 && !S_ISREG(status.st_mode)))
        return true;
    return sp_file_sha256(path, input.sha256, error) && append(inputs, &input, error);
}

bool cli_inputs_join(cli_inputs *inputs, const cli_inputs *more, sp_error *error)
{
    bool good = true;
    for (size_t i = 0; good && i < more->count; i++)
        good = is_known(inputs, more->list[i].path) || append(inputs, &more->list[i], error);
    return good;
}

bool cli_inputs_add_scene(cli_inputs *inputs, const char *path, const sp_scene *scene, sp_error *error)
{
    bool good = true;
    for (size_t i = cli_is_standard_input(path); good && i < sp_scene_file_count(scene); i++) {
        char *file = sp_scene_file_path(scene, i, error);
        good = file && cli_inputs_add(inputs, file, error);
        free(file);
    }
    return good;
}

void cli_inputs_free(cli_inputs *inputs)
{
    for (size_t i = 0; i < inputs->count; i++)
        free((char *)inputs->list[i].path);
    free(inputs->list);
    *inputs = (cli_inputs){0};
}
