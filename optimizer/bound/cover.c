#include "bound/cover.h"
#include "bound/rounding.h"

#include "mesh/grow.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#ifndef NDEBUG
/* Texels ascend, with one entry or, where a spray ends within one, two; no share is 0 or a NaN. */
static bool is_row(const uint32_t *texels, const float *shares, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if ((i && texels[i - 1] > texels[i]) || !(fabsf(shares[i]) > 0))
            return false;
    return true;
}
#endif

static bool make_room(sp_rows *rows, size_t more)
{
    assert(rows->count <= rows->capacity && rows->used <= rows->room);
    if (rows->count == rows->capacity) {
        size_t capacity = rows->capacity ? 2 * rows->capacity : 256;
        if (!sp_reallocate(&rows->start, capacity + 1, sizeof *rows->start) ||
            !sp_reallocate(&rows->port, capacity, sizeof *rows->port) ||
            !sp_reallocate(&rows->tier, capacity, sizeof *rows->tier) ||
            !sp_reallocate(&rows->key, capacity, sizeof *rows->key))
            return false;
        rows->capacity = capacity;
    }
    if (more <= rows->room - rows->used)
        return true;
    if (more > SIZE_MAX / 4 - rows->used)
        return false;
    size_t room = 2 * (rows->used + more);
    if (!sp_reallocate(&rows->texel, room, sizeof *rows->texel) ||
        !sp_reallocate(&rows->share, room, sizeof *rows->share))
        return false;
    rows->room = room;
    return true;
}

bool sp_rows_add(sp_rows *rows, uint64_t key, size_t port, uint32_t tier, const uint32_t *texels, const float *shares,
                 size_t count, sp_error *error)
{
    assert(is_row(texels, shares, count));
    if (!make_room(rows, count))
        return sp_fail_memory(error);
    if (!rows->count)
        rows->start[0] = 0;
    if (count) {
        memcpy(&rows->texel[rows->used], texels, count * sizeof *texels);
        memcpy(&rows->share[rows->used], shares, count * sizeof *shares);
    }
    rows->port[rows->count] = port;
    rows->tier[rows->count] = tier;
    rows->key[rows->count] = key;
    rows->used += count;
    rows->start[++rows->count] = rows->used;
    return true;
}

bool sp_rows_append(sp_rows *rows, const sp_rows *more, sp_error *error)
{
    bool done = true;
    for (size_t i = 0; done && i < more->count; i++)
        done = sp_rows_add(rows, more->key[i], more->port[i], more->tier[i], more->texel + more->start[i],
                           more->share + more->start[i], more->start[i + 1] - more->start[i], error);
    return done;
}

void sp_rows_keep(sp_rows *rows, const bool *marked)
{
    size_t kept = 0, used = 0;
    for (size_t i = 0; i < rows->count; i++) {
        size_t first = rows->start[i], count = rows->start[i + 1] - first;
        if (!marked[i])
            continue;
        memmove(&rows->texel[used], &rows->texel[first], count * sizeof *rows->texel);
        memmove(&rows->share[used], &rows->share[first], count * sizeof *rows->share);
        rows->port[kept] = rows->port[i];
        rows->tier[kept] = rows->tier[i];
        rows->key[kept] = rows->key[i];
        rows->start[kept++] = used;
        used += count;
    }
    rows->count = kept;
    rows->used = used;
    if (rows->start)
        rows->start[kept] = used;
}

static int by_key(const void *a, const void *b)
{
    uint64_t p = *(const uint64_t *)a, q = *(const uint64_t *)b;
    return (p > q) - (p < q);
}

uint64_t *sp_rows_keys(const sp_rows *rows)
{
    uint64_t *keys = malloc((rows->count + 1) * sizeof *keys);
    for (size_t i = 0; keys && i < rows->count; i++)
        keys[i] = rows->key[i];
    if (keys)
        qsort(keys, rows->count, sizeof *keys, by_key);
    return keys;
}

bool sp_keys_hold(const uint64_t *keys, size_t count, uint64_t key)
{
    return bsearch(&key, keys, count, sizeof *keys, by_key) != NULL;
}

void sp_rows_free(sp_rows *rows)
{
    free(rows->start);
    free(rows->port);
    free(rows->tier);
    free(rows->key);
    free(rows->texel);
    free(rows->share);
    *rows = (sp_rows){0};
}

bool sp_multipliers_create(const sp_cover *cover, sp_multipliers *multipliers, sp_error *error)
{
    size_t texels = cover->texel_count + 1;
    *multipliers = (sp_multipliers){.plain = malloc(texels * sizeof *multipliers->plain),
                                    .strengthened = calloc(texels, sizeof *multipliers->strengthened),
                                    .kind = calloc(texels, sizeof *multipliers->kind)};
    if (!multipliers->plain || !multipliers->strengthened || !multipliers->kind) {
        sp_multipliers_free(multipliers);
        return sp_fail_memory(error);
    }
    memcpy(multipliers->plain, cover->area, cover->texel_count * sizeof *multipliers->plain);
    return true;
}

void sp_multipliers_copy(const sp_cover *cover, const sp_multipliers *from, sp_multipliers *to)
{
    to->inequalities = from->inequalities;
    memcpy(to->plain, from->plain, cover->texel_count * sizeof *to->plain);
    memcpy(to->strengthened, from->strengthened, cover->texel_count * sizeof *to->strengthened);
    memcpy(to->kind, from->kind, cover->texel_count * sizeof *to->kind);
}

void sp_multipliers_free(sp_multipliers *multipliers)
{
    free(multipliers->plain);
    free(multipliers->strengthened);
    free(multipliers->kind);
    *multipliers = (sp_multipliers){0};
}

double sp_rows_price(const sp_rows *rows, size_t row, const sp_multipliers *multipliers)
{
    /* two sums side by side, so that neither waits for the other */
    double plain = 0, strengthened = 0;
    for (size_t i = rows->start[row]; i < rows->start[row + 1]; i++) {
        uint32_t t = rows->texel[i];
        plain += (double)sp_share_of(rows->share[i]) * (double)multipliers->plain[t];
        if (multipliers->inequalities && multipliers->strengthened[t] > 0)
            strengthened +=
                (double)sp_share_strengthened(multipliers->inequalities, multipliers->kind[t], rows->share[i]) *
                (double)multipliers->strengthened[t];
    }
    return (plain + strengthened) * SP_UPWARDS_TEXELS;
}

double sp_cover_rest(const sp_cover *cover, const sp_multipliers *multipliers)
{
    double rest = 0;
    for (size_t t = 0; t < cover->texel_count; t++) {
        /* below 0 they would prove less than is true */
        assert(multipliers->plain[t] >= 0 && multipliers->strengthened[t] >= 0);
        rest += fmax(0, (double)cover->area[t] - (double)multipliers->plain[t] - (double)multipliers->strengthened[t]);
    }
    return rest * SP_UPWARDS_TEXELS;
}
