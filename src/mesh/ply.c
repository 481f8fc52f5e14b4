/* PLY, text and binary of either byte order. After Greg Turk, "The PLY Polygon File Format", Stanford, 1994. */
#include "mesh/scanner.h"
#include "mesh/soup.h"

#include <math.h>
#include <string.h>

enum { ELEMENTS = 32, PROPERTIES = 256 }; /* in a header at most */

typedef enum { TEXT, LITTLE_ENDIAN_BYTES, BIG_ENDIAN_BYTES } order;

typedef struct {
    const char *name, *other;
    size_t size;
    bool whole, sign;
} scalar;

static const scalar scalars[] = {{"char", "int8", 1, true, true},      {"uchar", "uint8", 1, true, false},
                                 {"short", "int16", 2, true, true},    {"ushort", "uint16", 2, true, false},
                                 {"int", "int32", 4, true, true},      {"uint", "uint32", 4, true, false},
                                 {"float", "float32", 4, false, true}, {"double", "float64", 8, false, true}};

typedef enum { UNUSED, X, Y, Z, CORNERS } use;

typedef struct {
    use use;
    const scalar *type, *count; /* count: of a list; NULL of one value */
} property;

typedef enum { VERTEX, FACE, OTHER } kind;

typedef struct {
    sp_token name;
    kind kind;
    uint64_t count;
    size_t first, end; /* its properties */
} element;

typedef struct {
    sp_scanner scanner; /* also of the bytes behind the header */
    const char *start;  /* of the file */
    sp_soup *soup;
    double unit;
    order order;
    size_t element_count, property_count;
    element elements[ELEMENTS];
    property properties[PROPERTIES];
    uint64_t vertices; /* as the header says */
    uint32_t part;
    sp_error *error;
} reader;

static bool next_token(reader *r, sp_token *token, const char *expected)
{
    return sp_scan_token(&r->scanner, token) || sp_scanner_ended(&r->scanner, expected, r->error);
}

/* Behind the last token that a line may have; on to the next. */
static bool end_line(reader *r)
{
    sp_token token;
    if (sp_scan_token(&r->scanner, &token))
        return sp_token_unexpected(&r->scanner, &token, "the end of the line", r->error);
    sp_scan_next_line(&r->scanner);
    return true;
}

static bool read_format(reader *r)
{
    static const char *const names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    static const char expected[] = "ascii, binary_little_endian or binary_big_endian";
    sp_token token;
    if (!sp_scan_any_token(&r->scanner, &token))
        return sp_scanner_ended(&r->scanner, "format", r->error);
    if (!sp_token_is(&r->scanner, &token, "format"))
        return sp_token_unexpected(&r->scanner, &token, "format", r->error);
    if (!next_token(r, &token, expected))
        return false;
    int found = 0;
    while (found < 3 && !sp_token_is(&r->scanner, &token, names[found]))
        found++;
    if (found == 3)
        return sp_token_unexpected(&r->scanner, &token, expected, r->error);
    r->order = (order)found;
    return next_token(r, &token, "1.0") &&
           (sp_token_is(&r->scanner, &token, "1.0") || sp_token_unexpected(&r->scanner, &token, "1.0", r->error)) &&
           end_line(r);
}

static bool read_element_count(reader *r, uint64_t *count)
{
    sp_token token;
    double number;
    if (!next_token(r, &token, "how many") || !sp_token_number(&r->scanner, &token, &number, r->error))
        return false;
    if (!(number >= 0 && number < (double)SP_NONE && number == floor(number)))
        return sp_token_unexpected(&r->scanner, &token, "a whole number below 4294967295", r->error);
    *count = (uint64_t)number;
    return true;
}

/* Whether no element before it is of this kind. */
static bool is_first(const reader *r, kind kind)
{
    for (size_t i = 0; i < r->element_count; i++)
        if (r->elements[i].kind == kind)
            return false;
    return true;
}

static bool read_element(reader *r)
{
    element own = {.kind = OTHER, .first = r->property_count, .end = r->property_count};
    if (!next_token(r, &own.name, "the name of an element"))
        return false;
    if (r->element_count == ELEMENTS)
        return sp_token_unexpected(&r->scanner, &own.name, "at most 32 elements", r->error);
    if (sp_token_is(&r->scanner, &own.name, "tristrips"))
        return sp_fail(r->error, SP_ERROR_UNSUPPORTED, r->scanner.path, own.name.line, own.name.column,
                       "found 'tristrips', expected surface in faces only");
    if (sp_token_is(&r->scanner, &own.name, "vertex"))
        own.kind = VERTEX;
    else if (sp_token_is(&r->scanner, &own.name, "face"))
        own.kind = FACE;
    if (own.kind != OTHER && !is_first(r, own.kind))
        return sp_token_unexpected(&r->scanner, &own.name, "this element once", r->error);
    if (own.kind == FACE && is_first(r, VERTEX))
        return sp_token_unexpected(&r->scanner, &own.name, "vertex before it", r->error);
    if (!read_element_count(r, &own.count))
        return false;
    r->vertices = own.kind == VERTEX ? own.count : r->vertices;
    r->elements[r->element_count++] = own;
    return end_line(r);
}

static const scalar *read_type(reader *r, sp_token *token)
{
    for (size_t i = 0; i < sizeof scalars / sizeof *scalars; i++)
        if (sp_token_is(&r->scanner, token, scalars[i].name) || sp_token_is(&r->scanner, token, scalars[i].other))
            return &scalars[i];
    sp_token_unexpected(&r->scanner, token, "a type such as float, int or uchar", r->error);
    return NULL;
}

/* What the property is to the mesh. */
static use use_of(const reader *r, const element *own, const sp_token *name, bool list)
{
    static const char *const coordinates[] = {"x", "y", "z"};
    for (int k = 0; own->kind == VERTEX && !list && k < 3; k++)
        if (sp_token_is(&r->scanner, name, coordinates[k]))
            return (use)(X + k);
    bool corners = sp_token_is(&r->scanner, name, "vertex_indices") || sp_token_is(&r->scanner, name, "vertex_index");
    return own->kind == FACE && list && corners ? CORNERS : UNUSED;
}

static bool read_property(reader *r)
{
    property own = {0};
    sp_token token, name;
    if (!next_token(r, &token, "a type"))
        return false;
    element *last = r->element_count ? &r->elements[r->element_count - 1] : NULL;
    if (!last || r->property_count == PROPERTIES)
        return sp_token_unexpected(&r->scanner, &token, last ? "at most 256 properties" : "an element before it",
                                   r->error);
    if (sp_token_is(&r->scanner, &token, "list")) {
        if (!next_token(r, &token, "a type") || !(own.count = read_type(r, &token)))
            return false;
        if (!own.count->whole)
            return sp_token_unexpected(&r->scanner, &token, "a type of whole numbers", r->error);
        if (!next_token(r, &token, "a type"))
            return false;
    }
    if (!(own.type = read_type(r, &token)) || !next_token(r, &name, "the property's name"))
        return false;
    own.use = use_of(r, last, &name, own.count != NULL);
    if (own.use == CORNERS && !own.type->whole)
        return sp_token_unexpected(&r->scanner, &token, "a type of whole numbers", r->error);
    for (size_t i = last->first; own.use != UNUSED && i < last->end; i++)
        if (r->properties[i].use == own.use)
            return sp_token_unexpected(&r->scanner, &name, "this property once", r->error);
    r->properties[r->property_count++] = own;
    last->end = r->property_count;
    return end_line(r);
}

/* Whether vertices have all coordinates, and faces corners. */
static bool is_complete(const reader *r)
{
    for (size_t i = 0; i < r->element_count; i++) {
        const element *own = &r->elements[i];
        unsigned found = 0;
        for (size_t k = own->first; k < own->end; k++)
            found |= 1u << r->properties[k].use;
        bool whole = own->kind == VERTEX ? (found >> X & 7) == 7 : own->kind == FACE ? found >> CORNERS & 1 : true;
        if (!whole)
            return sp_token_unexpected(
                &r->scanner, &own->name,
                own->kind == VERTEX ? "its properties x, y and z" : "its property list vertex_indices", r->error);
    }
    return !is_first(r, FACE) || sp_fail(r->error, SP_ERROR_INPUT, r->scanner.path, 0, 0,
                                         "found a header without an element face, expected one");
}

/* Ends behind the line "end_header". */
static bool read_header(reader *r)
{
    sp_token token;
    if (!sp_scan_token(&r->scanner, &token) || !sp_token_is(&r->scanner, &token, "ply"))
        return sp_fail(r->error, SP_ERROR_INPUT, r->scanner.path, 1, 1,
                       "found no 'ply', expected it in the first line");
    if (!end_line(r) || !read_format(r))
        return false;
    while (sp_scan_any_token(&r->scanner, &token)) {
        bool good = true;
        if (sp_token_is(&r->scanner, &token, "end_header"))
            return end_line(r) && is_complete(r);
        if (sp_token_is(&r->scanner, &token, "element"))
            good = read_element(r);
        else if (sp_token_is(&r->scanner, &token, "property"))
            good = read_property(r);
        else if (sp_token_is(&r->scanner, &token, "comment") || sp_token_is(&r->scanner, &token, "obj_info"))
            sp_scan_next_line(&r->scanner);
        else
            good = sp_token_unexpected(&r->scanner, &token, "element, property, comment or end_header", r->error);
        if (!good)
            return false;
    }
    return sp_scanner_ended(&r->scanner, "end_header", r->error);
}

/* Whatever the byte order of this machine is. */
static double number_of(const unsigned char *at, const scalar *type, order order)
{
    uint64_t bits = 0;
    for (size_t i = 0; i < type->size; i++)
        bits = bits << 8 | at[order == BIG_ENDIAN_BYTES ? i : type->size - 1 - i];
    if (type->whole) {
        uint64_t top = UINT64_C(1) << (8 * type->size - 1);
        return type->sign && bits & top ? (double)bits - 2 * (double)top : (double)bits;
    }
    if (type->size == sizeof(double)) {
        double number;
        memcpy(&number, &bits, sizeof number);
        return number;
    }
    uint32_t word = (uint32_t)bits;
    float number;
    memcpy(&number, &word, sizeof number);
    return (double)number;
}

/* The next value of the line, or of the bytes; NULL for one that nobody asks for. */
static bool read_value(reader *r, const scalar *type, double *number)
{
    sp_scanner *scanner = &r->scanner;
    sp_token token;
    if (r->order == TEXT)
        return next_token(r, &token, "a number") && (!number || sp_token_number(scanner, &token, number, r->error));
    if ((size_t)(scanner->end - scanner->at) < type->size)
        return sp_fail(r->error, SP_ERROR_INPUT, scanner->path, 0, 0,
                       "found the end of the file, expected as many values as its header says");
    if (number)
        *number = number_of((const unsigned char *)scanner->at, type, r->order);
    scanner->at += type->size;
    return true;
}

/* Where in the file: a line of text, or which of an element. */
static bool fail_in(const reader *r, const element *own, uint64_t index, const char *found)
{
    return sp_fail(r->error, SP_ERROR_INPUT, r->scanner.path, r->order == TEXT ? r->scanner.line : 0, 0,
                   "found in %.*s %llu of %llu %s", own->name.length < 40 ? (int)own->name.length : 40, own->name.text,
                   (unsigned long long)(index + 1), (unsigned long long)own->count, found);
}

static bool check_size(const reader *r)
{
    return sp_soup_check_size(r->soup, r->scanner.path, (size_t)(r->scanner.at - r->start),
                              r->order == TEXT ? r->scanner.line : 0, r->error);
}

static bool add_corner(reader *r, const element *own, uint64_t index, double number)
{
    if (!(number >= 0 && number < (double)r->vertices && number == floor(number)))
        return fail_in(r, own, index, "a corner that no vertex has, expected numbers of vertices, from 0");
    return sp_soup_add_corner(r->soup, (uint32_t)number, r->error) && check_size(r);
}

static bool read_list(reader *r, const element *own, uint64_t index, const property *list)
{
    double count, number;
    if (!read_value(r, list->count, &count))
        return false;
    if (!(count >= 0 && count < (double)SP_NONE && count == floor(count)))
        return fail_in(r, own, index, "a list of no whole length, expected one of 0 or more");
    if (list->use == CORNERS && count < 3)
        return fail_in(r, own, index, "fewer than three corners, expected three or more");
    for (uint64_t i = 0; i < (uint64_t)count; i++)
        if (!read_value(r, list->type, list->use == CORNERS ? &number : NULL) ||
            (list->use == CORNERS && !add_corner(r, own, index, number)))
            return false;
    return list->use != CORNERS || sp_soup_add_polygon(r->soup, r->part, r->error);
}

static bool add_vertex(reader *r, const element *own, uint64_t index, const double coordinates[3])
{
    sp_vec3 point = sp_scale(sp_v(coordinates[0], coordinates[1], coordinates[2]), r->unit);
    if (!sp_coordinates_allowed(point))
        return fail_in(r, own, index, "a number that is not finite or beyond 1e30 m");
    return sp_soup_add_vertex(r->soup, point, r->error) && check_size(r);
}

static bool read_one(reader *r, const element *own, uint64_t index)
{
    double coordinates[3] = {0};
    if (r->order == TEXT && !sp_scan_blank_lines(&r->scanner))
        return sp_scanner_ended(&r->scanner, "as many lines as the header says", r->error);
    for (size_t k = own->first; k < own->end; k++) {
        const property *property = &r->properties[k];
        bool done = property->count ? read_list(r, own, index, property)
                                    : read_value(r, property->type,
                                                 property->use == UNUSED ? NULL : &coordinates[property->use - X]);
        if (!done)
            return false;
    }
    if (own->kind == VERTEX && !add_vertex(r, own, index, coordinates))
        return false;
    return r->order != TEXT || end_line(r);
}

static bool read_body(reader *r)
{
    for (size_t i = 0; i < r->element_count; i++) {
        const element *own = &r->elements[i];
        for (uint64_t k = 0; own->end > own->first && k < own->count; k++)
            if (!read_one(r, own, k))
                return false;
    }
    sp_token token;
    if (r->order == TEXT ? sp_scan_any_token(&r->scanner, &token) : r->scanner.at < r->scanner.end)
        return sp_fail(r->error, SP_ERROR_INPUT, r->scanner.path, r->order == TEXT ? token.line : 0, 0,
                       "found more behind the last element, expected the end of the file");
    return true;
}

bool sp_ply_read(const char *path, const char *text, size_t size, double unit, sp_soup *soup, sp_error *error)
{
    reader r = {
        .scanner = sp_scanner_open(path, text, size, false), .start = text, .soup = soup, .unit = unit, .error = error};
    r.part = sp_soup_part(soup, "default", error);
    return r.part != SP_NONE && read_header(&r) && read_body(&r);
}
