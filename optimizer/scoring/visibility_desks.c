#include "scoring/visibility_work.h"

#include <pthread.h>
#include <stdlib.h>

struct sp_desks {
    pthread_mutex_t lock;
    pthread_cond_t left;
    sp_desk *items; /* [desk_count] */
    sp_desk *idle;
    sp_error failure;
};

bool sp_desks_create(sp_visibility *visibility, bool any_marked, sp_error *error)
{
    sp_desks *desks = visibility->desks = calloc(1, sizeof *desks);
    if (!desks)
        return sp_fail_memory(error);
    pthread_mutex_init(&desks->lock, NULL);
    pthread_cond_init(&desks->left, NULL);
    desks->items = calloc((size_t)visibility->desk_count, sizeof *desks->items);
    for (int i = 0; desks->items && i < visibility->desk_count; i++) {
        sp_desk *desk = &desks->items[i];
        *desk = (sp_desk){
            .block = malloc(sp_view_bytes(visibility->largest, any_marked)), .at = SIZE_MAX, .next = desks->idle};
        if (!desk->block)
            return sp_fail_memory(error);
        desks->idle = desk;
    }
    return desks->items || sp_fail_memory(error);
}

void sp_desks_destroy(sp_desks *desks, int count)
{
    if (!desks)
        return;
    for (int i = 0; desks->items && i < count; i++)
        free(desks->items[i].block);
    pthread_mutex_destroy(&desks->lock);
    pthread_cond_destroy(&desks->left);
    free(desks->items);
    free(desks);
}

bool sp_visibility_sound(const sp_visibility *visibility, sp_error *error)
{
    const sp_error *failure = visibility->desks ? &visibility->desks->failure : NULL;
    return !failure || failure->kind == SP_OK ||
           sp_fail(error, failure->kind, failure->file, failure->line, failure->column, "%s", failure->message);
}

static sp_desk *take_desk(sp_desks *desks)
{
    pthread_mutex_lock(&desks->lock);
    while (!desks->idle)
        pthread_cond_wait(&desks->left, &desks->lock);
    sp_desk *desk = desks->idle;
    desks->idle = desk->next;
    pthread_mutex_unlock(&desks->lock);
    return desk;
}

void sp_visibility_leave(const sp_visibility *visibility, sp_desk **desk)
{
    sp_desks *desks = visibility->desks;
    if (!*desk)
        return;
    pthread_mutex_lock(&desks->lock);
    (*desk)->next = desks->idle;
    desks->idle = *desk;
    *desk = NULL;
    pthread_cond_signal(&desks->left);
    pthread_mutex_unlock(&desks->lock);
}

const sp_view *sp_visibility_look(const sp_visibility *visibility, uint32_t site, size_t launch, sp_desk **desk)
{
    size_t at = site * visibility->launch_count + launch;
    const sp_view *kept = &visibility->views[at];
    if (kept->start || !visibility->known[at])
        return kept;
    if (!*desk)
        *desk = take_desk(visibility->desks);
    if ((*desk)->at == at)
        return &(*desk)->view;
    sp_sightings sightings;
    sp_error error = {0};
    (*desk)->at = at;
    if (sp_visibility_trace(visibility, at, &sightings, &error))
        sp_view_write(&sightings, &visibility->bins, (*desk)->block, &(*desk)->view);
    else {
        (*desk)->view = (sp_view){0};
        (*desk)->at = SIZE_MAX;
        pthread_mutex_lock(&visibility->desks->lock);
        visibility->desks->failure = error;
        pthread_mutex_unlock(&visibility->desks->lock);
    }
    sp_sightings_free(&sightings);
    return &(*desk)->view;
}
