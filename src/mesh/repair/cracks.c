/* Corners at cracks, joined in pairs of which either is the other's nearest. */
#include "mesh/box_pairs.h"
#include "mesh/diagnosis/flaw.h"
#include "mesh/repair/mesh_edit.h"
#include "mesh/duplicates.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_PASSES = 30 }; /* in which pairs are given up */
#define UNSEEN (SP_NONE - 1)

typedef struct {
    sp_mesh_edit *edit;
    bool careful;
    double *radius;    /* [vertices], as sp_crack_corners gives it */
    uint32_t *list;    /* corners on open edges */
    uint32_t *shell;   /* [vertices], of a corner of two shells SP_NONE */
    uint32_t *nearest; /* [vertices], later the other of the pair, or SP_NONE */
    size_t left;       /* pairs that may be looked at */
} joining;

static void consider(joining *j, uint32_t own, uint32_t other, double distance)
{
    const sp_vec3 *at = j->edit->mesh->vertices;
    uint32_t last = j->nearest[own];
    double least = last == SP_NONE ? INFINITY : sp_distance(at[own], at[last]);
    if (distance < least || (distance <= least && other < last))
        j->nearest[own] = other;
}

/* A box visitor. */
static bool look_at(void *user, uint32_t a, uint32_t b)
{
    joining *j = user;
    if (j->left-- == 0)
        return false;
    double distance = sp_distance(j->edit->mesh->vertices[a], j->edit->mesh->vertices[b]);
    if (distance > 2 * fmin(j->radius[a], j->radius[b]) ||
        (j->careful && (j->shell[a] == SP_NONE || j->shell[a] != j->shell[b])))
        return true;
    consider(j, a, b, distance);
    consider(j, b, a, distance);
    return true;
}

static void find_shells(joining *j)
{
    const sp_mesh *mesh = j->edit->mesh;
    for (size_t v = 0; v < mesh->vertex_count; v++)
        j->shell[v] = UNSEEN;
    for (size_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++) {
            uint32_t *shell = &j->shell[mesh->triangles[t][k]], own = j->edit->shell[t];
            *shell = *shell == UNSEEN || *shell == own ? own : SP_NONE;
        }
}

/* Keeps of nearest corners those that are each other's. */
static void keep_pairs(joining *j)
{
    size_t count = j->edit->mesh->vertex_count;
    for (size_t v = 0; v < count; v++) {
        uint32_t other = j->nearest[v];
        j->list[v] = other != SP_NONE && j->nearest[other] == v ? other : SP_NONE;
    }
    memcpy(j->nearest, j->list, count * sizeof *j->nearest);
}

/* Leaves pairs, each in both of its corners. False when memory runs out. */
static bool find_pairs(joining *j, sp_error *error)
{
    const sp_mesh *mesh = j->edit->mesh;
    sp_vec3 low, high;
    double crack = SP_CRACK * sp_mesh_box(mesh, &low, &high);
    sp_box *boxes = malloc((mesh->vertex_count + 1) * sizeof *boxes);
    if (!boxes)
        return sp_fail_memory(error);
    find_shells(j);
    size_t count = sp_crack_corners(mesh, &j->edit->edges, crack, j->radius, j->list);
    j->left = SP_PAIRS_MOST(count);
    for (size_t v = 0; v < mesh->vertex_count; v++)
        j->nearest[v] = SP_NONE;
    for (size_t i = 0; i < count; i++)
        boxes[j->list[i]] = sp_box_around(mesh->vertices[j->list[i]], j->radius[j->list[i]]);
    bool good = sp_box_pairs(boxes, j->list, count, look_at, j, error) || j->left == SIZE_MAX;
    keep_pairs(j);
    free(boxes);
    return good;
}

static uint32_t image(const joining *j, uint32_t v)
{
    return j->nearest[v] < v ? j->nearest[v] : v;
}

static void give_up(joining *j, uint32_t v)
{
    if (j->nearest[v] == SP_NONE)
        return;
    j->nearest[j->nearest[v]] = SP_NONE;
    j->nearest[v] = SP_NONE;
}

static void give_up_triangle(joining *j, uint32_t triangle)
{
    for (int k = 0; k < 3; k++)
        give_up(j, j->edit->mesh->triangles[triangle][k]);
}

/* Draws the triangles anew. False where some had to give up pairs, for they would have collapsed or turned over. */
static bool shapes_hold(joining *j)
{
    const sp_mesh *mesh = j->edit->mesh;
    bool hold = true;
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        const uint32_t *before = mesh->triangles[t];
        uint32_t *corners = j->edit->triangles[t];
        for (int k = 0; k < 3; k++)
            corners[k] = image(j, before[k]);
        bool same = corners[0] == before[0] && corners[1] == before[1] && corners[2] == before[2];
        if (same || sp_keeps_its_side(mesh, sp_corners_area(mesh, before), corners))
            continue;
        hold = false;
        give_up_triangle(j, (uint32_t)t);
    }
    return hold;
}

/* False where some pairs were given up, for edges would have had three triangles or, being careful, two that disagree.
 */
static bool edges_hold(joining *j, const sp_mesh *joined, const sp_half_edges *edges)
{
    size_t of_edge;
    bool hold = true;
    for (size_t i = 0; i < 3 * joined->triangle_count; i += of_edge) {
        sp_edge_kind kind = edges->kind[edges->order[i]];
        of_edge = sp_half_edges_of_edge(joined, edges, i);
        if (kind != SP_EDGE_NON_MANIFOLD && !(j->careful && kind == SP_EDGE_FLIPPED))
            continue;
        bool was = true;
        for (size_t k = i; k < i + of_edge; k++)
            was &= j->edit->edges.kind[edges->order[k]] == kind;
        for (size_t k = i; !was && k < i + of_edge; k++) {
            give_up(j, sp_half_edge_from(j->edit->mesh, edges->order[k]));
            give_up(j, sp_half_edge_to(j->edit->mesh, edges->order[k]));
        }
        hold &= was;
    }
    return hold;
}

/* False where some pairs were given up, for triangles would have come to lie where another one lies. */
static bool triangles_hold(joining *j, const sp_mesh *joined, uint32_t *order, bool *hold, sp_error *error)
{
    *hold = true;
    if (!sp_sort_duplicates(joined, order, error))
        return false;
    for (size_t i = 1; i < joined->triangle_count; i++)
        if (sp_are_duplicates(joined, order[i - 1], order[i]) &&
            !sp_are_duplicates(j->edit->mesh, order[i - 1], order[i])) {
            give_up_triangle(j, order[i - 1]);
            give_up_triangle(j, order[i]);
            *hold = false;
        }
    return true;
}

/* Whether the triangles as they are drawn do no harm; else some pairs were given up. False in *good when memory runs
 * out. */
static bool holds(joining *j, uint32_t *order, bool *good, sp_error *error)
{
    sp_mesh joined = *j->edit->mesh;
    sp_half_edges edges = {0};
    bool hold;
    joined.triangles = j->edit->triangles;
    *good = triangles_hold(j, &joined, order, &hold, error) && sp_half_edges_create(&joined, &edges, error);
    hold = *good && edges_hold(j, &joined, &edges) && hold;
    sp_half_edges_destroy(&edges);
    return hold;
}

/* Gives up pairs until what is left does no harm. False when memory runs out. */
static bool settle(joining *j, sp_error *error)
{
    uint32_t *order = malloc((j->edit->mesh->triangle_count + 1) * sizeof *order);
    bool good = order || sp_fail_memory(error), settled = false;
    for (int pass = 0; good && !settled; pass++) {
        if (pass == MOST_PASSES)
            for (uint32_t v = 0; v < j->edit->mesh->vertex_count; v++)
                give_up(j, v);
        settled = shapes_hold(j) && holds(j, order, &good, error);
    }
    free(order);
    return good;
}

static size_t count_pairs(const joining *j)
{
    size_t count = 0;
    for (uint32_t v = 0; v < j->edit->mesh->vertex_count; v++)
        count += j->nearest[v] < v;
    return count;
}

bool sp_join_cracks(sp_mesh_edit *edit, bool careful, size_t *done, sp_error *error)
{
    size_t room = edit->mesh->vertex_count + 1;
    joining j = {edit,
                 careful,
                 malloc(room * sizeof *j.radius),
                 malloc(room * sizeof *j.list),
                 malloc(room * sizeof *j.shell),
                 malloc(room * sizeof *j.nearest),
                 0};
    bool good = (j.radius && j.list && j.shell && j.nearest) || sp_fail_memory(error);
    good = good && find_pairs(&j, error);
    *done = good ? count_pairs(&j) : 0;
    if (*done) {
        good = settle(&j, error);
        *done = count_pairs(&j);
    }
    free(j.radius);
    free(j.list);
    free(j.shell);
    free(j.nearest);
    return good;
}
