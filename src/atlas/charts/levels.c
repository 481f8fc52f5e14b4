/* Regions, cuts and mergers are found on a coarse mesh of so many triangles as their shape needs, whatever the fine
 * mesh has; there each chart is then only laid once, from near where it comes to lie. A chart that does not fit there
 * is made again on the coarse mesh, of smaller ones; at last it is halved. */
#include "atlas/charts/levels.h"

#include "atlas/charts/coarsen.h"
#include "atlas/charts/merge.h"
#include "atlas/charts/prolong.h"
#include "atlas/charts/settle.h"
#include "atlas/charts/split.h"

#include <stdlib.h>
#include <string.h>

#define COARSE_SHARE 0.04 /* of area that may have much strain there: the fine mesh has some more */
#define REPEATS 1         /* of making what does not fit again */
#define STRICTER 0.5      /* times the share, in each */

typedef struct {
    sp_making *fine, *rough;
    sp_coarse coarse;
    uint8_t *fits; /* [fine->sheets.count] */
} levels;

/* Settles a sheet that comes from the coarse mesh, where need be without the cuts that end inside of it: what stood
 * open there may overlap here. */
static sp_verdict settle_finely(sp_making *m, uint32_t number)
{
    sp_verdict verdict = sp_settle(&m->sheets, number, m->extent, &m->relaxer);
    if (verdict != SP_SHEET_UNFIT)
        return verdict;
    bool closed;
    if (!sp_close_ends(&m->sheets, number, &closed))
        return SP_SHEET_MEMORY;
    return closed ? sp_settle(&m->sheets, number, m->extent, &m->relaxer) : verdict;
}

/* Where a sheet is the same as one before that fits, it lies as that does. */
static void keep_what_fits(levels *l, sp_sheet *before, const uint32_t *owner_before, const uint8_t *fitted)
{
    sp_sheets *now = &l->fine->sheets;
    for (size_t i = 0; i < now->count; i++) {
        uint32_t owner = owner_before[now->items[i].triangle[0]];
        sp_sheet *a = &now->items[i], *b = &before[owner];
        size_t count = a->triangle_count;
        if (!fitted[owner] || count != b->triangle_count || a->vertex_count != b->vertex_count ||
            memcmp(a->triangle, b->triangle, count * sizeof *a->triangle) != 0 ||
            memcmp(a->corner, b->corner, count * sizeof *a->corner) != 0)
            continue;
        sp_sheet swap = *a;
        *a = *b;
        *b = swap;
        l->fits[i] = 1;
    }
}

/* Carries all sheets over, and settles those that have not been there before. */
static bool carry_over(levels *l)
{
    sp_sheets *fine = &l->fine->sheets;
    size_t bytes = fine->mesh->triangle_count * sizeof *fine->owner, count = fine->count;
    sp_sheet *before = fine->items;
    uint32_t *owner_before = malloc(bytes + 1);
    uint8_t *fitted = l->fits;
    l->fits = NULL;
    if (owner_before)
        memcpy(owner_before, fine->owner, bytes);
    fine->items = NULL;
    fine->count = fine->capacity = 0;
    bool good = owner_before && sp_prolong_sheets(&l->coarse, &l->rough->sheets, fine);
    l->fits = good ? calloc(fine->count + 1, 1) : NULL;
    good = good && l->fits;
    if (good && before)
        keep_what_fits(l, before, owner_before, fitted);
    for (uint32_t i = 0; good && i < fine->count; i++) {
        sp_verdict verdict = l->fits[i] ? SP_SHEET_FITS : settle_finely(l->fine, i);
        good = verdict != SP_SHEET_MEMORY;
        l->fits[i] = verdict == SP_SHEET_FITS;
    }
    for (size_t i = 0; before && i < count; i++)
        sp_sheet_free(&before[i]);
    free(before);
    free(owner_before);
    free(fitted);
    return good;
}

static bool all_fit(const levels *l)
{
    for (size_t i = 0; i < l->fine->sheets.count; i++)
        if (!l->fits[i])
            return false;
    return true;
}

/* Takes coarse sheets that do not fit on the fine mesh back to their regions, and merges these anew. */
static bool make_again(levels *l, sp_error *error)
{
    sp_sheets *rough = &l->rough->sheets;
    size_t count = rough->count, at = 0; /* fine sheets come in the order of the coarse ones */
    for (size_t i = 0; i < count; i++) {
        sp_sheet *sheet = &rough->items[i];
        if (sheet->triangle_count == 0 || l->fits[at++])
            continue;
        for (size_t k = 0; k < sheet->triangle_count; k++)
            rough->owner[sheet->triangle[k]] = SP_NONE;
        sp_sheet_free(sheet);
    }
    rough->share *= STRICTER;
    if (!sp_make_sheets(l->rough))
        return sp_fail_memory(error);
    return sp_merge(rough, count, l->rough->extent, &l->rough->relaxer, error);
}

/* Halves fine sheets that do not fit until they do, and joins of that again what it can. */
static bool halve_rest(levels *l, sp_error *error)
{
    sp_making *m = l->fine;
    size_t count = m->sheets.count;
    if (!sp_prepare_regions(m))
        return sp_fail_memory(error);
    for (uint32_t i = 0; i < m->sheets.count; i++) {
        sp_verdict verdict = i >= count ? settle_finely(m, i) : l->fits[i] ? SP_SHEET_FITS : SP_SHEET_UNFIT;
        if (verdict == SP_SHEET_FITS)
            continue;
        if (verdict == SP_SHEET_MEMORY || !sp_split(&m->sheets, &m->sheets.items[i], m->region, (uint32_t)m->regions) ||
            !sp_cut_apart(&m->cutter, &m->sheets, i, m->region))
            return sp_fail_memory(error);
        m->regions += 2;
    }
    return sp_merge(&m->sheets, count, m->extent, &m->relaxer, error);
}

static bool make(levels *l, sp_error *error)
{
    l->rough->sheets.coarse = true;
    l->rough->sheets.share = COARSE_SHARE;
    if (!sp_make_all(l->rough, error))
        return false;
    for (int repeat = 0; repeat <= REPEATS; repeat++) {
        if (repeat > 0 && !make_again(l, error))
            return false;
        if (!carry_over(l))
            return sp_fail_memory(error);
        if (all_fit(l))
            return true;
    }
    return halve_rest(l, error);
}

bool sp_make_coarsely(sp_making *making, size_t coarse, sp_error *error)
{
    sp_making rough = {.extent = making->extent};
    levels l = {.fine = making, .rough = &rough};
    if (!sp_coarsen(&making->sheets, coarse, &l.coarse))
        return sp_fail_memory(error);
    bool good = sp_sheets_create(&rough.sheets, &l.coarse.mesh, l.coarse.twin, error) && make(&l, error);
    sp_making_destroy(&rough);
    sp_coarse_free(&l.coarse);
    free(l.fits);
    return good;
}
