#include <sprayplan/cad.h>

#include "mesh/file.h"
#include "mesh/locales.h"
#include "mesh/soup.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

/* How much to read at first: a byte more than there is, where that is known, so that the end is seen. */
static size_t first_room(FILE *file)
{
    struct stat status;
    bool known = fstat(fileno(file), &status) == 0 && S_ISREG(status.st_mode) && status.st_size > 0 &&
                 (uintmax_t)status.st_size < SIZE_MAX - 2;
    return known ? (size_t)status.st_size + 2 : 1 << 16;
}

/* The rest of the file into a block that grows; NULL when memory runs out. */
static char *read_all(FILE *file, size_t *size)
{
    size_t room = first_room(file);
    char *text = malloc(room);
    *size = 0;
    while (text) {
        *size += fread(text + *size, 1, room - 1 - *size, file);
        if (*size < room - 1)
            break;
        char *larger = room <= SIZE_MAX / 2 ? realloc(text, 2 * room) : NULL;
        if (!larger)
            free(text);
        text = larger;
        room *= 2;
    }
    return text;
}

/* With a zero behind it. */
static char *read_stream(FILE *file, const char *path, size_t *size, sp_error *error)
{
    char *text = read_all(file, size);
    if (!text) {
        sp_fail_memory(error);
    } else if (ferror(file)) {
        sp_fail(error, SP_ERROR_INPUT, path, 0, 0, "cannot be read: %s", strerror(errno));
        free(text);
        text = NULL;
    } else {
        text[*size] = '\0';
    }
    return text;
}

char *sp_read_file(const char *path, size_t *size, sp_error *error)
{
    FILE *file = fopen(path, "rb");
    if (!file) {
        sp_fail(error, SP_ERROR_INPUT, path, 0, 0, "cannot be opened: %s", strerror(errno));
        return NULL;
    }
    char *text = read_stream(file, path, size, error);
    fclose(file);
    return text;
}

typedef bool read_function(const char *path, const char *text, size_t size, double unit, sp_soup *soup,
                           sp_error *error);

static read_function *reader_for(const char *path, sp_error *error)
{
    const char *dot = strrchr(path, '.');
    if (dot && strcasecmp(dot, ".obj") == 0)
        return sp_obj_read;
    if (dot && strcasecmp(dot, ".stl") == 0)
        return sp_stl_read;
    if (dot && strcasecmp(dot, ".ply") == 0)
        return sp_ply_read;
    sp_fail(error, SP_ERROR_INPUT, path, 0, 0,
            "found a file of unknown kind, expected .obj, .stl, .ply, .step, .iges or .brep");
    return NULL;
}

/* By what the file begins with, or for STL by its size. */
static read_function *reader_of(const char *name, const char *text, size_t size, sp_error *error)
{
    static const char *const cad[] = {"ISO-10303-21", "DBRep_DrawableShape", "CASCADE Topology"};
    bool iges = size > 72 && text[72] == 'S' && memchr(text, '\n', 72) == NULL; /* the section of its first line */
    for (size_t i = 0; i < sizeof cad / sizeof *cad; i++)
        iges = iges || (size > strlen(cad[i]) && memcmp(text, cad[i], strlen(cad[i])) == 0);
    if (iges) {
        sp_fail(error, SP_ERROR_INPUT, name, 0, 0,
                "found a CAD file, expected OBJ, STL or PLY: CAD files are read by their path alone");
        return NULL;
    }
    if (size > 3 && memcmp(text, "ply", 3) == 0 && strchr(" \t\r\n", text[3]) && text[3])
        return sp_ply_read;
    return sp_stl_is(text, size) ? sp_stl_read : sp_obj_read;
}

/* Numbers are read in the "C" locale whatever the program has set; only this thread is touched. */
static bool read_in_c_locale(read_function *read, const char *path, const char *text, size_t size, double unit,
                             sp_soup *soup, sp_error *error)
{
    locale_t c = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (c == (locale_t)0)
        return sp_fail_memory(error);
    locale_t before = uselocale(c);
    bool good = read(path, text, size, unit, soup, error);
    uselocale(before);
    freelocale(c);
    return good;
}

static sp_mesh *weld(const char *path, sp_soup *soup, sp_error *error)
{
    if (soup->triangle_count == 0) {
        sp_fail(error, SP_ERROR_INPUT, path, 0, 0, "found no triangle, expected at least one");
        return NULL;
    }
    sp_mesh *mesh = sp_soup_mesh(soup, error);
    if (mesh && mesh->triangle_count == 0) {
        sp_fail(error, SP_ERROR_INPUT, path, 0, 0,
                "found only triangles without area, expected at least one with some");
        sp_mesh_destroy(mesh);
        mesh = NULL;
    }
    return mesh;
}

static bool is_unit(const char *path, double unit, sp_error *error)
{
    return (unit > 0 && isfinite(unit)) ||
           sp_fail(error, SP_ERROR_ARGUMENT, path, 0, 0, "found a unit of %g m, expected a positive one", unit);
}

static sp_mesh *read_mesh(read_function *read, const char *path, char *text, size_t size, double unit, sp_error *error)
{
    sp_soup soup = {0};
    bool good = read_in_c_locale(read, path, text, size, unit, &soup, error);
    free(text);
    sp_mesh *mesh = good ? weld(path, &soup, error) : NULL;
    sp_soup_clear(&soup);
    return mesh;
}

sp_mesh *sp_mesh_load(const char *path, double unit, sp_error *error)
{
    if (!path)
        return NULL;
    if (!is_unit(path, unit, error))
        return NULL;
    if (sp_cad_kind_of(path) != SP_CAD_NONE) {
        const sp_cad_options options = sp_cad_options_default();
        return sp_cad_load(path, unit, &options, NULL, error);
    }
    size_t size;
    read_function *read = reader_for(path, error);
    char *text = read ? sp_read_file(path, &size, error) : NULL;
    return text ? read_mesh(read, path, text, size, unit, error) : NULL;
}

sp_mesh *sp_mesh_load_stream(FILE *stream, const char *name, double unit, sp_error *error)
{
    if (!stream || !name)
        return NULL;
    size_t size;
    char *text = is_unit(name, unit, error) ? read_stream(stream, name, &size, error) : NULL;
    read_function *read = text ? reader_of(name, text, size, error) : NULL;
    if (read)
        return read_mesh(read, name, text, size, unit, error);
    free(text);
    return NULL;
}
