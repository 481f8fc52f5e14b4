#include "search/lineup.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#define GAIN_LEAST 1e-5 /* of the area: less is no reason for an exchange */
#define SWEEPS_MOST 8
#define ROUNDS_MOST 4
#define WORTHS 64 /* fields that are gone through at a time */

bool sp_lineup_create(const sp_coverage_matrix *matrix, sp_lineup *lineup, sp_error *error)
{
    *lineup = (sp_lineup){.matrix = matrix,
                          .hit = malloc((matrix->patch_count + 1) * sizeof *lineup->hit),
                          .dry = malloc((matrix->patch_count + 1) * sizeof *lineup->dry),
                          .gain = malloc((matrix->row_count + 1) * sizeof *lineup->gain)};
    lineup->film = matrix->kept_film ? malloc((matrix->patch_count + 1) * sizeof *lineup->film) : NULL;
    lineup->wet = matrix->kept_film ? malloc((matrix->patch_count + 1) * sizeof *lineup->wet) : lineup->hit;
    if (!lineup->hit || !lineup->wet || !lineup->dry || !lineup->gain || (matrix->kept_film && !lineup->film)) {
        sp_lineup_free(lineup);
        return sp_fail_memory(error);
    }
    sp_lineup_set(lineup, NULL, 0);
    return true;
}

void sp_lineup_free(sp_lineup *lineup)
{
    if (lineup->wet != lineup->hit)
        free(lineup->wet);
    free(lineup->hit);
    free(lineup->film);
    free(lineup->dry);
    free(lineup->gain);
    *lineup = (sp_lineup){0};
}

static void count_covered(sp_lineup *lineup)
{
    lineup->covered = 0;
    for (size_t p = 0; p < lineup->matrix->patch_count; p++)
        lineup->covered += (double)(lineup->matrix->area[p] * sp_covered(lineup->wet[p], lineup->dry[p]));
    lineup->covered *= lineup->matrix->search->all;
}

static void pour(sp_lineup *lineup, uint32_t row)
{
    const sp_coverage_matrix *matrix = lineup->matrix;
    lineup->flow += sp_coverage_matrix_flow(matrix, row);
    lineup->outlay += sp_coverage_matrix_outlay(matrix, row);
    for (size_t i = matrix->start[row]; i < matrix->start[row + 1]; i++)
        sp_pour(matrix->search, matrix->field[i], &lineup->hit[matrix->patch[i]], &lineup->dry[matrix->patch[i]]);
    for (size_t i = matrix->start[row]; matrix->film && i < matrix->start[row + 1]; i++) {
        uint32_t p = matrix->patch[i];
        lineup->film[p] += matrix->film[i];
        lineup->wet[p] = fmaxf(lineup->hit[p], lineup->film[p]);
    }
}

void sp_lineup_set(sp_lineup *lineup, const uint32_t *rows, size_t count)
{
    const sp_coverage_matrix *matrix = lineup->matrix;
    memcpy(lineup->hit, matrix->kept_hit, matrix->patch_count * sizeof *lineup->hit);
    for (size_t p = 0; matrix->kept_film && p < matrix->patch_count; p++) {
        lineup->film[p] = matrix->kept_film[p];
        lineup->wet[p] = fmaxf(lineup->hit[p], lineup->film[p]);
    }
    memcpy(lineup->dry, matrix->kept_dry, matrix->patch_count * sizeof *lineup->dry);
    lineup->flow = lineup->outlay = matrix->search->kept_flow;
    lineup->count = count;
    for (size_t i = 0; i < count; i++) {
        lineup->row[i] = rows[i];
        pour(lineup, rows[i]);
    }
    count_covered(lineup);
}

void sp_lineup_add(sp_lineup *lineup, uint32_t row)
{
    assert(lineup->count < SP_LINEUP_MOST && row < lineup->matrix->row_count);
    lineup->row[lineup->count++] = row;
    pour(lineup, row);
    count_covered(lineup);
}

void sp_lineup_remove(sp_lineup *lineup, size_t i)
{
    /* poured anew: what is taken from a sum leaves rounding behind */
    uint32_t rows[SP_LINEUP_MOST];
    assert(i < lineup->count);
    memcpy(rows, lineup->row, lineup->count * sizeof *rows);
    memmove(&rows[i], &rows[i + 1], (lineup->count - i - 1) * sizeof *rows);
    sp_lineup_set(lineup, rows, lineup->count - 1);
}

static bool has_place(const sp_lineup *lineup, size_t row)
{
    const sp_coverage_matrix *matrix = lineup->matrix;
    const sp_place_options *options = matrix->search->options;
    uint32_t mount = sp_coverage_matrix_mount(matrix, row);
    size_t room = matrix->search->port_taken[mount] ? 0 : sp_mount_room(&options->mounts[mount]);
    for (size_t i = 0; room > 0 && room <= lineup->count && i < lineup->count; i++)
        room -= sp_coverage_matrix_mount(matrix, lineup->row[i]) == mount;
    return room > 0;
}

static bool affords(const sp_lineup *lineup, size_t row, double budget)
{
    const sp_coverage_matrix *matrix = lineup->matrix;
    return sp_affords(matrix->search, lineup->flow, lineup->outlay, sp_coverage_matrix_mount(matrix, row),
                      sp_coverage_matrix_flow(matrix, row), budget);
}

static bool has_number(const sp_lineup *lineup)
{
    size_t limit = lineup->matrix->search->options->max_nozzles;
    return lineup->count < SP_LINEUP_MOST && (!limit || lineup->matrix->search->kept_count + lineup->count < limit);
}

/* What a field's value adds to a patch that is not wet yet, per m²; without a branch, for many at a time. */
static inline float more_worth(bool single, float credit, float had, float dry, float more)
{
    float lack = 1 - credit * had, sum = had + more, most = more > had ? more : had, has = single ? most : sum;
    float plenty = has >= SP_ENOUGH ? lack : credit * (has - had);
    return dry * (more < 0 ? -more * lack : plenty);
}

/* A patch as a line-up leaves it, where film counts, too. */
typedef struct {
    float hit, film, dry;
    float lack; /* worth per m² that it has still to gain */
} left_over;

static left_over left_at(const sp_lineup *lineup, float credit, size_t p)
{
    float dry = lineup->dry[p];
    return (left_over){lineup->hit[p], lineup->film[p], dry, dry * (1 - credit * lineup->wet[p])};
}

/* As more_worth, of a field's value and its film. */
static inline float more_worth_of_both(bool single, float credit, left_over at, float field, float film)
{
    float more = field > 0 ? field : 0, edge = field < 0 ? 1 + field : 1, sum = at.hit + more;
    float hit = !single ? sum : more > at.hit ? more : at.hit, runs = at.film + film, wet = hit > runs ? hit : runs;
    return at.lack - (wet >= SP_ENOUGH ? 0 : at.dry * edge * (1 - credit * wet));
}

static double gain_of(const sp_lineup *lineup, size_t row, float credit)
{
    const sp_coverage_matrix *matrix = lineup->matrix;
    double gain = 0;
    for (size_t i = matrix->start[row]; i < matrix->start[row + 1]; i++) {
        uint32_t p = matrix->patch[i];
        if (lineup->wet[p] >= SP_ENOUGH)
            continue;
        bool single = matrix->search->single;
        float worth = matrix->film ? more_worth_of_both(single, credit, left_at(lineup, credit, p), matrix->field[i],
                                                        matrix->film[i])
                                   : more_worth(single, credit, lineup->wet[p], lineup->dry[p], matrix->field[i]);
        gain += (double)(matrix->area[p] * worth);
    }
    return gain * matrix->search->all;
}

double sp_lineup_gain(const sp_lineup *lineup, uint32_t row, double budget)
{
    bool fits = has_number(lineup) && has_place(lineup, row) && affords(lineup, row, budget);
    return fits ? gain_of(lineup, row, lineup->matrix->search->credit) : 0;
}

/* What every row gains, as a share of all. Patch by patch: most patches are wet already when the last rows are chosen.
 */
static void set_gains(sp_lineup *lineup, float credit)
{
    const sp_coverage_matrix *matrix = lineup->matrix;
    bool single = matrix->search->single;
    float worth[WORTHS];
    memset(lineup->gain, 0, matrix->row_count * sizeof *lineup->gain);
    for (size_t p = 0; p < matrix->patch_count; p++) {
        float had = lineup->wet[p], dry = lineup->dry[p], area = matrix->area[p];
        left_over at = matrix->film ? left_at(lineup, credit, p) : (left_over){0};
        size_t end = matrix->column_start[p + 1];
        for (size_t i = matrix->column_start[p]; had < SP_ENOUGH && i < end; i += WORTHS) {
            size_t count = end - i < WORTHS ? end - i : WORTHS;
            const uint32_t *row = &matrix->column_row[i];
            for (size_t k = 0; !matrix->film && k < count; k++)
                worth[k] = area * more_worth(single, credit, had, dry, matrix->column_field[i + k]);
            for (size_t k = 0; matrix->film && k < count; k++)
                worth[k] = area * more_worth_of_both(single, credit, at, matrix->column_field[i + k],
                                                     matrix->column_film[i + k]);
            for (size_t k = 0; k < count; k++)
                lineup->gain[row[k]] += (double)worth[k];
        }
    }
}

static double price_of(const sp_coverage_matrix *matrix, size_t row, double power)
{
    return power == 0 ? 1 : pow(sp_coverage_matrix_outlay(matrix, row), power);
}

uint32_t sp_lineup_best(sp_lineup *lineup, double power, float credit, double budget, double *gain)
{
    const sp_coverage_matrix *matrix = lineup->matrix;
    double merit = 0;
    *gain = 0;
    if (!has_number(lineup))
        return 0;
    set_gains(lineup, credit);
    for (size_t r = 0; r < matrix->row_count; r++) {
        if (!affords(lineup, r, budget) || !has_place(lineup, r))
            lineup->gain[r] = 0;
        merit = fmax(merit, lineup->gain[r] / price_of(matrix, r, power));
    }
    for (size_t r = 0; merit > 0 && r < matrix->row_count; r++)
        if (lineup->gain[r] > 0 && lineup->gain[r] + SP_SCORE_TIE >= merit * price_of(matrix, r, power)) {
            *gain = lineup->gain[r] * matrix->search->all;
            return (uint32_t)r;
        }
    return 0;
}

static double least_gain(const sp_lineup *lineup)
{
    return GAIN_LEAST * lineup->matrix->search->all;
}

static void fill(sp_lineup *lineup, float credit, double budget)
{
    for (;;) {
        double gain;
        uint32_t row = sp_lineup_best(lineup, 1, credit, budget, &gain);
        if (gain < least_gain(lineup))
            return;
        sp_lineup_add(lineup, row);
    }
}

/* Exchanges every row in turn for the best in its place. */
static bool exchange(sp_lineup *lineup, float credit, double budget)
{
    bool changed = false;
    for (size_t k = 0; k < lineup->count; k++) {
        uint32_t own = lineup->row[0];
        double gain;
        sp_lineup_remove(lineup, 0);
        double had = gain_of(lineup, own, credit);
        uint32_t row = sp_lineup_best(lineup, 0, credit, budget, &gain);
        bool better = gain > had + least_gain(lineup);
        sp_lineup_add(lineup, better ? row : own);
        changed |= better;
    }
    return changed;
}

void sp_lineup_improve(sp_lineup *lineup, double budget)
{
    /* credit leads to where nozzles complete one another; in the end only what is covered counts */
    const float credits[] = {lineup->matrix->search->credit, 0};
    for (size_t i = lineup->matrix->search->credit > 0 ? 0 : 1; i < 2; i++)
        for (int sweep = 0; sweep < SWEEPS_MOST; sweep++) {
            fill(lineup, credits[i], budget);
            if (!exchange(lineup, credits[i], budget))
                break;
        }
}

bool sp_lineup_merge(sp_lineup *lineup, size_t a, size_t b, double budget)
{
    uint32_t before[SP_LINEUP_MOST];
    size_t count = lineup->count;
    double gain, whole = lineup->outlay;
    memcpy(before, lineup->row, count * sizeof *before);
    sp_lineup_remove(lineup, a > b ? a : b);
    sp_lineup_remove(lineup, a > b ? b : a);
    uint32_t row = sp_lineup_best(lineup, 0, 0, fmin(budget, whole * (1 + 1e-12)), &gain);
    if (gain > 0)
        sp_lineup_add(lineup, row);
    else
        sp_lineup_set(lineup, before, count);
    return gain > 0;
}

/* How much of what a patch needs an entry brings. */
static float amount(const sp_coverage_matrix *matrix, size_t entry)
{
    float field = fabsf(matrix->field[entry]);
    return matrix->film ? fmaxf(field, matrix->film[entry]) : field;
}

/* The row whose liquid falls, or runs, most where row i's does. */
static size_t nearest(const sp_lineup *lineup, size_t i)
{
    const sp_coverage_matrix *matrix = lineup->matrix;
    size_t near = i;
    double most = -1; /* share of all */
    for (size_t k = 0; k < lineup->count; k++) {
        size_t a = matrix->start[lineup->row[i]], b = matrix->start[lineup->row[k]];
        double shared = 0;
        while (k != i && a < matrix->start[lineup->row[i] + 1] && b < matrix->start[lineup->row[k] + 1]) {
            uint32_t p = matrix->patch[a], q = matrix->patch[b];
            if (p == q)
                shared += (double)(matrix->area[p] * fminf(1, fminf(amount(matrix, a), amount(matrix, b))));
            a += p <= q;
            b += q <= p;
        }
        if (k != i && shared > most + SP_SCORE_TIE) {
            near = k;
            most = shared;
        }
    }
    return near;
}

/* One try from `lineup` as it is: false where there is nothing to try. */
static bool place_anew(const sp_lineup *lineup, size_t i, bool merging, double budget, sp_lineup *trial)
{
    size_t other = nearest(lineup, i);
    sp_lineup_set(trial, lineup->row, lineup->count);
    if (merging) {
        if (!sp_lineup_merge(trial, i, other, budget))
            return false;
    } else {
        sp_lineup_remove(trial, i > other ? i : other);
        sp_lineup_remove(trial, i > other ? other : i);
    }
    sp_lineup_improve(trial, budget);
    return true;
}

void sp_lineup_regroup(sp_lineup *lineup, double budget, sp_lineup *trial)
{
    bool better = true;
    for (int round = 0; better && round < ROUNDS_MOST; round++) {
        better = false;
        for (size_t i = 0; lineup->count > 1 && i < 2 * lineup->count; i++)
            if (place_anew(lineup, i / 2, i % 2, budget, trial) &&
                trial->covered > lineup->covered + least_gain(lineup)) {
                sp_lineup_set(lineup, trial->row, trial->count);
                better = true;
            }
    }
}
