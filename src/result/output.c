/* A set of files that appears whole or not at all: it is prepared in a staging folder, and moved by commit. */
#include "result/output.h"

#include "mesh/file.h"
#include "result/digest.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void output_free(sp_output *output)
{
    for (size_t i = 0; i < output->count; ++i) {
        free(output->entries[i].target);
        free(output->entries[i].temporary);
    }
    sp_staging_close(&output->staging);
    if (output->folder >= 0)
        close(output->folder);
    free(output->entries);
    free(output->protected_files);
    free(output->directory);
    free(output);
}

/* Makes what is missing of a folder and of those above it; `path` is changed meanwhile. Returns how many, from the last
 * on without a gap. Whether it is there now shows when it is opened; errno says why it was not made. */
static size_t make_folders(char *path)
{
    size_t made = 0;
    for (char *end = path + (*path != 0);; end++) {
        char kept = *end;
        if (kept && kept != '/')
            continue;
        *end = 0;
        if (mkdir(path, 0777) == 0)
            made++;
        *end = kept;
        if (!kept)
            return made;
    }
}

/* Those of its folders that are ours go again, where they are empty: what somebody else put there meanwhile stays. */
static void remove_folders(sp_output *output)
{
    char *path = output->directory;
    for (; output->made > 0 && rmdir(path) == 0; output->made--) {
        size_t length = strlen(path);
        while (length > 1 && path[length - 1] == '/')
            length--;
        while (length > 1 && path[length - 1] != '/')
            length--;
        path[length] = 0;
    }
}

static bool open_folder(sp_output *output, sp_error *error)
{
    output->made = make_folders(output->directory);
    int cause = errno;
    output->folder = open(output->directory, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (output->folder >= 0)
        return sp_staging_create(output->directory, output->folder, &output->staging, error);
    if (errno == ENOENT)
        return sp_fail(error, SP_ERROR_FILE, output->directory, 0, 0, "cannot make this folder: %s", strerror(cause));
    struct stat status;
    if (errno == ENOTDIR && stat(output->directory, &status) == 0)
        return sp_fail(error, SP_ERROR_FILE, output->directory, 0, 0, "is a file, expected a folder to write to");
    return sp_fail(error, SP_ERROR_FILE, output->directory, 0, 0, "cannot make this folder: %s", strerror(errno));
}

sp_output *sp_output_open(const char *directory, sp_error *error)
{
    if (!directory)
        return NULL;
    sp_output *output = calloc(1, sizeof *output);
    if (!output)
        return sp_fail_memory(error);
    output->folder = output->staging.folder = output->staging.fresh = output->staging.old = output->staging.lock = -1;
    output->directory = strdup(directory);
    if (!output->directory)
        sp_fail_memory(error);
    else if (open_folder(output, error))
        return output;
    else
        remove_folders(output);
    output_free(output);
    return NULL;
}

bool sp_output_protect(sp_output *output, const char *path, sp_error *error)
{
    if (!output || !path)
        return false;
    struct stat status;
    if (stat(path, &status) != 0)
        return true;
    struct stat *grown = realloc(output->protected_files, (output->protected_count + 1) * sizeof *grown);
    if (!grown)
        return sp_fail_memory(error);
    output->protected_files = grown;
    grown[output->protected_count++] = status;
    return true;
}

bool sp_output_supersede(sp_output *output, sp_error *error)
{
    if (!output)
        return false;
    int file = openat(output->staging.folder, "supersedes", O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    if (file < 0)
        return sp_fail(error, SP_ERROR_FILE, output->directory, 0, 0, "cannot be written to: %s", strerror(errno));
    close(file);
    return true;
}

bool sp_output_allows(const sp_output *output, const char *name, const char *target, sp_error *error)
{
    struct stat status;
    if (fstatat(output->folder, name, &status, 0) != 0)
        return true;
    if (S_ISDIR(status.st_mode))
        return sp_fail(error, SP_ERROR_FILE, target, 0, 0, "is a folder, expected nothing or a file to replace");
    for (size_t i = 0; i < output->protected_count; ++i)
        if (output->protected_files[i].st_dev == status.st_dev && output->protected_files[i].st_ino == status.st_ino)
            return sp_fail(error, SP_ERROR_FILE, target, 0, 0,
                           "would replace a file that was read, expected another folder to write to");
    return true;
}

static char *joined(const char *first, const char *second, const char *third, const char *name)
{
    size_t size = strlen(first) + strlen(second) + strlen(third) + strlen(name) + 3;
    char *path = malloc(size);
    if (path)
        snprintf(path, size, "%s/%s%s%s", first, second, third, name);
    return path;
}

static sp_output_entry *next_entry(sp_output *output, sp_error *error)
{
    if (output->count == output->capacity) {
        size_t capacity = output->capacity ? 2 * output->capacity : 16;
        sp_output_entry *grown = realloc(output->entries, capacity * sizeof *grown);
        if (!grown)
            return sp_fail_memory(error);
        output->entries = grown;
        output->capacity = capacity;
    }
    output->entries[output->count] = (sp_output_entry){0};
    return &output->entries[output->count];
}

static sp_output_entry *entry_of(sp_output *output, const char *name, sp_error *error)
{
    if (!name[0] || strchr(name, '/')) {
        sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "\"%s\" is no plain name of a file", name);
        return NULL;
    }
    for (size_t i = 0; i < output->count; ++i)
        if (strcmp(output->entries[i].name, name) == 0)
            return &output->entries[i];
    sp_output_entry *made = next_entry(output, error);
    if (!made)
        return NULL;
    made->target = joined(output->directory, "", "", name);
    made->temporary = joined(output->directory, output->staging.name, "/new/", name);
    if (!made->target || !made->temporary)
        sp_fail_memory(error);
    else if (sp_output_allows(output, name, made->target, error)) {
        made->name = strrchr(made->target, '/') + 1;
        output->count++;
        return made;
    }
    free(made->target);
    free(made->temporary);
    return NULL;
}

const char *sp_output_path(sp_output *output, const char *name, sp_error *error)
{
    if (!output || !name)
        return NULL;
    const sp_output_entry *entry = entry_of(output, name, error);
    return entry ? entry->temporary : NULL;
}

bool sp_output_may_replace(sp_output *output, const char *name, bool force, sp_error *error)
{
    if (!output || !name)
        return false;
    const sp_output_entry *entry = entry_of(output, name, error);
    sp_digest seal = entry ? sp_digest_check(output->folder, name, error) : SP_SEAL_UNKNOWN;
    if (seal == SP_SEAL_BROKEN && !force)
        return sp_fail(
            error, SP_ERROR_FILE, entry->target, 0, 0,
            "was edited since it was written, or is not sprayplan's; expected another folder to write to, or to "
            "force it (--force)");
    return seal != SP_SEAL_UNKNOWN;
}

bool sp_output_scene(sp_output *output, const char *name, const char *text, bool force, sp_error *error)
{
    if (!text)
        return false;
    char *sealed = sp_output_may_replace(output, name, force, error) ? sp_digest_text(text, error) : NULL;
    bool good = sealed && sp_output_text(output, name, sealed, error);
    free(sealed);
    return good;
}

size_t sp_output_count(const sp_output *output)
{
    return output->count;
}

const char *sp_output_name(const sp_output *output, size_t index)
{
    return output->entries[index].name;
}

void sp_output_tell(const sp_output *output, sp_error *error)
{
    for (size_t i = 0; output && error && error->kind != SP_OK && i < output->count; i++)
        if (strcmp(error->file, output->entries[i].temporary) == 0)
            snprintf(error->file, sizeof error->file, "%s", output->entries[i].target);
}

bool sp_output_bytes(sp_output *output, const char *name, const void *bytes, size_t size, sp_error *error)
{
    if (!bytes)
        return false;
    const char *path = sp_output_path(output, name, error);
    if (path && sp_write_file(path, bytes, size, error))
        return true;
    sp_output_tell(output, error);
    return false;
}

bool sp_output_text(sp_output *output, const char *name, const char *text, sp_error *error)
{
    if (!text)
        return false;
    return sp_output_bytes(output, name, text, strlen(text), error);
}

bool sp_output_commit(sp_output *output, sp_error *error)
{
    if (!output)
        return sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "there is no output to commit");
    if (!sp_output_move(output, error)) {
        sp_output_discard(output);
        return false;
    }
    sp_staging_remove(output->folder, &output->staging);
    output_free(output);
    return true;
}

void sp_output_discard(sp_output *output)
{
    if (!output)
        return;
    sp_staging_remove(output->folder, &output->staging);
    remove_folders(output);
    output_free(output);
}
