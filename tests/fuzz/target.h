/* What a fuzz target is made of. Each feeds one reader with the bytes it is given and looks at what comes out;
 * libFuzzer calls it in the build for fuzzing, replay.c in the ordinary tests. */
#ifndef TESTS_FUZZ_TARGET_H
#define TESTS_FUZZ_TARGET_H

#include "meter.h"

#include <sprayplan/error.h>

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Whether the last input was taken for what it should be; in the target's own file. */
extern bool target_accepted;

/* Not assert: these builds have NDEBUG. */
#define REQUIRE(condition)                                                                                             \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #condition);                                    \
            abort();                                                                                                   \
        }                                                                                                              \
    } while (0)

/* The input with a zero behind it, and nothing behind that, so that a sanitizer sees what lies beyond. */
static inline char *target_text(const uint8_t *data, size_t size)
{
    char *text = malloc(size + 1);
    REQUIRE(text);
    if (size)
        memcpy(text, data, size);
    text[size] = '\0';
    return text;
}

/* What every file may take: ten times its size, and 64 MiB. */
static inline void require_frugal(size_t size)
{
    REQUIRE(meter_peak() <= 10 * size + ((size_t)64 << 20));
}

static inline bool is_located(const sp_error *error, const char *path, const uint8_t *data, size_t size)
{
    size_t lines = 1;
    for (size_t i = 0; i < size; i++)
        lines += data[i] == '\n' || data[i] == '\r';
    if (!error->message[0] || !memchr(error->message, '\0', sizeof error->message) || strcmp(error->file, path) != 0)
        return false;
    for (const char *at = error->message; *at; at++)
        if ((unsigned char)*at < ' ' || *at == 127)
            return false;
    return (error->kind == SP_ERROR_INPUT || error->kind == SP_ERROR_UNSUPPORTED) && error->line >= 0 &&
           (size_t)error->line <= lines && error->column >= 0 && (error->line > 0 || error->column == 0);
}

/* An error says what is wrong, in which file, and nowhere outside of it; nothing in it moves a terminal's cursor. */
static inline void require_located(const sp_error *error, const char *path, const uint8_t *data, size_t size)
{
    if (is_located(error, path, data, size))
        return;
    fprintf(stderr, "no error of %s: %d: %s:%d:%d: %s\n", path, error->kind, error->file, error->line, error->column,
            error->message);
    abort();
}

static inline void require_utf8(const char *text)
{
    const unsigned char *at = (const unsigned char *)text;
    while (*at) {
        int more = *at < 0x80 ? 0 : *at < 0xE0 ? 1 : *at < 0xF0 ? 2 : 3;
        uint32_t code = *at & (more == 0 ? 0x7Fu : 0x3Fu >> more);
        REQUIRE(*at < 0x80 || (*at >= 0xC2 && *at <= 0xF4));
        at++;
        for (; more > 0; more--, at++) {
            REQUIRE((*at & 0xC0) == 0x80);
            code = code << 6 | (*at & 0x3F);
        }
        REQUIRE(code >= ' ' && code != 127 && !(code >= 0xD800 && code < 0xE000) && code < 0x110000);
    }
}

#endif
