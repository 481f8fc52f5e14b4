/* Wavefront OBJ: polygons with named groups. After the format's description in Wavefront's "Advanced Visualizer"
 * manual, appendix B1. */
#include "mesh/scanner.h"
#include "mesh/soup.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    sp_scanner scanner;
    const char *start; /* of the file's text */
    sp_soup *soup;
    double unit;
    size_t texture_count, normal_count;
    char *group;   /* name of the part that faces now go to */
    uint32_t part; /* its number, SP_NONE before its first face */
    sp_error *error;
} reader;

/* What carries no surface: appearance, texture and normal settings, points, lines. */
static const char *const harmless[] = {"mtllib", "usemtl",     "s",         "vp",       "l",
                                       "p",      "mg",         "bevel",     "c_interp", "d_interp",
                                       "lod",    "shadow_obj", "trace_obj", "usemap",   "maplib"};
/* What would be surface, and missing without a word if it were skipped. */
static const char *const curved[] = {"cstype", "deg",  "bmat", "step", "curv", "curv2", "surf", "parm",
                                     "trim",   "hole", "scrv", "sp",   "end",  "con",   "bzp",  "bsp",
                                     "cdc",    "cdp",  "res",  "call", "csh",  "ctech", "stech"};

static bool is_one_of(const reader *r, const sp_token *token, const char *const *words, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (sp_token_is(&r->scanner, token, words[i]))
            return true;
    return false;
}

/* The numbers on the rest of the line; -1 on error. */
static int read_numbers(reader *r, double *numbers, int minimum, int maximum, const char *expected)
{
    int count = 0;
    sp_token token;
    while (sp_scan_token(&r->scanner, &token)) {
        if (count == maximum) {
            sp_token_unexpected(&r->scanner, &token, expected, r->error);
            return -1;
        }
        if (!sp_token_number(&r->scanner, &token, &numbers[count++], r->error))
            return -1;
    }
    if (count < minimum) {
        sp_scanner_ended(&r->scanner, expected, r->error);
        return -1;
    }
    return count;
}

/* x y z, and after them a weight, a colour, or both, as several programs write them. */
static bool read_vertex(reader *r, const sp_token *keyword)
{
    double numbers[7];
    int count = read_numbers(r, numbers, 3, 7, "v x y z, with a weight or a colour at most");
    if (count < 0)
        return false;
    sp_vec3 p = sp_v(numbers[0], numbers[1], numbers[2]);
    if (count == 5 || !sp_coordinates_allowed(sp_scale(p, r->unit)))
        return sp_fail(r->error, SP_ERROR_INPUT, r->scanner.path, keyword->line, keyword->column,
                       count == 5 ? "found five numbers, expected x y z, with a weight or a colour"
                                  : "found a coordinate beyond 1e30 m, expected less");
    return sp_soup_add_vertex(r->soup, p, r->error);
}

/* One index: a whole number from 1, or from -1 backwards, of `count` things read so far. Moves *at behind it. */
static bool read_index(reader *r, const sp_token *corner, const char **at, size_t count, const char *what,
                       uint32_t *index)
{
    const char *end = corner->text + corner->length, *p = *at;
    bool backwards = p < end && *p == '-';
    if (backwards || (p < end && *p == '+'))
        p++;
    const char *digits = p;
    uint64_t value = 0;
    for (; p < end && *p >= '0' && *p <= '9'; p++)
        value = value < UINT32_MAX ? 10 * value + (uint64_t)(*p - '0') : value;
    if (p == digits || (p < end && *p != '/'))
        return sp_token_unexpected(&r->scanner, corner, "v, v/vt, v//vn or v/vt/vn with whole numbers", r->error);
    if (value == 0 || value > count || value >= UINT32_MAX)
        return sp_fail(r->error, SP_ERROR_INPUT, r->scanner.path, corner->line, corner->column,
                       "found %s index %.*s, expected one of the %zu that precede it, from 1 or backwards from -1",
                       what, p - *at < 24 ? (int)(p - *at) : 24, *at, count);
    *index = (uint32_t)(backwards ? count - value : value - 1);
    *at = p;
    return true;
}

/* v, v/vt, v//vn, v/vt/vn. `form` gets a bit for vt and one for vn. */
static bool read_corner(reader *r, const sp_token *corner, uint32_t *vertex, unsigned *form)
{
    const char *at = corner->text, *end = at + corner->length;
    uint32_t unused;
    *form = 0;
    if (!read_index(r, corner, &at, r->soup->vertex_count, "vertex", vertex))
        return false;
    if (at == end)
        return true;
    at++;
    if (at == end || *at != '/') {
        *form |= 1;
        if (!read_index(r, corner, &at, r->texture_count, "texture", &unused))
            return false;
        if (at == end)
            return true;
    }
    at++;
    *form |= 2;
    if (!read_index(r, corner, &at, r->normal_count, "normal", &unused))
        return false;
    return at == end || sp_token_unexpected(&r->scanner, corner, "v, v/vt, v//vn or v/vt/vn", r->error);
}

static bool add_corner(reader *r, uint32_t vertex)
{
    return sp_soup_add_corner(r->soup, vertex, r->error) &&
           sp_soup_check_size(r->soup, r->scanner.path, (size_t)(r->scanner.at - r->start), r->scanner.line, r->error);
}

static bool read_face(reader *r)
{
    uint32_t vertex;
    unsigned first_form = 0, form;
    sp_token token;
    size_t corners = 0;
    if (r->part == SP_NONE && (r->part = sp_soup_part(r->soup, r->group, r->error)) == SP_NONE)
        return false;
    for (; sp_scan_token(&r->scanner, &token); corners++) {
        if (!read_corner(r, &token, &vertex, &form))
            return false;
        first_form = corners ? first_form : form;
        if (form != first_form)
            return sp_token_unexpected(&r->scanner, &token, "all corners of a face in the same form", r->error);
        if (!add_corner(r, vertex))
            return false;
    }
    return corners >= 3 ? sp_soup_add_polygon(r->soup, r->part, r->error)
                        : sp_scanner_ended(&r->scanner, "three corners or more", r->error);
}

static bool read_group(reader *r)
{
    char *name = sp_scan_name(&r->scanner, "default", r->error);
    if (!name)
        return false;
    free(r->group);
    r->group = name;
    r->part = SP_NONE;
    return true;
}

static bool read_statement(reader *r, const sp_token *keyword)
{
    double numbers[3];
    if (sp_token_is(&r->scanner, keyword, "v"))
        return read_vertex(r, keyword);
    if (sp_token_is(&r->scanner, keyword, "f") || sp_token_is(&r->scanner, keyword, "fo"))
        return read_face(r);
    if (sp_token_is(&r->scanner, keyword, "vt")) {
        r->texture_count++;
        return read_numbers(r, numbers, 1, 3, "vt u, v and w at most") >= 0;
    }
    if (sp_token_is(&r->scanner, keyword, "vn")) {
        r->normal_count++;
        return read_numbers(r, numbers, 3, 3, "vn x y z") >= 0;
    }
    if (sp_token_is(&r->scanner, keyword, "g") || sp_token_is(&r->scanner, keyword, "o"))
        return read_group(r);
    if (is_one_of(r, keyword, harmless, sizeof harmless / sizeof *harmless))
        return true;
    if (is_one_of(r, keyword, curved, sizeof curved / sizeof *curved))
        return sp_fail(r->error, SP_ERROR_UNSUPPORTED, r->scanner.path, keyword->line, keyword->column,
                       "found '%.*s', a curved surface or a command, expected polygons only", (int)keyword->length,
                       keyword->text);
    return sp_token_unexpected(&r->scanner, keyword, "a statement of the OBJ format", r->error);
}

bool sp_obj_read(const char *path, const char *text, size_t size, double unit, sp_soup *soup, sp_error *error)
{
    reader r = {sp_scanner_open(path, text, size, true), text, soup, unit, 0, 0, strdup("default"), SP_NONE, error};
    bool good = r.group || sp_fail_memory(error);
    sp_token keyword;
    while (good && sp_scan_any_token(&r.scanner, &keyword)) {
        good = read_statement(&r, &keyword);
        if (good && !sp_scan_next_line(&r.scanner))
            break;
    }
    free(r.group);
    for (size_t i = 0; i < soup->vertex_count; i++) /* polygons have been cut as sp_texture_read does it */
        soup->vertices[i] = sp_scale(soup->vertices[i], unit);
    return good;
}
