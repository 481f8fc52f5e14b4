#include "search/column_gains.h"

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
