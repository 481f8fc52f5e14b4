/* Every layout of an instance small enough to try them all. */
#ifndef EXHAUSTIVE_H
#define EXHAUSTIVE_H

#include "instance.h"

#define EVERY_MOST 8 /* nozzles of a layout */

/* The most that layouts cover, by water: [water + 1]. */
typedef struct {
    const instance *in;
    double *by_water;
    float *sum;
    size_t chosen[EVERY_MOST];
} every_layout;

static inline double every_covered(const every_layout *t, size_t count)
{
    const sp_rows *rows = &t->in->rows;
    double area = t->in->cover.base;
    for (size_t p = 0; p < t->in->cover.texel_count; p++)
        t->sum[p] = 0;
    for (size_t i = 0; i < count; i++)
        for (size_t k = rows->start[t->chosen[i]]; k < rows->start[t->chosen[i] + 1]; k++)
            t->sum[rows->texel[k]] += rows->share[k];
    for (size_t p = 0; p < t->in->cover.texel_count; p++)
        area += t->sum[p] >= 1 ? (double)t->in->area[p] : 0;
    return area;
}

static inline void every_layout_try(every_layout *t, size_t count, size_t first, size_t water)
{
    const sp_cover *cover = &t->in->cover;
    const sp_rows *rows = &t->in->rows;
    double area = every_covered(t, count);
    for (size_t w = water; w <= cover->water; w++)
        t->by_water[w] = fmax(t->by_water[w], area);
    if (count == cover->nozzles || count == EVERY_MOST)
        return;
    for (size_t c = first; c < rows->count; c++) {
        bool taken = false;
        for (size_t i = 0; i < count; i++)
            taken |= rows->port[c] != SP_NO_PORT && rows->port[t->chosen[i]] == rows->port[c];
        size_t more = water + cover->weight[rows->tier[c]];
        if (taken || more > cover->water)
            continue;
        t->chosen[count] = c;
        every_layout_try(t, count + 1, cover->repeats ? c : c + 1, more);
    }
}

static inline void every_layout_create(const instance *in, every_layout *t)
{
    *t = (every_layout){.in = in};
    t->by_water = calloc(in->cover.water + 1, sizeof *t->by_water);
    t->sum = malloc(in->cover.texel_count * sizeof *t->sum);
    every_layout_try(t, 0, 0, 0);
}

static inline void every_layout_free(every_layout *t)
{
    free(t->by_water);
    free(t->sum);
}

#endif
