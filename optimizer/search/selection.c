#include "search/selection.h"

#include "scoring/bodies.h"
#include "scoring/mount_capacity.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#define GAIN_LEAST 1e-5 /* of the area: less is no reason for an exchange */
#define EXCHANGES_MOST 8
#define ROUNDS_MOST 4
#define NOISE 1e-12 /* of the area: what adding and taking away may leave of a gain that is none */

bool sp_selection_create(const sp_coverage_matrix *matrix, sp_selection *selection, sp_error *error)
{
    *selection = (sp_selection){.matrix = matrix,
                                .hit = malloc((matrix->patch_count + 1) * sizeof *selection->hit),
                                .dry = malloc((matrix->patch_count + 1) * sizeof *selection->dry),
                                .score = malloc((matrix->row_count + 1) * sizeof *selection->score)};
    selection->film = matrix->kept_film ? malloc((matrix->patch_count + 1) * sizeof *selection->film) : NULL;
    selection->wet = matrix->kept_film ? malloc((matrix->patch_count + 1) * sizeof *selection->wet) : selection->hit;
    bool done = true;
    for (int i = 0; done && i < 2; i++)
        done = sp_kept_gains_create(matrix->patch_count, matrix->row_count, matrix->kept_film, &selection->known[i]);
    if (!done || !selection->hit || !selection->wet || !selection->dry || !selection->score ||
        (matrix->kept_film && !selection->film)) {
        sp_selection_free(selection);
        return sp_fail_memory(error);
    }
    sp_selection_set(selection, NULL, 0);
    return true;
}

void sp_selection_free(sp_selection *selection)
{
    if (selection->wet != selection->hit)
        free(selection->wet);
    free(selection->hit);
    free(selection->film);
    free(selection->dry);
    free(selection->score);
    for (int i = 0; i < 2; i++)
        sp_kept_gains_free(&selection->known[i]);
    *selection = (sp_selection){0};
}

static void count_covered(sp_selection *selection)
{
    selection->covered = 0;
    for (size_t p = 0; p < selection->matrix->patch_count; p++)
        selection->covered += (double)(selection->matrix->area[p] * sp_covered(selection->wet[p], selection->dry[p]));
    selection->covered *= selection->matrix->search->all;
}

/* Whether a row is among the first `count` of the selection: its edges count once. */
static bool is_taken(const sp_selection *selection, size_t count, size_t row)
{
    bool found = false;
    for (size_t i = 0; i < count && !found; i++)
        found = selection->row[i] == row;
    return found;
}

/* Pours row i of the selection. */
static void pour(sp_selection *selection, size_t number)
{
    const sp_coverage_matrix *matrix = selection->matrix;
    uint32_t row = selection->row[number];
    bool again = is_taken(selection, number, row);
    selection->flow += sp_coverage_matrix_flow(matrix, row);
    selection->outlay += sp_coverage_matrix_outlay(matrix, row);
    for (size_t i = matrix->start[row]; i < matrix->start[row + 1]; i++) {
        float field = again ? sp_without_edge(matrix->field[i]) : matrix->field[i];
        sp_pour(matrix->search, field, &selection->hit[matrix->patch[i]], &selection->dry[matrix->patch[i]]);
    }
    for (size_t i = matrix->start[row]; matrix->film && i < matrix->start[row + 1]; i++) {
        uint32_t p = matrix->patch[i];
        selection->film[p] += matrix->film[i];
        selection->wet[p] = fmaxf(selection->hit[p], selection->film[p]);
    }
}

static void set_rows(sp_selection *selection, const uint32_t *rows, size_t count)
{
    const sp_coverage_matrix *matrix = selection->matrix;
    memcpy(selection->hit, matrix->kept_hit, matrix->patch_count * sizeof *selection->hit);
    for (size_t p = 0; matrix->kept_film && p < matrix->patch_count; p++) {
        selection->film[p] = matrix->kept_film[p];
        selection->wet[p] = fmaxf(selection->hit[p], selection->film[p]);
    }
    memcpy(selection->dry, matrix->kept_dry, matrix->patch_count * sizeof *selection->dry);
    selection->flow = selection->outlay = matrix->search->kept_flow;
    selection->count = count;
    for (size_t i = 0; i < count; i++) {
        selection->row[i] = rows[i];
        pour(selection, i);
    }
    count_covered(selection);
}

void sp_selection_set(sp_selection *selection, const uint32_t *rows, size_t count)
{
    /* gains kept up from an earlier selection on this memory, whose thread is chance, would differ in their last bits
     */
    selection->known[0].found = selection->known[1].found = false;
    set_rows(selection, rows, count);
}

void sp_selection_add(sp_selection *selection, uint32_t row)
{
    assert(selection->count < SP_SELECTION_MOST && row < selection->matrix->row_count);
    selection->row[selection->count++] = row;
    pour(selection, selection->count - 1);
    count_covered(selection);
}

void sp_selection_remove(sp_selection *selection, size_t i)
{
    /* poured anew: what is taken from a sum leaves rounding behind */
    uint32_t rows[SP_SELECTION_MOST];
    assert(i < selection->count);
    memcpy(rows, selection->row, selection->count * sizeof *rows);
    memmove(&rows[i], &rows[i + 1], (selection->count - i - 1) * sizeof *rows);
    set_rows(selection, rows, selection->count - 1);
}

static sp_body body_of(const sp_coverage_matrix *matrix, size_t row)
{
    size_t poses = matrix->pool->count;
    return row < poses ? sp_pose_body(matrix->search, &matrix->pool->items[row])
                       : sp_nozzle_body(&matrix->others[row - poses]->nozzle);
}

static bool is_clear(const sp_selection *selection, size_t row)
{
    const sp_coverage_matrix *matrix = selection->matrix;
    sp_body own = body_of(matrix, row);
    bool clear = sp_body_clear_of_kept(matrix->search, own);
    for (size_t i = 0; matrix->search->bodies && clear && i < selection->count; i++)
        clear = !sp_body_overlaps(own, body_of(matrix, selection->row[i]));
    return clear;
}

static bool has_place(const sp_selection *selection, size_t row)
{
    const sp_coverage_matrix *matrix = selection->matrix;
    if (selection->barred && selection->barred[row])
        return false;
    uint32_t mount = sp_coverage_matrix_mount(matrix, row);
    size_t capacity = sp_mount_left(matrix->search, mount), there = 0;
    for (size_t i = 0; capacity <= selection->count && i < selection->count; i++)
        there += sp_coverage_matrix_mount(matrix, selection->row[i]) == mount;
    return there < capacity && is_clear(selection, row);
}

static bool affords(const sp_selection *selection, size_t row, double budget)
{
    const sp_coverage_matrix *matrix = selection->matrix;
    return sp_affords(matrix->search, selection->flow, selection->outlay, sp_coverage_matrix_mount(matrix, row),
                      sp_coverage_matrix_flow(matrix, row), budget);
}

static bool has_number(const sp_selection *selection)
{
    return selection->count < SP_SELECTION_MOST && sp_number_allows(selection->matrix->search, selection->count);
}

static sp_left_over left_at(const sp_selection *selection, float credit, size_t p)
{
    return sp_left_over_of(credit, selection->hit[p], selection->film ? selection->film[p] : 0, selection->dry[p]);
}

static double gain_of(const sp_selection *selection, size_t row, float credit)
{
    const sp_coverage_matrix *matrix = selection->matrix;
    double gain = 0;
    bool again = is_taken(selection, selection->count, row);
    for (size_t i = matrix->start[row]; i < matrix->start[row + 1]; i++) {
        uint32_t p = matrix->patch[i];
        float field = again ? sp_without_edge(matrix->field[i]) : matrix->field[i];
        if (selection->wet[p] >= SP_ENOUGH)
            continue;
        bool single = matrix->search->single;
        float worth = matrix->film
                          ? sp_more_worth_of_both(single, credit, left_at(selection, credit, p), field, matrix->film[i])
                          : sp_more_worth(single, credit, selection->wet[p], selection->dry[p], field);
        gain += (double)(matrix->area[p] * worth);
    }
    return gain * matrix->search->all;
}

double sp_selection_gain(const sp_selection *selection, uint32_t row, double budget)
{
    bool fits = has_number(selection) && has_place(selection, row) && affords(selection, row, budget);
    return fits ? gain_of(selection, row, selection->matrix->search->credit) : 0;
}

/* Terms of sums that it takes to find all gains, less what it takes to bring those that are known up to date. */
static ptrdiff_t saving(const sp_selection *selection, const sp_kept_gains *known)
{
    const sp_coverage_matrix *matrix = selection->matrix;
    ptrdiff_t saved = 0;
    for (size_t p = 0; p < matrix->patch_count; p++) {
        sp_left_over was = sp_kept_at(known, 0, p), is = left_at(selection, 0, p);
        int terms = sp_left_over_differs(&was, &is) ? (was.wet < SP_ENOUGH) + (is.wet < SP_ENOUGH) : 0;
        saved += ((is.wet < SP_ENOUGH) - terms) * (ptrdiff_t)(matrix->column_start[p + 1] - matrix->column_start[p]);
    }
    return saved;
}

/* What every row gains: of many nozzles one more or less changes few patches. */
static const double *find_gains(sp_selection *selection, float credit)
{
    const sp_coverage_matrix *matrix = selection->matrix;
    sp_kept_gains *known = &selection->known[credit > 0];
    assert(credit <= 0 || (credit >= matrix->search->credit && credit <= matrix->search->credit));
    bool anew = !known->found || saving(selection, known) <= 0;
    if (anew)
        memset(known->gain, 0, matrix->row_count * sizeof *known->gain);
    for (size_t p = 0; p < matrix->patch_count; p++) {
        sp_left_over was = anew ? sp_nothing_left : sp_kept_at(known, credit, p), is = left_at(selection, credit, p);
        size_t first = matrix->column_start[p];
        sp_column column = {matrix->column_start[p + 1] - first, &matrix->column_row[first],
                            &matrix->column_field[first], matrix->film ? &matrix->column_film[first] : NULL};
        if (sp_left_over_differs(&was, &is))
            sp_column_keep_up(matrix->search->single, credit, matrix->area[p], &column, was, is, known->gain);
    }
    sp_kept_gains_note(known, selection->hit, selection->film, selection->dry);
    return known->gain;
}

static double price_of(const sp_coverage_matrix *matrix, size_t row, double power)
{
    return power == 0 ? 1 : pow(sp_coverage_matrix_outlay(matrix, row), power);
}

const double *sp_selection_gains(sp_selection *selection, float credit, double budget)
{
    const sp_coverage_matrix *matrix = selection->matrix;
    if (!has_number(selection)) {
        memset(selection->score, 0, matrix->row_count * sizeof *selection->score);
        return selection->score;
    }
    const double *gains = find_gains(selection, credit);
    for (size_t r = 0; r < matrix->row_count; r++) {
        bool fits = gains[r] > NOISE && affords(selection, r, budget) && has_place(selection, r);
        selection->score[r] = fits ? gains[r] : 0;
    }
    for (size_t i = 0; i < selection->count; i++)
        if (selection->score[selection->row[i]] > 0)
            selection->score[selection->row[i]] = gain_of(selection, selection->row[i], credit) / matrix->search->all;
    return selection->score;
}

static sp_selection_answer find_best(sp_selection *selection, double power, float credit, double budget)
{
    const sp_coverage_matrix *matrix = selection->matrix;
    const double *gains = sp_selection_gains(selection, credit, budget);
    double merit = 0;
    for (size_t r = 0; r < matrix->row_count; r++)
        merit = fmax(merit, gains[r] / price_of(matrix, r, power));
    for (size_t r = 0; merit > 0 && r < matrix->row_count; r++)
        if (gains[r] > 0 && gains[r] + SP_SCORE_TIE >= merit * price_of(matrix, r, power))
            return (sp_selection_answer){(uint32_t)r, gains[r] * matrix->search->all};
    return (sp_selection_answer){0};
}

uint32_t sp_selection_best(sp_selection *selection, double power, float credit, double budget, double *gain)
{
    sp_selection_answer best = {0};
    if (has_number(selection)) {
        sp_selection_question question = sp_selection_ask(selection->row, selection->count, power, credit, budget);
        const sp_selection_answer *known = selection->memo ? sp_selection_memo_find(selection->memo, &question) : NULL;
        best = known ? *known : find_best(selection, power, credit, budget);
        if (selection->memo && !known)
            sp_selection_memo_note(selection->memo, &question, best);
    }
    *gain = best.gain;
    return best.row;
}

static double least_gain(const sp_selection *selection)
{
    return GAIN_LEAST * selection->matrix->search->all;
}

static void fill(sp_selection *selection, float credit, double budget)
{
    for (;;) {
        double gain;
        uint32_t row = sp_selection_best(selection, 1, credit, budget, &gain);
        if (gain < least_gain(selection))
            return;
        sp_selection_add(selection, row);
    }
}

/* Exchanges every row in turn for the best in its place. */
static bool exchange(sp_selection *selection, float credit, double budget)
{
    bool changed = false;
    for (size_t k = 0; k < selection->count; k++) {
        uint32_t own = selection->row[0];
        double gain;
        sp_selection_remove(selection, 0);
        double had = gain_of(selection, own, credit);
        uint32_t row = sp_selection_best(selection, 0, credit, budget, &gain);
        bool better = gain > had + least_gain(selection);
        sp_selection_add(selection, better ? row : own);
        changed |= better;
    }
    return changed;
}

void sp_selection_improve(sp_selection *selection, double budget)
{
    /* credit leads to where nozzles complete one another; in the end only what is covered counts */
    const float credits[] = {selection->matrix->search->credit, 0};
    for (size_t i = selection->matrix->search->credit > 0 ? 0 : 1; i < 2; i++)
        for (int round = 0; round < EXCHANGES_MOST; round++) {
            fill(selection, credits[i], budget);
            if (!exchange(selection, credits[i], budget))
                break;
        }
}

bool sp_selection_merge(sp_selection *selection, size_t a, size_t b, double budget)
{
    uint32_t before[SP_SELECTION_MOST];
    size_t count = selection->count;
    double gain, whole = selection->outlay;
    memcpy(before, selection->row, count * sizeof *before);
    sp_selection_remove(selection, a > b ? a : b);
    sp_selection_remove(selection, a > b ? b : a);
    uint32_t row = sp_selection_best(selection, 0, 0, fmin(budget, whole * (1 + 1e-12)), &gain);
    if (gain > 0)
        sp_selection_add(selection, row);
    else
        sp_selection_set(selection, before, count);
    return gain > 0;
}

/* How much of what a patch needs an entry brings. */
static float amount(const sp_coverage_matrix *matrix, size_t entry)
{
    float field = fabsf(matrix->field[entry]);
    return matrix->film ? fmaxf(field, matrix->film[entry]) : field;
}

/* The row whose liquid falls, or runs, most where row i's does. */
static size_t nearest(const sp_selection *selection, size_t i)
{
    const sp_coverage_matrix *matrix = selection->matrix;
    size_t near = i;
    double most = -1; /* share of all */
    for (size_t k = 0; k < selection->count; k++) {
        size_t a = matrix->start[selection->row[i]], b = matrix->start[selection->row[k]];
        double shared = 0;
        while (k != i && a < matrix->start[selection->row[i] + 1] && b < matrix->start[selection->row[k] + 1]) {
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

/* One try from `selection` as it is: false where there is nothing to try. */
static bool place_anew(const sp_selection *selection, size_t i, bool merging, double budget, sp_selection *trial)
{
    size_t other = nearest(selection, i);
    sp_selection_set(trial, selection->row, selection->count);
    if (merging) {
        if (!sp_selection_merge(trial, i, other, budget))
            return false;
    } else {
        sp_selection_remove(trial, i > other ? i : other);
        sp_selection_remove(trial, i > other ? other : i);
    }
    sp_selection_improve(trial, budget);
    return true;
}

void sp_selection_regroup(sp_selection *selection, double budget, sp_selection *trial)
{
    bool better = true;
    for (int round = 0; better && round < ROUNDS_MOST; round++) {
        better = false;
        for (size_t i = 0; selection->count > 1 && i < 2 * selection->count; i++)
            if (place_anew(selection, i / 2, i % 2, budget, trial) &&
                trial->covered > selection->covered + least_gain(selection)) {
                sp_selection_set(selection, trial->row, trial->count);
                better = true;
            }
    }
}
