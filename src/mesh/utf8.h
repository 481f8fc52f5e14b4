/* Names as UTF-8. */
#ifndef MESH_UTF8_H
#define MESH_UTF8_H

#include <stddef.h>

/* Copies the text to where there is room for twice its length, without a zero behind it; returns how long it is there.
 * Bytes that are no UTF-8 are taken for Latin-1, which older programs write: every byte a character, so that different
 * names stay different. */
size_t sp_utf8_append(char *to, const char *text, size_t length);

/* How much of the text, from its beginning, is UTF-8. */
size_t sp_utf8_length(const char *text, size_t length);

#endif
