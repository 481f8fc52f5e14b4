#include <sprayplan/error.h>

#include <stdarg.h>
#include <stdio.h>

bool sp_fail(sp_error *error, sp_error_kind kind, const char *file, int line, int column, const char *format, ...)
{
    if (!error || error->kind != SP_OK)
        return false;
    error->kind = kind;
    error->line = line;
    error->column = column;
    snprintf(error->file, sizeof error->file, "%s", file ? file : "");
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error->message, sizeof error->message, format, arguments);
    va_end(arguments);
    for (char *at = error->message; *at; at++)
        if ((unsigned char)*at < ' ' || *at == 127)
            *at = '?';
    return false;
}

void *sp_fail_memory(sp_error *error)
{
    sp_fail(error, SP_ERROR_MEMORY, NULL, 0, 0, "out of memory");
    return NULL;
}

void sp_error_text(const sp_error *error, char *text, unsigned long size)
{
    if (error->file[0] && error->line > 0 && error->column > 0)
        snprintf(text, size, "%s:%d:%d: %s", error->file, error->line, error->column, error->message);
    else if (error->file[0] && error->line > 0)
        snprintf(text, size, "%s:%d: %s", error->file, error->line, error->message);
    else if (error->file[0])
        snprintf(text, size, "%s: %s", error->file, error->message);
    else
        snprintf(text, size, "%s", error->message);
}
