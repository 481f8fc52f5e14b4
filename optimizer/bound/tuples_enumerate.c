#include "bound/tuples_work.h"

#include "mesh/grow.h"
#include "ranking/ranking.h"

#include <assert.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

#define FOUND_MOST 100000 /* layouts whose union comes above the target */
#define WORK_PASSED 16    /* and as a candidate that is passed by */
#define WORK_TOLD 1e8     /* that a thread may keep to itself */

/* The candidates that could still join a layout in the making: heavier ones first, then those of most merit, which is
 * what each would add to its union at most, m². */
typedef struct {
    uint64_t *had;      /* [words] */
    sp_ranked *entries; /* [items] */
    size_t count;
    size_t *end;  /* [kinds], of the kind's entries */
    double *most; /* [kinds][steps + 1], what those of this kind and lighter could add together */
} level;

/* One thread's own. */
typedef struct {
    sp_tuples *all;
    level levels[DEEP_MOST + 1];
    uint32_t chosen[DEEP_MOST];
    uint64_t *united; /* [words] */
    double work;
} worker;

static bool is_over(const worker *own)
{
    bool over;
#pragma omp atomic read
    over = own->all->over;
    return over;
}

/* Adds what was done to all threads' work. */
static void tell_work(worker *own)
{
    sp_tuples *o = own->all;
    bool over = !sp_cover_goes_on(o->cover);
#pragma omp critical(sp_tuples_work)
    {
        o->work += own->work;
        over |= o->work > o->work_most;
    }
    own->work = 0;
    if (over) {
#pragma omp atomic write
        o->over = true;
    }
}

/* What those chosen cover together, edges counted where no other covers all of a texel. */
static double united(worker *own, size_t count)
{
    const sp_tuples *o = own->all;
    uint64_t *all = own->united;
    double area = o->cover->base;
    memset(all, 0, o->sets.words * sizeof *all);
    for (size_t i = 0; i < count; i++) {
        uint32_t set = o->items[own->chosen[i]].set;
        const uint64_t *bits = o->sets.bits + set * o->sets.words;
        area += sp_bit_rows_gain(&o->sets, set, all);
        for (size_t w = 0; w < o->sets.words; w++)
            all[w] |= bits[w];
    }
    for (size_t i = 0; i < count; i++)
        area += sp_bit_rows_edge(&o->sets, o->items[own->chosen[i]].set, all);
    return area * SP_UPWARDS_SETS;
}

static void note_found(worker *own, size_t count)
{
    sp_tuples *o = own->all;
    bool over;
    own->work += 4.0 * (double)o->sets.words;
    if (united(own, count) <= o->target)
        return;
#pragma omp critical(sp_tuples_found)
    {
        over = o->found_count >= FOUND_MOST;
        if (!over && !sp_grow(&o->found, &o->found_capacity, o->found_count + 1, sizeof *o->found))
            over = o->failed = true;
        if (!over) {
            own->work += WORK_ROW;
            sp_tuple *t = &o->found[o->found_count++];
            *t = (sp_tuple){.count = (uint32_t)count};
            memcpy(t->item, own->chosen, count * sizeof *t->item);
        }
    }
    if (over) {
#pragma omp atomic write
        o->over = true;
    }
}

/* Orders a level's entries, which stand by kinds, and finds what they could add together. */
static void settle(const sp_tuples *o, level *at)
{
    const double *lighter = NULL;
    size_t first = 0;
    for (size_t k = 0; k < o->list->kind_count; k++) {
        size_t end = first;
        while (end < at->count && o->items[at->entries[end].at].kind == k)
            end++;
        sp_rank_falling(at->entries + first, end - first);
        at->end[k] = first = end;
    }
    assert(first == at->count); /* entries stood by kinds */
    for (size_t k = o->list->kind_count; k-- > 0;) {
        size_t start = k ? at->end[k - 1] : 0;
        double *most = sp_tuples_of_kind(o, at->most, k);
        sp_tuples_fill_kind(o, k, at->end[k] > start ? at->entries[start].merit : 0, lighter, most);
        lighter = most;
    }
}

/* Draws the next level from the entries of one from the chosen one on: those that could join it. */
static void list_joining(worker *own, size_t depth, size_t first, double covered, const double *priced, size_t water)
{
    const sp_tuples *o = own->all;
    const level *from = &own->levels[depth];
    level *to = &own->levels[depth + 1];
    const sp_tuple_item *chosen = &o->items[from->entries[first].at];
    const uint64_t *bits = o->sets.bits + chosen->set * o->sets.words;
    const double *most = sp_tuples_of_kind(o, from->most, chosen->kind);
    size_t swept = 0, passed = 0;
    for (size_t w = 0; w < o->sets.words; w++)
        to->had[w] = from->had[w] | bits[w];
    to->count = 0;
    for (size_t i = first + (chosen->port != SP_NO_PORT || !o->cover->repeats); i < from->count; i++) {
        const sp_tuple_item *other = &o->items[from->entries[i].at];
        passed++;
        if (other->weight > water) {
            i = from->end[other->kind] - 1;
            continue;
        }
        double others = most[(water - other->weight) / o->unit];
        assert(other->set < o->sets.count && other->kind >= chosen->kind);
        if (covered + from->entries[i].merit + others <= o->target) {
            i = from->end[other->kind] - 1;
            continue;
        }
        if ((other->port == chosen->port && other->port != SP_NO_PORT) ||
            !sp_tuples_all_above(o, priced, other->price, chosen->kind, water - other->weight))
            continue;
        double gain = (sp_bit_rows_gain(&o->sets, other->set, to->had) + o->sets.edge[other->set]) * SP_UPWARDS_SETS;
        swept++;
        if (covered + gain + others > o->target)
            to->entries[to->count++] = (sp_ranked){gain, from->entries[i].at};
    }
    own->work += (double)(swept * o->sets.words) + (double)passed * WORK_PASSED;
}

static void grow(worker *own, size_t depth, double covered, const double *priced, size_t water);

/* Chooses an entry of a level: layouts of one more nozzle. False where it, and all after it of its kind, are no use. */
static bool choose(worker *own, size_t depth, size_t i, double covered, const double *priced, size_t water)
{
    const sp_tuples *o = own->all;
    const level *at = &own->levels[depth];
    const sp_tuple_item *one = &o->items[at->entries[i].at];
    double now = (covered + at->entries[i].merit) * SP_UPWARDS_SETS;
    assert(depth < DEEP_MOST && one->weight <= water && one->set < o->sets.count);
    size_t left = water - one->weight;
    if (now + sp_tuples_of_kind(o, at->most, one->kind)[left / o->unit] <= o->target)
        return false;
    if (!sp_tuples_all_above(o, priced, one->price, one->kind, left))
        return true;
    own->chosen[depth] = (uint32_t)at->entries[i].at;
    if (now > o->target)
        note_found(own, depth + 1);
    if (left < o->lightest || depth + 1 == o->cover->nozzles)
        return true;
    if (depth + 1 == DEEP_MOST) {
        own->work = INFINITY;
        return true;
    }
    double with[BY_MULTIPLIERS] = {0};
    for (size_t k = 0; k < o->priced; k++)
        with[k] = priced[k] + (double)one->price[k];
    list_joining(own, depth, i, now, with, left);
    grow(own, depth + 1, now, with, left);
    return true;
}

/* All layouts that hold those chosen so far and others of the level. */
static void grow(worker *own, size_t depth, double covered, const double *priced, size_t water)
{
    level *at = &own->levels[depth];
    if (!at->count)
        return;
    settle(own->all, at);
    for (size_t i = 0; i < at->count && !is_over(own); i++)
        if (!choose(own, depth, i, covered, priced, water))
            i = at->end[own->all->items[at->entries[i].at].kind] - 1;
    if (own->work > WORK_TOLD)
        tell_work(own);
}

static bool worker_create(sp_tuples *o, worker *own)
{
    *own = (worker){.all = o};
    size_t deep = o->water / o->lightest, kinds = o->list->kind_count;
    own->united = malloc((o->sets.words + 1) * sizeof *own->united);
    if (!own->united)
        return false;
    for (size_t d = 0; d <= DEEP_MOST && d <= deep; d++) {
        level *at = &own->levels[d];
        at->had = calloc(o->sets.words + 1, sizeof *at->had);
        at->entries = malloc((o->able_count + 1) * sizeof *at->entries);
        at->end = malloc(kinds * sizeof *at->end);
        at->most = malloc(kinds * (o->steps + 1) * sizeof *at->most);
        if (!at->had || !at->entries || !at->end || !at->most)
            return false;
    }
    level *root = &own->levels[0];
    for (size_t i = 0; i < o->able_count; i++)
        root->entries[i] = (sp_ranked){o->items[o->able[i]].alone, o->able[i]};
    root->count = o->able_count;
    settle(o, root);
    return true;
}

static void worker_free(worker *own)
{
    free(own->united);
    for (size_t d = 0; d <= DEEP_MOST; d++) {
        free(own->levels[d].had);
        free(own->levels[d].entries);
        free(own->levels[d].end);
        free(own->levels[d].most);
    }
}

bool sp_tuples_enumerate(sp_tuples *o, sp_error *error)
{
    static const double none[BY_MULTIPLIERS] = {0};
    int threads = o->cover->threads;
    worker *workers = calloc((size_t)threads, sizeof *workers);
    bool done = workers != NULL;
    for (int i = 0; done && i < threads; i++)
        done = worker_create(o, &workers[i]);
    if (done) {
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1)
        for (size_t i = 0; i < o->able_count; i++) {
            worker *own = &workers[omp_get_thread_num()];
            if (!is_over(own))
                choose(own, 0, i, o->cover->base, none, o->water);
            if (own->work > WORK_TOLD)
                tell_work(own);
        }
        for (int i = 0; i < threads; i++)
            tell_work(&workers[i]);
    }
    for (int i = 0; workers && i < threads; i++)
        worker_free(&workers[i]);
    free(workers);
    return (done && !o->failed) || sp_fail_memory(error);
}
