/* Wavefront OBJ: vertices, faces of any number of corners, groups and objects as parts. */
#include "mesh/build.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    int line;
    double unit;
    mesh_build *build;
    size_t textures, normals; /* vt and vn so far, to check indices against */
    uint32_t part;            /* SP_NONE before any group */
    sp_error *error;
} obj_reader;

#define WRONG(reader, ...) sp_fail((reader)->error, SP_ERROR_INPUT, NULL, (reader)->line, 0, __VA_ARGS__)

/* The next word of the line, terminated in place; NULL at its end. */
static char *next_word(char **at)
{
    char *word = *at + strspn(*at, " \t\r\v\f");
    if (!*word)
        return NULL;
    char *end = word + strcspn(word, " \t\r\v\f");
    *at = *end ? end + 1 : end;
    *end = 0;
    return word;
}

static bool read_number(obj_reader *reader, const char *word, double *value)
{
    char *end;
    *value = strtod(word, &end);
    if (end == word || *end || !isfinite(*value) || strpbrk(word, "xX"))
        return WRONG(reader, "found \"%.40s\", expected a finite number", word);
    return true;
}

static bool read_vertex(obj_reader *reader, char *rest)
{
    double number[3];
    for (int i = 0; i < 3; i++) {
        char *word = next_word(&rest);
        if (!word)
            return WRONG(reader, "v: found %d numbers, expected at least 3", i);
        if (!read_number(reader, word, &number[i]))
            return false;
        number[i] *= reader->unit;
        if (!isfinite(number[i]))
            return WRONG(reader, "v: found a coordinate beyond all range");
    }
    for (char *word; (word = next_word(&rest));) { /* a weight or a colour */
        double ignored;
        if (!read_number(reader, word, &ignored))
            return false;
    }
    return mesh_build_point(reader->build, sp_v(number[0], number[1], number[2]), reader->error);
}

/* One index of a corner, from 1, or from -1 backwards; `*at` ends behind it. */
static bool read_index(obj_reader *reader, char **at, size_t count, const char *what, uint32_t *index)
{
    char *end;
    errno = 0;
    long long value = strtoll(*at, &end, 10);
    if (end == *at || (!(**at >= '0' && **at <= '9') && **at != '-'))
        return WRONG(reader, "f: found \"%.40s\", expected the number of a %s", *at, what);
    if (value < 0)
        value += (long long)count + 1;
    if (errno || value < 1 || (unsigned long long)value > count)
        return WRONG(reader, "f: found %s %.*s, expected one of the %zu before it", what, (int)(end - *at), *at,
                     count);
    *index = (uint32_t)(value - 1);
    *at = end;
    return true;
}

/* v, v/vt, v//vn or v/vt/vn. */
static bool read_corner(obj_reader *reader, char *word, uint32_t *vertex)
{
    uint32_t ignored;
    char *at = word;
    if (!read_index(reader, &at, reader->build->point_count, "vertex", vertex))
        return false;
    if (*at == '/') {
        at++;
        if (*at != '/' && !read_index(reader, &at, reader->textures, "texture vertex", &ignored))
            return false;
        if (*at == '/') {
            at++;
            if (!read_index(reader, &at, reader->normals, "normal", &ignored))
                return false;
        }
    }
    if (*at)
        return WRONG(reader, "f: found \"%.40s\", expected v, v/vt, v//vn or v/vt/vn", word);
    return true;
}

static bool default_part(obj_reader *reader)
{
    return reader->part != SP_NONE || mesh_build_part(reader->build, "default", 7, &reader->part, reader->error);
}

static bool read_face(obj_reader *reader, char *rest)
{
    uint32_t first = 0, last = 0, corner;
    int count = 0;
    if (!default_part(reader))
        return false;
    for (char *word; (word = next_word(&rest)); count++, last = corner) {
        if (!read_corner(reader, word, &corner))
            return false;
        if (count == 0)
            first = corner;
        else if (count >= 2 &&
                 !mesh_build_triangle(reader->build, first, last, corner, reader->part, reader->error))
            return false;
    }
    return count >= 3 || WRONG(reader, "f: found %d corners, expected at least 3", count);
}

/* The whole rest of the line names the part: names with blanks do occur. */
static bool read_group(obj_reader *reader, char *rest)
{
    rest += strspn(rest, " \t\r\v\f");
    size_t length = strlen(rest);
    while (length && strchr(" \t\r\v\f", rest[length - 1]))
        length--;
    return mesh_build_part(reader->build, length ? rest : "default", length ? length : 7, &reader->part,
                           reader->error);
}

/* Statements of the format that say nothing of the surface. */
static bool harmless(const char *keyword)
{
    static const char *const known[] = {"mtllib", "usemtl", "s", "l", "p", "vp", "maplib", "usemap",
                                        "bevel", "c_interp", "d_interp", "lod", "shadow_obj", "trace_obj", "mg"};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (!strcmp(keyword, known[i]))
            return true;
    return false;
}

static bool read_counted(obj_reader *reader, char *rest, size_t *count)
{
    double ignored;
    for (char *word; (word = next_word(&rest));)
        if (!read_number(reader, word, &ignored))
            return false;
    ++*count;
    return true;
}

static bool read_statement(obj_reader *reader, char *line)
{
    char *rest = line;
    char *keyword = next_word(&rest);
    if (!keyword || *keyword == '#')
        return true;
    if (!strcmp(keyword, "v"))
        return read_vertex(reader, rest);
    if (!strcmp(keyword, "f"))
        return read_face(reader, rest);
    if (!strcmp(keyword, "g") || !strcmp(keyword, "o"))
        return read_group(reader, rest);
    if (!strcmp(keyword, "vt"))
        return read_counted(reader, rest, &reader->textures);
    if (!strcmp(keyword, "vn"))
        return read_counted(reader, rest, &reader->normals);
    if (harmless(keyword))
        return true;
    return WRONG(reader, "found the statement \"%.40s\", expected v, vt, vn, f, g or o", keyword);
}

/* The end of the statement at `at`, continued lines (a backslash before the line's end) made one; counts lines. */
static char *end_statement(char *at, char *end, int *lines)
{
    for (;;) {
        char *stop = memchr(at, '\n', (size_t)(end - at));
        if (!stop)
            return end;
        ++*lines;
        char *last = stop > at && stop[-1] == '\r' ? stop - 2 : stop - 1;
        if (last < at || *last != '\\')
            return stop;
        memset(last, ' ', (size_t)(stop - last) + 1);
        at = stop + 1;
    }
}

bool mesh_read_obj(char *text, size_t size, double unit, mesh_build *build, sp_error *error)
{
    obj_reader reader = {.line = 1, .unit = unit, .build = build, .part = SP_NONE, .error = error};
    char *end = text + size;
    for (char *line = text; line < end;) {
        int lines = 0;
        char *stop = end_statement(line, end, &lines);
        if (memchr(line, 0, (size_t)(stop - line)))
            return WRONG(&reader, "found a zero byte, expected text");
        *stop = 0;
        if (!read_statement(&reader, line))
            return false;
        reader.line += lines;
        line = stop + 1;
    }
    return true;
}
