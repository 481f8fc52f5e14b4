/* STL, text and binary. */
#include "mesh/build.h"

#include <stdlib.h>
#include <string.h>

enum { HEADER = 80, RECORD = 50 };

static uint32_t little_endian(const char *bytes)
{
    const unsigned char *b = (const unsigned char *)bytes;
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

static double read_float(const char *bytes)
{
    uint32_t bits = little_endian(bytes);
    float value;
    memcpy(&value, &bits, sizeof value);
    return (double)value;
}

/* The size tells, not the first word: many binary files begin with "solid". */
static bool is_binary(const char *bytes, size_t size)
{
    return size >= HEADER + 4 && size == HEADER + 4 + (uint64_t)RECORD * little_endian(bytes + HEADER);
}

static bool read_binary(const char *bytes, double unit, mesh_build *build, sp_error *error)
{
    uint32_t count = little_endian(bytes + HEADER), part;
    if (!mesh_build_part(build, "default", 7, &part, error))
        return false;
    for (uint32_t t = 0; t < count; t++) {
        const char *record = bytes + HEADER + 4 + (size_t)RECORD * t + 12; /* behind the normal */
        uint32_t first = (uint32_t)build->point_count;
        for (int i = 0; i < 3; i++) {
            double number[3];
            for (int k = 0; k < 3; k++) {
                number[k] = unit * read_float(record + 12 * i + 4 * k);
                if (!isfinite(number[k]))
                    return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                                   "triangle %lu: found a coordinate that is not finite", (unsigned long)t);
            }
            if (!mesh_build_point(build, sp_v(number[0], number[1], number[2]), error))
                return false;
        }
        if (!mesh_build_triangle(build, first, first + 1, first + 2, part, error))
            return false;
    }
    return true;
}

typedef struct {
    const char *at, *end;
    int line;
    double unit;
    mesh_build *build;
    sp_error *error;
} stl_reader;

#define WRONG(reader, ...) sp_fail((reader)->error, SP_ERROR_INPUT, NULL, (reader)->line, 0, __VA_ARGS__)

static bool blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f'; }

/* The next word; its length is 0 at the end of the file. */
static const char *next_word(stl_reader *reader, int *length)
{
    while (reader->at < reader->end && blank(*reader->at))
        reader->line += *reader->at++ == '\n';
    const char *word = reader->at;
    while (reader->at < reader->end && !blank(*reader->at) && reader->at - word < 1000)
        reader->at++;
    *length = (int)(reader->at - word);
    return word;
}

static bool is_word(const char *word, int length, const char *expected)
{
    return length == (int)strlen(expected) && !strncmp(word, expected, (size_t)length);
}

static bool expect(stl_reader *reader, const char *expected)
{
    int length;
    const char *word = next_word(reader, &length);
    return is_word(word, length, expected) ||
           WRONG(reader, "found \"%.*s\", expected \"%s\"", length > 40 ? 40 : length, word, expected);
}

static bool read_number(stl_reader *reader, double *value)
{
    char copy[64];
    int length;
    const char *word = next_word(reader, &length);
    if (length > 0 && length < (int)sizeof copy) {
        char *end;
        memcpy(copy, word, (size_t)length);
        copy[length] = 0;
        *value = strtod(copy, &end);
        if (!*end && isfinite(*value) && !strpbrk(copy, "xX"))
            return true;
    }
    return WRONG(reader, "found \"%.*s\", expected a finite number", length > 40 ? 40 : length, word);
}

static bool read_point(stl_reader *reader, double scale, sp_vec3 *point)
{
    if (!read_number(reader, &point->x) || !read_number(reader, &point->y) || !read_number(reader, &point->z))
        return false;
    *point = sp_scale(*point, scale);
    return (isfinite(point->x) && isfinite(point->y) && isfinite(point->z)) ||
           WRONG(reader, "found a coordinate beyond all range");
}

/* Behind the word "facet". */
static bool read_facet(stl_reader *reader, uint32_t part)
{
    uint32_t first = (uint32_t)reader->build->point_count;
    sp_vec3 point;
    if (!expect(reader, "normal") || !read_point(reader, 1, &point) || !expect(reader, "outer") ||
        !expect(reader, "loop"))
        return false;
    for (int i = 0; i < 3; i++)
        if (!expect(reader, "vertex") || !read_point(reader, reader->unit, &point) ||
            !mesh_build_point(reader->build, point, reader->error))
            return false;
    return expect(reader, "endloop") && expect(reader, "endfacet") &&
           mesh_build_triangle(reader->build, first, first + 1, first + 2, part, reader->error);
}

static void skip_line(stl_reader *reader, const char **rest, size_t *length)
{
    while (reader->at < reader->end && (*reader->at == ' ' || *reader->at == '\t'))
        reader->at++;
    *rest = reader->at;
    while (reader->at < reader->end && *reader->at != '\n')
        reader->at++;
    *length = (size_t)(reader->at - *rest);
    while (*length && blank((*rest)[*length - 1]))
        --*length;
}

/* Behind the word "solid". */
static bool read_solid(stl_reader *reader)
{
    const char *name;
    size_t name_length;
    uint32_t part;
    skip_line(reader, &name, &name_length);
    if (!mesh_build_part(reader->build, name_length ? name : "default", name_length ? name_length : 7, &part,
                         reader->error))
        return false;
    for (;;) {
        int length;
        const char *word = next_word(reader, &length);
        if (is_word(word, length, "endsolid")) {
            skip_line(reader, &name, &name_length);
            return true;
        }
        if (!is_word(word, length, "facet"))
            return WRONG(reader, "found \"%.*s\", expected \"facet\" or \"endsolid\"", length > 40 ? 40 : length, word);
        if (!read_facet(reader, part))
            return false;
    }
}

bool mesh_read_stl(const char *bytes, size_t size, double unit, mesh_build *build, sp_error *error)
{
    if (is_binary(bytes, size))
        return read_binary(bytes, unit, build, error);
    stl_reader reader = {.at = bytes, .end = bytes + size, .line = 1, .unit = unit, .build = build, .error = error};
    if (size < 5 || strncmp(bytes, "solid", 5))
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                       "found %zu bytes that are neither text beginning with \"solid\" nor a header and the triangles "
                       "it counts", size);
    for (;;) {
        int length;
        const char *word = next_word(&reader, &length);
        if (length == 0)
            return true;
        if (!is_word(word, length, "solid"))
            return WRONG(&reader, "found \"%.*s\", expected \"solid\"", length > 40 ? 40 : length, word);
        if (!read_solid(&reader))
            return false;
    }
}
