#include "bound/bit_rows.h"
#include "bound/rounding.h"

#include "mesh/grow.h"
#include "ranking/ranking.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define UNITS 0xffff /* of the largest texel */

/* Texels by falling area, 64 a word. */
static void place_texels(sp_ranked *order, size_t count, sp_bit_rows *sets)
{
    sp_rank_falling(order, count);
    sets->unit = count ? order[0].merit / UNITS * SP_UPWARDS_SETS : 1;
    assert(sets->unit > 0);
    for (size_t i = 0; i < count; i++) {
        sets->place[order[i].at] = (uint32_t)i;
        if (i % 64 == 0)
            sets->area[i / 64] = (uint32_t)ceil(order[i].merit / sets->unit);
        assert(sets->area[i / 64] <= UNITS && order[i].merit <= sets->area[i / 64] * sets->unit * SP_UPWARDS_SETS);
    }
}

bool sp_bit_rows_create(const sp_cover *cover, sp_bit_rows *sets, sp_error *error)
{
    size_t count = 0;
    *sets = (sp_bit_rows){0};
    sp_ranked *order = malloc((cover->texel_count + 1) * sizeof *order);
    sets->place = malloc((cover->texel_count + 1) * sizeof *sets->place);
    sets->area = malloc((cover->texel_count / 64 + 1) * sizeof *sets->area);
    bool done = order && sets->place && sets->area;
    for (size_t t = 0; done && t < cover->texel_count; t++) {
        sets->place[t] = UINT32_MAX;
        if (cover->area[t] > 0)
            order[count++] = (sp_ranked){(double)cover->area[t], t};
    }
    sets->words = (count + 63) / 64;
    if (done)
        place_texels(order, count, sets);
    free(order);
    if (done)
        return true;
    sp_bit_rows_free(sets);
    return sp_fail_memory(error);
}

void sp_bit_rows_free(sp_bit_rows *sets)
{
    free(sets->area);
    free(sets->place);
    free(sets->bits);
    free(sets->edge);
    free(sets->start);
    free(sets->edge_at);
    free(sets->edge_covers);
    *sets = (sp_bit_rows){0};
}

static bool make_room(sp_bit_rows *sets, size_t edges)
{
    if (sets->count == sets->capacity) {
        size_t capacity = sets->capacity ? 2 * sets->capacity : 256;
        if (!sp_reallocate(&sets->bits, capacity * sets->words + 1, sizeof *sets->bits) ||
            !sp_reallocate(&sets->edge, capacity, sizeof *sets->edge) ||
            !sp_reallocate(&sets->start, capacity + 1, sizeof *sets->start))
            return false;
        sets->capacity = capacity;
    }
    if (edges <= sets->room - sets->edges)
        return true;
    size_t room = 2 * (sets->edges + edges);
    if (!sp_reallocate(&sets->edge_at, room, sizeof *sets->edge_at) ||
        !sp_reallocate(&sets->edge_covers, room, sizeof *sets->edge_covers))
        return false;
    sets->room = room;
    return true;
}

bool sp_bit_rows_add(sp_bit_rows *sets, const sp_cover *cover, const sp_rows *rows, size_t row, double least,
                     sp_error *error)
{
    assert(least > 0 && row < rows->count); /* else entries of edges would be bits, too */
    if (!make_room(sets, rows->start[row + 1] - rows->start[row]))
        return sp_fail_memory(error);
    uint64_t *bits = sets->bits + sets->count * sets->words;
    memset(bits, 0, sets->words * sizeof *bits);
    sets->start[sets->count] = sets->edges;
    for (size_t i = rows->start[row]; i < rows->start[row + 1]; i++) {
        assert(rows->texel[i] < cover->texel_count);
        uint32_t place = sets->place[rows->texel[i]];
        float share = rows->share[i];
        if (place == UINT32_MAX)
            continue;
        if ((double)share >= least)
            bits[place / 64] |= (uint64_t)1 << place % 64;
        if (share >= 0)
            continue;
        sets->edge_at[sets->edges] = place;
        sets->edge_covers[sets->edges++] = -share * cover->area[rows->texel[i]];
    }
    sets->start[++sets->count] = sets->edges;
    sets->edge[sets->count - 1] = sp_bit_rows_edge(sets, sets->count - 1, bits);
    return true;
}

double sp_bit_rows_bytes(const sp_bit_rows *sets)
{
    return (double)sets->capacity * (double)sets->words * sizeof *sets->bits +
           (double)sets->room * (sizeof *sets->edge_at + sizeof *sets->edge_covers);
}

double sp_bit_rows_edge(const sp_bit_rows *sets, size_t row, const uint64_t *had)
{
    double sum = 0;
    for (size_t i = sets->start[row]; i < sets->start[row + 1]; i++) {
        uint32_t place = sets->edge_at[i];
        sum += (had[place / 64] >> place % 64 & 1) ? 0 : (double)sets->edge_covers[i];
    }
    return sum * SP_UPWARDS_SINGLE;
}

static inline uint64_t count_gain(const uint64_t *row, const uint64_t *had, const uint32_t *area, size_t words)
{
    uint64_t sum = 0;
    for (size_t w = 0; w < words; w++)
        sum += (uint64_t)__builtin_popcountll(row[w] & ~had[w]) * area[w];
    return sum;
}

#if defined __x86_64__ && defined __GNUC__
__attribute__((target("popcnt"))) static uint64_t count_gain_popcnt(const uint64_t *row, const uint64_t *had,
                                                                    const uint32_t *area, size_t words)
{
    return count_gain(row, had, area, words);
}
/* gcc alone is told in words not to halve its vectors. */
#ifdef __clang__
#define WIDE "avx512f,avx512dq,avx512vl,avx512vpopcntdq"
#else
#define WIDE "avx512f,avx512dq,avx512vl,avx512vpopcntdq,prefer-vector-width=512"
#endif
__attribute__((target(WIDE))) static uint64_t count_gain_wide(const uint64_t *row, const uint64_t *had,
                                                              const uint32_t *area, size_t words)
{
    return count_gain(row, had, area, words);
}
#endif

double sp_bit_rows_gain(const sp_bit_rows *sets, size_t row, const uint64_t *had)
{
    assert(row < sets->count);
    const uint64_t *bits = sets->bits + row * sets->words;
#if defined __x86_64__ && defined __GNUC__
    if (__builtin_cpu_supports("avx512vpopcntdq") && __builtin_cpu_supports("avx512dq"))
        return (double)count_gain_wide(bits, had, sets->area, sets->words) * sets->unit;
    if (__builtin_cpu_supports("popcnt"))
        return (double)count_gain_popcnt(bits, had, sets->area, sets->words) * sets->unit;
#endif
    return (double)count_gain(bits, had, sets->area, sets->words) * sets->unit;
}
