/* The surface is grown into regions, each cut to a disc and flattened, halved where that fails; then neighbours are
 * joined as long as what results can be flattened, too. */
#include <sprayplan/atlas.h>

#include "atlas/coarsen.h"
#include "atlas/cut.h"
#include "atlas/merge.h"
#include "atlas/orient.h"
#include "atlas/refine.h"
#include "atlas/regions.h"
#include "atlas/renumber.h"
#include "atlas/settle.h"
#include "atlas/split.h"
#include "atlas/unfold.h"
#include "mesh/half_edge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define COARSE 12000         /* triangles of a coarse mesh */
#define COARSE_SHARE 0.04    /* of area that may have much strain there: the fine mesh has some more */
#define COARSE_CLEARANCE 0.2 /* between borders there */
#define LARGE 30000          /* triangles that are worth a coarse mesh */

typedef struct {
    sp_sheets sheets;
    sp_cutter cutter;
    sp_relaxer relaxer;
    uint32_t *region; /* [triangle_count] */
    size_t regions;
    double extent;
} making;

/* Makes a sheet of a region's part around `seed`, and settles it; where that fails, it is halved and nothing is left of
 * it but two more regions. */
static bool make_sheet(making *m, uint32_t seed)
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

/* Every triangle comes into a sheet: those of a halved one come by again until theirs is made. */
static bool make_sheets(making *m)
{
    for (uint32_t t = 0; t < m->sheets.mesh->triangle_count; t++)
        while (m->sheets.owner[t] == SP_NONE)
            if (!make_sheet(m, t))
                return false;
    return true;
}

/* Turns a sheet to waste little of its page, unless round-off then makes triangles touch. */
static bool turn(making *m, uint32_t number)
{
    sp_sheet *sheet = &m->sheets.items[number];
    sp_least_box box = sp_find_least_box(sheet, m->extent);
    size_t bytes = sheet->vertex_count * sizeof *sheet->at;
    double(*before)[2] = malloc(bytes + 1);
    if (!box.memory || !before) {
        free(before);
        return false;
    }
    memcpy(before, sheet->at, bytes);
    sp_verdict verdict = SP_SHEET_FITS;
    if (box.fits) {
        sp_turn_sheet(sheet, &box);
        if (sheet->triangle_count > 1)
            verdict = sp_judge_overlap(&m->sheets, number);
    }
    if (verdict == SP_SHEET_UNFIT)
        memcpy(sheet->at, before, bytes);
    free(before);
    return verdict != SP_SHEET_MEMORY;
}

/* Numbers the charts in the order of their first triangles, which `old` gives their own numbers back; NULL where they
 * have them. */
static bool write_charts(const making *m, const uint32_t *old, sp_charts *charts)
{
    uint32_t *number = malloc((m->sheets.count + 1) * sizeof *number);
    if (!number)
        return false;
    for (size_t i = 0; i < m->sheets.count; i++)
        number[i] = SP_NONE;
    for (size_t t = 0; t < charts->triangle_count; t++) {
        uint32_t owner = m->sheets.owner[t];
        const sp_sheet *sheet = &m->sheets.items[owner];
        size_t as = old ? old[t] : t;
        charts->chart[as] = owner;
        for (int i = 0; i < 3; i++)
            memcpy(charts->flat[as][i], sheet->at[sheet->corner[m->sheets.local[t]][i]], sizeof charts->flat[as][i]);
    }
    for (size_t t = 0; t < charts->triangle_count; t++) {
        uint32_t *owner = &charts->chart[t];
        if (number[*owner] == SP_NONE)
            number[*owner] = (uint32_t)charts->chart_count++;
        *owner = number[*owner];
    }
    free(number);
    return true;
}

static void destroy(making *m)
{
    sp_cutter_destroy(&m->cutter);
    sp_relaxer_destroy(&m->relaxer);
    sp_sheets_destroy(&m->sheets);
    free(m->region);
}

/* Room to cut the sheets' mesh into regions, of which there are none yet. */
static bool prepare(making *m)
{
    size_t count = m->sheets.mesh->triangle_count;
    m->region = malloc((count + 1) * sizeof *m->region);
    for (size_t t = 0; m->region && t < count; t++)
        m->region[t] = SP_NONE;
    return m->region && sp_cutter_create(&m->cutter, m->sheets.mesh);
}

/* Grows, lays and merges sheets of the whole mesh. */
static bool make_all(making *m, sp_error *error)
{
    if (!prepare(m))
        return sp_fail_memory(error);
    if (!sp_regions_grow(m->sheets.mesh, m->sheets.twin, m->region, &m->regions, error))
        return false;
    if (!make_sheets(m))
        return sp_fail_memory(error);
    return sp_merge(&m->sheets, 0, m->extent, &m->relaxer, error);
}

/* Settles a sheet that comes from a coarser mesh, where need be without the cuts that end inside of it: what stood open
 * there may overlap here. */
static sp_verdict settle_finely(making *m, uint32_t number)
{
    sp_verdict verdict = sp_settle(&m->sheets, number, m->extent, &m->relaxer);
    if (verdict != SP_SHEET_UNFIT)
        return verdict;
    bool closed;
    if (!sp_close_ends(&m->sheets, number, &closed))
        return SP_SHEET_MEMORY;
    return closed ? sp_settle(&m->sheets, number, m->extent, &m->relaxer) : verdict;
}

/* Sheets that do not fit are halved until they do, and joined again where they can. */
static bool settle_all(making *m, sp_error *error)
{
    size_t first_new = m->sheets.count;
    for (uint32_t i = 0; i < m->sheets.count; i++) {
        sp_verdict verdict = settle_finely(m, i);
        if (verdict == SP_SHEET_MEMORY || (verdict == SP_SHEET_UNFIT && !m->region && !prepare(m)))
            return sp_fail_memory(error);
        if (verdict == SP_SHEET_FITS)
            continue;
        if (!sp_split(&m->sheets, &m->sheets.items[i], m->region, (uint32_t)m->regions) ||
            !sp_cut_apart(&m->cutter, &m->sheets, i, m->region))
            return sp_fail_memory(error);
        m->regions += 2;
    }
    return first_new == m->sheets.count || sp_merge(&m->sheets, first_new, m->extent, &m->relaxer, error);
}

/* Makes the charts on a coarser mesh and carries them over. */
static bool make_coarsely(making *m, sp_error *error)
{
    sp_coarse coarse;
    if (!sp_coarsen(&m->sheets, COARSE, &coarse))
        return sp_fail_memory(error);
    making rough = {.extent = m->extent};
    bool good = sp_sheets_create(&rough.sheets, &coarse.mesh, coarse.twin, error);
    rough.sheets.share = COARSE_SHARE;
    rough.sheets.clearance = COARSE_CLEARANCE;
    good = good && make_all(&rough, error);
    if (good && !sp_refine(&coarse, &rough.sheets, &m->sheets))
        good = sp_fail_memory(error);
    destroy(&rough);
    sp_coarse_free(&coarse);
    return good && settle_all(m, error);
}

static bool make(sp_charts *charts, const sp_mesh *mesh, const uint32_t *twin, const uint32_t *old, sp_error *error)
{
    making m = {.extent = charts->extent};
    if (!sp_sheets_create(&m.sheets, mesh, twin, error))
        return false;
    bool good = mesh->triangle_count > LARGE ? make_coarsely(&m, error) : make_all(&m, error);
    for (uint32_t i = 0; good && i < m.sheets.count; i++)
        if (m.sheets.items[i].triangle_count > 0 && !turn(&m, i))
            good = sp_fail_memory(error);
    if (good && !write_charts(&m, old, charts))
        good = sp_fail_memory(error);
    destroy(&m);
    return good;
}

/* Large meshes are put in order first. */
static bool make_of(sp_charts *charts, const sp_mesh *mesh, sp_error *error)
{
    sp_half_edges edges = {0};
    sp_renumbered ordered = {0};
    bool done = sp_half_edges_create(mesh, &edges, error), large = mesh->triangle_count > LARGE;
    if (done && large) {
        done = sp_renumber(mesh, edges.opposite, &ordered);
        sp_half_edges_destroy(&edges);
        if (!done)
            sp_fail_memory(error);
    }
    done = done && (large ? make(charts, &ordered.mesh, ordered.twin, ordered.old, error)
                          : make(charts, mesh, edges.opposite, NULL, error));
    sp_renumbered_free(&ordered);
    sp_half_edges_destroy(&edges);
    return done;
}

sp_charts *sp_charts_create(const sp_mesh *mesh, double extent, sp_error *error)
{
    if (!mesh)
        return NULL;
    if (!(extent > 0)) {
        sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "charts of at most %g m; expected a length above 0", extent);
        return NULL;
    }
    if (mesh->triangle_count >= SP_NONE / 3) {
        sp_fail(error, SP_ERROR_UNSUPPORTED, NULL, 0, 0, "an atlas of %zu triangles; at most %u are possible",
                mesh->triangle_count, SP_NONE / 3 - 1);
        return NULL;
    }
    sp_charts *charts = calloc(1, sizeof *charts);
    if (!charts)
        return sp_fail_memory(error);
    size_t count = mesh->triangle_count;
    charts->triangle_count = count;
    charts->extent = extent;
    charts->chart = malloc((count + 1) * sizeof *charts->chart);
    charts->flat = malloc((count + 1) * sizeof *charts->flat);
    bool done = charts->chart && charts->flat;
    if (!done)
        sp_fail_memory(error);
    if (done && make_of(charts, mesh, error))
        return charts;
    sp_charts_destroy(charts);
    return NULL;
}

void sp_charts_destroy(sp_charts *charts)
{
    if (!charts)
        return;
    free(charts->chart);
    free(charts->flat);
    free(charts);
}
