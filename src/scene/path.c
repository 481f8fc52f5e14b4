/* Paths: relative to the scene, to the working directory, and from one directory to another. */
#include "scene/state.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static char *join(const char *first, const char *between, const char *last, sp_error *error)
{
    size_t size = strlen(first) + strlen(between) + strlen(last) + 1;
    char *path = malloc(size);
    if (!path)
        return sp_fail_memory(error);
    snprintf(path, size, "%s%s%s", first, between, last);
    return path;
}

char *sp_path_join(const char *directory, const char *file, sp_error *error)
{
    if (file[0] == '/' || strcmp(directory, ".") == 0)
        return join("", "", file, error);
    return join(directory, directory[strlen(directory) - 1] == '/' ? "" : "/", file, error);
}

char *sp_path_directory(const char *path, sp_error *error)
{
    const char *slash = strrchr(path, '/');
    char *directory = join("", "", slash ? path : ".", error);
    if (directory && slash)
        directory[slash == path ? 1 : slash - path] = '\0';
    return directory;
}

char *sp_scene_file(const char *directory, const char *owner, const sp_reader *reader, const sp_yaml *node,
                    const char *key)
{
    const char *name = sp_read_text(reader, node, key, "the path of a file");
    char *path = name ? sp_path_join(directory, name, reader->error) : NULL;
    struct stat status;
    if (!path)
        return NULL;
    if (stat(path, &status) != 0)
        sp_fail(reader->error, SP_ERROR_INPUT, node->file, node->line, node->column,
                "%s: found '%.300s', which cannot be opened (%s), expected a file, relative to %s", key, name,
                strerror(errno), owner);
    else if (!S_ISREG(status.st_mode))
        sp_fail(reader->error, SP_ERROR_INPUT, node->file, node->line, node->column,
                "%s: found '%.300s', which is no regular file, expected a file, relative to %s", key, name, owner);
    else
        return path;
    free(path);
    return NULL;
}

/* The real path of a directory that may not exist yet: symbolic links are followed as far as it does. */
static char *real_directory(const char *path, sp_error *error)
{
    char *real = realpath(path, NULL);
    if (real)
        return real;
    int reason = errno;
    if (reason == ENOMEM)
        return sp_fail_memory(error);
    char *trimmed = join("", "", path, error);
    if (!trimmed)
        return NULL;
    for (size_t n = strlen(trimmed); n > 1 && trimmed[n - 1] == '/'; n--)
        trimmed[n - 1] = '\0';
    const char *slash = strrchr(trimmed, '/'), *name = slash ? slash + 1 : trimmed;
    char *whole = NULL;
    if (reason == ENOENT && *name && strcmp(name, ".") != 0 && strcmp(name, "..") != 0) {
        char *above = sp_path_directory(trimmed, error);
        char *base = above ? real_directory(above, error) : NULL;
        whole = base ? join(strcmp(base, "/") == 0 ? "" : base, "/", name, error) : NULL;
        free(above);
        free(base);
    } else {
        sp_fail(error, SP_ERROR_FILE, path, 0, 0, "cannot resolve this path: %s", strerror(reason));
    }
    free(trimmed);
    return whole;
}

/* From one absolute directory without links or dots to another: up to the last one that they share, then down. */
static char *route(const char *from, const char *to, sp_error *error)
{
    size_t shared = 0, ups = 0;
    for (size_t i = 0;; i++) {
        if ((!from[i] || from[i] == '/') && (!to[i] || to[i] == '/'))
            shared = i;
        if (!from[i] || from[i] != to[i])
            break;
    }
    for (const char *c = from + shared; *c; c++)
        ups += *c == '/';
    const char *down = to + shared + (to[shared] == '/');
    char *path = malloc(3 * ups + strlen(down) + 2);
    if (!path)
        return sp_fail_memory(error);
    for (size_t i = 0; i < ups; i++)
        memcpy(path + 3 * i, "../", 3);
    sprintf(path + 3 * ups, "%s%s", down, *down ? "/" : "");
    return path;
}

char *sp_path_relative(const char *path, const char *directory, sp_error *error)
{
    const char *slash = strrchr(path, '/');
    char *above = sp_path_directory(path, error);
    char *to = above ? real_directory(above, error) : NULL;
    char *from = to ? real_directory(directory, error) : NULL;
    char *way = from ? route(strcmp(from, "/") == 0 ? "" : from, strcmp(to, "/") == 0 ? "" : to, error) : NULL;
    char *relative = way ? join(way, "", slash ? slash + 1 : path, error) : NULL;
    free(above);
    free(to);
    free(from);
    free(way);
    return relative;
}
