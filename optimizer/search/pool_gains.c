#include "search/pool_gains.h"

#include "ranks/messages.h"
#include "scoring/bodies.h"
#include "scoring/field.h"
#include "scoring/footprints.h"
#include "scoring/scoring.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#define PART 128 /* poses: few enough for many threads, many enough for a column to have several */

/* What a pose brings to one patch. */
typedef struct {
    uint32_t patch;
    float field, film, edge;
} entry;

typedef struct {
    size_t count;
    entry *entries;
} row;

static bool row_of_footprint(const sp_footprint *footprint, row *row)
{
    row->entries = malloc((footprint->count + 1) * sizeof *row->entries);
    for (size_t i = 0; row->entries && i < footprint->count; i++) {
        const sp_print *print = &footprint->prints[i];
        bool both = print->hit > 0 && print->edge > 0;
        row->entries[row->count++] =
            (entry){print->patch, print->hit > 0 ? print->hit : -print->edge, print->film, both ? print->edge : 0};
    }
    return row->entries;
}

static bool row_of_field(const sp_search *search, const float *field, row *row)
{
    const float *film = search->kept_film ? field + search->patch_count : NULL;
    size_t count = 0;
    for (size_t p = 0; p < search->patch_count; p++)
        count += field[p] != 0 || (film && film[p] > 0);
    row->entries = malloc((count + 1) * sizeof *row->entries);
    for (uint32_t p = 0; row->entries && p < search->patch_count; p++)
        if (field[p] != 0 || (film && film[p] > 0))
            row->entries[row->count++] = (entry){p, field[p], film ? film[p] : 0, 0};
    return row->entries;
}

/* Rows of the poses of this rank's sites; `field` [field_count] is scratch. False where memory ran out. */
static bool find_row(const sp_search *search, sp_pose pose, float *field, row *row)
{
    if (!sp_ranks_mine(search->options->run.ranks, pose.site))
        return true;
    if (!sp_type_is_uniform(search->candidates->variants[pose.variant].type))
        return row_of_footprint(sp_footprints_look(search->footprints, pose), row);
    sp_field_pose(search, pose, field);
    return row_of_field(search, field, row);
}

/* Writes the rows of a part by columns. */
static bool turn(const sp_search *search, const row *rows, sp_pool_part *part)
{
    size_t used = 0;
    for (size_t i = 0; i < part->count; i++)
        used += rows[i].count;
    part->start = calloc(search->patch_count + 2, sizeof *part->start);
    part->pose = malloc((used + 1) * sizeof *part->pose);
    part->field = malloc((used + 1) * sizeof *part->field);
    part->film = search->kept_film ? malloc((used + 1) * sizeof *part->film) : NULL;
    part->edge = search->footprints ? malloc((used + 1) * sizeof *part->edge) : NULL;
    if (!part->start || !part->pose || !part->field || (search->kept_film && !part->film) ||
        (search->footprints && !part->edge))
        return false;
    /* counted two places on, so that filling moves each start to its own place */
    for (size_t i = 0; i < part->count; i++)
        for (size_t k = 0; k < rows[i].count; k++)
            part->start[rows[i].entries[k].patch + 2]++;
    for (size_t p = 0; p < search->patch_count; p++)
        part->start[p + 2] += part->start[p + 1];
    for (size_t i = 0; i < part->count; i++)
        for (size_t k = 0; k < rows[i].count; k++) {
            size_t at = part->start[rows[i].entries[k].patch + 1]++;
            part->pose[at] = (uint32_t)i;
            part->field[at] = rows[i].entries[k].field;
            if (part->film)
                part->film[at] = rows[i].entries[k].film;
            if (part->edge)
                part->edge[at] = rows[i].entries[k].edge;
        }
    assert(part->start[0] == 0 && part->start[search->patch_count] == used);
    return true;
}

static bool part_create(const sp_search *search, const sp_pool *pool, float *field, sp_pool_part *part)
{
    row rows[PART] = {0};
    bool done = true;
    for (size_t i = 0; done && i < part->count; i++)
        done = find_row(search, pool->items[part->first + i], field, &rows[i]);
    done = done && turn(search, rows, part);
    for (size_t i = 0; i < part->count; i++)
        free(rows[i].entries);
    return done;
}

static bool create_parts(const sp_search *search, sp_pool_gains *gains, sp_error *error)
{
    int threads = sp_scorer_threads(search);
    size_t fields = search->field_count + 1, lacking = 0;
    float *scratch = malloc((size_t)threads * fields * sizeof *scratch);
    if (!scratch)
        return sp_fail_memory(error);
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1) reduction(+ : lacking)
    for (size_t i = 0; i < gains->part_count; i++) {
        sp_pool_part *part = &gains->parts[i];
        size_t left = gains->pool->count - i * PART;
        part->first = i * PART;
        part->count = left < PART ? left : PART;
        lacking += !part_create(search, gains->pool, scratch + (size_t)omp_get_thread_num() * fields, part);
    }
    free(scratch);
    return !lacking || sp_fail_memory(error);
}

bool sp_pool_gains_create(const sp_search *search, const sp_pool *pool, sp_pool_gains *gains, sp_error *error)
{
    *gains = (sp_pool_gains){.pool = pool, .part_count = (pool->count + PART - 1) / PART};
    gains->score = malloc((pool->count + 1) * sizeof *gains->score);
    gains->changes = malloc((search->patch_count + 1) * sizeof *gains->changes);
    gains->parts = calloc(gains->part_count + 1, sizeof *gains->parts);
    bool done = (gains->score && gains->changes && gains->parts) || sp_fail_memory(error);
    for (int i = 0; done && i < 2; i++)
        done = sp_kept_gains_create(search->patch_count, pool->count, search->kept_film, &gains->known[i]) ||
               sp_fail_memory(error);
    done = done && create_parts(search, gains, error);
    if (!done)
        sp_pool_gains_free(gains);
    return done;
}

void sp_pool_gains_free(sp_pool_gains *gains)
{
    for (size_t i = 0; gains->parts && i < gains->part_count; i++) {
        free(gains->parts[i].start);
        free(gains->parts[i].pose);
        free(gains->parts[i].field);
        free(gains->parts[i].film);
        free(gains->parts[i].edge);
    }
    for (int i = 0; i < 2; i++)
        sp_kept_gains_free(&gains->known[i]);
    free(gains->parts);
    free(gains->score);
    free(gains->changes);
    *gains = (sp_pool_gains){0};
}

static sp_left_over left_at(const sp_search *search, const sp_partial *partial, size_t p)
{
    return sp_left_over_of(search->credit, partial->hit[p], partial->film ? partial->film[p] : 0, partial->dry[p]);
}

/* What entry i of a part adds to a patch, per m², where hits and edges may be of one entry. */
static double more_of(const sp_search *search, const sp_pool_part *part, size_t i, sp_left_over at)
{
    float hit = at.hit, dry = at.dry;
    sp_pour(search, part->field[i], &hit, &dry);
    dry *= 1 - part->edge[i];
    return (double)(at.lack -
                    sp_left_over_of(search->credit, hit, at.film + (part->film ? part->film[i] : 0), dry).lack);
}

/* Brings a part's gains on one patch from what it was to what it is. */
static void keep_up_patch(const sp_search *search, const sp_pool_part *part, size_t p, sp_left_over was,
                          sp_left_over is, double *gain)
{
    size_t first = part->start[p], end = part->start[p + 1];
    if (!part->edge) {
        sp_column column = {end - first, &part->pose[first], &part->field[first],
                            part->film ? &part->film[first] : NULL};
        sp_column_keep_up(search->single, search->credit, search->area[p], &column, was, is, gain);
        return;
    }
    for (size_t i = first; i < end; i++)
        gain[part->pose[i]] += (double)search->area[p] * (more_of(search, part, i, is) - more_of(search, part, i, was));
}

/* Lists the patches on which gains differ from those that are known; or, where that is less work, clears the gains and
 * lists all on which there is anything to gain. */
static size_t list_changes(const sp_search *search, const sp_pool_gains *gains, const sp_kept_gains *known,
                           const sp_partial *partial)
{
    size_t count = 0, open = 0;
    ptrdiff_t saved = 0;
    for (uint32_t p = 0; known->found && p < search->patch_count; p++) {
        sp_left_over was = sp_kept_at(known, search->credit, p), is = left_at(search, partial, p);
        saved += is.wet < SP_ENOUGH;
        if (!sp_left_over_differs(&was, &is))
            continue;
        saved -= (was.wet < SP_ENOUGH) + (is.wet < SP_ENOUGH);
        gains->changes[count++] = (sp_pool_change){p, was, is};
    }
    if (known->found && saved >= 0)
        return count;
    memset(known->gain, 0, gains->pool->count * sizeof *known->gain);
    for (uint32_t p = 0; p < search->patch_count; p++) {
        sp_left_over is = left_at(search, partial, p);
        if (is.wet < SP_ENOUGH)
            gains->changes[open++] = (sp_pool_change){p, sp_nothing_left, is};
    }
    return open;
}

/* What every pose gains on the partial layout, share of all. */
static const double *find_gains(const sp_search *search, sp_pool_gains *gains, const sp_partial *partial)
{
    sp_kept_gains *known = &gains->known[search->credit > 0];
    const sp_pool_change *changes = gains->changes;
    size_t count = list_changes(search, gains, known, partial);
    int threads = sp_threads(&search->options->run);
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1)
    for (size_t i = 0; i < gains->part_count; i++)
        for (size_t k = 0; k < count; k++)
            keep_up_patch(search, &gains->parts[i], changes[k].patch, changes[k].was, changes[k].is,
                          known->gain + gains->parts[i].first);
    sp_kept_gains_note(known, partial->hit, partial->film, partial->dry);
    return known->gain;
}

/* True where pose i is this rank's, and one more nozzle there is allowed. */
static bool allowed(const sp_search *search, const sp_partial *partial, sp_pose pose, double budget)
{
    uint32_t mount = search->sites->items[pose.site].mount;
    return sp_ranks_mine(search->options->run.ranks, pose.site) &&
           sp_partial_affords(search, partial, mount, pose.variant, budget) &&
           sp_partial_has_place(search, partial, mount) && sp_body_clear(search, partial, sp_pose_body(search, &pose));
}

/* The scores of the others' poses that are above 0. */
static bool share_scores(const sp_search *search, sp_pool_gains *gains, sp_error *error)
{
    sp_ranks *ranks = search->options->run.ranks;
    sp_outgoing outgoing = {0};
    sp_gathered gathered;
    uint32_t count = 0;
    if (sp_ranks_count(ranks) == 1)
        return true;
    for (size_t i = 0; i < gains->pool->count; i++)
        count += gains->score[i] > 0;
    sp_pack(&outgoing, &count, sizeof count);
    for (uint32_t i = 0; i < gains->pool->count; i++)
        if (gains->score[i] > 0) {
            sp_pack(&outgoing, &i, sizeof i);
            sp_pack(&outgoing, &gains->score[i], sizeof gains->score[i]);
        }
    if (!sp_ranks_gather(ranks, "scores", &outgoing, &gathered, error))
        return false;
    for (size_t rank = 0; rank < gathered.count; rank++)
        for (uint32_t i, k = sp_unpack(&gathered, rank, &count, sizeof count) ? count : 0; k > 0; k--)
            if (sp_unpack(&gathered, rank, &i, sizeof i) && i < gains->pool->count)
                sp_unpack(&gathered, rank, &gains->score[i], sizeof gains->score[i]);
    sp_gathered_free(&gathered);
    return true;
}

bool sp_pool_best(const sp_search *search, sp_pool_gains *gains, const sp_partial *partial, double power, double budget,
                  sp_pose *best, double *gain, sp_error *error)
{
    const sp_pose *poses = gains->pool->items;
    const double *shares = find_gains(search, gains, partial);
    double merit = 0, tie = SP_SCORE_TIE * search->all;
    *gain = 0;
    for (size_t i = 0; i < gains->pool->count; i++)
        gains->score[i] = allowed(search, partial, poses[i], budget)
                              ? sp_gain_at(search, partial, poses[i], shares[i] * search->all)
                              : 0;
    if (!share_scores(search, gains, error))
        return false;
    for (size_t i = 0; i < gains->pool->count; i++)
        merit = fmax(merit, gains->score[i] / sp_merit_price(search, &poses[i], power));
    for (size_t i = 0; merit > 0 && i < gains->pool->count; i++)
        if (gains->score[i] > 0 && gains->score[i] + tie >= merit * sp_merit_price(search, &poses[i], power)) {
            *best = poses[i];
            *gain = gains->score[i];
            return true;
        }
    return true;
}
