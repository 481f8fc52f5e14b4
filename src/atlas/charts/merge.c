/* Greedy merging: of all pairs of neighbours that one is tried next which promises least strain and the roundest chart.
 * What failed is tried again only when the row of edges between the two has changed. */
#include "atlas/charts/merge.h"

#include "atlas/charts/cut.h"
#include "mesh/heap.h"
#include "atlas/charts/join.h"
#include "atlas/charts/orient.h"
#include "atlas/charts/settle.h"
#include "atlas/texels/texels.h"

#include <math.h>
#include <stdlib.h>

/* The gap over the smaller sheet's size weighs this much against the share of its boundary that is not shared. */
#define GAP_WEIGHT 8.0
#define WIDEST_GAP 0.12      /* over the smaller sheet's size */
#define DEVELOPABLE_GAP 1e-4 /* over the length of the shared boundary */
#define LEAST_SHARE 0.15     /* of the smaller sheet's boundary that must be shared */
#define MOST_WASTE 1.126     /* box around the union over those around the two; above 9/8, which boxes may have */
#define PATCH_SHARE 0.05     /* of the area of developable surface, that a sheet may have which joins it with strain */

typedef struct {
    sp_shared_boundary shared;
    uint32_t sheet, version, other_version;
} candidate;

/* The least box around a sheet. */
typedef struct {
    double area, side; /* m², m: of its longer side */
} room;

typedef struct {
    sp_sheets *sheets;
    double extent;
    sp_relaxer *relaxer;
    size_t first_new; /* only sheets from here on are joined, to each other and to those before */
    candidate *candidates;
    size_t count, capacity;
    sp_heap heap;
    uint32_t *version; /* [sheets->count], how often it has changed */
    double *perimeter; /* [sheets->count], m */
    room *box;         /* [sheets->count] */
    uint32_t *failed;  /* [3 triangle_count], length in edges of the one from here that could not be joined */
    sp_shared_boundaries boundaries;
} merging;

/* Scores are rounded like costs in regions.c. */
static uint64_t key_of(double score, size_t candidate)
{
    double cell = fmin(fmax((score + 2) * 0x1p14 + 0.37, 0), 4294967295.0);
    return (uint64_t)(uint32_t)cell << 32 | (uint32_t)candidate;
}

/* Scores the union along a shared boundary; false where it is not worth trying. */
static bool promises(const merging *m, uint32_t sheet, const sp_shared_boundary *shared, double *score)
{
    const sp_sheet *a = &m->sheets->items[sheet], *b = &m->sheets->items[shared->other];
    double share = shared->length / fmin(m->perimeter[sheet], m->perimeter[shared->other]);
    sp_fit fit = sp_join_fit(m->sheets, shared);
    double size = sqrt(fmin(a->area, b->area));
    bool developable =
        fmax(a->strain, b->strain) <= SP_DEVELOPABLE_STRAIN && fit.gap <= DEVELOPABLE_GAP * shared->length;
    if (!developable && (share < LEAST_SHARE || fit.gap > WIDEST_GAP * size))
        return false;
    if (!developable && (b->area > PATCH_SHARE * a->kept && a->kept > 0))
        return false;
    if (!developable && (a->area > PATCH_SHARE * b->kept && b->kept > 0))
        return false;
    *score = 1 - share + (developable ? -2 : GAP_WEIGHT * fit.gap / size);
    return true;
}

static bool add_candidate(merging *m, uint32_t sheet, const sp_shared_boundary *shared)
{
    if (m->failed[shared->first] == shared->count)
        return true;
    if (m->count == m->capacity) {
        size_t capacity = m->capacity ? 2 * m->capacity : 256;
        candidate *grown = capacity < SP_NONE ? realloc(m->candidates, capacity * sizeof *grown) : NULL;
        if (!grown)
            return false;
        m->candidates = grown;
        m->capacity = capacity;
    }
    double score;
    if (!promises(m, sheet, shared, &score))
        return true;
    m->candidates[m->count] = (candidate){*shared, sheet, m->version[sheet], m->version[shared->other]};
    return sp_heap_push(&m->heap, key_of(score, m->count++));
}

/* Enters the shared boundaries of a sheet with all its neighbours, or with those of higher number, of which one must be
 * new. */
static bool add_candidates(merging *m, uint32_t sheet, bool higher_only)
{
    bool developable = m->sheets->items[sheet].strain <= SP_DEVELOPABLE_STRAIN;
    for (sp_bend most = developable ? SP_BEND_NONE : SP_BEND_SMOOTH; most <= SP_BEND_SMOOTH; most++) {
        if (!sp_shared_boundaries_find(&m->boundaries, m->sheets, sheet, most))
            return false;
        m->perimeter[sheet] = m->boundaries.perimeter;
        for (size_t i = 0; i < m->boundaries.count; i++)
            if (!(higher_only && m->boundaries.items[i].other < sheet) &&
                (sheet >= m->first_new || m->boundaries.items[i].other >= m->first_new) &&
                !add_candidate(m, sheet, &m->boundaries.items[i]))
                return false;
    }
    return true;
}

static void take_over(sp_sheets *sheets, const sp_sheet *from, uint32_t owner, uint32_t first_local)
{
    for (size_t i = 0; i < from->triangle_count; i++) {
        sheets->owner[from->triangle[i]] = owner;
        sheets->local[from->triangle[i]] = first_local + (uint32_t)i;
    }
}

/* The shared boundary as seen from the other sheet. */
static sp_shared_boundary turned(const sp_sheets *sheets, uint32_t sheet, const sp_shared_boundary *shared)
{
    uint32_t last = shared->first;
    for (uint32_t i = 1; i < shared->count; i++)
        last = sp_boundary_next(sheets, last);
    return (sp_shared_boundary){sheet, sheets->twin[last], shared->count, shared->length};
}

static bool is_crease(const merging *m, const sp_shared_boundary *shared)
{
    const sp_sheets *sheets = m->sheets;
    uint32_t here = shared->first;
    for (uint32_t i = 0; i < shared->count; i++, here = sp_boundary_next(sheets, here))
        if (!sp_edge_is_crease(sheets->mesh, here, sheets->twin[here]))
            return false;
    return true;
}

/* Whether the box around the union, as it lies before it is settled, wastes little; sets it. Faces are not strung
 * together to what is longer than a square page has to be: four sides of a cube in a row would leave most of it empty.
 */
static sp_verdict judge_waste(const merging *m, const sp_sheet *joined, room a, room b, bool crease, room *box)
{
    double extent = crease ? fmin(m->extent, fmax(m->sheets->square, fmax(a.side, b.side))) : m->extent;
    sp_least_box least = sp_find_least_box(joined, extent);
    *box = (room){least.width * least.height, fmax(least.width, least.height)};
    if (!least.memory)
        return SP_SHEET_MEMORY;
    return least.fits && box->area <= MOST_WASTE * (a.area + b.area) ? SP_SHEET_FITS : SP_SHEET_UNFIT;
}

static sp_verdict try_join(merging *m, uint32_t sheet, const sp_shared_boundary *shared)
{
    sp_sheets *sheets = m->sheets;
    sp_fit fit = sp_join_fit(sheets, shared);
    sp_sheet joined, a = sheets->items[sheet], b = sheets->items[shared->other];
    bool crease = is_crease(m, shared);
    if (!sp_join(sheets, shared, &fit, &joined))
        return SP_SHEET_MEMORY;
    room box;
    sp_verdict verdict = judge_waste(m, &joined, m->box[sheet], m->box[shared->other], crease, &box);
    if (verdict != SP_SHEET_FITS) {
        sp_sheet_free(&joined);
        return verdict;
    }
    take_over(sheets, &b, sheet, (uint32_t)a.triangle_count);
    sheets->items[sheet] = joined;
    sheets->items[shared->other] = (sp_sheet){0};
    bool closed; /* what is left open here might overlap on the finer mesh */
    if (sheets->coarse && fmax(a.strain, b.strain) > SP_DEVELOPABLE_STRAIN && !sp_close_ends(sheets, sheet, &closed))
        verdict = SP_SHEET_MEMORY;
    else
        verdict = sp_settle(sheets, sheet, m->extent, m->relaxer);
    if (verdict == SP_SHEET_FITS) {
        sp_sheet_free(&a);
        sp_sheet_free(&b);
        m->box[sheet] = box;
        return verdict;
    }
    sp_sheet_free(&sheets->items[sheet]);
    sheets->items[sheet] = a;
    sheets->items[shared->other] = b;
    take_over(sheets, &b, shared->other, 0);
    return verdict;
}

static bool attempt(merging *m, const candidate *c)
{
    sp_shared_boundary shared = c->shared, back = turned(m->sheets, c->sheet, &shared);
    uint32_t sheet = c->sheet;
    if (m->sheets->items[shared.other].triangle_count > m->sheets->items[sheet].triangle_count) {
        sp_shared_boundary swap = shared;
        sheet = shared.other;
        shared = back;
        back = swap;
    }
    sp_verdict verdict = try_join(m, sheet, &shared);
    if (verdict == SP_SHEET_MEMORY)
        return false;
    if (verdict == SP_SHEET_UNFIT) {
        m->failed[shared.first] = m->failed[back.first] = shared.count;
        return true;
    }
    m->version[sheet]++;
    m->version[shared.other]++;
    return add_candidates(m, sheet, false);
}

static bool is_current(const merging *m, const candidate *c)
{
    return m->version[c->sheet] == c->version && m->version[c->shared.other] == c->other_version;
}

bool sp_merge(sp_sheets *sheets, size_t first_new, double extent, sp_relaxer *relaxer, sp_error *error)
{
    merging m = {.sheets = sheets, .extent = extent, .relaxer = relaxer, .first_new = first_new};
    m.version = calloc(sheets->count + 1, sizeof *m.version);
    m.perimeter = calloc(sheets->count + 1, sizeof *m.perimeter);
    m.box = calloc(sheets->count + 1, sizeof *m.box);
    m.failed = calloc(3 * sheets->mesh->triangle_count + 1, sizeof *m.failed);
    bool good =
        m.version && m.perimeter && m.box && m.failed && sp_shared_boundaries_create(&m.boundaries, sheets->mesh);
    for (uint32_t i = 0; good && i < sheets->count; i++) {
        if (sheets->items[i].triangle_count == 0)
            continue;
        good = sp_shared_boundaries_find(&m.boundaries, sheets, i, SP_BEND_SMOOTH);
        m.perimeter[i] = m.boundaries.perimeter;
        sp_least_box box = sp_find_least_box(&sheets->items[i], INFINITY);
        m.box[i] = (room){box.width * box.height, fmax(box.width, box.height)};
        good = good && box.memory;
    }
    for (uint32_t i = 0; good && i < sheets->count; i++)
        good = add_candidates(&m, i, true);
    while (good && m.heap.count) {
        candidate c = m.candidates[(uint32_t)sp_heap_pop(&m.heap)];
        good = !is_current(&m, &c) || attempt(&m, &c);
    }
    sp_shared_boundaries_destroy(&m.boundaries);
    free(m.version);
    free(m.perimeter);
    free(m.box);
    free(m.failed);
    free(m.candidates);
    free(m.heap.keys);
    if (!good)
        sp_fail_memory(error);
    return good;
}
