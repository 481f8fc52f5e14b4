/* A folder DIR/.sprayplan-new-* in which a set of files is prepared for DIR. The file `lock` in it is locked for
 * as long as the process lives that made it, so that what a killed process left is known, on whichever machine, and
 * goes. */
#ifndef RESULT_STAGING_H
#define RESULT_STAGING_H

#include <sprayplan/error.h>

#include <stddef.h>

#define SP_STAGING_COMMIT ".sprayplan-commit" /* the name of the one that is being moved to its places */

typedef struct {
    char name[32];                /* in DIR */
    int folder, fresh, old, lock; /* descriptors of it, of new/ and old/ in it, and of the lock; -1: there is none */
} sp_staging;

typedef enum { SP_STAGING_NONE, SP_STAGING_ALIVE, SP_STAGING_DEAD, SP_STAGING_UNKNOWN } sp_staging_state;

/* `folder` is a descriptor of DIR, which `directory` names. Removes the dead ones there that never came to commit. */
bool sp_staging_create(const char *directory, int folder, sp_staging *staging, sp_error *error);
/* Opens the one of that name. Only a dead one is then open, and locked: what is in it is the caller's. Unknown: errno
 * says why. */
sp_staging_state sp_staging_open(int folder, const char *name, sp_staging *staging);
/* With all that is in it. */
void sp_staging_remove(int folder, sp_staging *staging);
void sp_staging_close(sp_staging *staging);

/* Calls for every name in a folder until one call is false. */
bool sp_each_name(int folder, bool (*call)(void *user, const char *name), void *user);

#endif
