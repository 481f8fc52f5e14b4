/* Triangles that face the other side than their neighbours. */
#include "mesh/repair/mesh_edit.h"

#include <stdlib.h>

#define TIE 1e-9 /* of the area */

typedef struct {
    sp_mesh_edit *edit;
    sp_vec3 middle;
    uint32_t *across;  /* [3 triangles]: the half edge beside it, of edges of two; else SP_NONE */
    uint8_t *label;    /* [triangles]: 0: not seen, else 1 and 2: of these, one kind is turned over */
    uint32_t *members; /* what hangs together; a queue meanwhile */
    size_t turned;
} turning;

/* What hangs together by edges of two triangles. */
typedef struct {
    size_t count;
    double area[3], volume[3]; /* m², m³; by label */
    bool closed, two_sided, sound;
} patch;

static void find_neighbours(turning *t)
{
    const sp_mesh *mesh = t->edit->mesh;
    const sp_half_edges *edges = &t->edit->edges;
    size_t of_edge;
    for (size_t i = 0; i < 3 * mesh->triangle_count; i += of_edge) {
        const uint32_t *edge = edges->order + i;
        of_edge = sp_half_edges_of_edge(mesh, edges, i);
        for (size_t k = 0; k < of_edge; k++)
            t->across[edge[k]] = of_edge == 2 ? edge[1 - k] : SP_NONE;
    }
}

static void measure(const turning *t, uint32_t triangle, patch *found)
{
    const sp_mesh *mesh = t->edit->mesh;
    const uint32_t *corner = mesh->triangles[triangle];
    sp_vec3 a = sp_sub(mesh->vertices[corner[0]], t->middle), b = sp_sub(mesh->vertices[corner[1]], t->middle),
            c = sp_sub(mesh->vertices[corner[2]], t->middle);
    found->area[t->label[triangle]] += sp_triangle_area(mesh, triangle);
    found->volume[t->label[triangle]] += sp_dot(a, sp_cross(b, c)) / 6;
}

static patch spread(turning *t, uint32_t first)
{
    patch found = {.count = 1, .closed = true, .two_sided = true, .sound = true};
    t->members[0] = first;
    t->label[first] = 1;
    for (size_t i = 0; i < found.count; i++) {
        uint32_t own = t->members[i];
        measure(t, own, &found);
        for (uint32_t h = 3 * own; h < 3 * own + 3; h++) {
            if (t->across[h] == SP_NONE) {
                found.closed = false;
                continue;
            }
            uint32_t other = t->across[h] / 3;
            bool flipped = t->edit->edges.kind[h] == SP_EDGE_FLIPPED;
            uint8_t wanted = flipped ? 3 - t->label[own] : t->label[own];
            found.sound &= !flipped;
            if (!t->label[other]) {
                t->label[other] = wanted;
                t->members[found.count++] = other;
            } else if (t->label[other] != wanted) {
                found.two_sided = false;
            }
        }
    }
    return found;
}

/* The lesser area is turned over; of halves that which makes a closed surface enclose with its back. */
static int label_to_turn(const patch *found)
{
    double difference = found->area[1] - found->area[2];
    if (fabs(difference) > TIE * (found->area[1] + found->area[2]))
        return difference > 0 ? 2 : 1;
    return found->closed && found->volume[1] < found->volume[2] ? 1 : 2;
}

static void turn(turning *t, const patch *found)
{
    int label = label_to_turn(found);
    for (size_t i = 0; i < found->count; i++) {
        uint32_t *corners = t->edit->triangles[t->members[i]];
        if (t->label[t->members[i]] != label)
            continue;
        uint32_t swap = corners[1];
        corners[1] = corners[2];
        corners[2] = swap;
        t->turned++;
    }
}

bool sp_turn_over(sp_mesh_edit *edit, bool careful, size_t *done, sp_error *error)
{
    (void)careful;
    size_t count = edit->mesh->triangle_count;
    sp_vec3 low, high;
    sp_mesh_box(edit->mesh, &low, &high);
    turning t = {edit,
                 sp_scale(sp_add(low, high), 0.5),
                 malloc((3 * count + 1) * sizeof *t.across),
                 calloc(count + 1, 1),
                 malloc((count + 1) * sizeof *t.members),
                 0};
    bool good = (t.across && t.label && t.members) || sp_fail_memory(error);
    if (good)
        find_neighbours(&t);
    for (uint32_t first = 0; good && first < count; first++) {
        if (t.label[first])
            continue;
        patch found = spread(&t, first);
        if (!found.sound && found.two_sided)
            turn(&t, &found);
    }
    *done = t.turned;
    free(t.across);
    free(t.label);
    free(t.members);
    return good;
}
