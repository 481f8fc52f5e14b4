#include "mesh/utf8.h"

#include <stdbool.h>
#include <string.h>

/* Length of the UTF-8 character at `at`, 0 where the bytes are none (RFC 3629: no overlong forms, no surrogates). */
static size_t character_length(const unsigned char *at, const unsigned char *end)
{
    if (at[0] < 0x80)
        return 1;
    size_t length = at[0] < 0xC2 ? 0 : at[0] < 0xE0 ? 2 : at[0] < 0xF0 ? 3 : at[0] < 0xF5 ? 4 : 0;
    if (length == 0 || (size_t)(end - at) < length)
        return 0;
    for (size_t i = 1; i < length; i++)
        if ((at[i] & 0xC0) != 0x80)
            return 0;
    bool overlong = (at[0] == 0xE0 && at[1] < 0xA0) || (at[0] == 0xF0 && at[1] < 0x90);
    bool surrogate = at[0] == 0xED && at[1] >= 0xA0;
    bool beyond = at[0] == 0xF4 && at[1] >= 0x90;
    return overlong || surrogate || beyond ? 0 : length;
}

size_t sp_utf8_length(const char *text, size_t length)
{
    const unsigned char *at = (const unsigned char *)text, *end = at + length;
    for (size_t of_one; at < end && (of_one = character_length(at, end)) > 0;)
        at += of_one;
    return (size_t)((const char *)at - text);
}

size_t sp_utf8_append(char *to, const char *text, size_t length)
{
    size_t at = 0;
    if (sp_utf8_length(text, length) == length) {
        memcpy(to, text, length);
        return length;
    }
    for (size_t i = 0; i < length; i++) {
        unsigned char c = (unsigned char)text[i];
        if (c >= 0x80) {
            to[at++] = (char)(0xC0 | c >> 6);
            c = 0x80 | (c & 0x3F);
        }
        to[at++] = (char)c;
    }
    return at;
}
