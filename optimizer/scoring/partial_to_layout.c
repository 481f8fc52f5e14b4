/* Partial layouts as layouts, whose nozzles have names. */
#include "scoring/partial.h"

#include <stdio.h>
#include <string.h>

static bool name_taken(const sp_layout *layout, size_t but, const char *name)
{
    for (size_t i = 0; i < layout->count; i++)
        if (i != but && !strcmp(layout->nozzles[i].name, name))
            return true;
    return false;
}

/* A nozzle that sits elsewhere and is called like a port, even one left empty, would be fitted there. */
static bool is_port(const sp_place_options *options, const char *name)
{
    for (size_t i = 0; i < options->mount_count + options->other_count; i++) {
        bool other = i >= options->mount_count;
        const sp_mount *mount = other ? &options->others[i - options->mount_count] : &options->mounts[i];
        if (mount->kind == SP_MOUNT_PORT && !strcmp(mount->name, name))
            return true;
    }
    return false;
}

/* A port's nozzle is called after the port, where that is taken the first free "name-2", ...; any other P1, P2, ... */
static void name_nozzle(const sp_search *search, const sp_layout *layout, size_t i, const char *port, size_t *number)
{
    char *name = layout->nozzles[i].name;
    if (port && port[0]) {
        snprintf(name, SP_NAME, "%s", port);
        for (size_t again = 2; name_taken(layout, i, name); again++)
            snprintf(name, SP_NAME, "%.40s-%zu", port, again);
        return;
    }
    do
        snprintf(name, SP_NAME, "P%zu", ++*number);
    while (name_taken(layout, i, name) || is_port(search->options, name));
}

sp_layout *sp_partial_to_layout(const sp_search *search, const sp_partial *partial, sp_error *error)
{
    sp_layout *layout = sp_layout_create(NULL, search->kept_count + partial->count, error);
    if (!layout)
        return NULL;
    for (size_t i = 0; i < search->kept_count; i++)
        layout->nozzles[i] = search->kept[i];
    size_t number = 0;
    /* ports first, so that none of their names is taken */
    for (int ports = 1; ports >= 0; ports--)
        for (size_t i = 0; i < partial->count; i++) {
            const sp_mount *mount = &search->options->mounts[partial->items[i].site.mount];
            size_t at = search->kept_count + i;
            if ((mount->kind == SP_MOUNT_PORT) != ports)
                continue;
            layout->nozzles[at] = partial->items[i].nozzle;
            layout->nozzles[at].name[0] = 0;
            name_nozzle(search, layout, at, ports ? mount->name : NULL, &number);
        }
    return layout;
}
