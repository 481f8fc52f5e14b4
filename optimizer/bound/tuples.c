#include "bound/tuples.h"

#include "bound/bit_rows.h"
#include "mesh/grow.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

#define DEEP_MOST 6            /* nozzles of a layout that are chosen one by one */
#define STEPS_LEAST 96         /* of the water, by which what is left of it is told apart */
#define STEPS_MOST 256         /* with more nozzles than that, none are few */
#define FOUND_MOST 100000      /* layouts whose union comes above the target */
#define ITEMS_A_WORD 4         /* a candidate that is passed by takes as long as a fourth of a word */
#define UPWARDS (1 + 1e-9)     /* more than sums here are rounded by */
#define SHARE_LEAST (1 - 1e-5) /* of weight / W: more than shares, and their sums, are rounded by */
#define SHARE_UPWARDS (1 + 1e-6)

typedef struct {
    size_t position;
    uint32_t weight, steps;
    uint32_t set; /* of the sets */
    size_t port;
    double price, alone; /* m² */
} item;

/* A layout whose union comes above the target. */
typedef struct {
    uint32_t count, item[DEEP_MOST];
} tuple;

typedef struct {
    const sp_cover *cover;
    const sp_line *line;
    const sp_tuple_task *task;
    sp_bit_rows sets;
    item *items; /* heavier ones first, then those that cover more alone */
    size_t count, capacity;
    uint32_t lightest, unit; /* unit: of a step */
    size_t steps;
    double most_priced[STEPS_MOST + 1]; /* what candidates could add to the sum of prices, by steps of water left */
    tuple *found;
    size_t found_count, found_capacity;
    double work;
    bool failed, over; /* memory ran out; more was to do than may be */
} tuples;

/* The candidates that could still join a layout in the making, and what each would add to its union at most. */
typedef struct {
    uint64_t *had;  /* [words] */
    uint32_t *item; /* [items] */
    double *gain;   /* [items], m² */
    size_t count;
} level;

/* One thread's own. */
typedef struct {
    tuples *all;
    level levels[DEEP_MOST + 1];
    uint32_t chosen[DEEP_MOST];
    double work;
} worker;

/* most[s] = the most that candidates of s steps in all can come to, best[q] being the best of those that take q. */
static void fill_steps(size_t steps, const double *best, double *most)
{
    most[0] = 0;
    for (size_t s = 1; s <= steps; s++) {
        most[s] = most[s - 1];
        for (size_t q = 1; q <= s; q++)
            if (best[q] > 0 && best[q] + most[s - q] > most[s])
                most[s] = best[q] + most[s - q];
    }
}

static void fill_prices(tuples *o)
{
    const sp_line *line = o->line;
    double best[STEPS_MOST + 1] = {0};
    for (size_t k = 0; k < line->kind_count; k++)
        for (size_t i = line->kind_start[k]; i < line->kind_start[k + 1] && line->weight[k] <= o->task->water; i++)
            if (o->task->alive[i])
                best[line->weight[k] / o->unit] = fmax(best[line->weight[k] / o->unit], (double)o->task->price[i]);
    fill_steps(o->steps, best, o->most_priced);
}

/* By prices alone: could a layout that holds candidates worth so much, with so much water left, come above the target?
 */
static bool priced_above(const tuples *o, double priced, size_t water)
{
    return (o->task->rest + priced + o->most_priced[water / o->unit]) * UPWARDS > o->task->target;
}

/* The candidates that prices leave. */
static bool list_items(tuples *o, sp_error *error)
{
    const sp_line *line = o->line;
    for (size_t r = 0; r < line->run_count; r++) {
        uint32_t weight = line->weight[sp_line_kind(line, line->run_start[r])];
        for (size_t i = line->run_start[r]; i < line->run_start[r + 1] && weight <= o->task->water; i++) {
            double price = (double)o->task->price[i];
            if (!o->task->alive[i] || !priced_above(o, price, o->task->water - weight))
                continue;
            if (!sp_grow(&o->items, &o->capacity, o->count + 1, sizeof *o->items))
                return sp_fail_memory(error);
            o->items[o->count] = (item){i, weight, weight / o->unit, (uint32_t)o->count, line->run_port[r], price, 0};
            o->count++;
        }
    }
    return true;
}

static int by_weight(const void *a, const void *b)
{
    const item *p = a, *q = b;
    if (p->weight != q->weight)
        return p->weight < q->weight ? 1 : -1;
    if (p->alone != q->alone)
        return p->alone < q->alone ? 1 : -1;
    return (p->position > q->position) - (p->position < q->position);
}

static bool build_sets(tuples *o, sp_error *error)
{
    sp_rows one = {0};
    bool done = sp_bit_rows_create(o->cover, &o->sets, error);
    uint64_t *none = done ? calloc(o->sets.words + 1, sizeof *none) : NULL;
    for (size_t i = 0; done && none && i < o->count && sp_cover_goes_on(o->cover); i++) {
        item *own = &o->items[i];
        one.count = one.used = 0;
        done = o->line->row(o->line->user, own->position, &one, error) &&
               sp_bit_rows_add(&o->sets, o->cover, &one, 0,
                               SHARE_LEAST * (double)own->weight / (double)o->task->water, error);
        if (done)
            own->alone = sp_bit_rows_gain(&o->sets, i, none) + o->sets.edge[i];
    }
    sp_rows_free(&one);
    done = (done && none) || (done && sp_fail_memory(error));
    free(none);
    if (done)
        qsort(o->items, o->count, sizeof *o->items, by_weight);
    return done;
}

static bool goes_on(const worker *own)
{
    bool over;
#pragma omp atomic read
    over = own->all->over;
    return !over && sp_cover_goes_on(own->all->cover);
}

/* Adds what was done to all threads' work. */
static void tell_work(worker *own)
{
    tuples *o = own->all;
    bool over;
#pragma omp critical(sp_tuples_work)
    {
        o->work += own->work;
        over = o->work > o->task->work_most;
    }
    own->work = 0;
    if (over) {
#pragma omp atomic write
        o->over = true;
    }
}

static void note_found(worker *own, size_t count)
{
    tuples *o = own->all;
    bool over;
#pragma omp critical(sp_tuples_found)
    {
        over = o->found_count >= FOUND_MOST;
        if (!over && !sp_grow(&o->found, &o->found_capacity, o->found_count + 1, sizeof *o->found))
            over = o->failed = true;
        if (!over) {
            tuple *t = &o->found[o->found_count++];
            *t = (tuple){.count = (uint32_t)count};
            memcpy(t->item, own->chosen, count * sizeof *t->item);
        }
    }
    if (over) {
#pragma omp atomic write
        o->over = true;
    }
}

/* What the candidates of a level could add to its union, at most, by steps of water. */
static void fill_gains(const tuples *o, const level *at, double *most)
{
    double best[STEPS_MOST + 1] = {0};
    for (size_t i = 0; i < at->count; i++) {
        uint32_t steps = o->items[at->item[i]].steps;
        best[steps] = fmax(best[steps], at->gain[i]);
    }
    fill_steps(o->steps, best, most);
}

/* Draws the next level from candidates i and on of one, the i-th having been chosen: those that could join it. */
static void list_joining(worker *own, size_t depth, size_t first, double covered, double priced, size_t water,
                         const double *most)
{
    const tuples *o = own->all;
    const level *from = &own->levels[depth];
    level *to = &own->levels[depth + 1];
    const item *chosen = &o->items[from->item[first]];
    const uint64_t *bits = o->sets.bits + chosen->set * o->sets.words;
    size_t swept = 0;
    for (size_t w = 0; w < o->sets.words; w++)
        to->had[w] = from->had[w] | bits[w];
    to->count = 0;
    for (size_t i = first + (chosen->port != SP_NO_PORT || !o->cover->repeats); i < from->count; i++) {
        const item *other = &o->items[from->item[i]];
        if (other->weight > water || (other->port == chosen->port && other->port != SP_NO_PORT) ||
            !priced_above(o, priced + other->price, water - other->weight))
            continue;
        double others = most[(water - other->weight) / o->unit];
        if (covered + from->gain[i] + others <= o->task->target)
            continue;
        double gain = sp_bit_rows_gain(&o->sets, other->set, to->had) + o->sets.edge[other->set];
        swept++;
        if (covered + gain + others <= o->task->target)
            continue;
        to->item[to->count] = from->item[i];
        to->gain[to->count++] = gain;
    }
    own->work += (double)(swept * o->sets.words) + (double)(from->count - first) / ITEMS_A_WORD;
}

static void grow(worker *own, size_t depth, double covered, double priced, size_t water);

/* Chooses candidate i of a level: a layout of one more nozzle. */
static void choose(worker *own, size_t depth, size_t i, double covered, double priced, size_t water,
                   const double *most)
{
    const tuples *o = own->all;
    const level *at = &own->levels[depth];
    const item *one = &o->items[at->item[i]];
    double now = (covered + at->gain[i]) * UPWARDS;
    size_t left = water - one->weight;
    if (now + most[left / o->unit] <= o->task->target)
        return;
    own->chosen[depth] = at->item[i];
    if (now > o->task->target)
        note_found(own, depth + 1);
    if (left < o->lightest || depth + 1 == o->cover->nozzles)
        return;
    if (depth + 1 == DEEP_MOST) {
        own->work = INFINITY;
        return;
    }
    list_joining(own, depth, i, now, priced + one->price, left, most);
    grow(own, depth + 1, now, priced + one->price, left);
}

/* All layouts that hold those chosen so far and others of the level. */
static void grow(worker *own, size_t depth, double covered, double priced, size_t water)
{
    double most[STEPS_MOST + 1];
    const level *at = &own->levels[depth];
    if (!at->count)
        return;
    fill_gains(own->all, at, most);
    for (size_t i = 0; i < at->count; i++)
        choose(own, depth, i, covered, priced, water, most);
    if (depth == 1 || own->work > 1e8)
        tell_work(own);
}

static bool worker_create(tuples *o, worker *own)
{
    *own = (worker){.all = o};
    size_t deep = o->task->water / o->lightest;
    for (size_t d = 0; d <= DEEP_MOST && d <= deep; d++) {
        level *at = &own->levels[d];
        at->had = calloc(o->sets.words + 1, sizeof *at->had);
        at->item = malloc((o->count + 1) * sizeof *at->item);
        at->gain = malloc((o->count + 1) * sizeof *at->gain);
        if (!at->had || !at->item || !at->gain)
            return false;
    }
    level *root = &own->levels[0];
    for (size_t i = 0; i < o->count; i++) {
        root->item[i] = (uint32_t)i;
        root->gain[i] = o->items[i].alone;
    }
    root->count = o->count;
    return true;
}

static void worker_free(worker *own)
{
    for (size_t d = 0; d <= DEEP_MOST; d++) {
        free(own->levels[d].had);
        free(own->levels[d].item);
        free(own->levels[d].gain);
    }
}

/* Every layout, by the first of its nozzles. */
static bool enumerate(tuples *o, sp_error *error)
{
    int threads = o->cover->threads;
    worker *workers = calloc((size_t)threads, sizeof *workers);
    bool done = workers != NULL;
    for (int i = 0; done && i < threads; i++)
        done = worker_create(o, &workers[i]);
    if (done && o->count) {
        double most[STEPS_MOST + 1];
        fill_gains(o, &workers[0].levels[0], most);
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1)
        for (size_t i = 0; i < o->count; i++) {
            worker *own = &workers[omp_get_thread_num()];
            if (goes_on(own))
                choose(own, 0, i, o->cover->base, 0, o->task->water, most);
        }
        for (int i = 0; i < threads; i++)
            tell_work(&workers[i]);
    }
    for (int i = 0; workers && i < threads; i++)
        worker_free(&workers[i]);
    free(workers);
    return (done && !o->failed) || sp_fail_memory(error);
}

/* What a layout brings to every texel: shares in all, and the part that edges leave dry. */
typedef struct {
    double *sum, *dry; /* [texels] */
} brought;

static bool bring(const tuples *o, uint32_t one, const brought *from, brought *to, sp_error *error)
{
    sp_rows row = {0};
    size_t texels = o->cover->texel_count;
    if (!o->line->row(o->line->user, o->items[one].position, &row, error)) {
        sp_rows_free(&row);
        return false;
    }
    memcpy(to->sum, from->sum, texels * sizeof *to->sum);
    memcpy(to->dry, from->dry, texels * sizeof *to->dry);
    for (size_t k = 0; k < row.used; k++)
        if (row.share[k] > 0)
            to->sum[row.texel[k]] += (double)row.share[k] * SHARE_UPWARDS;
        else
            to->dry[row.texel[k]] *= 1 + (double)row.share[k];
    sp_rows_free(&row);
    return true;
}

static double covered_by(const tuples *o, const brought *b)
{
    double area = o->cover->base;
    for (size_t t = 0; t < o->cover->texel_count; t++)
        area += (b->sum[t] >= 1 ? 1 : 1 - b->dry[t]) * (double)o->cover->area[t];
    return area * SHARE_UPWARDS;
}

static int by_items(const void *a, const void *b)
{
    const tuple *p = a, *q = b;
    for (size_t i = 0; i < p->count && i < q->count; i++)
        if (p->item[i] != q->item[i])
            return p->item[i] < q->item[i] ? -1 : 1;
    return (p->count > q->count) - (p->count < q->count);
}

/* Covers what was found exactly, but where a texel may be covered in several ways: then no less. */
static bool check_found(tuples *o, double *most, sp_error *error)
{
    size_t texels = o->cover->texel_count;
    brought kept[DEEP_MOST + 1] = {{NULL, NULL}};
    bool done = true;
    const tuple *last = NULL;
    qsort(o->found, o->found_count, sizeof *o->found, by_items);
    for (size_t d = 0; d <= DEEP_MOST; d++) {
        kept[d] = (brought){calloc(texels + 1, sizeof(double)), malloc((texels + 1) * sizeof(double))};
        done &= kept[d].sum && kept[d].dry;
    }
    done = done || sp_fail_memory(error);
    for (size_t t = 0; done && t < texels; t++)
        kept[0].dry[t] = 1;
    for (size_t i = 0; done && i < o->found_count && sp_cover_goes_on(o->cover); i++) {
        const tuple *now = &o->found[i];
        size_t same = 0;
        while (last && same < last->count && same < now->count && last->item[same] == now->item[same])
            same++;
        for (size_t d = same; done && d < now->count; d++)
            done = bring(o, now->item[d], &kept[d], &kept[d + 1], error);
        if (done)
            *most = fmax(*most, covered_by(o, &kept[now->count]));
        last = now;
    }
    for (size_t d = 0; d <= DEEP_MOST; d++) {
        free(kept[d].sum);
        free(kept[d].dry);
    }
    return done;
}

bool sp_tuples_bound(const sp_cover *cover, const sp_line *line, const sp_tuple_task *task, sp_tuple_answer *answer,
                     sp_error *error)
{
    tuples o = {.cover = cover, .line = line, .task = task};
    *answer = (sp_tuple_answer){.bound = task->target};
    o.lightest = line->kind_count ? line->weight[line->kind_count - 1] : 0;
    if (!o.lightest || task->water / o.lightest > STEPS_MOST)
        return true;
    o.unit = (uint32_t)fmax(1, fmin(o.lightest, ceil((double)task->water / STEPS_LEAST)));
    o.steps = task->water / o.unit;
    if (o.steps > STEPS_MOST)
        return true;
    fill_prices(&o);
    bool done = list_items(&o, error);
    answer->candidates = o.count;
    if (done && o.count <= task->rows_most) {
        done = build_sets(&o, error) && enumerate(&o, error);
        answer->checked = o.found_count;
        answer->work = o.work;
        if (done && !o.over)
            done = check_found(&o, &answer->bound, error);
        answer->complete = done && !o.over && sp_cover_goes_on(cover);
    }
    free(o.items);
    free(o.found);
    sp_bit_rows_free(&o.sets);
    return done;
}
