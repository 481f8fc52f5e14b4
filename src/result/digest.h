/* Files that people may edit: a first line holds the digest of all that follows, which tells what is still as it was
 * written. */
#ifndef RESULT_DIGEST_H
#define RESULT_DIGEST_H

#include <sprayplan/error.h>

#include <stdbool.h>

typedef enum {
    SP_SEAL_ABSENT,  /* there is no file of that name */
    SP_SEAL_WHOLE,   /* as it was written */
    SP_SEAL_BROKEN,  /* edited since, or by somebody else */
    SP_SEAL_UNKNOWN, /* with an error: memory ran out */
} sp_digest;

/* `folder` is a descriptor. */
sp_digest sp_digest_check(int folder, const char *name, sp_error *error);
/* The text with that line, a comment in YAML, in front; malloc'd. */
char *sp_digest_text(const char *text, sp_error *error);
/* Whether files of that name are sealed: layout.yaml, layout-1.yaml, layout-2.yaml, .. */
bool sp_digest_is_for(const char *name);

#endif
