#include "search/kept_gains.h"

#include <stdlib.h>
#include <string.h>

#define WORTHS 64 /* entries that are gone through at a time */

/* What `count` entries from the first on add to the patch, as shares of all. */
static void set_worths(bool single, float credit, float area, const sp_column *column, sp_left_over at, size_t first,
                       size_t count, float *worth)
{
    const float *field = &column->field[first];
    for (size_t k = 0; !column->film && k < count; k++)
        worth[k] = area * sp_more_worth(single, credit, at.wet, at.dry, field[k]);
    for (size_t k = 0; column->film && k < count; k++)
        worth[k] = area * sp_more_worth_of_both(single, credit, at, field[k], column->film[first + k]);
}

void sp_column_keep_up(bool single, float credit, float area, const sp_column *column, sp_left_over was,
                       sp_left_over is, double *gain)
{
    float worth[WORTHS];
    for (size_t i = 0; i < column->count; i += WORTHS) {
        size_t count = column->count - i < WORTHS ? column->count - i : WORTHS;
        const uint32_t *row = &column->row[i];
        if (is.wet < SP_ENOUGH)
            set_worths(single, credit, area, column, is, i, count, worth);
        for (size_t k = 0; is.wet < SP_ENOUGH && k < count; k++)
            gain[row[k]] += (double)worth[k];
        if (was.wet < SP_ENOUGH)
            set_worths(single, credit, area, column, was, i, count, worth);
        for (size_t k = 0; was.wet < SP_ENOUGH && k < count; k++)
            gain[row[k]] -= (double)worth[k];
    }
}

bool sp_kept_gains_create(size_t patch_count, size_t row_count, bool film, sp_kept_gains *kept)
{
    *kept = (sp_kept_gains){.patch_count = patch_count,
                            .hit = malloc((patch_count + 1) * sizeof *kept->hit),
                            .film = film ? malloc((patch_count + 1) * sizeof *kept->film) : NULL,
                            .dry = malloc((patch_count + 1) * sizeof *kept->dry),
                            .gain = malloc((row_count + 1) * sizeof *kept->gain)};
    return kept->hit && kept->dry && kept->gain && (kept->film || !film);
}

void sp_kept_gains_free(sp_kept_gains *kept)
{
    free(kept->hit);
    free(kept->film);
    free(kept->dry);
    free(kept->gain);
    *kept = (sp_kept_gains){0};
}

void sp_kept_gains_note(sp_kept_gains *kept, const float *hit, const float *film, const float *dry)
{
    memcpy(kept->hit, hit, kept->patch_count * sizeof *kept->hit);
    memcpy(kept->dry, dry, kept->patch_count * sizeof *kept->dry);
    if (kept->film)
        memcpy(kept->film, film, kept->patch_count * sizeof *kept->film);
    kept->found = true;
}
