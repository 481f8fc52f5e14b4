/* A set of files that appears whole or not at all. */
#include <sprayplan/result.h>

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct {
    char *target, *temporary;
    char *backup;           /* a second name of what target was, while commit is under way */
    bool existed, replaced; /* before commit; by commit */
} entry;

struct sp_output {
    char *directory;
    bool made; /* the directory is ours */
    size_t count, capacity;
    entry *entries;
    size_t protected_count;
    struct stat *protected_files; /* only their device and inode */
};

static char *joined(const char *directory, const char *before, long number, const char *name)
{
    size_t size = strlen(directory) + strlen(before) + strlen(name) + 40;
    char *path = malloc(size);
    if (!path)
        return NULL;
    if (before[0])
        snprintf(path, size, "%s/.%s-%ld-%s", directory, before, number, name);
    else
        snprintf(path, size, "%s/%s", directory, name);
    return path;
}

static void output_free(sp_output *output)
{
    for (size_t i = 0; i < output->count; ++i) {
        free(output->entries[i].target);
        free(output->entries[i].temporary);
        free(output->entries[i].backup);
    }
    free(output->entries);
    free(output->protected_files);
    free(output->directory);
    free(output);
}

/* Makes what is missing of the folders above `path`, which is changed meanwhile; whether that worked shows when the
 * folder itself is made. */
static void make_parents(char *path)
{
    for (char *slash = strchr(path + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = 0;
        mkdir(path, 0777);
        *slash = '/';
    }
}

sp_output *sp_output_open(const char *directory, sp_error *error)
{
    sp_output *output = calloc(1, sizeof *output);
    char *copy = malloc(strlen(directory) + 1);
    if (!output || !copy) {
        free(output);
        free(copy);
        return sp_fail_memory(error);
    }
    output->directory = strcpy(copy, directory);
    make_parents(output->directory);
    output->made = mkdir(directory, 0777) == 0;
    struct stat status;
    if (!output->made && errno != EEXIST)
        sp_fail(error, SP_ERROR_FILE, directory, 0, 0, "cannot make this folder: %s", strerror(errno));
    else if (stat(directory, &status) != 0)
        sp_fail(error, SP_ERROR_FILE, directory, 0, 0, "cannot be opened: %s", strerror(errno));
    else if (!S_ISDIR(status.st_mode))
        sp_fail(error, SP_ERROR_FILE, directory, 0, 0, "is a file, expected a folder to write to");
    else
        return output;
    output_free(output);
    return NULL;
}

bool sp_output_protect(sp_output *output, const char *path, sp_error *error)
{
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

static bool target_allowed(const sp_output *output, const char *target, sp_error *error)
{
    struct stat status;
    if (stat(target, &status) != 0)
        return true;
    if (S_ISDIR(status.st_mode))
        return sp_fail(error, SP_ERROR_FILE, target, 0, 0, "is a folder, expected nothing or a file to replace");
    for (size_t i = 0; i < output->protected_count; ++i)
        if (output->protected_files[i].st_dev == status.st_dev && output->protected_files[i].st_ino == status.st_ino)
            return sp_fail(error, SP_ERROR_FILE, target, 0, 0,
                           "would replace a file that was read, expected another folder to write to");
    return true;
}

/* The temporary file is made here and now, so that two programs at work in one folder never share one. */
static char *reserve(const sp_output *output, const char *name, sp_error *error)
{
    for (long attempt = 0; attempt < 1000; ++attempt) {
        char *path = joined(output->directory, "writing", (long)getpid() * 1000 + attempt, name);
        if (!path)
            return sp_fail_memory(error);
        int file = open(path, O_WRONLY | O_CREAT | O_EXCL, 0666);
        if (file >= 0) {
            close(file);
            return path;
        }
        int cause = errno;
        if (cause != EEXIST) {
            sp_fail(error, SP_ERROR_FILE, path, 0, 0, "cannot be written: %s", strerror(cause));
            free(path);
            return NULL;
        }
        free(path);
    }
    sp_fail(error, SP_ERROR_FILE, output->directory, 0, 0, "is full of unfinished files, expected at most a few");
    return NULL;
}

static entry *next_entry(sp_output *output, sp_error *error)
{
    if (output->count == output->capacity) {
        size_t capacity = output->capacity ? 2 * output->capacity : 16;
        entry *grown = realloc(output->entries, capacity * sizeof *grown);
        if (!grown)
            return sp_fail_memory(error);
        output->entries = grown;
        output->capacity = capacity;
    }
    output->entries[output->count] = (entry){0};
    return &output->entries[output->count];
}

const char *sp_output_path(sp_output *output, const char *name, sp_error *error)
{
    if (!name[0] || strchr(name, '/')) {
        sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "\"%s\" is no plain name of a file", name);
        return NULL;
    }
    entry *made = next_entry(output, error);
    char *target = made ? joined(output->directory, "", 0, name) : NULL;
    if (!target)
        return sp_fail_memory(error);
    for (size_t i = 0; i < output->count; ++i)
        if (strcmp(output->entries[i].target, target) == 0) {
            free(target);
            return output->entries[i].temporary;
        }
    char *temporary = target_allowed(output, target, error) ? reserve(output, name, error) : NULL;
    if (!temporary) {
        free(target);
        return NULL;
    }
    made->target = target;
    made->temporary = temporary;
    output->count++;
    return temporary;
}

bool sp_output_bytes(sp_output *output, const char *name, const void *bytes, size_t size, sp_error *error)
{
    const char *path = sp_output_path(output, name, error);
    if (!path)
        return false;
    FILE *file = fopen(path, "wb");
    if (!file)
        return sp_fail(error, SP_ERROR_FILE, path, 0, 0, "cannot be written: %s", strerror(errno));
    bool written = fwrite(bytes, 1, size, file) == size;
    int cause = errno;
    if (fclose(file) != 0 && written) {
        written = false;
        cause = errno;
    }
    return written || sp_fail(error, SP_ERROR_FILE, path, 0, 0, "cannot be written: %s", strerror(cause));
}

bool sp_output_text(sp_output *output, const char *name, const char *text, sp_error *error)
{
    return sp_output_bytes(output, name, text, strlen(text), error);
}

/* A second name for what is about to be replaced. A file system without links keeps none; its rename must do. */
static bool keep_old(const sp_output *output, entry *file, sp_error *error)
{
    const char *name = strrchr(file->target, '/') + 1;
    file->backup = joined(output->directory, "replaced", (long)getpid(), name);
    if (!file->backup)
        return sp_fail_memory(error);
    file->existed = access(file->target, F_OK) == 0;
    if (link(file->target, file->backup) != 0) {
        free(file->backup);
        file->backup = NULL;
    }
    return true;
}

static void put_back(sp_output *output)
{
    for (size_t i = output->count; i-- > 0;) {
        entry *file = &output->entries[i];
        if (file->backup && file->replaced)
            rename(file->backup, file->target);
        else if (file->backup)
            unlink(file->backup);
        else if (file->replaced && !file->existed)
            unlink(file->target);
    }
}

static bool move_all(sp_output *output, sp_error *error)
{
    for (size_t i = 0; i < output->count; ++i) {
        entry *file = &output->entries[i];
        if (!target_allowed(output, file->target, error) || !keep_old(output, file, error))
            return false;
        if (rename(file->temporary, file->target) != 0)
            return sp_fail(error, SP_ERROR_FILE, file->target, 0, 0, "cannot be written: %s", strerror(errno));
        file->replaced = true;
    }
    return true;
}

bool sp_output_commit(sp_output *output, sp_error *error)
{
    if (!output)
        return sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "there is no output to commit");
    if (!move_all(output, error)) {
        put_back(output);
        sp_output_discard(output);
        return false;
    }
    for (size_t i = 0; i < output->count; ++i)
        if (output->entries[i].backup)
            unlink(output->entries[i].backup);
    output_free(output);
    return true;
}

void sp_output_discard(sp_output *output)
{
    if (!output)
        return;
    for (size_t i = 0; i < output->count; ++i)
        unlink(output->entries[i].temporary);
    /* Only an empty folder goes, so what somebody else put there meanwhile stays. */
    if (output->made)
        rmdir(output->directory);
    output_free(output);
}
