#include "growing_text.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool make_room(sp_text *text, size_t length)
{
    if (text->failed || length > SIZE_MAX / 4 - text->length) {
        text->failed = true;
        return false;
    }
    size_t needed = text->length + length + 1;
    if (needed <= text->capacity)
        return true;
    size_t capacity = needed + needed / 2 + 256;
    char *grown = realloc(text->text, capacity);
    if (!grown) {
        text->failed = true;
        return false;
    }
    text->text = grown;
    text->capacity = capacity;
    return true;
}

void sp_text_append(sp_text *text, const char *bytes, size_t length)
{
    if (!make_room(text, length))
        return;
    if (length > 0) /* of nothing there may be no bytes */
        memcpy(text->text + text->length, bytes, length);
    text->length += length;
    text->text[text->length] = 0;
}

void sp_text_add(sp_text *text, const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    if (length < 0)
        text->failed = true;
    else if (make_room(text, (size_t)length)) {
        vsnprintf(text->text + text->length, (size_t)length + 1, format, again);
        text->length += (size_t)length;
    }
    va_end(again);
}

void sp_text_number(sp_text *text, double value)
{
    char digits[40];
    for (int precision = 15; precision <= 17; ++precision) {
        snprintf(digits, sizeof digits, "%.*g", precision, value);
        if (strtod(digits, NULL) == value)
            break;
    }
    sp_text_append(text, digits, strlen(digits));
}

char *sp_text_finish(sp_text *text, sp_error *error)
{
    if (!text->failed && make_room(text, 0)) {
        text->text[text->length] = 0;
        return text->text;
    }
    free(text->text);
    *text = (sp_text){0};
    return sp_fail_memory(error);
}

/* Bytes of the valid UTF-8 sequence at `at`; 0 where there is none. Unicode 15, table 3-7. */
static size_t sequence_length(const unsigned char *at)
{
    if (at[0] < 0x80)
        return at[0] >= 0x20 && at[0] != 0x7f ? 1 : 0;
    size_t length = at[0] >= 0xc2 && at[0] <= 0xdf ? 2 : at[0] >= 0xe0 && at[0] <= 0xef ? 3 : 4;
    if (at[0] < 0xc2 || at[0] > 0xf4)
        return 0;
    unsigned char low = at[0] == 0xe0 ? 0xa0 : at[0] == 0xf0 ? 0x90 : 0x80;
    unsigned char high = at[0] == 0xed ? 0x9f : at[0] == 0xf4 ? 0x8f : 0xbf;
    if (at[1] < low || at[1] > high || (at[0] == 0xc2 && at[1] < 0xa0))
        return 0;
    for (size_t i = 2; i < length; ++i)
        if ((at[i] & 0xc0) != 0x80)
            return 0;
    return length;
}

char *sp_text_utf8(const char *bytes)
{
    sp_text text = {0};
    for (const char *at = bytes; *at;) {
        size_t length = sequence_length((const unsigned char *)at);
        if (length)
            sp_text_append(&text, at, length);
        else
            sp_text_append(&text, "\xef\xbf\xbd", 3);
        at += length ? length : 1;
    }
    char *whole = sp_text_finish(&text, NULL), *fitting = whole ? realloc(whole, text.length + 1) : NULL;
    return fitting ? fitting : whole;
}
