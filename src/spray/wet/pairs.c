#include "spray/wet/pairs.h"

#include "mesh/box_pairs.h"
#include "mesh/siphash.h"

#include <stdlib.h>
#include <string.h>

#define MOST_SHELLS 256 /* beyond it shells' boxes are not compared with each other */
#define FOLDED 1e-6     /* rad: neighbours at a smaller angle lie on each other */

typedef struct {
    const sp_mesh *mesh;
    const sp_shells *shells;
    sp_box *box; /* [triangles] */
    sp_pair *pairs;
    size_t count, capacity;
    bool failed; /* memory ran out */
} pair_search;

static void note(pair_search *search, uint32_t a, uint32_t b, bool copy)
{
    if (search->count == search->capacity) {
        size_t capacity = 2 * search->capacity + 1024;
        sp_pair *pairs = realloc(search->pairs, capacity * sizeof *pairs);
        if (!pairs) {
            search->failed = true;
            return;
        }
        search->pairs = pairs;
        search->capacity = capacity;
    }
    search->pairs[search->count++] = (sp_pair){a, b, copy};
}

/* Whether two triangles have two corners in common and lie side by side there, at whatever angle, rather than folded
 * onto each other. */
static bool lie_side_by_side(const sp_mesh *mesh, uint32_t a, uint32_t b)
{
    int common = 0, own[2] = {3, 3}; /* the last corner of either that the other has not */
    bool shared[2][3] = {{false}};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            if (mesh->triangles[a][i] == mesh->triangles[b][k]) {
                common++;
                shared[0][i] = shared[1][k] = true;
            }
    if (common != 2)
        return false;
    for (int i = 0; i < 3; i++) {
        own[0] = shared[0][i] ? own[0] : i;
        own[1] = shared[1][i] ? own[1] : i;
    }
    const uint32_t *corners = mesh->triangles[a];
    sp_vec3 from = mesh->vertices[corners[(own[0] + 1) % 3]], to = mesh->vertices[corners[(own[0] + 2) % 3]];
    sp_vec3 along = sp_unit(sp_sub(to, from)), across[2];
    across[0] = sp_sub(mesh->vertices[corners[own[0]]], from);
    across[1] = sp_sub(mesh->vertices[mesh->triangles[b][own[1]]], from);
    for (int i = 0; i < 2; i++)
        across[i] = sp_unit(sp_along(across[i], -sp_dot(across[i], along), along));
    return !(sp_dot(across[0], across[1]) > 0 && sp_length(sp_cross(across[0], across[1])) < FOLDED);
}

/* A box visitor. */
static bool compare(void *user, uint32_t a, uint32_t b)
{
    pair_search *search = user;
    uint32_t shell = search->shells->of[a];
    if ((shell != search->shells->of[b] || !search->shells->simple[shell]) && !lie_side_by_side(search->mesh, a, b))
        note(search, a < b ? a : b, a < b ? b : a, false);
    return !search->failed;
}

/* Whether a triangle's box meets that of a shell with which it may interfere. */
static bool may_meet(const pair_search *search, uint32_t triangle, double margin)
{
    const sp_shells *shells = search->shells;
    uint32_t own = shells->of[triangle];
    if (!shells->simple[own] || shells->count > MOST_SHELLS)
        return true;
    for (uint32_t s = 0; s < shells->count; s++) {
        sp_box box = {{shells->low[s].x - margin, shells->low[s].y - margin, shells->low[s].z - margin},
                      {shells->high[s].x + margin, shells->high[s].y + margin, shells->high[s].z + margin}};
        if (s != own && sp_boxes_overlap(&box, &search->box[triangle]))
            return true;
    }
    return false;
}

static bool same_corners(const sp_mesh *mesh, uint32_t a, uint32_t b)
{
    const uint32_t *p = mesh->triangles[a], *q = mesh->triangles[b];
    for (int i = 0; i < 3; i++)
        if (p[i] != q[0] && p[i] != q[1] && p[i] != q[2])
            return false;
    return true;
}

/* Triangles by hash of their corners, SP_NONE where free. */
typedef struct {
    size_t size; /* a power of two */
    uint32_t *slots;
    sp_hash_key key;
} corner_table;

static bool table_create(corner_table *table, size_t triangles)
{
    for (table->size = 16; table->size < 2 * triangles;)
        table->size *= 2;
    table->key = sp_hash_key_draw();
    table->slots = malloc(table->size * sizeof *table->slots);
    if (table->slots)
        memset(table->slots, 0xff, table->size * sizeof *table->slots);
    return table->slots != NULL;
}

/* Whether an earlier triangle has the same corners and stands for this one: of a thousand copies one is compared with
 * the rest of the mesh, and each of the others with that one alone. A solid's triangle does not
 * stand for a sheet's. */
static bool is_copy(pair_search *search, corner_table *table, uint32_t triangle)
{
    const sp_shells *shells = search->shells;
    const uint32_t *corner = search->mesh->triangles[triangle];
    uint64_t hash = 0; /* in whatever order they stand */
    for (int i = 0; i < 3; i++)
        hash += sp_siphash(table->key, &corner[i], sizeof corner[i]);
    size_t slot = hash & (table->size - 1);
    while (table->slots[slot] != SP_NONE && !same_corners(search->mesh, table->slots[slot], triangle))
        slot = (slot + 1) & (table->size - 1);
    uint32_t first = table->slots[slot];
    if (first == SP_NONE || (shells->closed[shells->of[first]] && !shells->closed[shells->of[triangle]])) {
        table->slots[slot] = triangle;
        return false;
    }
    note(search, first, triangle, true);
    return true;
}

static int by_triangles(const void *left, const void *right)
{
    const sp_pair *p = left, *q = right;
    if (p->a != q->a)
        return p->a < q->a ? -1 : 1;
    return p->b < q->b ? -1 : p->b > q->b;
}

sp_pair *sp_pairs_create(const sp_mesh *mesh, const sp_shells *shells, double margin, size_t *count, sp_error *error)
{
    size_t triangles = mesh->triangle_count, candidates = 0;
    uint32_t *list = malloc((triangles + 1) * sizeof *list);
    pair_search search = {.mesh = mesh,
                          .shells = shells,
                          .box = malloc((triangles + 1) * sizeof *search.box),
                          .pairs = malloc(1024 * sizeof *search.pairs),
                          .capacity = 1024};
    corner_table table = {0};
    search.failed = !list || !search.box || !search.pairs || !table_create(&table, triangles);
    for (uint32_t t = 0; !search.failed && t < triangles; t++) {
        search.box[t] = sp_box_of(mesh, t, margin);
        if (may_meet(&search, t, margin) && !is_copy(&search, &table, t))
            list[candidates++] = t;
    }
    search.failed = search.failed || !sp_box_pairs(search.box, list, candidates, compare, &search, error);
    free(list);
    free(table.slots);
    free(search.box);
    if (search.failed) {
        free(search.pairs);
        return sp_fail_memory(error);
    }
    qsort(search.pairs, search.count, sizeof *search.pairs, by_triangles);
    *count = search.count;
    return search.pairs;
}
