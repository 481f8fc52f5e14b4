/* The surface is grown into regions, each cut to a disc and flattened, halved where that fails; then neighbours are
 * joined as long as what results can be flattened, too. */
#include <sprayplan/atlas.h>

#include "atlas/charts/charts.h"
#include "atlas/charts/judge.h"
#include "atlas/charts/levels.h"
#include "atlas/charts/making.h"
#include "atlas/charts/orient.h"
#include "atlas/charts/renumber.h"
#include "mesh/adjacent.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LARGE 30000  /* triangles that are worth a coarse mesh */
#define COARSE 12000 /* triangles of the coarse mesh */

/* Turns a sheet to waste little of its page, unless round-off then makes triangles touch. */
static bool turn(sp_making *m, uint32_t number)
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
static bool write_charts(const sp_making *m, const uint32_t *old, sp_charts *charts)
{
    uint32_t *number = malloc((m->sheets.count + 1) * sizeof *number);
    if (!number)
        return false;
    for (size_t i = 0; i < m->sheets.count; i++)
        number[i] = SP_NONE;
    for (size_t t = 0; t < charts->triangle_count; t++) {
        uint32_t owner = m->sheets.owner[t];
        const sp_sheet *sheet = &m->sheets.items[owner];
        assert(owner < m->sheets.count && m->sheets.local[t] < sheet->triangle_count);
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

/* By way of a coarse mesh of `coarse` triangles unless that is 0. */
static bool make(sp_charts *charts, const sp_mesh *mesh, const uint32_t *twin, const uint32_t *old, size_t coarse,
                 sp_error *error)
{
    sp_making m = {.extent = charts->extent};
    if (!sp_sheets_create(&m.sheets, mesh, twin, error))
        return false;
    bool good = coarse ? sp_make_coarsely(&m, coarse, error) : sp_make_all(&m, error);
    for (uint32_t i = 0; good && i < m.sheets.count; i++)
        if (m.sheets.items[i].triangle_count > 0 && !turn(&m, i))
            good = sp_fail_memory(error);
    if (good && !write_charts(&m, old, charts))
        good = sp_fail_memory(error);
    sp_making_destroy(&m);
    return good;
}

/* Meshes of more than `most` triangles are put in order first. */
static bool make_of(sp_charts *charts, const sp_mesh *mesh, size_t most, size_t coarse, sp_error *error)
{
    sp_half_edges edges = {0};
    sp_renumbered ordered = {0};
    bool done = sp_adjacent_create(mesh, &edges, error), large = mesh->triangle_count > most;
    if (done && large) {
        done = sp_renumber(mesh, edges.opposite, &ordered);
        sp_half_edges_destroy(&edges);
        if (!done)
            sp_fail_memory(error);
    }
    done = done && (large ? make(charts, &ordered.mesh, ordered.twin, ordered.old, coarse, error)
                          : make(charts, mesh, edges.opposite, NULL, 0, error));
    sp_renumbered_free(&ordered);
    sp_half_edges_destroy(&edges);
    return done;
}

sp_charts *sp_charts_create(const sp_mesh *mesh, double extent, sp_error *error)
{
    return sp_charts_by_levels(mesh, extent, LARGE, COARSE, error);
}

sp_charts *sp_charts_by_levels(const sp_mesh *mesh, double extent, size_t large, size_t coarse, sp_error *error)
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
    if (done && make_of(charts, mesh, large, coarse, error))
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
