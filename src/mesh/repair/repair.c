/* Mending, step by step, until nothing is left that a step would do. What may do harm is tried first, and taken back
 * where the diagnosis then finds more of anything. */
#include "mesh/diagnosis/flaw.h"
#include "mesh/repair/mesh_edit.h"

#include <stdlib.h>

enum { MOST_PASSES = 30, MOST_ROUNDS = 20 };

typedef struct {
    sp_mesh *mesh;
    bool diagnosed;
    sp_mesh_diagnosis diagnosis; /* of the mesh, once it is diagnosed */
    size_t changes;
    const bool *preferred; /* [part_count], borrowed, or NULL */
    sp_repair_account *account;
} mending;

/* One mender, again and again. *made: NULL where it did nothing. */
static bool apply(const mending *m, const sp_mesh *mesh, sp_mender *mend, bool careful, sp_mesh **made, size_t *count,
                  sp_error *error)
{
    *made = NULL;
    *count = 0;
    for (int pass = 0; pass < MOST_PASSES; pass++) {
        sp_mesh_edit edit;
        size_t done = 0;
        if (!sp_mesh_edit_open(&edit, *made ? *made : mesh, error))
            return false;
        edit.preferred = m->preferred;
        edit.account = m->account;
        sp_mesh *next = NULL;
        bool good = mend(&edit, careful, &done, error) && (!done || (next = sp_mesh_edit_mesh(&edit, error)));
        sp_mesh_edit_close(&edit);
        if (!good || done) {
            sp_mesh_destroy(*made);
            *made = next;
        }
        *count += done;
        if (!good || !done)
            return good;
    }
    return true;
}

static bool is_more(const sp_flaw *before, const sp_flaw *after)
{
    return after->count > before->count || after->more;
}

/* Whether more pairs of triangles run through each other, whatever hangs together: what was brought together may have
 * done so all along, and have been two shells. */
static bool cross_more(const sp_mesh *before, const sp_mesh *after, bool *more, sp_error *error)
{
    sp_flaw was = {0}, is = {0};
    bool good = sp_find_crossings(before, NULL, &was, NULL, error) && sp_find_crossings(after, NULL, &is, NULL, error);
    *more = is_more(&was, &is);
    return good;
}

/* No more of anything, and less of something. Whether a shell is inside out is no matter before it is closed. */
static bool is_better(const mending *m, const sp_mesh *made, const sp_mesh_diagnosis *a, bool *better, sp_error *error)
{
    const sp_mesh_diagnosis *b = &m->diagnosis;
    const sp_flaw *const before[] = {
        &b->open_edges, &b->non_manifold_edges, &b->flipped_edges, &b->duplicate_triangles, &b->cracks, &b->bits};
    const sp_flaw *const after[] = {
        &a->open_edges, &a->non_manifold_edges, &a->flipped_edges, &a->duplicate_triangles, &a->cracks, &a->bits};
    bool more = false, less = false;
    for (size_t i = 0; i < sizeof before / sizeof *before; i++) {
        more |= is_more(before[i], after[i]);
        less |= after[i]->count < before[i]->count;
    }
    bool good = more || !is_more(&b->crossings, &a->crossings) || cross_more(m->mesh, made, &more, error);
    *better = good && less && !more;
    return good;
}

static bool diagnose(mending *m, sp_error *error)
{
    m->diagnosed = m->diagnosed || sp_mesh_diagnose(m->mesh, &m->diagnosis, error);
    return m->diagnosed;
}

/* Takes the mesh over. */
static void accept(mending *m, sp_mesh *made)
{
    sp_mesh_destroy(m->mesh);
    m->mesh = made;
    m->diagnosed = false;
    m->changes++;
}

/* What does no harm. */
static bool do_for_sure(mending *m, sp_mender *mend, size_t *count, sp_error *error)
{
    sp_mesh *made;
    size_t done;
    if (!apply(m, m->mesh, mend, false, &made, &done, error))
        return false;
    if (made)
        accept(m, made);
    *count += done;
    return true;
}

/* What may: with neighbours turned to agree where it brought them together. *settled: there was nothing to do, or it
 * was for the better. */
static bool attempt(mending *m, sp_mender *mend, bool careful, size_t *count, bool *settled, sp_error *error)
{
    const sp_repair_account before = *m->account;
    sp_mesh *made, *turned;
    sp_mesh_diagnosis diagnosis;
    size_t done, turns;
    *settled = false;
    if (!apply(m, m->mesh, mend, careful, &made, &done, error))
        return false;
    *settled = !made;
    if (!made)
        return true;
    bool good = apply(m, made, sp_turn_over, false, &turned, &turns, error);
    if (turned) {
        sp_mesh_destroy(made);
        made = turned;
    }
    good = good && diagnose(m, error) && sp_mesh_diagnose(made, &diagnosis, error) &&
           is_better(m, made, &diagnosis, settled, error);
    if (!*settled) {
        *m->account = before;
        sp_mesh_destroy(made);
        return good;
    }
    accept(m, made);
    m->diagnosis = diagnosis;
    m->diagnosed = true;
    *count += done;
    m->account->turned += turns;
    return true;
}

static bool try(mending *m, sp_mender *mend, size_t *count, sp_error *error)
{
    bool settled;
    return attempt(m, mend, false, count, &settled, error) &&
           (settled || attempt(m, mend, true, count, &settled, error));
}

static bool mend_all(mending *m, sp_error *error)
{
    size_t before = SIZE_MAX;
    for (int round = 0; round < MOST_ROUNDS && m->changes != before; round++) {
        before = m->changes;
        if (!do_for_sure(m, sp_take_out_copies, &m->account->copies, error) ||
            !do_for_sure(m, sp_turn_over, &m->account->turned, error) ||
            !try(m, sp_join_cracks, &m->account->joined, error) ||
            !try(m, sp_split_at_corners, &m->account->split, error) ||
            !try(m, sp_fill_holes, &m->account->filled, error))
            return false;
    }
    return true;
}

/* The mesh without its degenerate triangles. */
static sp_mesh *cleared(const sp_mesh *mesh, sp_error *error)
{
    sp_mesh_edit edit = {.mesh = mesh, .count = mesh->triangle_count, .triangles = mesh->triangles, .part = mesh->part};
    return sp_mesh_edit_mesh(&edit, error);
}

sp_mesh *sp_mesh_repair(const sp_mesh *mesh, const bool *preferred, sp_repair_account *account, sp_error *error)
{
    *account = (sp_repair_account){0};
    if (!mesh)
        return NULL;
    mending m = {.preferred = preferred, .account = account, .diagnosed = true};
    bool good = sp_mesh_diagnose(mesh, &account->before, error) && (m.mesh = cleared(mesh, error));
    m.diagnosis = account->before;
    m.diagnosis.degenerate = (sp_flaw){0};
    account->dropped = account->before.degenerate.count;
    good = good && mend_all(&m, error) && diagnose(&m, error);
    account->after = m.diagnosis;
    if (good)
        return m.mesh;
    sp_mesh_destroy(m.mesh);
    return NULL;
}
