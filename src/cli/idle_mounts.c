/* Mounts on which no nozzle can stand. */
#include "cli.h"

#include <stdlib.h>

static const char *const kinds[] = {"port", "surface", "line", "box"};

static void warn_of_mount(const sp_place_options *options, size_t mount, size_t points, cli_warning_handler *warn,
                          void *user)
{
    char text[320];
    const sp_mount *m = &options->mounts[mount];
    int used = snprintf(text, sizeof text, "mounts: %s %s%.*s%s (number %zu): ", kinds[m->kind], m->name[0] ? "'" : "",
                        80, m->name, m->name[0] ? "'" : "", mount + 1);
    if (points == 1)
        snprintf(text + used, sizeof text - (size_t)used,
                 "no nozzle can be there: its mounting point is not inside the cavity and %.4g m clear of surfaces",
                 options->clearance);
    else if (points)
        snprintf(text + used, sizeof text - (size_t)used,
                 "no nozzle can be there: none of its %zu mounting points is inside the cavity and %.4g m clear of "
                 "surfaces",
                 points, options->clearance);
    else
        snprintf(text + used, sizeof text - (size_t)used, "no nozzle can be there: it has no mounting points");
    warn(user, text);
}

bool cli_warn_of_idle_mounts(const cli_scene *opened, cli_warning_handler *warn, void *user, sp_error *error)
{
    sp_place_options options = sp_scene_place_options(opened->scene);
    size_t *all = calloc(2 * options.mount_count + 1, sizeof *all);
    sp_error own = {0};
    if (!all)
        return sp_fail_memory(error);
    bool counted = sp_place_count_points(opened->evaluator, &options, all, all + options.mount_count, &own);
    for (size_t m = 0; counted && m < options.mount_count; m++)
        if (!all[options.mount_count + m])
            warn_of_mount(&options, m, all[m], warn, user);
    free(all);
    if (own.kind == SP_ERROR_MEMORY)
        return sp_fail_memory(error);
    if (!counted)
        warn(user, own.message);
    return true;
}
