/* The second reading of an OBJ file, after Wavefront's "Advanced Visualizer" manual, appendix B1. */
#include "mesh/texture.h"

#include "mesh/polygon.h"
#include "mesh/scanner.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* How many there are, so that no room grows. */
typedef struct {
    size_t vertices, coordinates, triangles;
    size_t corners; /* of the face that has most */
} counts;

typedef struct {
    sp_scanner scanner;
    sp_texture *texture;
    size_t vertex_count, coordinate_count;
    sp_vec3 *vertices; /* as they stand in the file */
    double (*coordinates)[2];
    uint32_t *corners;      /* of a face: vertices */
    double (*corner_uv)[2]; /* of a face */
    uint32_t page;
    sp_error *error;
} reader;

static bool is_face(const sp_scanner *scanner, const sp_token *keyword)
{
    return sp_token_is(scanner, keyword, "f") || sp_token_is(scanner, keyword, "fo");
}

static counts count_all(sp_scanner scanner)
{
    sp_token token;
    counts all = {0};
    while (sp_scan_any_token(&scanner, &token)) {
        bool face = is_face(&scanner, &token);
        size_t corners = 0;
        all.vertices += sp_token_is(&scanner, &token, "v");
        all.coordinates += sp_token_is(&scanner, &token, "vt");
        while (face && sp_scan_token(&scanner, &token))
            corners++;
        all.triangles += corners > 2 ? corners - 2 : 0;
        all.corners = corners > all.corners ? corners : all.corners;
        if (!sp_scan_next_line(&scanner))
            break;
    }
    return all;
}

/* A file takes ten times its size and 64 MiB at most. */
static bool make_room(reader *r, size_t size)
{
    enum { CUTTING = 100 }; /* bytes a corner, at its worst */
    sp_texture *t = r->texture;
    counts all = count_all(r->scanner);
    uint64_t bytes = (uint64_t)all.vertices * sizeof *r->vertices + (uint64_t)all.coordinates * sizeof *r->coordinates +
                     (uint64_t)all.triangles * (sizeof *t->uv + sizeof *t->page + sizeof *t->line) +
                     (uint64_t)all.corners * (sizeof *r->corners + sizeof *r->corner_uv + CUTTING);
    if (bytes > 9 * (uint64_t)size + (64 << 20))
        return sp_fail(r->error, SP_ERROR_INPUT, r->scanner.path, 0, 0,
                       "found %zu triangles and %zu texture coordinates in %zu bytes, expected fewer", all.triangles,
                       all.coordinates, size);
    r->vertices = calloc(all.vertices + 1, sizeof *r->vertices);
    r->coordinates = malloc((all.coordinates + 1) * sizeof *r->coordinates);
    r->corners = malloc((all.corners + 1) * sizeof *r->corners);
    r->corner_uv = malloc((all.corners + 1) * sizeof *r->corner_uv);
    t->uv = malloc((all.triangles + 1) * sizeof *t->uv);
    t->page = malloc((all.triangles + 1) * sizeof *t->page);
    t->line = malloc((all.triangles + 1) * sizeof *t->line);
    return (r->vertices && r->coordinates && r->corners && r->corner_uv && t->uv && t->page && t->line) ||
           sp_fail_memory(r->error);
}

/* As many numbers of the line as there are, and no more than `count`. */
static bool read_numbers(reader *r, double *numbers, int count)
{
    sp_token token;
    for (int k = 0; k < count && sp_scan_token(&r->scanner, &token); k++)
        if (!sp_token_number(&r->scanner, &token, &numbers[k], r->error))
            return false;
    return true;
}

static bool add_vertex(reader *r)
{
    double at[3] = {0};
    bool good = read_numbers(r, at, 3);
    r->vertices[r->vertex_count++] = sp_v(at[0], at[1], at[2]);
    return good;
}

static bool add_coordinate(reader *r)
{
    double *at = r->coordinates[r->coordinate_count++];
    at[0] = at[1] = 0;
    return read_numbers(r, at, 2);
}

/* An index of one of `count`, from 1 or backwards from -1, as one from 0. False where it is of none: the mesh's reader
 * has seen that it is, but the text may be another. */
static bool find(const char *index, size_t count, size_t *at)
{
    long number = strtol(index, NULL, 10);
    *at = number < 0 ? count + (size_t)number : (size_t)number - 1;
    return number && *at < count;
}

/* v/vt or v/vt/vn; not a number where it has no coordinates. */
static void read_corner(const reader *r, const sp_token *token, size_t corner)
{
    const char *slash = memchr(token->text, '/', token->length);
    double *uv = r->corner_uv[corner];
    size_t at;
    r->corners[corner] = find(token->text, r->vertex_count, &at) ? (uint32_t)at : 0;
    bool there = slash && find(slash + 1, r->coordinate_count, &at);
    uv[0] = there ? r->coordinates[at][0] : NAN;
    uv[1] = there ? r->coordinates[at][1] : NAN;
}

static bool read_face(reader *r, int line)
{
    sp_texture *t = r->texture;
    sp_token token;
    sp_facets cut;
    size_t corners = 0;
    while (sp_scan_token(&r->scanner, &token))
        read_corner(r, &token, corners++);
    if (corners < 3)
        return true;
    if (!sp_polygon_cut(r->vertices, r->corners, corners, &cut, r->error))
        return false;
    for (size_t i = 0; i + 2 < corners; i++) {
        uint32_t own[3];
        sp_facets_triangle(&cut, i, own);
        for (int k = 0; k < 3; k++)
            memcpy(t->uv[t->triangle_count][k], r->corner_uv[own[k]], sizeof *r->corner_uv);
        t->page[t->triangle_count] = r->page;
        t->line[t->triangle_count++] = line;
    }
    sp_facets_free(&cut);
    return true;
}

static bool read_material(reader *r)
{
    sp_token token;
    if (!sp_scan_token(&r->scanner, &token))
        return sp_scanner_ended(&r->scanner, "a page as page_0", r->error);
    char name[16] = "";
    memcpy(name, token.text, token.length < sizeof name ? token.length : 0);
    char *end = name;
    unsigned long page =
        strncmp(name, "page_", 5) == 0 && name[5] >= '0' && name[5] <= '9' ? strtoul(name + 5, &end, 10) : 0;
    if (end == name || *end || page >= 1000000)
        return sp_token_unexpected(&r->scanner, &token, "a page as page_0", r->error);
    r->page = (uint32_t)page;
    return true;
}

static bool read_all(reader *r)
{
    sp_token keyword;
    bool good = true;
    while (good && sp_scan_any_token(&r->scanner, &keyword)) {
        if (sp_token_is(&r->scanner, &keyword, "vt"))
            good = add_coordinate(r);
        else if (sp_token_is(&r->scanner, &keyword, "v"))
            good = add_vertex(r);
        else if (is_face(&r->scanner, &keyword))
            good = read_face(r, keyword.line);
        else if (sp_token_is(&r->scanner, &keyword, "usemtl"))
            good = read_material(r);
        if (good && !sp_scan_next_line(&r->scanner))
            break;
    }
    return good;
}

bool sp_texture_read(const char *path, const char *text, size_t size, sp_texture *texture, sp_error *error)
{
    reader r = {.scanner = sp_scanner_open(path, text, size, true), .texture = texture, .error = error};
    *texture = (sp_texture){0};
    bool good = make_room(&r, size) && read_all(&r);
    free(r.vertices);
    free(r.coordinates);
    free(r.corners);
    free(r.corner_uv);
    if (!good)
        sp_texture_free(texture);
    return good;
}

void sp_texture_free(sp_texture *texture)
{
    free(texture->uv);
    free(texture->page);
    free(texture->line);
    *texture = (sp_texture){0};
}
