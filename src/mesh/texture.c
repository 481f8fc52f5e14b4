/* The second reading of an OBJ file, after Wavefront's "Advanced Visualizer" manual, appendix B1. */
#include "mesh/texture.h"

#include "mesh/scanner.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    sp_scanner scanner;
    sp_texture *texture;
    double (*coordinates)[2];
    size_t coordinate_count;
    uint32_t page;
    sp_error *error;
} reader;

/* How many coordinates and triangles there are, so that no room grows. */
static void count_all(sp_scanner scanner, size_t *coordinates, size_t *triangles)
{
    sp_token token;
    *coordinates = *triangles = 0;
    while (sp_scan_any_token(&scanner, &token)) {
        bool face = sp_token_is(&scanner, &token, "f") || sp_token_is(&scanner, &token, "fo");
        *coordinates += sp_token_is(&scanner, &token, "vt");
        for (size_t corners = 1; face && sp_scan_token(&scanner, &token); corners++)
            *triangles += corners > 2;
        if (!sp_scan_next_line(&scanner))
            break;
    }
}

/* A file takes ten times its size and 64 MiB at most. */
static bool make_room(reader *r, size_t size)
{
    size_t coordinates, triangles;
    sp_texture *t = r->texture;
    count_all(r->scanner, &coordinates, &triangles);
    uint64_t bytes = (uint64_t)coordinates * sizeof *r->coordinates +
                     (uint64_t)triangles * (sizeof *t->uv + sizeof *t->page + sizeof *t->line);
    if (bytes > 9 * (uint64_t)size + (64 << 20))
        return sp_fail(r->error, SP_ERROR_INPUT, r->scanner.path, 0, 0,
                       "found %zu triangles and %zu texture coordinates in %zu bytes, expected fewer", triangles,
                       coordinates, size);
    r->coordinates = malloc((coordinates + 1) * sizeof *r->coordinates);
    t->uv = malloc((triangles + 1) * sizeof *t->uv);
    t->page = malloc((triangles + 1) * sizeof *t->page);
    t->line = malloc((triangles + 1) * sizeof *t->line);
    return (r->coordinates && t->uv && t->page && t->line) || sp_fail_memory(r->error);
}

static bool add_coordinate(reader *r)
{
    double *at = r->coordinates[r->coordinate_count++];
    sp_token token;
    at[1] = 0;
    for (int k = 0; k < 2 && sp_scan_token(&r->scanner, &token); k++)
        if (!sp_token_number(&r->scanner, &token, &at[k], r->error))
            return false;
    return true;
}

/* The coordinates of one corner, v/vt or v/vt/vn; not a number where it has none. */
static void read_corner(const reader *r, const sp_token *token, double uv[2])
{
    const char *slash = memchr(token->text, '/', token->length);
    long index = slash ? strtol(slash + 1, NULL, 10) : 0;
    size_t count = r->coordinate_count, at = index < 0 ? count + (size_t)index : (size_t)index - 1;
    bool there = index && at < count; /* the mesh's reader has seen that it is, but the text may be another */
    uv[0] = there ? r->coordinates[at][0] : NAN;
    uv[1] = there ? r->coordinates[at][1] : NAN;
}

static void read_face(reader *r, int line)
{
    sp_texture *t = r->texture;
    double corner[3][2];
    sp_token token;
    for (size_t corners = 0; sp_scan_token(&r->scanner, &token); corners++) {
        read_corner(r, &token, corner[corners < 2 ? corners : 2]);
        if (corners < 2)
            continue;
        memcpy(t->uv[t->triangle_count], corner, sizeof *t->uv);
        t->page[t->triangle_count] = r->page;
        t->line[t->triangle_count++] = line;
        memcpy(corner[1], corner[2], sizeof corner[1]);
    }
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
        else if (sp_token_is(&r->scanner, &keyword, "f") || sp_token_is(&r->scanner, &keyword, "fo"))
            read_face(r, keyword.line);
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
    free(r.coordinates);
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
