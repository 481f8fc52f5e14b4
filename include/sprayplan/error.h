/* Errors: what went wrong and where. */
#ifndef SPRAYPLAN_ERROR_H
#define SPRAYPLAN_ERROR_H

#include <sprayplan/export.h>

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    SP_OK = 0,
    SP_ERROR_INPUT,       /* a file that is read is missing, or holds something that is not allowed; a wrong setting */
    SP_ERROR_FILE,        /* a file cannot be written */
    SP_ERROR_MEMORY,      /* an allocation failed */
    SP_ERROR_ARGUMENT,    /* a function was called with arguments that make no sense */
    SP_ERROR_UNSUPPORTED, /* well formed, but not built yet */
    SP_ERROR_INTERRUPTED, /* the progress callback asked to stop and there is nothing to return */
} sp_error_kind;

/* Starts as {0}, in C++ as well, where no enumeration may stand first for it. Plain data that owns nothing: it may be
 * copied and needs no freeing. */
typedef struct {
    int line, column;  /* from 1; 0 where unknown */
    char message[768]; /* what was found, what was expected; no control characters */
    char file[512];    /* empty where no file is concerned */
    sp_error_kind kind;
} sp_error;

/* Records an error unless `error` is NULL or holds one already: the first error is the cause, later ones are its
 * consequences. `file` may be NULL. Returns false always, so that `return sp_fail(...)` reads well. */
SP_API bool sp_fail(sp_error *error, sp_error_kind kind, const char *file, int line, int column, const char *format,
                    ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 6, 7)))
#endif
    ;

/* As sp_fail with SP_ERROR_MEMORY; returns NULL always. */
SP_API void *sp_fail_memory(sp_error *error);

/* Writes "file:line:column: message" (the parts that are known) to `text` of `size` bytes, always terminated. */
SP_API void sp_error_text(const sp_error *error, char *text, unsigned long size);

#ifdef __cplusplus
}
#endif
#endif
