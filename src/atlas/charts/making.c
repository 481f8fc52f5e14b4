#include "atlas/charts/making.h"

#include "atlas/charts/merge.h"
#include "atlas/charts/regions.h"
#include "atlas/charts/settle.h"
#include "atlas/charts/split.h"
#include "atlas/charts/unfold.h"

#include <stdlib.h>

void sp_making_destroy(sp_making *m)
{
    sp_cutter_destroy(&m->cutter);
    sp_relaxer_destroy(&m->relaxer);
    sp_sheets_destroy(&m->sheets);
    free(m->region);
}

bool sp_prepare_regions(sp_making *m)
{
    size_t count = m->sheets.mesh->triangle_count;
    m->region = malloc((count + 1) * sizeof *m->region);
    for (size_t t = 0; m->region && t < count; t++)
        m->region[t] = SP_NONE;
    return m->region && sp_cutter_create(&m->cutter, m->sheets.mesh);
}

/* Makes a sheet of a region's part around `seed`, and settles it; where that fails, it is halved and nothing is left of
 * it but two more regions. */
static bool make_sheet(sp_making *m, uint32_t seed)
{
    sp_sheet sheet;
    if (!sp_cut_open(&m->cutter, &m->sheets, m->region, seed, &sheet))
        return false;
    if (!sp_sheets_add(&m->sheets, &sheet)) {
        sp_sheet_free(&sheet);
        return false;
    }
    uint32_t number = (uint32_t)m->sheets.count - 1;
    sp_verdict verdict = SP_SHEET_MEMORY;
    if (sp_unfold(&m->sheets, number))
        verdict = sp_settle(&m->sheets, number, m->extent, &m->relaxer);
    if (verdict != SP_SHEET_UNFIT)
        return verdict == SP_SHEET_FITS;
    sheet = m->sheets.items[number];
    bool good = sp_split(&m->sheets, &sheet, m->region, (uint32_t)m->regions);
    m->regions += 2;
    for (size_t i = 0; i < sheet.triangle_count; i++)
        m->sheets.owner[sheet.triangle[i]] = SP_NONE;
    sp_sheet_free(&sheet);
    m->sheets.count--;
    return good;
}

bool sp_make_sheets(sp_making *m)
{
    for (uint32_t t = 0; t < m->sheets.mesh->triangle_count; t++)
        while (m->sheets.owner[t] == SP_NONE)
            if (!make_sheet(m, t))
                return false;
    return true;
}

bool sp_make_all(sp_making *m, sp_error *error)
{
    if (!sp_prepare_regions(m))
        return sp_fail_memory(error);
    if (!sp_regions_grow(m->sheets.mesh, m->sheets.twin, m->region, &m->regions, error))
        return false;
    if (!sp_make_sheets(m))
        return sp_fail_memory(error);
    return sp_merge(&m->sheets, 0, m->extent, &m->relaxer, error);
}
