#include "scoring/visibility_work.h"

#include <pthread.h>
#include <stdlib.h>

struct sp_view_buffers {
    pthread_mutex_t lock;
    pthread_cond_t left;
    sp_view_buffer *items; /* [buffer_count] */
    sp_view_buffer *idle;
    sp_error failure;
};

bool sp_view_buffers_create(sp_visibility *visibility, bool any_marked, sp_error *error)
{
    sp_view_buffers *buffers = visibility->buffers = calloc(1, sizeof *buffers);
    if (!buffers)
        return sp_fail_memory(error);
    pthread_mutex_init(&buffers->lock, NULL);
    pthread_cond_init(&buffers->left, NULL);
    buffers->items = calloc((size_t)visibility->buffer_count, sizeof *buffers->items);
    for (int i = 0; buffers->items && i < visibility->buffer_count; i++) {
        sp_view_buffer *buffer = &buffers->items[i];
        *buffer = (sp_view_buffer){
            .block = malloc(sp_view_bytes(visibility->largest, any_marked)), .at = SIZE_MAX, .next = buffers->idle};
        if (!buffer->block)
            return sp_fail_memory(error);
        buffers->idle = buffer;
    }
    return buffers->items || sp_fail_memory(error);
}

void sp_view_buffers_destroy(sp_view_buffers *buffers, int count)
{
    if (!buffers)
        return;
    for (int i = 0; buffers->items && i < count; i++)
        free(buffers->items[i].block);
    pthread_mutex_destroy(&buffers->lock);
    pthread_cond_destroy(&buffers->left);
    free(buffers->items);
    free(buffers);
}

bool sp_visibility_sound(const sp_visibility *visibility, sp_error *error)
{
    const sp_error *failure = visibility->buffers ? &visibility->buffers->failure : NULL;
    return !failure || failure->kind == SP_OK ||
           sp_fail(error, failure->kind, failure->file, failure->line, failure->column, "%s", failure->message);
}

static sp_view_buffer *take_buffer(sp_view_buffers *buffers)
{
    pthread_mutex_lock(&buffers->lock);
    while (!buffers->idle)
        pthread_cond_wait(&buffers->left, &buffers->lock);
    sp_view_buffer *buffer = buffers->idle;
    buffers->idle = buffer->next;
    pthread_mutex_unlock(&buffers->lock);
    return buffer;
}

void sp_visibility_release(const sp_visibility *visibility, sp_view_buffer **buffer)
{
    sp_view_buffers *buffers = visibility->buffers;
    if (!*buffer)
        return;
    pthread_mutex_lock(&buffers->lock);
    (*buffer)->next = buffers->idle;
    buffers->idle = *buffer;
    *buffer = NULL;
    pthread_cond_signal(&buffers->left);
    pthread_mutex_unlock(&buffers->lock);
}

const sp_view *sp_visibility_look(const sp_visibility *visibility, uint32_t site, size_t launch,
                                  sp_view_buffer **buffer)
{
    size_t at = site * visibility->launch_count + launch;
    const sp_view *kept = &visibility->views[at];
    if (kept->start || !visibility->known[at])
        return kept;
    if (!*buffer)
        *buffer = take_buffer(visibility->buffers);
    if ((*buffer)->at == at)
        return &(*buffer)->view;
    sp_sightings sightings;
    sp_error error = {0};
    (*buffer)->at = at;
    if (sp_visibility_trace(visibility, at, &sightings, &error))
        sp_view_write(&sightings, &visibility->bins, (*buffer)->block, &(*buffer)->view);
    else {
        (*buffer)->view = (sp_view){0};
        (*buffer)->at = SIZE_MAX;
        pthread_mutex_lock(&visibility->buffers->lock);
        visibility->buffers->failure = error;
        pthread_mutex_unlock(&visibility->buffers->lock);
    }
    sp_sightings_free(&sightings);
    return &(*buffer)->view;
}
