/* Corners that lie on another triangle's open edge, as where one face was cut finely and its neighbour coarsely.
 *
 * A triangle is split at all such corners of one of its edges at once, where more of the pieces of that edge then lie
 * beside an open edge than there are pieces left over. */
#include "mesh/box_pairs.h"
#include "mesh/diagnosis/flaw.h"
#include "mesh/grow.h"
#include "mesh/repair/mesh_edit.h"

#define MOST_CANDIDATES 16 /* for each corner and edge, on the whole */

/* A corner on an edge. */
typedef struct {
    uint32_t half_edge, vertex;
    double along; /* of the edge, 0 to 1 */
} candidate;

typedef struct {
    sp_mesh_edit *edit;
    bool careful;
    double *radius; /* [vertices], as sp_crack_corners gives it */
    uint32_t *item; /* what each box is of: open half edges, and after these corners */
    size_t edge_count, item_count;
    size_t left; /* pairs that may be looked at */
    candidate *found;
    size_t count, room, most;
    bool failed;     /* memory ran out */
    bool *used;      /* [half edges]: open no more */
    bool *touched;   /* [triangles]: split already, or not to be split */
    uint32_t *chain; /* the edge's start, corners on it, its end */
} splitting;

/* A box visitor: item `edge` and item `corner` or the other way round. */
static bool look_at(void *user, uint32_t edge, uint32_t corner)
{
    splitting *s = user;
    const sp_mesh *mesh = s->edit->mesh;
    if (s->left-- == 0)
        return false;
    if ((edge < s->edge_count) == (corner < s->edge_count))
        return true;
    uint32_t h = s->item[edge < corner ? edge : corner], v = s->item[edge < corner ? corner : edge];
    const uint32_t *own = mesh->triangles[h / 3];
    if (v == own[0] || v == own[1] || v == own[2])
        return true;
    sp_vec3 from = mesh->vertices[sp_half_edge_from(mesh, h)], to = mesh->vertices[sp_half_edge_to(mesh, h)];
    sp_vec3 way = sp_sub(to, from), p = mesh->vertices[v];
    double along = sp_dot(sp_sub(p, from), way) / sp_dot(way, way), near = 2 * s->radius[v];
    if (!(along > 0 && along < 1) || sp_distance(p, sp_along(from, along, way)) > near ||
        sp_distance(p, from) <= near || sp_distance(p, to) <= near || s->count == s->most)
        return true;
    s->failed = !sp_grow(&s->found, &s->room, s->count + 1, sizeof *s->found);
    if (!s->failed)
        s->found[s->count++] = (candidate){h, v, along};
    return !s->failed;
}

static int by_edge(const void *left, const void *right)
{
    const candidate *a = left, *b = right;
    if (a->half_edge != b->half_edge)
        return a->half_edge < b->half_edge ? -1 : 1;
    if (a->along < b->along || a->along > b->along)
        return a->along < b->along ? -1 : 1;
    return a->vertex < b->vertex ? -1 : a->vertex > b->vertex;
}

/* Lists open half edges and the corners on them, with their boxes. NULL when memory runs out. */
static sp_box *list_items(splitting *s, double crack)
{
    const sp_mesh *mesh = s->edit->mesh;
    s->item = malloc((3 * mesh->triangle_count + mesh->vertex_count + 1) * sizeof *s->item);
    uint32_t *corners = malloc((mesh->vertex_count + 1) * sizeof *corners);
    size_t corner_count = 0;
    if (s->item && corners) {
        corner_count = sp_crack_corners(mesh, &s->edit->edges, crack, s->radius, corners);
        for (uint32_t h = 0; h < 3 * mesh->triangle_count; h++)
            if (s->edit->edges.kind[h] == SP_EDGE_OPEN)
                s->item[s->edge_count++] = h;
        memcpy(s->item + s->edge_count, corners, corner_count * sizeof *corners);
    }
    s->item_count = s->edge_count + corner_count;
    sp_box *boxes = s->item && corners ? malloc((s->item_count + 1) * sizeof *boxes) : NULL;
    for (size_t i = 0; boxes && i < s->item_count; i++) {
        bool edge = i < s->edge_count;
        sp_vec3 a = mesh->vertices[edge ? sp_half_edge_from(mesh, s->item[i]) : s->item[i]];
        sp_vec3 b = mesh->vertices[edge ? sp_half_edge_to(mesh, s->item[i]) : s->item[i]];
        double near = edge ? 0 : 2 * s->radius[s->item[i]];
        boxes[i] = (sp_box){{fmin(a.x, b.x) - near, fmin(a.y, b.y) - near, fmin(a.z, b.z) - near},
                            {fmax(a.x, b.x) + near, fmax(a.y, b.y) + near, fmax(a.z, b.z) + near}};
    }
    free(corners);
    return boxes;
}

static bool find_candidates(splitting *s, sp_error *error)
{
    sp_vec3 low, high;
    sp_box *boxes = list_items(s, SP_CRACK * sp_mesh_box(s->edit->mesh, &low, &high));
    uint32_t *list = malloc((s->item_count + 1) * sizeof *list);
    bool good = (boxes && list) || sp_fail_memory(error);
    for (uint32_t i = 0; good && i < s->item_count; i++)
        list[i] = i;
    s->left = SP_PAIRS_MOST(s->item_count);
    s->most = MOST_CANDIDATES * s->item_count;
    good = good && (sp_box_pairs(boxes, list, s->item_count, look_at, s, error) || s->left == SIZE_MAX) && !s->failed;
    if (good && s->count)
        qsort(s->found, s->count, sizeof *s->found, by_edge);
    free(boxes);
    free(list);
    return good || sp_fail_memory(error);
}

/* The open half edge that a piece from a to b of half edge `own` would lie beside; SP_NONE where there is none. */
static uint32_t beside(const splitting *s, uint32_t own, uint32_t a, uint32_t b)
{
    const sp_mesh *mesh = s->edit->mesh;
    size_t first = sp_half_edges_between(mesh, &s->edit->edges, a, b);
    uint32_t h = first == SIZE_MAX ? SP_NONE : s->edit->edges.order[first];
    if (h == SP_NONE || s->edit->edges.kind[h] != SP_EDGE_OPEN || s->used[h] || h / 3 == own / 3)
        return SP_NONE;
    if (s->careful && (sp_half_edge_from(mesh, h) != b || s->edit->shell[h / 3] != s->edit->shell[own / 3]))
        return SP_NONE;
    return h;
}

/* Keeps of the chain's `count` corners those beside which something lies; how many. */
static size_t thin_out(splitting *s, uint32_t own, size_t count)
{
    size_t kept = 0;
    bool before = beside(s, own, s->chain[0], s->chain[1]) != SP_NONE;
    for (size_t i = 1; i <= count; i++) {
        bool after = beside(s, own, s->chain[i], s->chain[i + 1]) != SP_NONE;
        if (before || after)
            s->chain[++kept] = s->chain[i];
        before = after;
    }
    s->chain[kept + 1] = s->chain[count + 1];
    return kept;
}

/* Whether splitting at the chain's corners closes more than it opens, and draws no edge that is there already. */
static bool is_worth_it(const splitting *s, uint32_t own, uint32_t apex, size_t count)
{
    const sp_mesh *mesh = s->edit->mesh;
    sp_vec3 area = sp_corners_area(mesh, mesh->triangles[own / 3]);
    size_t closed = 0;
    for (size_t i = 0; i <= count; i++) {
        const uint32_t corners[3] = {s->chain[i], s->chain[i + 1], apex};
        bool fits = beside(s, own, corners[0], corners[1]) != SP_NONE;
        closed += fits;
        if (!sp_keeps_its_side(mesh, area, corners) ||
            (!fits && sp_half_edges_between(mesh, &s->edit->edges, corners[0], corners[1]) != SIZE_MAX) ||
            (i && sp_half_edges_between(mesh, &s->edit->edges, corners[0], apex) != SIZE_MAX))
            return false;
    }
    return 2 * closed > count;
}

static bool split(splitting *s, uint32_t own, uint32_t apex, size_t count, sp_error *error)
{
    uint32_t *corners = s->edit->triangles[own / 3];
    corners[0] = s->chain[0];
    corners[1] = s->chain[1];
    corners[2] = apex;
    s->touched[own / 3] = s->used[own] = true;
    for (size_t i = 0; i <= count; i++) {
        uint32_t h = beside(s, own, s->chain[i], s->chain[i + 1]);
        if (h != SP_NONE)
            s->used[h] = true;
        if (i && !sp_mesh_edit_add(s->edit, s->chain[i], s->chain[i + 1], apex, s->edit->mesh->part[own / 3], error))
            return false;
    }
    return true;
}

static bool split_all(splitting *s, size_t *done, sp_error *error)
{
    const sp_mesh *mesh = s->edit->mesh;
    for (size_t from = 0, to; from < s->count; from = to) {
        uint32_t own = s->found[from].half_edge, apex = mesh->triangles[own / 3][(own % 3 + 2) % 3];
        for (to = from; to < s->count && s->found[to].half_edge == own; to++)
            s->chain[1 + to - from] = s->found[to].vertex;
        if (s->used[own] || s->touched[own / 3])
            continue;
        s->chain[0] = sp_half_edge_from(mesh, own);
        s->chain[1 + to - from] = sp_half_edge_to(mesh, own);
        size_t count = thin_out(s, own, thin_out(s, own, to - from));
        if (!count || !is_worth_it(s, own, apex, count))
            continue;
        if (!split(s, own, apex, count, error))
            return false;
        ++*done;
    }
    return true;
}

bool sp_split_at_corners(sp_mesh_edit *edit, bool careful, size_t *done, sp_error *error)
{
    const sp_mesh *mesh = edit->mesh;
    splitting s = {.edit = edit, .careful = careful};
    s.radius = malloc((mesh->vertex_count + 1) * sizeof *s.radius);
    s.used = calloc(3 * mesh->triangle_count + 1, sizeof *s.used);
    s.touched = calloc(mesh->triangle_count + 1, sizeof *s.touched);
    bool good = (s.radius && s.used && s.touched) || sp_fail_memory(error);
    sp_flaw crossings = {0};
    good = good && (!careful || sp_find_crossings(mesh, NULL, &crossings, s.touched, error));
    good = good && find_candidates(&s, error);
    s.chain = good ? malloc((s.count + 2) * sizeof *s.chain) : NULL;
    good = good && (s.chain || sp_fail_memory(error));
    *done = 0;
    good = good && split_all(&s, done, error);
    free(s.radius);
    free(s.item);
    free(s.found);
    free(s.used);
    free(s.touched);
    free(s.chain);
    return good;
}
