#include "mesh/cad/mend.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_PASSES = 20 }; /* where the neighbour has no area either, its pieces are looked at again */

/* A triangle without area, a -> b -> c with b between the others, and the neighbour a -> c -> d. */
typedef struct {
    uint32_t a, b, c, part, triangle, neighbour, d;
} flat;

static int compare(const flat *x, uint32_t a, uint32_t c, uint32_t part)
{
    if (x->a != a)
        return x->a < a ? -1 : 1;
    if (x->c != c)
        return x->c < c ? -1 : 1;
    return x->part != part ? x->part < part ? -1 : 1 : 0;
}

static int by_edge(const void *left, const void *right)
{
    const flat *x = left, *y = right;
    int order = compare(x, y->a, y->c, y->part);
    return order ? order : x->triangle < y->triangle ? -1 : x->triangle > y->triangle;
}

static bool is_flat(const sp_mesh *mesh, size_t source, flat *found)
{
    const uint32_t *corners = mesh->source_triangles[source];
    double longest = 0;
    int apex = 0;
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
        return false;
    for (int k = 0; k < 3; k++) {
        double length = sp_distance(mesh->vertices[corners[(k + 1) % 3]], mesh->vertices[corners[(k + 2) % 3]]);
        if (length > longest) {
            longest = length;
            apex = k;
        }
    }
    *found = (flat){corners[(apex + 2) % 3],
                    corners[apex],
                    corners[(apex + 1) % 3],
                    mesh->source_part[source],
                    (uint32_t)source,
                    SP_NONE,
                    SP_NONE};
    return true;
}

/* Those that the mesh has left out, by their long edge. NULL, with *count 0, where there are none. */
static flat *find_flats(const sp_mesh *mesh, size_t *count, sp_error *error)
{
    size_t left_out = mesh->source_triangle_count - mesh->triangle_count, kept = 0;
    flat *flats = left_out ? malloc(left_out * sizeof *flats) : NULL;
    *count = 0;
    if (left_out && !flats)
        return sp_fail_memory(error);
    for (size_t s = 0; flats && s < mesh->source_triangle_count; s++) {
        if (kept < mesh->triangle_count && mesh->source[kept] == s)
            kept++;
        else
            *count += is_flat(mesh, s, &flats[*count]);
    }
    if (*count)
        qsort(flats, *count, sizeof *flats, by_edge);
    return flats;
}

static void find_neighbours(const sp_mesh *mesh, flat *flats, size_t count)
{
    for (size_t s = 0; s < mesh->source_triangle_count; s++)
        for (int k = 0; k < 3; k++) {
            const uint32_t *corners = mesh->source_triangles[s];
            uint32_t from = corners[k], to = corners[(k + 1) % 3];
            size_t low = 0, high = count;
            while (low < high) {
                size_t middle = (low + high) / 2;
                if (compare(&flats[middle], from, to, mesh->source_part[s]) < 0)
                    low = middle + 1;
                else
                    high = middle;
            }
            if (low < count && compare(&flats[low], from, to, mesh->source_part[s]) == 0 &&
                flats[low].neighbour == SP_NONE) {
                flats[low].neighbour = (uint32_t)s;
                flats[low].d = corners[(k + 2) % 3];
            }
        }
}

static void put(uint32_t *triangle, uint32_t a, uint32_t b, uint32_t c)
{
    triangle[0] = a;
    triangle[1] = b;
    triangle[2] = c;
}

/* Splits in the mesh's own source triangles, each at most once; how many. */
static size_t split_neighbours(sp_mesh *mesh, const flat *flats, size_t count, bool *touched)
{
    size_t done = 0;
    for (size_t i = 0; i < count; i++) {
        const flat *f = &flats[i];
        if (f->neighbour == SP_NONE || f->d == f->b || touched[f->neighbour] || touched[f->triangle])
            continue;
        touched[f->neighbour] = touched[f->triangle] = true;
        put(mesh->source_triangles[f->triangle], f->a, f->b, f->d);
        put(mesh->source_triangles[f->neighbour], f->b, f->c, f->d);
        done++;
    }
    return done;
}

/* Closes up the mesh's source triangles over those with two equal corners; how many. */
static size_t drop_points(sp_mesh *mesh)
{
    size_t kept = 0, count = mesh->source_triangle_count;
    for (size_t s = 0; s < count; s++) {
        const uint32_t *corners = mesh->source_triangles[s];
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
            continue;
        memmove(mesh->source_triangles[kept], corners, sizeof *mesh->source_triangles);
        mesh->source_part[kept++] = mesh->source_part[s];
    }
    mesh->source_triangle_count = kept;
    return count - kept;
}

static sp_mesh *anew(const sp_mesh *mesh, sp_error *error)
{
    const char **names = calloc(mesh->part_count + 1, sizeof *names);
    if (!names)
        return sp_fail_memory(error);
    for (size_t i = 0; i < mesh->part_count; i++)
        names[i] = mesh->parts[i].name;
    sp_mesh *made = sp_mesh_create(mesh->vertices, mesh->vertex_count, (const uint32_t(*)[3])mesh->source_triangles,
                                   mesh->source_triangle_count, mesh->source_part, names, mesh->part_count, error);
    free(names);
    return made;
}

/* What can be done at once, in the mesh's source triangles. False where memory runs out. */
static bool mend_once(sp_mesh *mesh, size_t *done, sp_error *error)
{
    size_t count;
    flat *flats = find_flats(mesh, &count, error);
    bool *touched = calloc(mesh->source_triangle_count + 1, sizeof *touched);
    bool good = touched && (flats || mesh->source_triangle_count == mesh->triangle_count);
    *done = 0;
    if (good && count) {
        find_neighbours(mesh, flats, count);
        *done = split_neighbours(mesh, flats, count, touched);
    }
    if (good)
        *done += drop_points(mesh);
    free(touched);
    free(flats);
    return good || sp_fail_memory(error);
}

sp_mesh *sp_cad_mend(sp_mesh *mesh, size_t *mended, sp_error *error)
{
    for (int pass = 0; mesh && pass < MOST_PASSES; pass++) {
        size_t done;
        bool good = mend_once(mesh, &done, error);
        if (good && !done)
            break;
        sp_mesh *better = good ? anew(mesh, error) : NULL;
        sp_mesh_destroy(mesh);
        mesh = better;
        *mended += done;
    }
    return mesh;
}
