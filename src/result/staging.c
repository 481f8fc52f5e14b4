#include "result/staging.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#define PREFIX ".sprayplan-new-"
#define ATTEMPTS 100

static const sp_staging none = {.folder = -1, .fresh = -1, .old = -1, .lock = -1};

bool sp_each_name(int folder, bool (*call)(void *user, const char *name), void *user)
{
    int own = openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *list = own >= 0 ? fdopendir(own) : NULL;
    if (!list) {
        if (own >= 0)
            close(own);
        return false;
    }
    bool good = true;
    for (struct dirent *entry; good && (entry = readdir(list));)
        good = !strcmp(entry->d_name, ".") || !strcmp(entry->d_name, "..") || call(user, entry->d_name);
    closedir(list);
    return good;
}

void sp_staging_close(sp_staging *staging)
{
    const int descriptors[] = {staging->fresh, staging->old, staging->folder, staging->lock};
    for (size_t i = 0; i < sizeof descriptors / sizeof *descriptors; i++)
        if (descriptors[i] >= 0)
            close(descriptors[i]);
    *staging = none;
}

static bool remove_file(void *user, const char *name)
{
    unlinkat(*(const int *)user, name, 0);
    return true;
}

/* The lock goes last: what has none is empty, and any rename may take its place; what cannot be emptied keeps it. */
void sp_staging_remove(int folder, sp_staging *staging)
{
    if (staging->fresh >= 0)
        sp_each_name(staging->fresh, remove_file, &staging->fresh);
    if (staging->old >= 0)
        sp_each_name(staging->old, remove_file, &staging->old);
    static const struct {
        const char *name;
        int flags;
    } parts[] = {{"new", AT_REMOVEDIR}, {"old", AT_REMOVEDIR}, {"supersedes", 0}, {"lock", 0}};
    bool empty = true;
    for (size_t i = 0; staging->folder >= 0 && empty && i < sizeof parts / sizeof *parts; i++)
        empty = unlinkat(staging->folder, parts[i].name, parts[i].flags) == 0 || errno == ENOENT;
    unlinkat(folder, staging->name, AT_REMOVEDIR);
    sp_staging_close(staging);
}

static int open_folder(int in, const char *name)
{
    return openat(in, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

/* What this process holds alone now, or nobody does any more: an unlinked lock is that of no folder. */
static sp_staging_state try_lock(int lock)
{
    struct stat status;
    if (flock(lock, LOCK_EX | LOCK_NB) != 0)
        return errno == EWOULDBLOCK || errno == EINTR ? SP_STAGING_ALIVE : SP_STAGING_UNKNOWN;
    if (fstat(lock, &status) != 0)
        return SP_STAGING_UNKNOWN;
    return status.st_nlink > 0 ? SP_STAGING_DEAD : SP_STAGING_NONE;
}

sp_staging_state sp_staging_open(int folder, const char *name, sp_staging *staging)
{
    *staging = none;
    snprintf(staging->name, sizeof staging->name, "%s", name);
    staging->folder = open_folder(folder, name);
    staging->lock = staging->folder >= 0 ? openat(staging->folder, "lock", O_RDWR | O_NOFOLLOW | O_CLOEXEC) : -1;
    sp_staging_state state = staging->lock >= 0 ? try_lock(staging->lock)
                             : errno == ENOENT  ? SP_STAGING_NONE
                                                : SP_STAGING_UNKNOWN;
    int cause = errno;
    if (state != SP_STAGING_DEAD) {
        sp_staging_close(staging);
        errno = cause;
        return state;
    }
    staging->fresh = open_folder(staging->folder, "new");
    staging->old = open_folder(staging->folder, "old");
    return state;
}

static bool sweep(void *user, const char *name)
{
    int folder = *(const int *)user;
    sp_staging left;
    if (strncmp(name, PREFIX, strlen(PREFIX)) != 0 || strlen(name) >= sizeof left.name)
        return true;
    sp_staging_state state = sp_staging_open(folder, name, &left);
    if (state == SP_STAGING_DEAD)
        sp_staging_remove(folder, &left);
    else if (state == SP_STAGING_NONE)
        unlinkat(folder, name, AT_REMOVEDIR); /* without a lock yet, if it is not empty: then it stays */
    return true;
}

/* False where another process swept it away before it was locked, or with another errno than ENOENT for good. */
static bool fill(int folder, sp_staging *staging)
{
    errno = 0;
    staging->folder = open_folder(folder, staging->name);
    if (staging->folder < 0)
        return false;
    staging->lock = openat(staging->folder, "lock", O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (staging->lock < 0)
        return false;
    sp_staging_state state = try_lock(staging->lock);
    errno = ENOENT;
    if (state == SP_STAGING_NONE || state == SP_STAGING_ALIVE || mkdirat(staging->folder, "new", 0777) != 0 ||
        mkdirat(staging->folder, "old", 0777) != 0)
        return false;
    staging->fresh = open_folder(staging->folder, "new");
    staging->old = open_folder(staging->folder, "old");
    return staging->fresh >= 0 && staging->old >= 0;
}

bool sp_staging_create(const char *directory, int folder, sp_staging *staging, sp_error *error)
{
    sp_each_name(folder, sweep, &folder);
    size_t size = strlen(directory) + sizeof staging->name + 1;
    char *path = malloc(size);
    *staging = none;
    if (!path)
        return sp_fail_memory(error);
    bool done = false, again = true;
    for (int attempt = 0; !done && again && attempt < ATTEMPTS; attempt++) {
        snprintf(path, size, "%s/" PREFIX "XXXXXX", directory);
        bool made = mkdtemp(path) != NULL;
        if (made)
            snprintf(staging->name, sizeof staging->name, "%s", path + strlen(directory) + 1);
        done = made && fill(folder, staging);
        int cause = errno;
        again = made && cause == ENOENT;
        if (!done && made)
            sp_staging_remove(folder, staging);
        errno = cause;
    }
    free(path);
    return done || sp_fail(error, SP_ERROR_FILE, directory, 0, 0, "cannot be written to: %s", strerror(errno));
}
