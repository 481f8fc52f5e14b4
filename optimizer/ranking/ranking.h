/* Things in the order of a figure, and at equal figures in the order they had: the same whatever sorts them. */
#ifndef OPTIMIZER_RANKING_H
#define OPTIMIZER_RANKING_H

#include <stddef.h>
#include <stdlib.h>

typedef struct {
    double merit;
    size_t at; /* which thing */
} sp_ranked;

static inline int sp_by_rise(const void *a, const void *b)
{
    const sp_ranked *p = a, *q = b;
    if (p->merit != q->merit)
        return p->merit < q->merit ? -1 : 1;
    return (p->at > q->at) - (p->at < q->at);
}

static inline int sp_by_fall(const void *a, const void *b)
{
    const sp_ranked *p = a, *q = b;
    if (p->merit != q->merit)
        return p->merit > q->merit ? -1 : 1;
    return (p->at > q->at) - (p->at < q->at);
}

static inline int sp_by_number(const void *a, const void *b)
{
    const sp_ranked *p = a, *q = b;
    return (p->at > q->at) - (p->at < q->at);
}

/* The least first. */
static inline void sp_rank_rising(sp_ranked *items, size_t count)
{
    if (count)
        qsort(items, count, sizeof *items, sp_by_rise);
}

/* The highest first. */
static inline void sp_rank_falling(sp_ranked *items, size_t count)
{
    if (count)
        qsort(items, count, sizeof *items, sp_by_fall);
}

/* The same where what lies within `tie` (a share) below the highest that is left is equal to it. */
static inline void sp_rank_falling_ties(sp_ranked *items, size_t count, double tie)
{
    sp_rank_falling(items, count);
    for (size_t first = 0, end; first < count; first = end) {
        end = first + 1;
        while (end < count && items[end].merit >= items[first].merit * (1 - tie))
            end++;
        qsort(&items[first], end - first, sizeof *items, sp_by_number);
    }
}

#endif
