/* What is wrong with a mesh as a surface. */
#include <sprayplan/mesh.h>

#include "atlas/edges.h"
#include "atlas/order.h"

#include <stdlib.h>
#include <string.h>

/* Union-find over triangles, and which trees hold an edge that no closed surface has. */
typedef struct {
    uint32_t *parent; /* [triangle_count] */
    bool *open;       /* [triangle_count], said of roots once all is joined */
} shells;

static uint32_t root_of(uint32_t *parent, uint32_t i)
{
    while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
    return i;
}

/* The lower number stays root. */
static void unite(uint32_t *parent, uint32_t a, uint32_t b)
{
    a = root_of(parent, a);
    b = root_of(parent, b);
    if (a < b)
        parent[b] = a;
    else
        parent[a] = b;
}

static uint32_t start_of(const sp_mesh *mesh, uint32_t half_edge)
{
    return mesh->triangles[half_edge / 3][half_edge % 3];
}

/* One edge with its half-edges. */
static void count_edge(const sp_mesh *mesh, const uint32_t *half_edges, size_t count, shells *found,
                       sp_mesh_diagnosis *diagnosis)
{
    bool open = count == 1, forked = count > 2;
    bool flipped = count == 2 && start_of(mesh, half_edges[0]) == start_of(mesh, half_edges[1]);
    diagnosis->open_edges += open;
    diagnosis->non_manifold_edges += forked;
    diagnosis->flipped_edges += flipped;
    for (size_t i = 0; i < count; i++) {
        unite(found->parent, half_edges[0] / 3, half_edges[i] / 3);
        found->open[half_edges[i] / 3] |= open || forked || flipped;
    }
}

static void count_edges(const sp_mesh *mesh, const uint32_t *order, shells *found, sp_mesh_diagnosis *diagnosis)
{
    size_t count = 3 * mesh->triangle_count;
    for (size_t first = 0, next; first < count; first = next) {
        uint64_t key = sp_edge_key(mesh, order[first]);
        for (next = first + 1; next < count && sp_edge_key(mesh, order[next]) == key;)
            next++;
        count_edge(mesh, order + first, next - first, found, diagnosis);
    }
}

static void count_shells(const sp_mesh *mesh, shells *found, sp_mesh_diagnosis *diagnosis)
{
    for (size_t t = 0; t < mesh->triangle_count; t++)
        if (found->open[t])
            found->open[root_of(found->parent, (uint32_t)t)] = true;
    for (size_t t = 0; t < mesh->triangle_count; t++)
        if (found->parent[t] == t) {
            diagnosis->shells++;
            diagnosis->closed_shells += !found->open[t];
        }
}

typedef struct {
    uint32_t corners[3]; /* ascending */
} corner_set;

static int compare_corners(const void *a, const void *b)
{
    const uint32_t *x = ((const corner_set *)a)->corners, *y = ((const corner_set *)b)->corners;
    for (int i = 0; i < 3; i++)
        if (x[i] != y[i])
            return x[i] < y[i] ? -1 : 1;
    return 0;
}

static void swap_if_above(uint32_t *a, uint32_t *b)
{
    if (*a > *b) {
        uint32_t kept = *a;
        *a = *b;
        *b = kept;
    }
}

static bool count_duplicates(const sp_mesh *mesh, sp_mesh_diagnosis *diagnosis)
{
    corner_set *sets = malloc((mesh->triangle_count + 1) * sizeof *sets);
    if (!sets)
        return false;
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        uint32_t *corners = sets[t].corners;
        memcpy(corners, mesh->triangles[t], sizeof sets[t].corners);
        swap_if_above(&corners[0], &corners[1]);
        swap_if_above(&corners[1], &corners[2]);
        swap_if_above(&corners[0], &corners[1]);
    }
    qsort(sets, mesh->triangle_count, sizeof *sets, compare_corners);
    for (size_t t = 1; t < mesh->triangle_count; t++)
        diagnosis->duplicate_triangles += compare_corners(&sets[t - 1], &sets[t]) == 0;
    free(sets);
    return true;
}

static void measure_box(const sp_mesh *mesh, sp_mesh_diagnosis *diagnosis)
{
    for (size_t t = 0; t < mesh->triangle_count; t++)
        for (int i = 0; i < 3; i++) {
            sp_vec3 p = mesh->vertices[mesh->triangles[t][i]];
            sp_vec3 low = t + (size_t)i ? diagnosis->minimum : p, high = t + (size_t)i ? diagnosis->maximum : p;
            diagnosis->minimum = sp_v(fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z));
            diagnosis->maximum = sp_v(fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z));
        }
}

bool sp_mesh_diagnose(const sp_mesh *mesh, sp_mesh_diagnosis *diagnosis, sp_error *error)
{
    *diagnosis = (sp_mesh_diagnosis){.degenerate = mesh->source_triangle_count - mesh->triangle_count,
                                     .area = sp_mesh_area(mesh)};
    shells found = {malloc((mesh->triangle_count + 1) * sizeof *found.parent),
                    calloc(mesh->triangle_count + 1, sizeof *found.open)};
    uint32_t *order = sp_edges_in_order(mesh);
    bool good = found.parent && found.open && order && count_duplicates(mesh, diagnosis);
    if (good) {
        for (size_t t = 0; t < mesh->triangle_count; t++)
            found.parent[t] = (uint32_t)t;
        count_edges(mesh, order, &found, diagnosis);
        count_shells(mesh, &found, diagnosis);
        measure_box(mesh, diagnosis);
    } else {
        sp_fail_memory(error);
    }
    free(order);
    free(found.parent);
    free(found.open);
    return good;
}
