/* The surface is grown into regions, each cut to a disc and flattened, halved where that fails; then neighbours are
 * joined as long as what results can be flattened, too. */
#include <sprayplan/atlas.h>

#include "atlas/cut.h"
#include "atlas/merge.h"
#include "atlas/orient.h"
#include "atlas/regions.h"
#include "atlas/settle.h"
#include "atlas/split.h"
#include "atlas/unfold.h"
#include "mesh/half_edge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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

/* Numbers the charts in the order of their first triangles. */
static bool write_charts(const making *m, sp_charts *charts)
{
    uint32_t *number = malloc((m->sheets.count + 1) * sizeof *number);
    if (!number)
        return false;
    for (size_t i = 0; i < m->sheets.count; i++)
        number[i] = SP_NONE;
    for (size_t t = 0; t < charts->triangle_count; t++) {
        uint32_t owner = m->sheets.owner[t];
        const sp_sheet *sheet = &m->sheets.items[owner];
        if (number[owner] == SP_NONE)
            number[owner] = (uint32_t)charts->chart_count++;
        charts->chart[t] = number[owner];
        for (int i = 0; i < 3; i++)
            memcpy(charts->flat[t][i], sheet->at[sheet->corner[m->sheets.local[t]][i]], sizeof charts->flat[t][i]);
    }
    free(number);
    return true;
}

static bool make_charts(making *m, sp_charts *charts, sp_error *error)
{
    if (!sp_merge(&m->sheets, m->extent, &m->relaxer, error))
        return false;
    bool good = true;
    for (uint32_t i = 0; good && i < m->sheets.count; i++)
        good = m->sheets.items[i].triangle_count == 0 || turn(m, i);
    if (good && write_charts(m, charts))
        return true;
    sp_fail_memory(error);
    return false;
}

static bool make(sp_charts *charts, const sp_mesh *mesh, const uint32_t *twin, sp_error *error)
{
    making m = {.extent = charts->extent};
    if (!sp_sheets_create(&m.sheets, mesh, twin, error))
        return false;
    m.region = malloc((mesh->triangle_count + 1) * sizeof *m.region);
    bool good = m.region && sp_cutter_create(&m.cutter, mesh);
    if (!good)
        sp_fail_memory(error);
    good = good && sp_regions_grow(mesh, twin, m.region, &m.regions, error);
    if (good && !make_sheets(&m)) {
        sp_fail_memory(error);
        good = false;
    }
    sp_cutter_destroy(&m.cutter);
    free(m.region);
    good = good && make_charts(&m, charts, error);
    sp_relaxer_destroy(&m.relaxer);
    sp_sheets_destroy(&m.sheets);
    return good;
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
    sp_half_edges edges = {0};
    bool done = charts->chart && charts->flat;
    if (!done)
        sp_fail_memory(error);
    done = done && sp_half_edges_create(mesh, &edges, error) && make(charts, mesh, edges.opposite, error);
    sp_half_edges_destroy(&edges);
    if (done)
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
