#include "search/lineup.h"

#include "scoring/mount_capacity.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#define GAIN_LEAST 1e-5 /* of the area: less is no reason for an exchange */
#define SWEEPS_MOST 8
#define ROUNDS_MOST 4
#define NOISE 1e-12 /* of the area: what adding and taking away may leave of a gain that is none */

bool sp_lineup_create(const sp_coverage_matrix *matrix, sp_lineup *lineup, sp_error *error)
{
    *lineup = (sp_lineup){.matrix = matrix,
                          .hit = malloc((matrix->patch_count + 1) * sizeof *lineup->hit),
                          .dry = malloc((matrix->patch_count + 1) * sizeof *lineup->dry),
                          .score = malloc((matrix->row_count + 1) * sizeof *lineup->score)};
    lineup->film = matrix->kept_film ? malloc((matrix->patch_count + 1) * sizeof *lineup->film) : NULL;
    lineup->wet = matrix->kept_film ? malloc((matrix->patch_count + 1) * sizeof *lineup->wet) : lineup->hit;
    bool done = true;
    for (int i = 0; done && i < 2; i++)
        done = sp_kept_gains_create(matrix->patch_count, matrix->row_count, matrix->kept_film, &lineup->known[i]);
    if (!done || !lineup->hit || !lineup->wet || !lineup->dry || !lineup->score ||
        (matrix->kept_film && !lineup->film)) {
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
    free(lineup->score);
    for (int i = 0; i < 2; i++)
        sp_kept_gains_free(&lineup->known[i]);
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

static void set_rows(sp_lineup *lineup, const uint32_t *rows, size_t count)
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

void sp_lineup_set(sp_lineup *lineup, const uint32_t *rows, size_t count)
{
    /* gains kept up from an earlier line-up on this memory, whose thread is chance, would differ in their last bits */
    lineup->known[0].found = lineup->known[1].found = false;
    set_rows(lineup, rows, count);
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
    set_rows(lineup, rows, lineup->count - 1);
}

static bool has_place(const sp_lineup *lineup, size_t row)
{
    const sp_coverage_matrix *matrix = lineup->matrix;
    uint32_t mount = sp_coverage_matrix_mount(matrix, row);
    size_t capacity = sp_mount_left(matrix->search, mount), there = 0;
    for (size_t i = 0; capacity <= lineup->count && i < lineup->count; i++)
        there += sp_coverage_matrix_mount(matrix, lineup->row[i]) == mount;
    return there < capacity;
}

static bool affords(const sp_lineup *lineup, size_t row, double budget)
{
    const sp_coverage_matrix *matrix = lineup->matrix;
    return sp_affords(matrix->search, lineup->flow, lineup->outlay, sp_coverage_matrix_mount(matrix, row),
                      sp_coverage_matrix_flow(matrix, row), budget);
}

static bool has_number(const sp_lineup *lineup)
{
    return lineup->count < SP_LINEUP_MOST && sp_number_allows(lineup->matrix->search, lineup->count);
}

static sp_left_over left_at(const sp_lineup *lineup, float credit, size_t p)
{
    return sp_left_over_of(credit, lineup->hit[p], lineup->film ? lineup->film[p] : 0, lineup->dry[p]);
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
        float worth = matrix->film ? sp_more_worth_of_both(single, credit, left_at(lineup, credit, p), matrix->field[i],
                                                           matrix->film[i])
                                   : sp_more_worth(single, credit, lineup->wet[p], lineup->dry[p], matrix->field[i]);
        gain += (double)(matrix->area[p] * worth);
    }
    return gain * matrix->search->all;
}

double sp_lineup_gain(const sp_lineup *lineup, uint32_t row, double budget)
{
    bool fits = has_number(lineup) && has_place(lineup, row) && affords(lineup, row, budget);
    return fits ? gain_of(lineup, row, lineup->matrix->search->credit) : 0;
}

/* Terms of sums that it takes to find all gains, less what it takes to bring those that are known up to date. */
static ptrdiff_t saving(const sp_lineup *lineup, const sp_kept_gains *known)
{
    const sp_coverage_matrix *matrix = lineup->matrix;
    ptrdiff_t saved = 0;
    for (size_t p = 0; p < matrix->patch_count; p++) {
        sp_left_over was = sp_kept_at(known, 0, p), is = left_at(lineup, 0, p);
        int terms = sp_left_over_differs(&was, &is) ? (was.wet < SP_ENOUGH) + (is.wet < SP_ENOUGH) : 0;
        saved += ((is.wet < SP_ENOUGH) - terms) * (ptrdiff_t)(matrix->column_start[p + 1] - matrix->column_start[p]);
    }
    return saved;
}

/* What every row gains: of many nozzles one more or less changes few patches. */
static const double *find_gains(sp_lineup *lineup, float credit)
{
    const sp_coverage_matrix *matrix = lineup->matrix;
    sp_kept_gains *known = &lineup->known[credit > 0];
    assert(credit <= 0 || (credit >= matrix->search->credit && credit <= matrix->search->credit));
    bool anew = !known->found || saving(lineup, known) <= 0;
    if (anew)
        memset(known->gain, 0, matrix->row_count * sizeof *known->gain);
    for (size_t p = 0; p < matrix->patch_count; p++) {
        sp_left_over was = anew ? sp_nothing_left : sp_kept_at(known, credit, p), is = left_at(lineup, credit, p);
        size_t first = matrix->column_start[p];
        sp_column column = {matrix->column_start[p + 1] - first, &matrix->column_row[first],
                            &matrix->column_field[first], matrix->film ? &matrix->column_film[first] : NULL};
        if (sp_left_over_differs(&was, &is))
            sp_column_keep_up(matrix->search->single, credit, matrix->area[p], &column, was, is, known->gain);
    }
    sp_kept_gains_note(known, lineup->hit, lineup->film, lineup->dry);
    return known->gain;
}

static double price_of(const sp_coverage_matrix *matrix, size_t row, double power)
{
    return power == 0 ? 1 : pow(sp_coverage_matrix_outlay(matrix, row), power);
}

static sp_lineup_answer find_best(sp_lineup *lineup, double power, float credit, double budget)
{
    const sp_coverage_matrix *matrix = lineup->matrix;
    double merit = 0;
    const double *gains = find_gains(lineup, credit);
    for (size_t r = 0; r < matrix->row_count; r++) {
        bool fits = gains[r] > NOISE && affords(lineup, r, budget) && has_place(lineup, r);
        lineup->score[r] = fits ? gains[r] : 0;
        merit = fmax(merit, lineup->score[r] / price_of(matrix, r, power));
    }
    for (size_t r = 0; merit > 0 && r < matrix->row_count; r++)
        if (lineup->score[r] > 0 && lineup->score[r] + SP_SCORE_TIE >= merit * price_of(matrix, r, power))
            return (sp_lineup_answer){(uint32_t)r, lineup->score[r] * matrix->search->all};
    return (sp_lineup_answer){0};
}

uint32_t sp_lineup_best(sp_lineup *lineup, double power, float credit, double budget, double *gain)
{
    sp_lineup_answer best = {0};
    if (has_number(lineup)) {
        sp_lineup_question question = sp_lineup_ask(lineup->row, lineup->count, power, credit, budget);
        const sp_lineup_answer *known = lineup->memo ? sp_lineup_memo_find(lineup->memo, &question) : NULL;
        best = known ? *known : find_best(lineup, power, credit, budget);
        if (lineup->memo && !known)
            sp_lineup_memo_note(lineup->memo, &question, best);
    }
    *gain = best.gain;
    return best.row;
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
