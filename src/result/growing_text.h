/* Text that grows as it is written. */
#ifndef RESULT_GROWING_TEXT_H
#define RESULT_GROWING_TEXT_H

#include <sprayplan/error.h>

#include <stddef.h>

/* Starts as {0}. Once an allocation has failed, further additions do nothing and finish reports it. */
typedef struct {
    char *text;
    size_t length, capacity;
    bool failed;
} sp_text;

void sp_text_append(sp_text *text, const char *bytes, size_t length);
void sp_text_add(sp_text *text, const char *format, ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 2, 3)))
#endif
    ;
/* With as few digits (15 to 17) as read back exactly. */
void sp_text_number(sp_text *text, double value);
/* The terminated text, the caller's to free; NULL (and nothing left to free) where memory ran out. */
char *sp_text_finish(sp_text *text, sp_error *error);

/* A malloc'd copy in which every byte that is not part of valid UTF-8 (RFC 3629), and every control character, is
 * U+FFFD: names come from files of strangers. NULL where memory ran out. */
char *sp_text_utf8(const char *bytes);

#endif
