/* Arrays as the viewer's script reads them: little-endian one after the other, each from a multiple of four bytes on,
 * deflated (RFC 1950), and 13 bits, the least first, as two letters of 91, behind how many bytes that makes. */
#ifndef REPORT_VIEWER_PACKED_H
#define REPORT_VIEWER_PACKED_H

#include "report/markup.h"

#include <string.h>

/* Bytes that grow; starts as {0}. */
typedef sp_text sp_packed;

void sp_packed_bytes(sp_packed *packed, const uint8_t *values, size_t count);
/* With `differences` each as what it is more than the value before, modulo 2^16 and 2^32: such deflate better. */
void sp_packed_shorts(sp_packed *packed, const uint16_t *values, size_t count, bool differences);
void sp_packed_words(sp_packed *packed, const uint32_t *values, size_t count, bool differences);
/* Whole numbers that are mostly small: of each, twice its size, plus one where it is below 0, in as few bytes as it
 * takes. How many these are for each of them, then how many in all, then they. */
void sp_packed_numbers(sp_packed *packed, const int64_t *values, size_t count);
/* Vertices of triangles, which mostly come one after the other as triangles ask for them: each as what it is less than
 * the next of these, as sp_packed_numbers. False where memory runs out. */
bool sp_packed_corners(sp_packed *packed, const uint32_t *vertices, size_t count);
/* How many doubles `value` lies above `from`, modulo 2^64: the difference of their bits. */
static inline int64_t sp_packed_apart(double value, double from)
{
    uint64_t bits[2];
    memcpy(&bits[0], &value, sizeof value);
    memcpy(&bits[1], &from, sizeof from);
    bits[0] -= bits[1];
    int64_t apart;
    memcpy(&apart, bits, sizeof apart);
    return apart;
}
/* Deflated, as text that neither JSON nor HTML has to escape, malloc'd; NULL on error. */
char *sp_packed_finish(const sp_packed *packed, sp_error *error);
/* The same of bytes that nothing makes fewer. */
char *sp_packed_letters(const uint8_t *bytes, size_t count, sp_error *error);

#endif
