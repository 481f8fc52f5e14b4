#include "atlas/charts/settle.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define BATCHES 4            /* of flattening, the strain measured after each */
#define FURTHER 3            /* more batches, where they promise to reach what is asked for */
#define ROUNDS 2             /* in a batch */
#define SURFACE_TRIANGLES 16 /* laid without strain, that need no vertex between them to be developable surface */
#define CLOSED 1e-9          /* lips that lie this near, in parts of the edge, are one edge again */

/* Beyond these shares of area with too much strain after each batch but the last there is no hope. */
static const double hopeless[BATCHES] = {0.40, 0.20, 0.10, 1};

static bool near(const sp_sheet *sheet, uint32_t v, uint32_t w, double distance)
{
    return hypot(sheet->at[v][0] - sheet->at[w][0], sheet->at[v][1] - sheet->at[w][1]) <= distance;
}

/* Where the two lips of a cut lie on each other, the cut is none. False when memory runs out. */
static bool close_cuts(const sp_sheets *sheets, sp_sheet *sheet, uint32_t number)
{
    uint32_t *link = NULL, *scratch = NULL;
    for (size_t i = 0; i < 3 * sheet->triangle_count; i++) {
        uint32_t h = 3 * sheet->triangle[i / 3] + (uint32_t)(i % 3), twin = sheets->twin[h];
        if (twin == SP_NONE || sheets->owner[twin / 3] != number || sp_across(sheets, h) != SP_NONE)
            continue;
        uint32_t a = sp_begin(sheets, h), b = sp_begin(sheets, sp_around(h));
        uint32_t c = sp_begin(sheets, sp_around(twin)), d = sp_begin(sheets, twin);
        double distance = CLOSED * hypot(sheet->at[a][0] - sheet->at[b][0], sheet->at[a][1] - sheet->at[b][1]);
        if (!near(sheet, a, c, distance) || !near(sheet, b, d, distance))
            continue;
        if (!link) {
            link = malloc((sheet->vertex_count + 1) * sizeof *link);
            scratch = malloc((sheet->vertex_count + 1) * sizeof *scratch);
            if (!link || !scratch) {
                free(link);
                free(scratch);
                return false;
            }
            for (uint32_t v = 0; v < sheet->vertex_count; v++)
                link[v] = v;
        }
        sp_link(link, a, c);
        sp_link(link, b, d);
    }
    if (link)
        sp_sheet_identify(sheet, link, scratch);
    free(link);
    free(scratch);
    return true;
}

/* Not merely a few triangles side by side, which any surface has. */
static bool is_a_surface(const sp_sheet *sheet)
{
    size_t inner = sheet->triangle_count + 2 - sheet->vertex_count; /* vertices, of a disc */
    return sheet->triangle_count >= SURFACE_TRIANGLES || inner > 0;
}

/* Whether a few batches more, each a gain like the last, would come down to what is asked for. */
static bool comes_near(double before, double now, double asked)
{
    return now <= asked || (now < before && now - FURTHER * (before - now) <= asked);
}

/* Of triangles that lie turned over too: each batch carries round-off on, and after dozens of them it would decide what
 * becomes of a sheet that holds on to a few. */
static bool is_near(const sp_strain *before, const sp_strain *now, double share)
{
    return comes_near(before->share, now->share, share) && comes_near((double)before->flipped, (double)now->flipped, 0);
}

/* What is left of a larger sheet lies there as that strained it; alone it has no reason to. */
static void lay_alone(const sp_sheets *sheets, sp_sheet *sheet)
{
    const double *shape = sheets->shape[sheet->triangle[0]];
    const double rest[3][2] = {{0, 0}, {shape[0], 0}, {shape[1], shape[2]}};
    for (int i = 0; i < 3; i++)
        memcpy(sheet->at[sheet->corner[0][i]], rest[i], sizeof rest[i]);
}

sp_verdict sp_settle(sp_sheets *sheets, uint32_t number, double extent, sp_relaxer *relaxer)
{
    sp_sheet *sheet = &sheets->items[number];
    sp_strain strain = sp_measure_strain(sheets, sheet);
    if (sheet->triangle_count == 1) {
        if (!(strain.most <= SP_EXACT_STRAIN) || strain.flipped)
            lay_alone(sheets, sheet);
        sheet->strain = 0; /* however large or thin */
        return SP_SHEET_FITS;
    }
    bool exact = strain.most <= SP_EXACT_STRAIN && !strain.flipped;
    if (exact && !close_cuts(sheets, sheet, number))
        return SP_SHEET_MEMORY;
    if (!exact) {
        /* More for wider sheets, but not without end: what is left waits for the next round. */
        int inner = 6 + (int)fmin(sqrt((double)sheet->vertex_count) / 4, 10);
        sp_strain before = strain;
        for (int batch = 0; batch < BATCHES || is_near(&before, &strain, sheets->share); batch++) {
            before = strain;
            if (!sp_relax(relaxer, sheets, sheet, ROUNDS, inner))
                return SP_SHEET_MEMORY;
            strain = sp_measure_strain(sheets, sheet);
            if (batch < BATCHES && strain.share > hopeless[batch])
                return SP_SHEET_UNFIT;
            if (strain.share <= sheets->share && !strain.flipped)
                break;
        }
        if (strain.flipped || strain.share > sheets->share)
            return SP_SHEET_UNFIT;
    }
    sheet->strain = strain.most;
    if (strain.most <= SP_DEVELOPABLE_STRAIN && is_a_surface(sheet))
        sheet->kept = sheet->area;
    sp_verdict verdict = sp_judge_box(sheets, sheet, extent);
    return verdict == SP_SHEET_FITS ? sp_judge_overlap(sheets, number) : verdict;
}
