/* STL, text and binary. After the "StereoLithography Interface Specification", 3D Systems, 1989. */
#include "mesh/scanner.h"
#include "mesh/soup.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

enum { HEADER = 80, START = HEADER + 4, RECORD = 50, POINT = 12 };

typedef struct {
    sp_scanner scanner;
    sp_soup *soup;
    double unit;
    uint32_t part;
    sp_error *error;
} reader;

static bool expect(reader *r, const char *word)
{
    sp_token token;
    if (!sp_scan_any_token(&r->scanner, &token))
        return sp_scanner_ended(&r->scanner, word, r->error);
    return sp_token_is(&r->scanner, &token, word) || sp_token_unexpected(&r->scanner, &token, word, r->error);
}

static bool read_point(reader *r, sp_vec3 *point)
{
    double numbers[3];
    for (int k = 0; k < 3; k++) {
        sp_token token;
        if (!sp_scan_any_token(&r->scanner, &token))
            return sp_scanner_ended(&r->scanner, "a number", r->error);
        if (!sp_token_number(&r->scanner, &token, &numbers[k], r->error))
            return false;
    }
    *point = sp_v(numbers[0], numbers[1], numbers[2]);
    return true;
}

static bool add_triangle(const char *path, sp_soup *soup, const sp_vec3 corners[3], uint32_t part, sp_error *error)
{
    uint32_t numbers[3];
    if (soup->vertex_count > SP_NONE - 3)
        return sp_fail(error, SP_ERROR_INPUT, path, 0, 0, "found more than %u vertices, expected fewer", SP_NONE - 1);
    for (int k = 0; k < 3; k++)
        if (!sp_soup_weld_vertex(soup, corners[k], &numbers[k], error))
            return false;
    return sp_soup_add_triangle(soup, numbers[0], numbers[1], numbers[2], part, error);
}

/* Three words that are not looked at: the order of the corners says the same, and programs write "nan" for the normal
 * of a triangle without area. */
static bool skip_normal(reader *r)
{
    sp_token token;
    for (int k = 0; k < 3; k++)
        if (!sp_scan_any_token(&r->scanner, &token))
            return sp_scanner_ended(&r->scanner, "a number", r->error);
    return true;
}

/* From behind "facet". */
static bool read_facet(reader *r)
{
    sp_vec3 corners[3];
    if (!expect(r, "normal") || !skip_normal(r) || !expect(r, "outer") || !expect(r, "loop"))
        return false;
    for (int k = 0; k < 3; k++) {
        if (!expect(r, "vertex") || !read_point(r, &corners[k]))
            return false;
        corners[k] = sp_scale(corners[k], r->unit);
        if (!sp_coordinates_allowed(corners[k]))
            return sp_fail(r->error, SP_ERROR_INPUT, r->scanner.path, r->scanner.line, 0,
                           "found a coordinate beyond 1e30 m, expected less");
    }
    return expect(r, "endloop") && expect(r, "endfacet") &&
           add_triangle(r->scanner.path, r->soup, corners, r->part, r->error);
}

/* From behind "solid" to behind "endsolid" and its name. */
static bool read_solid(reader *r)
{
    char *name = sp_scan_name(&r->scanner, "default", r->error);
    if (!name)
        return false;
    r->part = sp_soup_part(r->soup, name, r->error);
    free(name);
    if (r->part == SP_NONE)
        return false;
    sp_token token;
    while (sp_scan_any_token(&r->scanner, &token)) {
        if (sp_token_is(&r->scanner, &token, "endsolid")) {
            sp_scan_next_line(&r->scanner);
            return true;
        }
        if (!sp_token_is(&r->scanner, &token, "facet"))
            return sp_token_unexpected(&r->scanner, &token, "facet or endsolid", r->error);
        if (!read_facet(r))
            return false;
    }
    return sp_scanner_ended(&r->scanner, "facet or endsolid", r->error);
}

static bool read_text(const char *path, const char *text, size_t size, double unit, sp_soup *soup, sp_error *error)
{
    reader r = {sp_scanner_open(path, text, size, false), soup, unit, SP_NONE, error};
    sp_token token;
    while (sp_scan_any_token(&r.scanner, &token)) {
        if (!sp_token_is(&r.scanner, &token, "solid"))
            return sp_token_unexpected(&r.scanner, &token, "solid", error);
        if (!read_solid(&r))
            return false;
    }
    return true;
}

/* Little-endian, whatever this machine is. */
static uint32_t read_word(const unsigned char *at)
{
    return (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

static double read_float(const unsigned char *at)
{
    uint32_t word = read_word(at);
    float number;
    memcpy(&number, &word, sizeof number);
    return number;
}

/* What follows the header says how many triangles there are. */
static bool is_whole_binary(const unsigned char *bytes, size_t size)
{
    return size >= START && size == START + RECORD * (uint64_t)read_word(bytes + HEADER);
}

/* Text has none; a binary file that has none has more than 16 million triangles. */
static bool has_zero_in_head(const unsigned char *bytes, size_t size)
{
    return memchr(bytes, '\0', size < START ? size : START) != NULL;
}

static bool refuse_size(const char *path, const unsigned char *bytes, size_t size, sp_error *error)
{
    uint64_t count = size >= START ? read_word(bytes + HEADER) : 0;
    if (!has_zero_in_head(bytes, size))
        return sp_fail(error, SP_ERROR_INPUT, path, 0, 0,
                       "found no STL, expected text that begins with \"solid\", or %d bytes of binary STL and %d more "
                       "for each triangle",
                       START, RECORD);
    return sp_fail(error, SP_ERROR_INPUT, path, 0, 0,
                   "found %zu bytes of binary STL, expected %llu for its %llu triangles", size,
                   (unsigned long long)(START + RECORD * count), (unsigned long long)count);
}

static bool read_binary(const char *path, const unsigned char *bytes, size_t size, double unit, sp_soup *soup,
                        sp_error *error)
{
    if (!is_whole_binary(bytes, size))
        return refuse_size(path, bytes, size, error);
    uint64_t count = read_word(bytes + HEADER);
    uint32_t part = sp_soup_part(soup, "default", error);
    /* A closed surface has half as many vertices as triangles. */
    if (part == SP_NONE || !sp_soup_reserve(soup, count / 2 + count / 64 + 256, count, error))
        return false;
    for (uint64_t i = 0; i < count; i++) {
        const unsigned char *at = bytes + START + RECORD * i + POINT; /* behind the normal */
        sp_vec3 corners[3];
        for (int k = 0; k < 3; k++, at += POINT) {
            corners[k] = sp_scale(sp_v(read_float(at), read_float(at + 4), read_float(at + 8)), unit);
            if (!sp_coordinates_allowed(corners[k]))
                return sp_fail(error, SP_ERROR_INPUT, path, 0, 0,
                               "found in triangle %llu of %llu a coordinate that is not finite or beyond 1e30 m",
                               (unsigned long long)(i + 1), (unsigned long long)count);
        }
        if (!add_triangle(path, soup, corners, part, error))
            return false;
    }
    return true;
}

/* Text begins with "solid"; so do many binary files, but then their size fits, or there are zero bytes. */
static bool is_text(const unsigned char *bytes, size_t size)
{
    if (is_whole_binary(bytes, size) || has_zero_in_head(bytes, size))
        return false;
    size_t at = size >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
    while (at < size && isspace(bytes[at]))
        at++;
    static const char word[] = "solid";
    for (size_t k = 0; k < 5; k++)
        if (at + k >= size || tolower(bytes[at + k]) != word[k])
            return false;
    return true;
}

bool sp_stl_is(const char *text, size_t size)
{
    const unsigned char *bytes = (const unsigned char *)text;
    return is_text(bytes, size) || is_whole_binary(bytes, size);
}

bool sp_stl_read(const char *path, const char *text, size_t size, double unit, sp_soup *soup, sp_error *error)
{
    const unsigned char *bytes = (const unsigned char *)text;
    return is_text(bytes, size) ? read_text(path, text, size, unit, soup, error)
                                : read_binary(path, bytes, size, unit, soup, error);
}
