/* Triangles that lie where the same one lies, be it of another part.
 *
 * Bodies that touch have such by right, and so has a sheet that was drawn with both of its sides: taken out, they would
 * leave edges whose triangles do not run one way as often as the other. What is there twice for no reason leaves edges
 * no worse than they were, or better. So copies that hang together are taken out or left as one. */
#include "mesh/disjoint_sets.h"
#include "mesh/repair/mesh_edit.h"
#include "mesh/duplicates.h"

#include <stdlib.h>

typedef enum {
    SAME_SIDE,  /* those that face the same side as an earlier one */
    OTHER_SIDE, /* those that face the other side than the first */
    FIRST_SIDE, /* those that face the first's side, where others do not */
    CHOICES
} choice;

typedef struct {
    const sp_mesh_edit *edit;
    uint32_t *order;      /* by corners */
    bool *chosen;         /* [triangles] */
    uint32_t *set;        /* [triangles]: which of these hang together */
    bool *worse, *better; /* [triangles], of a set's root: some edge then is */
} copies;

static bool runs_upwards(const uint32_t corners[3])
{
    return (corners[0] < corners[1]) + (corners[1] < corners[2]) + (corners[2] < corners[0]) == 2;
}

/* Among order[from .. to], which have the same corners. */
static size_t choose_among(copies *c, size_t from, size_t to, choice which)
{
    const sp_mesh *mesh = c->edit->mesh;
    bool first_side = runs_upwards(mesh->triangles[c->order[from]]);
    size_t of_side[2] = {0, 0}, chosen = 0, others = 0;
    for (size_t i = from; i < to; i++)
        others += runs_upwards(mesh->triangles[c->order[i]]) != first_side;
    for (size_t i = from; i < to; i++) {
        bool upwards = runs_upwards(mesh->triangles[c->order[i]]);
        bool is = which == SAME_SIDE    ? of_side[upwards]++ > 0
                  : which == OTHER_SIDE ? upwards != first_side
                                        : upwards == first_side && others > 0;
        c->chosen[c->order[i]] = is;
        chosen += is;
    }
    return chosen;
}

static bool is_other_side(const copies *c, size_t first, size_t i)
{
    const sp_mesh *mesh = c->edit->mesh;
    return runs_upwards(mesh->triangles[c->order[i]]) != runs_upwards(mesh->triangles[c->order[first]]);
}

static size_t group_end(const sp_mesh *mesh, const uint32_t *order, size_t from)
{
    size_t to = from + 1;
    while (to < mesh->triangle_count && sp_are_duplicates(mesh, order[from], order[to]))
        to++;
    return to;
}

static size_t choose(copies *c, choice which)
{
    size_t count = c->edit->mesh->triangle_count, chosen = 0;
    for (size_t from = 0, to; from < count; from = to) {
        to = group_end(c->edit->mesh, c->order, from);
        chosen += choose_among(c, from, to, which);
    }
    for (uint32_t t = 0; t < count; t++) {
        c->set[t] = t;
        c->worse[t] = c->better[t] = false;
    }
    return chosen;
}

/* Joins the chosen ones at edges; each set's least is its root. */
static void join_at_edges(copies *c)
{
    const sp_half_edges *edges = &c->edit->edges;
    size_t of_edge;
    for (size_t i = 0; i < 3 * c->edit->mesh->triangle_count; i += of_edge) {
        uint32_t last = SP_NONE;
        of_edge = sp_half_edges_of_edge(c->edit->mesh, edges, i);
        for (size_t k = i; k < i + of_edge; k++) {
            uint32_t t = edges->order[k] / 3;
            if (!c->chosen[t])
                continue;
            if (last != SP_NONE)
                sp_set_join(c->set, t, last);
            last = t;
        }
    }
}

static void judge_edge(copies *c, size_t first, size_t of_edge)
{
    const sp_mesh *mesh = c->edit->mesh;
    const uint32_t *edge = c->edit->edges.order + first;
    uint32_t from = sp_half_edge_from(mesh, edge[0]), root = SP_NONE;
    long before = 0, after = 0;
    size_t left = 0;
    for (size_t k = 0; k < of_edge; k++) {
        long way = sp_half_edge_from(mesh, edge[k]) == from ? 1 : -1;
        before += way;
        if (c->chosen[edge[k] / 3]) {
            root = sp_set_root(c->set, edge[k] / 3);
            continue;
        }
        after += way;
        left++;
    }
    if (root == SP_NONE)
        return;
    bool now_flipped = left == 2 && labs(after) == 2 && of_edge != 2;
    c->worse[root] |= labs(after) > labs(before) || left == 0 || now_flipped;
    c->better[root] |= labs(after) < labs(before);
}

static size_t take_out(copies *c, sp_mesh_edit *edit, choice which)
{
    size_t of_edge, done = 0;
    join_at_edges(c);
    for (size_t i = 0; i < 3 * edit->mesh->triangle_count; i += of_edge) {
        of_edge = sp_half_edges_of_edge(edit->mesh, &edit->edges, i);
        judge_edge(c, i, of_edge);
    }
    for (uint32_t t = 0; t < edit->mesh->triangle_count; t++) {
        uint32_t root = sp_set_root(c->set, t);
        if (!c->chosen[t] || c->worse[root] || (which != SAME_SIDE && !c->better[root]))
            continue;
        edit->triangles[t][0] = SP_NONE;
        done++;
    }
    return done;
}

/* Which of order[from .. to] stay in the place of others that face the side that the first does (0), or the other: the
 * first of the same side, else of any. */
static void find_staying(const copies *c, const sp_mesh_edit *edit, size_t from, size_t to, uint32_t staying[2])
{
    staying[0] = staying[1] = SP_NONE;
    for (size_t i = to; i-- > from;)
        if (edit->triangles[c->order[i]][0] != SP_NONE)
            staying[is_other_side(c, from, i)] = c->order[i];
    for (int side = 0; side < 2; side++)
        staying[side] = staying[side] == SP_NONE ? staying[1 - side] : staying[side];
}

static void note_yield(sp_repair_account *account, uint32_t part, uint32_t to, double area)
{
    size_t at = 0;
    while (at < account->yield_count && (account->yields[at].part != part || account->yields[at].to != to))
        at++;
    if (at == SP_PLACES) {
        account->other_yields++;
        return;
    }
    if (at == account->yield_count)
        account->yields[account->yield_count++] = (sp_yield){part, to, 0, 0};
    account->yields[at].triangles++;
    account->yields[at].area += area;
}

/* Gives what stays to a preferred part that lay there too. */
static void prefer(const copies *c, sp_mesh_edit *edit, size_t from, size_t to, const uint32_t staying[2])
{
    for (size_t i = from; edit->preferred && i < to; i++) {
        uint32_t lost = c->order[i], kept = staying[is_other_side(c, from, i)], part = edit->part[lost];
        if (edit->triangles[lost][0] != SP_NONE || !edit->preferred[part] || edit->preferred[edit->part[kept]])
            continue;
        note_yield(edit->account, edit->part[kept], part, sp_triangle_area(edit->mesh, kept));
        edit->part[kept] = part;
    }
}

/* Notes which part lost triangles to which. */
static void settle_parts(const copies *c, sp_mesh_edit *edit)
{
    for (size_t from = 0, to; from < edit->mesh->triangle_count; from = to) {
        uint32_t staying[2];
        to = group_end(edit->mesh, c->order, from);
        find_staying(c, edit, from, to, staying);
        prefer(c, edit, from, to, staying);
        for (size_t i = from; i < to; i++) {
            uint32_t lost = c->order[i], kept = staying[is_other_side(c, from, i)];
            if (edit->triangles[lost][0] == SP_NONE && edit->part[lost] != edit->part[kept])
                note_yield(edit->account, edit->part[lost], edit->part[kept], sp_triangle_area(edit->mesh, lost));
        }
    }
}

bool sp_take_out_copies(sp_mesh_edit *edit, bool careful, size_t *done, sp_error *error)
{
    (void)careful;
    size_t room = edit->mesh->triangle_count + 1;
    copies c = {edit,        malloc(room * sizeof *c.order), malloc(room), malloc(room * sizeof *c.set), malloc(room),
                malloc(room)};
    bool good = (c.order && c.chosen && c.set && c.worse && c.better) || sp_fail_memory(error);
    good = good && sp_sort_duplicates(edit->mesh, c.order, error);
    *done = 0;
    for (choice which = SAME_SIDE; good && !*done && which < CHOICES; which++)
        if (choose(&c, which))
            *done = take_out(&c, edit, which);
    if (*done)
        settle_parts(&c, edit);
    free(c.order);
    free(c.chosen);
    free(c.set);
    free(c.worse);
    free(c.better);
    return good;
}
