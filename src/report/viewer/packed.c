#include "packed.h"

#include <sprayplan/mesh.h>

#include <stdlib.h>
#include <zlib.h>

static void put(sp_packed *packed, uint32_t value, int bytes)
{
    char little[4];
    for (int k = 0; k < bytes; ++k)
        little[k] = (char)(value >> (8 * k) & 0xff);
    sp_text_append(packed, little, (size_t)bytes);
}

static void align(sp_packed *packed)
{
    sp_text_append(packed, "\0\0\0", (4 - packed->length % 4) % 4);
}

void sp_packed_bytes(sp_packed *packed, const uint8_t *values, size_t count)
{
    sp_text_append(packed, (const char *)values, count);
    align(packed);
}

void sp_packed_shorts(sp_packed *packed, const uint16_t *values, size_t count, bool differences)
{
    for (size_t i = 0; i < count; ++i)
        put(packed, differences && i ? (uint32_t)values[i] - values[i - 1] : values[i], 2);
    align(packed);
}

void sp_packed_words(sp_packed *packed, const uint32_t *values, size_t count, bool differences)
{
    for (size_t i = 0; i < count; ++i)
        put(packed, differences && i ? values[i] - values[i - 1] : values[i], 4);
}

static uint64_t unsigned_of(int64_t value)
{
    return value < 0 ? 2 * (uint64_t) - (value + 1) + 1 : 2 * (uint64_t)value;
}

void sp_packed_numbers(sp_packed *packed, const int64_t *values, size_t count)
{
    uint32_t all = 0;
    for (size_t i = 0; i < count; ++i) {
        char bytes = 0;
        for (uint64_t rest = unsigned_of(values[i]); rest; rest >>= 8)
            bytes++;
        sp_text_append(packed, &bytes, 1);
        all += (uint32_t)bytes;
    }
    align(packed);
    sp_packed_words(packed, &all, 1, false);
    for (size_t i = 0; i < count; ++i)
        for (uint64_t rest = unsigned_of(values[i]); rest; rest >>= 8)
            put(packed, (uint32_t)(rest & 0xff), 1);
    align(packed);
}

bool sp_packed_corners(sp_packed *packed, const uint32_t *vertices, size_t count)
{
    int64_t *before = malloc((count + 1) * sizeof *before);
    uint32_t next = 0;
    for (size_t i = 0; before && i < count; ++i) {
        before[i] = (int64_t)next - vertices[i];
        next = vertices[i] >= next ? vertices[i] + 1 : next;
    }
    if (before)
        sp_packed_numbers(packed, before, count);
    free(before);
    return before != NULL;
}

/* 91² letters tell 13 bits: a seventh less than base64 takes. */
static void add_letters(sp_text *text, const uint8_t *bytes, size_t count)
{
    static const char letters[] =
        "!#$%&'()*+,-./0123456789:;=>?@ABCDEFGHIJKLMNOPQRSTUVWXYZ[]^_`abcdefghijklmnopqrstuvwxyz"
        "{|}~";
    uint32_t held = 0;
    int bits = 0;
    for (size_t i = 0; i < count || bits > 0; ++i) {
        held |= i < count ? (uint32_t)bytes[i] << bits : 0;
        bits += i < count ? 8 : 0;
        if (bits < 13 && i < count)
            continue;
        char pair[2] = {letters[(held & 0x1fff) % 91], letters[(held & 0x1fff) / 91]};
        sp_text_append(text, pair, sizeof pair);
        held >>= 13;
        bits -= 13;
    }
}

char *sp_packed_letters(const uint8_t *bytes, size_t count, sp_error *error)
{
    sp_text text = {0};
    sp_text_add(&text, "%zu ", count);
    add_letters(&text, bytes, count);
    return sp_text_finish(&text, error);
}

char *sp_packed_finish(const sp_packed *packed, sp_error *error)
{
    uLongf size = compressBound(packed->length);
    uint8_t *deflated = packed->failed ? NULL : malloc(size);
    bool done =
        deflated && compress2(deflated, &size, (const Bytef *)packed->text, packed->length, Z_BEST_COMPRESSION) == Z_OK;
    char *text = done ? sp_packed_letters(deflated, size, error) : sp_fail_memory(error);
    free(deflated);
    return text;
}
