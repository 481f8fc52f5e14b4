/* What the targets of mesh files do with what was read. */
#ifndef TESTS_FUZZ_MESH_H
#define TESTS_FUZZ_MESH_H

#include "mesh/file.h"
#include "mesh/soup.h"
#include "target.h"

#include <unistd.h>

static inline void require_sound_soup(const sp_soup *soup)
{
    for (size_t i = 0; i < soup->vertex_count; i++)
        REQUIRE(sp_coordinates_allowed(soup->vertices[i]));
    for (size_t t = 0; t < soup->triangle_count; t++) {
        REQUIRE(soup->part[t] < soup->part_count);
        for (int k = 0; k < 3; k++)
            REQUIRE(soup->triangles[t][k] < soup->vertex_count);
    }
    for (size_t i = 0; i < soup->part_count; i++) {
        require_utf8(soup->part_names[i]);
        for (size_t k = 0; soup->part_count < 10 && k < i; k++)
            REQUIRE(strcmp(soup->part_names[i], soup->part_names[k]) != 0);
    }
}

static inline void require_sound_mesh(const sp_mesh *mesh)
{
    REQUIRE(mesh->triangle_count <= mesh->source_triangle_count && mesh->part_count > 0);
    for (size_t i = 0; i < mesh->vertex_count; i++)
        REQUIRE(sp_coordinates_allowed(mesh->vertices[i]));
    for (size_t s = 0; s < mesh->source_triangle_count; s++) {
        REQUIRE(mesh->source_part[s] < mesh->part_count);
        for (int k = 0; k < 3; k++)
            REQUIRE(mesh->source_triangles[s][k] < mesh->vertex_count);
    }
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        size_t source = mesh->source[t];
        REQUIRE(source < mesh->source_triangle_count && (t == 0 || source > mesh->source[t - 1]));
        REQUIRE(memcmp(mesh->triangles[t], mesh->source_triangles[source], sizeof *mesh->triangles) == 0);
        REQUIRE(mesh->part[t] == mesh->source_part[source]);
        double area = sp_triangle_area(mesh, (uint32_t)t);
        REQUIRE(area >= 0 && isfinite(area));
    }
    for (size_t i = 0; i < mesh->part_count; i++)
        require_utf8(mesh->parts[i].name);
}

/* Takes what the soup holds. */
static inline sp_mesh *weld_soup(sp_soup *soup)
{
    sp_error error = {0};
    size_t triangles = soup->triangle_count, vertices = soup->vertex_count, parts = soup->part_count;
    sp_mesh *mesh = sp_soup_mesh(soup, &error);
    REQUIRE(mesh && error.kind == SP_OK);
    REQUIRE(mesh->source_triangle_count == triangles && mesh->vertex_count <= vertices && mesh->part_count == parts);
    require_sound_mesh(mesh);
    return mesh;
}

/* What is welded stays as it is when it is welded again. */
static inline void require_welded(const sp_mesh *mesh)
{
    sp_error error = {0};
    sp_mesh *again = sp_mesh_create(mesh->vertices, mesh->vertex_count, (const uint32_t(*)[3])mesh->source_triangles,
                                    mesh->source_triangle_count, mesh->source_part, NULL, mesh->part_count, &error);
    REQUIRE(again && again->vertex_count == mesh->vertex_count && again->triangle_count == mesh->triangle_count);
    if (mesh->triangle_count)
        REQUIRE(memcmp(again->source, mesh->source, mesh->triangle_count * sizeof *mesh->source) == 0);
    sp_mesh_destroy(again);
}

/* What is written is the same triangles, to the last bit. */
static inline void require_written_mesh(const sp_mesh *mesh)
{
    static char path[64];
    sp_error error = {0};
    size_t size;
    sp_soup soup = {0};
    if (!path[0])
        snprintf(path, sizeof path, "/dev/shm/sprayplan-fuzz-%ld", (long)getpid());
    REQUIRE(sp_mesh_write_obj(mesh, path, &error));
    char *text = sp_read_file(path, &size, &error);
    REQUIRE(text && unlink(path) == 0);
    if (!sp_obj_read("again", text, size, 1, &soup, &error))
        fprintf(stderr, "%d: %s in\n%s", error.line, error.message, text);
    REQUIRE(error.kind == SP_OK && soup.triangle_count == mesh->triangle_count);
    for (size_t t = 0; t < soup.triangle_count; t++)
        for (int k = 0; k < 3; k++)
            REQUIRE(memcmp(&soup.vertices[soup.triangles[t][k]], &mesh->vertices[mesh->triangles[t][k]],
                           sizeof *mesh->vertices) == 0);
    sp_soup_clear(&soup);
    free(text);
}

enum { WRITTEN_MESH = 32 }; /* of so many lengths one: a file takes longer than all the rest */

typedef bool mesh_reader(const char *path, const char *text, size_t size, double unit, sp_soup *soup, sp_error *error);

static inline void read_mesh(mesh_reader *read, const uint8_t *data, size_t size)
{
    sp_error error = {0};
    sp_soup soup = {0};
    meter_start();
    char *text = target_text(data, size);
    target_accepted = read("strange", text, size, 1, &soup, &error);
    free(text);
    REQUIRE(target_accepted == (error.kind == SP_OK));
    require_sound_soup(&soup);
    if (target_accepted && soup.triangle_count > 0) {
        sp_mesh *mesh = weld_soup(&soup);
        require_frugal(size);
        require_welded(mesh);
        if (mesh->triangle_count && size % WRITTEN_MESH == 0)
            require_written_mesh(mesh);
        sp_mesh_destroy(mesh);
    } else if (!target_accepted) {
        require_located(&error, "strange", data, size);
    }
    require_frugal(size);
    sp_soup_clear(&soup);
}

#endif
