#include "bound/tuples.h"

#include "bound/bit_rows.h"
#include "mesh/grow.h"
#include "ranking.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

#define DEEP_MOST 6            /* nozzles of a layout that are chosen one by one */
#define STEPS_LEAST 96         /* of the water, by which what is left of it is told apart */
#define STEPS_MOST 256         /* with more nozzles than that, none are few */
#define CHECKED_AT_A_TIME 64   /* layouts, before the clock is asked again */
#define FOUND_MOST 100000      /* layouts whose union comes above the target */
#define BYTES_MOST 4e8         /* of sets */
#define WORK_ROW 2e5           /* words that take as long as a row */
#define ROWS_AT_A_TIME 256     /* by all threads */
#define WORK_PASSED 16         /* and as a candidate that is passed by */
#define WORK_TOLD 1e8          /* that a thread may keep to itself */
#define UPWARDS (1 + 1e-9)     /* more than sums here are rounded by */
#define SHARE_LEAST (1 - 1e-5) /* of weight / W: more than shares, and their sums, are rounded by */
#define SHARE_UPWARDS (1 + 1e-6)
#define TARGETS 1000 /* that are told apart */
#define NO_SET UINT32_MAX
#define BY_PRICES 5 /* prices that layouts are told by: those given, the texels' areas, and what lies between */
#define SIFTED 3    /* times by all of them, as what is shut out lowers what others could add */

typedef struct {
    size_t position, kind;
    uint32_t weight, set; /* set: of the sets, NO_SET: not yet */
    size_t port;
    float price[BY_PRICES], above; /* above: m², up to which targets are that prices leave it for */
    double alone;                  /* m², of the set */
} item;

/* A layout whose union comes above the target. */
typedef struct {
    uint32_t count, item[DEEP_MOST];
} tuple;

struct sp_tuples {
    const sp_cover *cover;
    const sp_line *line;
    size_t water, most;
    double floor, bound, target;
    double least;                   /* of targets, for which all candidates in question are items */
    size_t priced;                  /* of BY_PRICES, that tell anything */
    double rest[BY_PRICES];         /* m² that the prices leave, base included */
    double *most_priced[BY_PRICES]; /* [kinds][steps + 1], see fill_kind: what candidates could add to sums of prices */
    item *items;                    /* heavier ones first */
    size_t count, capacity;
    sp_bit_rows sets;
    uint32_t lightest, unit; /* unit: of a step */
    size_t steps;            /* of all water; 0: more than can be told apart */
    uint32_t *able;          /* [able_count], items that could be part of a layout above the target */
    size_t able_count;
    tuple *found;
    size_t found_count, found_capacity;
    double work, work_most;
    bool failed, over; /* memory ran out; more was to do than may be */
};

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

/* most[s] = the most that candidates of s steps in all can come to: `lighter`, and any number of one kind. */
static void fill_kind(const sp_tuples *o, size_t kind, double best, const double *lighter, double *most)
{
    size_t own = o->line->weight[kind] / o->unit;
    for (size_t s = 0; s <= o->steps; s++)
        most[s] = lighter ? lighter[s] : 0;
    for (size_t s = own; best > 0 && s <= o->steps; s++)
        most[s] = fmax(most[s], best + most[s - own]);
}

static double *of_kind(const sp_tuples *o, double *tables, size_t kind)
{
    return tables + kind * (o->steps + 1);
}

/* What candidates could add to the sums of the k-th prices, `price` by position: the best of each kind. */
static void fill_prices(sp_tuples *o, size_t k, const float *price)
{
    const sp_line *line = o->line;
    const double *lighter = NULL;
    for (size_t kind = line->kind_count; kind-- > 0;) {
        double best = 0, *most = of_kind(o, o->most_priced[k], kind);
        for (size_t i = line->kind_start[kind]; i < line->kind_start[kind + 1] && line->weight[kind] <= o->water; i++)
            best = fmax(best, (double)price[i]);
        fill_kind(o, kind, best, lighter, most);
        lighter = most;
    }
}

/* Could a layout that holds candidates worth so much by the k-th prices, and others of the kind and lighter in so much
 * water, come above the target? */
static bool priced_above(const sp_tuples *o, size_t k, double priced, size_t kind, size_t water)
{
    double most = o->most_priced[k][kind * (o->steps + 1) + water / o->unit];
    return (o->rest[k] + priced + most) * UPWARDS > o->target;
}

static bool all_above(const sp_tuples *o, const double *priced, const float *more, size_t kind, size_t water)
{
    bool above = true;
    for (size_t k = 0; k < o->priced; k++)
        above &= priced_above(o, k, priced[k] + (double)more[k], kind, water);
    return above;
}

/* The highest target that a candidate could be part of a layout above, by the k-th prices. */
static double above_by(const sp_tuples *o, size_t k, double price, size_t kind)
{
    return (o->rest[k] + price + o->most_priced[k][(o->water - o->line->weight[kind]) / o->unit]) * UPWARDS;
}

/* The lowest target, from the floor on, that no more than so many of the numbers lie above. */
static double target_for(const sp_tuples *o, size_t most, const float *above, size_t count)
{
    size_t over[TARGETS + 1] = {0}, sum = 0, i = TARGETS;
    double step = (o->bound - o->floor) / TARGETS;
    for (size_t k = 0; k < count && step > 0; k++)
        over[(size_t)fmin(TARGETS, fmax(0, ceil(((double)above[k] - o->floor) / step)))]++;
    for (; i > 0 && (sum += over[i]) <= most; i--)
        ;
    return o->floor + (double)i * step;
}

/* Leaves alive what the k-th prices do. */
static void shut_out(const sp_tuples *o, size_t k, const float *price, uint8_t *alive)
{
    const sp_line *line = o->line;
    for (size_t kind = 0; kind < line->kind_count; kind++)
        for (size_t i = line->kind_start[kind]; i < line->kind_start[kind + 1]; i++)
            alive[i] &= line->weight[kind] <= o->water &&
                        priced_above(o, k, (double)price[i], 0, o->water - line->weight[kind]);
}

/* Prices what is alive anew, exactly. */
static bool price_by(sp_tuples *o, const sp_prices *u, const uint8_t *alive, float *price, sp_error *error)
{
    o->rest[o->priced++] = o->cover->base + sp_cover_rest(o->cover, u);
    return o->line->price(o->line->user, u, alive, price, error);
}

/* Prices between the first two: what holds for both does for these, and the best completions by one need not be those
 * by the other. */
static void mix(sp_tuples *o, float *const price[BY_PRICES])
{
    for (; o->priced < BY_PRICES; o->priced++) {
        double part = (double)(o->priced - 1) / (BY_PRICES - 1);
        o->rest[o->priced] = part * o->rest[0] + (1 - part) * o->rest[1];
        for (size_t i = 0; i < o->line->count; i++) {
            double mean = part * (double)price[0][i] + (1 - part) * (double)price[1][i];
            price[o->priced][i] = nextafterf((float)mean, INFINITY);
        }
    }
}

/* The candidates that the prices left. */
static bool list_items(sp_tuples *o, const uint8_t *alive, float *const price[BY_PRICES], sp_error *error)
{
    const sp_line *line = o->line;
    for (size_t r = 0; r < line->run_count; r++) {
        size_t kind = sp_line_kind(line, line->run_start[r]);
        for (size_t i = line->run_start[r]; i < line->run_start[r + 1]; i++) {
            if (!alive[i])
                continue;
            if (!sp_grow(&o->items, &o->capacity, o->count + 1, sizeof *o->items))
                return sp_fail_memory(error);
            item *own = &o->items[o->count++];
            *own = (item){.position = i,
                          .kind = kind,
                          .weight = line->weight[kind],
                          .set = NO_SET,
                          .port = line->run_port[r],
                          .above = INFINITY};
            for (size_t k = 0; k < o->priced; k++) {
                own->price[k] = price[k][i];
                own->above = fminf(own->above, nextafterf((float)above_by(o, k, (double)price[k][i], kind), INFINITY));
            }
        }
    }
    return true;
}

/* Shuts out by all prices what could not be part of a layout above the target. */
static void sift(sp_tuples *o, uint8_t *alive, float *const price[BY_PRICES])
{
    for (int round = 0; round < SIFTED; round++)
        for (size_t k = 0; k < o->priced; k++) {
            for (size_t i = 0; i < o->line->count; i++)
                price[k][i] = alive[i] ? price[k][i] : 0;
            fill_prices(o, k, price[k]);
            shut_out(o, k, price[k], alive);
        }
    for (size_t k = 0; k < o->priced; k++)
        fill_prices(o, k, price[k]);
}

/* Raises the floor until no more candidates than may be are left by prices as they were found; `above` [positions] is
 * overwritten. */
static void raise_floor(sp_tuples *o, const float *found, float *above)
{
    const sp_line *line = o->line;
    for (size_t kind = 0; kind < line->kind_count; kind++)
        for (size_t i = line->kind_start[kind]; i < line->kind_start[kind + 1]; i++)
            above[i] = line->weight[kind] > o->water ? 0 : (float)above_by(o, 0, (double)found[i], kind);
    o->target = target_for(o, o->most, above, line->count);
}

/* What is left by prices as they were found, then by all. */
static bool price_items(sp_tuples *o, const sp_prices *u, const float *found, uint8_t *alive,
                        float *const price[BY_PRICES], sp_error *error)
{
    sp_prices areas = {0};
    bool done = sp_prices_create(o->cover, &areas, error);
    /* lifts hold for no more nozzles than they were made for */
    bool holds = !u->lifts || o->water / o->lightest <= u->lifts->nozzles || o->cover->nozzles <= u->lifts->nozzles;
    if (done && holds) {
        o->rest[0] = o->cover->base + sp_cover_rest(o->cover, u);
        fill_prices(o, 0, found);
        raise_floor(o, found, price[0]);
        shut_out(o, 0, found, alive);
        done = price_by(o, u, alive, price[0], error);
    }
    done = done && price_by(o, &areas, alive, price[o->priced], error);
    sp_prices_free(&areas);
    if (!done || !sp_cover_goes_on(o->cover))
        return done;
    if (holds)
        mix(o, price);
    o->least = o->target;
    sift(o, alive, price);
    return list_items(o, alive, price, error);
}

static bool find_items(sp_tuples *o, const sp_prices *u, const float *found, sp_error *error)
{
    size_t positions = o->line->count + 1;
    uint8_t *alive = malloc(positions);
    float *price[BY_PRICES];
    bool done = alive != NULL;
    for (size_t k = 0; k < BY_PRICES; k++) {
        price[k] = calloc(positions, sizeof *price[k]);
        done &= price[k] != NULL;
    }
    if (done)
        memset(alive, 1, positions);
    done = (done || sp_fail_memory(error)) && price_items(o, u, found, alive, price, error);
    free(alive);
    for (size_t k = 0; k < BY_PRICES; k++)
        free(price[k]);
    return done;
}

sp_tuples *sp_tuples_create(const sp_cover *cover, const sp_line *line, const sp_tuple_task *task, sp_error *error)
{
    sp_tuples *o = calloc(1, sizeof *o);
    if (!o) {
        sp_fail_memory(error);
        return NULL;
    }
    *o = (sp_tuples){.cover = cover,
                     .line = line,
                     .water = task->water,
                     .most = task->most,
                     .floor = task->floor,
                     .bound = fmax(task->bound, task->floor),
                     .target = task->floor};
    size_t water = task->water;
    o->lightest = line->kind_count ? line->weight[line->kind_count - 1] : 0;
    if (!o->lightest || water / o->lightest > STEPS_MOST)
        return o;
    o->unit = (uint32_t)fmax(1, fmin(o->lightest, ceil((double)water / STEPS_LEAST)));
    if (water / o->unit > STEPS_MOST)
        return o;
    o->steps = water / o->unit;
    bool done = true;
    for (size_t k = 0; k < BY_PRICES; k++) {
        o->most_priced[k] = malloc(line->kind_count * (o->steps + 1) * sizeof(double));
        done &= o->most_priced[k] != NULL;
    }
    done = done || sp_fail_memory(error);
    if (done && find_items(o, task->u, task->price, error) && sp_bit_rows_create(cover, &o->sets, error))
        return o;
    sp_tuples_destroy(o);
    return NULL;
}

void sp_tuples_destroy(sp_tuples *o)
{
    if (!o)
        return;
    for (size_t k = 0; k < BY_PRICES; k++)
        free(o->most_priced[k]);
    free(o->items);
    free(o->able);
    free(o->found);
    sp_bit_rows_free(&o->sets);
    free(o);
}

/* The rows of those able, from `first` on, that have no sets yet. */
static bool find_rows(const sp_tuples *o, size_t first, size_t end, sp_rows *rows, sp_error *error)
{
    sp_error failure = {0};
    int threads = o->line->threads;
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1)
    for (size_t i = first; i < end; i++) {
        const item *own = &o->items[o->able[i]];
        sp_rows *row = &rows[i - first];
        sp_error mine = {0};
        row->count = row->used = 0;
        if (own->set == NO_SET && !o->line->row(o->line->user, own->position, row, &mine)) {
#pragma omp critical(sp_tuples_rows)
            failure = mine;
        }
    }
    return failure.kind == SP_OK ||
           sp_fail(error, failure.kind, failure.file, failure.line, failure.column, "%s", failure.message);
}

/* The sets of these rows. */
static bool add_sets(sp_tuples *o, size_t first, size_t end, const sp_rows *rows, const uint64_t *none, sp_error *error)
{
    for (size_t i = first; i < end; i++) {
        item *own = &o->items[o->able[i]];
        double least = SHARE_LEAST * (double)own->weight / (double)o->water;
        if (own->set != NO_SET)
            continue;
        if (!sp_bit_rows_add(&o->sets, o->cover, &rows[i - first], 0, least, error))
            return false;
        own->set = (uint32_t)(o->sets.count - 1);
        own->alone = (sp_bit_rows_gain(&o->sets, own->set, none) + o->sets.edge[own->set]) * UPWARDS;
    }
    o->over = sp_bit_rows_bytes(&o->sets) > BYTES_MOST;
    return true;
}

static bool build_sets(sp_tuples *o, sp_error *error)
{
    uint64_t *none = calloc(o->sets.words + 1, sizeof *none);
    sp_rows *rows = calloc(ROWS_AT_A_TIME, sizeof *rows);
    bool done = (none && rows) || sp_fail_memory(error);
    for (size_t i = 0; done && i < o->able_count && !o->over && sp_cover_goes_on(o->cover); i += ROWS_AT_A_TIME) {
        size_t end = i + ROWS_AT_A_TIME < o->able_count ? i + ROWS_AT_A_TIME : o->able_count;
        done = find_rows(o, i, end, rows, error) && add_sets(o, i, end, rows, none, error);
    }
    for (size_t i = 0; rows && i < ROWS_AT_A_TIME; i++)
        sp_rows_free(&rows[i]);
    free(rows);
    free(none);
    return done;
}

/* Lists what could be part of a layout above the target, sets built. */
static bool list_able(sp_tuples *o, sp_error *error)
{
    static const double none[BY_PRICES] = {0};
    free(o->able);
    o->able = malloc((o->count + 1) * sizeof *o->able);
    o->able_count = 0;
    for (size_t i = 0; o->able && i < o->count; i++) {
        const item *own = &o->items[i];
        if (all_above(o, none, own->price, 0, o->water - own->weight)) {
            o->able[o->able_count++] = (uint32_t)i;
            o->work += own->set == NO_SET ? WORK_ROW : 0;
        }
    }
    o->over = o->work > o->work_most;
    if (!o->able)
        return sp_fail_memory(error);
    return build_sets(o, error);
}

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
    return area * UPWARDS;
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

/* Orders a level's entries, which stand by kinds, and finds what they could add together. */
static void settle(const sp_tuples *o, level *at)
{
    const double *lighter = NULL;
    size_t first = 0;
    for (size_t k = 0; k < o->line->kind_count; k++) {
        size_t end = first;
        while (end < at->count && o->items[at->entries[end].at].kind == k)
            end++;
        sp_rank_falling(at->entries + first, end - first);
        at->end[k] = first = end;
    }
    for (size_t k = o->line->kind_count; k-- > 0;) {
        size_t start = k ? at->end[k - 1] : 0;
        double *most = of_kind(o, at->most, k);
        fill_kind(o, k, at->end[k] > start ? at->entries[start].merit : 0, lighter, most);
        lighter = most;
    }
}

/* Draws the next level from the entries of one from the chosen one on: those that could join it. */
static void list_joining(worker *own, size_t depth, size_t first, double covered, const double *priced, size_t water)
{
    const sp_tuples *o = own->all;
    const level *from = &own->levels[depth];
    level *to = &own->levels[depth + 1];
    const item *chosen = &o->items[from->entries[first].at];
    const uint64_t *bits = o->sets.bits + chosen->set * o->sets.words;
    const double *most = of_kind(o, from->most, chosen->kind);
    size_t swept = 0, passed = 0;
    for (size_t w = 0; w < o->sets.words; w++)
        to->had[w] = from->had[w] | bits[w];
    to->count = 0;
    for (size_t i = first + (chosen->port != SP_NO_PORT || !o->cover->repeats); i < from->count; i++) {
        const item *other = &o->items[from->entries[i].at];
        passed++;
        if (other->weight > water) {
            i = from->end[other->kind] - 1;
            continue;
        }
        double others = most[(water - other->weight) / o->unit];
        if (covered + from->entries[i].merit + others <= o->target) {
            i = from->end[other->kind] - 1;
            continue;
        }
        if ((other->port == chosen->port && other->port != SP_NO_PORT) ||
            !all_above(o, priced, other->price, chosen->kind, water - other->weight))
            continue;
        double gain = (sp_bit_rows_gain(&o->sets, other->set, to->had) + o->sets.edge[other->set]) * UPWARDS;
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
    const item *one = &o->items[at->entries[i].at];
    double now = (covered + at->entries[i].merit) * UPWARDS;
    size_t left = water - one->weight;
    if (now + of_kind(o, at->most, one->kind)[left / o->unit] <= o->target)
        return false;
    if (!all_above(o, priced, one->price, one->kind, left))
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
    double with[BY_PRICES] = {0};
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
    size_t deep = o->water / o->lightest, kinds = o->line->kind_count;
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

/* Every layout, by the first of its nozzles. */
static bool enumerate(sp_tuples *o, sp_error *error)
{
    static const double none[BY_PRICES] = {0};
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

/* What a layout brings to every texel: shares in all, and the part that edges leave dry. */
typedef struct {
    double *sum, *dry; /* [texels] */
    double area;       /* m² that it covers, base included */
} brought;

static double covered_of(double sum, double dry)
{
    return sum >= 1 ? 1 : 1 - dry;
}

/* Adds a nozzle to what a layout brings; to->sum NULL: only the area. */
static bool bring(const sp_tuples *o, uint32_t one, const brought *from, brought *to, sp_error *error)
{
    sp_rows row = {0};
    size_t texels = o->cover->texel_count;
    if (!o->line->row(o->line->user, o->items[one].position, &row, error)) {
        sp_rows_free(&row);
        return false;
    }
    if (to->sum) {
        memcpy(to->sum, from->sum, texels * sizeof *to->sum);
        memcpy(to->dry, from->dry, texels * sizeof *to->dry);
    }
    to->area = from->area;
    for (size_t k = 0, end; k < row.used; k = end) {
        uint32_t t = row.texel[k];
        double sum = from->sum[t], dry = from->dry[t], before = covered_of(sum, dry);
        /* where a spray ends within a texel it has two entries */
        for (end = k; end < row.used && row.texel[end] == t; end++)
            if (row.share[end] > 0)
                sum += (double)row.share[end] * SHARE_UPWARDS;
            else
                dry *= 1 + (double)row.share[end];
        to->area += (covered_of(sum, dry) - before) * (double)o->cover->area[t];
        if (to->sum) {
            to->sum[t] = sum;
            to->dry[t] = dry;
        }
    }
    sp_rows_free(&row);
    return true;
}

static int by_items(const void *a, const void *b)
{
    const tuple *p = a, *q = b;
    for (size_t i = 0; i < p->count && i < q->count; i++)
        if (p->item[i] != q->item[i])
            return p->item[i] < q->item[i] ? -1 : 1;
    return (p->count > q->count) - (p->count < q->count);
}

/* What the layouts found cover, exactly, but where a texel may be covered in several ways: then no less. Those that
 * begin with the same nozzles stand together. */
static bool check(sp_tuples *o, brought *kept, double *most, sp_error *error)
{
    const tuple *last = NULL;
    if (o->found_count)
        qsort(o->found, o->found_count, sizeof *o->found, by_items);
    for (size_t i = 0; i < o->found_count && (i % CHECKED_AT_A_TIME || sp_cover_goes_on(o->cover)); i++) {
        const tuple *now = &o->found[i];
        size_t same = 0;
        brought whole = {NULL, NULL, 0};
        while (last && same + 1 < last->count && same + 1 < now->count && last->item[same] == now->item[same])
            same++;
        for (size_t d = same; d + 1 < now->count; d++)
            if (!bring(o, now->item[d], &kept[d], &kept[d + 1], error))
                return false;
        if (!bring(o, now->item[now->count - 1], &kept[now->count - 1], &whole, error))
            return false;
        *most = fmax(*most, whole.area * SHARE_UPWARDS);
        last = now;
    }
    return true;
}

static bool check_found(sp_tuples *o, double *most, sp_error *error)
{
    size_t texels = o->cover->texel_count;
    brought kept[DEEP_MOST] = {{NULL, NULL, 0}};
    bool done = true;
    for (size_t d = 0; d < DEEP_MOST; d++) {
        kept[d] = (brought){calloc(texels + 1, sizeof(double)), malloc((texels + 1) * sizeof(double)), o->cover->base};
        done &= kept[d].sum && kept[d].dry;
    }
    for (size_t t = 0; done && t < texels; t++)
        kept[0].dry[t] = 1;
    done = (done || sp_fail_memory(error)) && check(o, kept, most, error);
    for (size_t d = 0; d < DEEP_MOST; d++) {
        free(kept[d].sum);
        free(kept[d].dry);
    }
    return done;
}

double sp_tuples_target(const sp_tuples *o, size_t candidates)
{
    float *above = malloc((o->count + 1) * sizeof *above);
    double target = o->bound;
    for (size_t i = 0; above && i < o->count; i++)
        above[i] = o->items[i].above;
    if (above && o->steps)
        target = fmax(o->least, target_for(o, candidates, above, o->count));
    free(above);
    return target;
}

bool sp_tuples_bound(sp_tuples *o, double target, double work_most, sp_tuple_answer *answer, sp_error *error)
{
    *answer = (sp_tuple_answer){.bound = target};
    if (!o->steps || target < o->least)
        return true;
    o->target = target;
    o->work = 0;
    o->work_most = work_most;
    o->over = false;
    o->found_count = 0;
    bool done = list_able(o, error), begun = !o->over;
    done = done && (!begun || enumerate(o, error)) && (o->over || check_found(o, &answer->bound, error));
    answer->complete = done && !o->over && sp_cover_goes_on(o->cover);
    /* what was done of what is broken off depends on threads: all that it might have been counts */
    answer->work = answer->complete ? o->work : begun ? work_most : 0;
    return done;
}
