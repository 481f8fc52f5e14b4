/* A prepared set of files goes to its places.
 *
 * POSIX replaces one file at a time, so nobody who looks meanwhile sees all of them change at once; whoever writes
 * comes first to one rename that decides: the staging folder, whole and on the disk, takes the name .sprayplan-commit.
 * Killed before that, all files are the old ones and the next run removes what was prepared; killed after it, the next
 * commit finds the folder with nobody at its lock and moves what is left in it, so that all files are the new ones. The
 * name is also what one run at a time can have: sets of several runs do not mix. Another folder in the place of the
 * whole one (RENAME_EXCHANGE) would show all at once, but take with it what others have there, its links and its
 * mounts. */
#include "result/output.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define PATIENCE 3000 /* times WAIT */
#define WAIT 10000000 /* ns */

static bool refuse(const char *path, sp_error *error)
{
    return sp_fail(error, SP_ERROR_FILE, path, 0, 0, "cannot be written: %s", strerror(errno));
}

/* To the disk, where the file system knows how to. */
static bool settle(int file)
{
    return file >= 0 && (fsync(file) == 0 || errno == EINVAL || errno == ENOSYS);
}

/* All that was prepared is on the disk before anything is replaced. */
static bool settle_all(const sp_output *output, sp_error *error)
{
    for (size_t i = 0; i < output->count; i++) {
        int file = openat(output->staging.fresh, output->entries[i].name, O_RDONLY | O_CLOEXEC);
        bool settled = settle(file);
        int cause = errno;
        if (file >= 0)
            close(file);
        errno = cause;
        if (!settled)
            return refuse(output->entries[i].target, error);
    }
    return (settle(output->staging.fresh) && settle(output->staging.folder)) || refuse(output->directory, error);
}

typedef struct {
    const sp_output *output;
    const sp_staging *left;
} recovery;

static bool move_left(void *user, const char *name)
{
    const recovery *r = user;
    return !sp_output_allows(r->output, name, name, NULL) ||
           renameat(r->left->fresh, name, r->output->folder, name) == 0;
}

/* What a killed run had begun to move. */
static bool finish(const sp_output *output, sp_staging *left, sp_error *error)
{
    recovery r = {output, left};
    bool done = sp_move_superseded(output, left, error);
    if (done && left->fresh >= 0 && (!sp_each_name(left->fresh, move_left, &r) || !settle(output->folder)))
        done = refuse(output->directory, error);
    if (done)
        sp_staging_remove(output->folder, left);
    sp_staging_close(left);
    return done;
}

/* The folder has the name that one at a time can have: its owner is waited for, or finished where there is none. */
static bool seize(sp_output *output, sp_error *error)
{
    sp_staging *staging = &output->staging, other;
    for (int waited = 0; waited < PATIENCE; waited++) {
        if (renameat(output->folder, staging->name, output->folder, SP_STAGING_COMMIT) == 0) {
            snprintf(staging->name, sizeof staging->name, "%s", SP_STAGING_COMMIT);
            return true;
        }
        if (errno != EEXIST && errno != ENOTEMPTY)
            return refuse(output->directory, error);
        sp_staging_state state = sp_staging_open(output->folder, SP_STAGING_COMMIT, &other);
        if (state == SP_STAGING_UNKNOWN)
            break;
        if (state == SP_STAGING_DEAD && !finish(output, &other, error))
            return false;
        if (state != SP_STAGING_DEAD)
            nanosleep(&(struct timespec){.tv_nsec = WAIT}, NULL);
    }
    return sp_fail(error, SP_ERROR_FILE, output->directory, 0, 0,
                   "is being written to by another run, or has a folder %s that cannot be removed", SP_STAGING_COMMIT);
}

/* What was there keeps a second name. A file system without links has it without the first for a moment. */
static bool keep_old(const sp_output *output, const char *name)
{
    int folder = output->folder, old = output->staging.old;
    return linkat(folder, name, old, name, 0) == 0 || errno == ENOENT || renameat(folder, name, old, name) == 0;
}

static bool put_back(sp_output *output)
{
    bool done = sp_put_superseded_back(output);
    for (size_t i = output->count; i-- > 0;) {
        const sp_output_entry *file = &output->entries[i];
        if (renameat(output->staging.old, file->name, output->folder, file->name) != 0)
            done = errno == ENOENT && (!file->moved || unlinkat(output->folder, file->name, 0) == 0) && done;
    }
    return done;
}

static bool move_all(sp_output *output, sp_error *error)
{
    for (size_t i = 0; i < output->count; i++) {
        sp_output_entry *file = &output->entries[i];
        if (!sp_output_allows(output, file->name, file->target, error))
            return false;
        if (!keep_old(output, file->name) ||
            renameat(output->staging.fresh, file->name, output->folder, file->name) != 0)
            return refuse(file->target, error);
        file->moved = true;
    }
    return settle(output->folder) || refuse(output->directory, error);
}

bool sp_output_move(sp_output *output, sp_error *error)
{
    if (!settle_all(output, error) || !seize(output, error))
        return false;
    if ((settle(output->folder) || refuse(output->directory, error)) &&
        sp_move_superseded(output, &output->staging, error) && move_all(output, error))
        return true;
    if (!put_back(output))
        sp_staging_close(&output->staging);
    return false;
}
