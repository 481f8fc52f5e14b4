#include "bound/tuples_work.h"

#include "mesh/grow.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TARGETS 1000 /* that are told apart */
#define SIFTED 3     /* times by all of them, as what is shut out lowers what others could add */

void sp_tuples_fill_kind(const sp_tuples *o, size_t kind, double best, const double *lighter, double *most)
{
    size_t own = o->list->weight[kind] / o->unit;
    assert(own > 0); /* a candidate takes a step at least, or would be counted once for any number */
    for (size_t s = 0; s <= o->steps; s++)
        most[s] = lighter ? lighter[s] : 0;
    for (size_t s = own; best > 0 && s <= o->steps; s++)
        most[s] = fmax(most[s], best + most[s - own]);
}

double *sp_tuples_of_kind(const sp_tuples *o, double *tables, size_t kind)
{
    return tables + kind * (o->steps + 1);
}

/* What candidates could add to the sums of prices by the k-th multipliers: the best of each kind, whose prices are
 * price[kind_start[kind]] to price[kind_start[kind + 1] - 1]. */
static void fill_prices(sp_tuples *o, size_t k, const size_t *kind_start, const float *price)
{
    const sp_candidate_list *list = o->list;
    const double *lighter = NULL;
    for (size_t kind = list->kind_count; kind-- > 0;) {
        float best = 0;
        double *most = sp_tuples_of_kind(o, o->most_priced[k], kind);
        size_t end = list->weight[kind] <= o->water ? kind_start[kind + 1] : 0;
        for (size_t i = kind_start[kind]; i < end; i++)
            best = price[i] > best ? price[i] : best;
        sp_tuples_fill_kind(o, kind, (double)best, lighter, most);
        lighter = most;
    }
}

/* Could a layout that holds candidates worth so much by the k-th multipliers, and others of the kind and lighter in so
 * much water, come above the target? */
static bool priced_above(const sp_tuples *o, size_t k, double priced, size_t kind, size_t water)
{
    double most = o->most_priced[k][kind * (o->steps + 1) + water / o->unit];
    return (o->rest[k] + priced + most) * SP_UPWARDS_SETS > o->target;
}

bool sp_tuples_all_above(const sp_tuples *o, const double *priced, const float *more, size_t kind, size_t water)
{
    bool above = true;
    for (size_t k = 0; k < o->priced; k++)
        above &= priced_above(o, k, priced[k] + (double)more[k], kind, water);
    return above;
}

/* The highest target that a candidate could be part of a layout above, by the k-th multipliers. */
static double above_by(const sp_tuples *o, size_t k, double price, size_t kind)
{
    return (o->rest[k] + price + o->most_priced[k][(o->water - o->list->weight[kind]) / o->unit]) * SP_UPWARDS_SETS;
}

double sp_tuples_target_for(const sp_tuples *o, size_t most, const float *above, size_t count)
{
    size_t over[TARGETS + 1] = {0}, sum = 0, i = TARGETS;
    double step = (o->bound - o->floor) / TARGETS;
    for (size_t k = 0; k < count && step > 0; k++)
        over[(size_t)fmin(TARGETS, fmax(0, ceil(((double)above[k] - o->floor) / step)))]++;
    for (; i > 0 && (sum += over[i]) <= most; i--)
        ;
    return o->floor + (double)i * step;
}

/* Leaves alive what the k-th multipliers do, kind by kind as in fill_prices. */
static void shut_out(const sp_tuples *o, size_t k, const size_t *kind_start, const float *price, uint8_t *alive)
{
    const sp_candidate_list *list = o->list;
    for (size_t kind = 0; kind < list->kind_count; kind++) {
        bool fits = list->weight[kind] <= o->water;
        size_t left = fits ? o->water - list->weight[kind] : 0;
        for (size_t i = kind_start[kind]; i < kind_start[kind + 1]; i++)
            alive[i] &= fits && priced_above(o, k, (double)price[i], 0, left);
    }
}

/* Raises the floor until no more candidates than may be are left by prices as they were found; `above` [positions] is
 * overwritten. */
static void raise_floor(sp_tuples *o, const float *found, float *above)
{
    const sp_candidate_list *list = o->list;
    for (size_t kind = 0; kind < list->kind_count; kind++)
        for (size_t i = list->kind_start[kind]; i < list->kind_start[kind + 1]; i++)
            above[i] = list->weight[kind] > o->water ? 0 : (float)above_by(o, 0, (double)found[i], kind);
    o->target = sp_tuples_target_for(o, o->most, above, list->count);
}

/* The candidates that prices as they were found left, which are few, and what they are worth by all multipliers. */
typedef struct {
    size_t count;
    size_t *position;             /* [count], rising */
    size_t *kind_start;           /* [kind_count + 1] */
    uint8_t *alive;               /* [count] */
    float *price[BY_MULTIPLIERS]; /* [count] */
} remaining;

static void remaining_free(remaining *left)
{
    free(left->position);
    free(left->kind_start);
    free(left->alive);
    for (size_t k = 0; k < BY_MULTIPLIERS; k++)
        free(left->price[k]);
}

static bool remaining_create(const sp_candidate_list *list, const uint8_t *alive, remaining *left, sp_error *error)
{
    size_t count = 0;
    for (size_t i = 0; i < list->count; i++)
        count += alive[i];
    left->position = malloc((count + 1) * sizeof *left->position);
    left->kind_start = malloc((list->kind_count + 1) * sizeof *left->kind_start);
    left->alive = malloc(count + 1);
    bool done = left->position && left->kind_start && left->alive;
    for (size_t k = 0; k < BY_MULTIPLIERS; k++) {
        left->price[k] = malloc((count + 1) * sizeof *left->price[k]);
        done &= left->price[k] != NULL;
    }
    for (size_t kind = 0; done && kind < list->kind_count; kind++) {
        left->kind_start[kind] = left->count;
        for (size_t i = list->kind_start[kind]; i < list->kind_start[kind + 1]; i++)
            if (alive[i])
                left->position[left->count++] = i;
    }
    if (!done)
        return sp_fail_memory(error);
    assert(left->count == count);
    left->kind_start[list->kind_count] = count;
    memset(left->alive, 1, count);
    return true;
}

/* Prices what is left exactly; `price` [positions] is overwritten. */
static bool price_by(sp_tuples *o, const sp_multipliers *u, const uint8_t *alive, remaining *left, float *price,
                     sp_error *error)
{
    size_t k = o->priced++;
    assert(k < BY_MULTIPLIERS);
    o->rest[k] = o->cover->base + sp_cover_rest(o->cover, u);
    if (!o->list->price(o->list->user, u, alive, price, error))
        return false;
    for (size_t i = 0; i < left->count; i++)
        left->price[k][i] = price[left->position[i]];
    return true;
}

/* Multipliers between the first two: what holds for both does for these, and the best completions by one need not be
 * those by the other. */
static void mix(sp_tuples *o, remaining *left)
{
    for (; o->priced < BY_MULTIPLIERS; o->priced++) {
        double part = (double)(o->priced - 1) / (BY_MULTIPLIERS - 1);
        o->rest[o->priced] = part * o->rest[0] + (1 - part) * o->rest[1];
        for (size_t i = 0; i < left->count; i++) {
            double mean = part * (double)left->price[0][i] + (1 - part) * (double)left->price[1][i];
            left->price[o->priced][i] = nextafterf((float)mean, INFINITY);
        }
    }
}

/* Shuts out by all multipliers what could not be part of a layout above the target. */
static void sift(sp_tuples *o, remaining *left)
{
    for (int round = 0; round < SIFTED; round++)
        for (size_t k = 0; k < o->priced; k++) {
            for (size_t i = 0; i < left->count; i++)
                left->price[k][i] = left->alive[i] ? left->price[k][i] : 0;
            fill_prices(o, k, left->kind_start, left->price[k]);
            shut_out(o, k, left->kind_start, left->price[k], left->alive);
        }
    for (size_t k = 0; k < o->priced; k++)
        fill_prices(o, k, left->kind_start, left->price[k]);
}

/* The candidates that the multipliers left. */
static bool list_items(sp_tuples *o, const remaining *left, sp_error *error)
{
    const sp_candidate_list *list = o->list;
    for (size_t i = 0; i < left->count; i++) {
        if (!left->alive[i])
            continue;
        size_t position = left->position[i], kind = sp_candidate_list_kind(list, position);
        if (!sp_grow(&o->items, &o->capacity, o->count + 1, sizeof *o->items))
            return sp_fail_memory(error);
        sp_tuple_item *own = &o->items[o->count++];
        *own = (sp_tuple_item){.position = position,
                               .kind = kind,
                               .weight = list->weight[kind],
                               .set = NO_SET,
                               .port = list->run_port[sp_candidate_list_run(list, position)],
                               .above = INFINITY};
        for (size_t k = 0; k < o->priced; k++) {
            double price = (double)left->price[k][i];
            own->price[k] = left->price[k][i];
            own->above = fminf(own->above, nextafterf((float)above_by(o, k, price, kind), INFINITY));
        }
    }
    return true;
}

/* What is left, priced by the multipliers where they hold, by the areas, and by what lies between. */
static bool price_left(sp_tuples *o, const sp_multipliers *u, const uint8_t *alive, float *price, sp_error *error)
{
    sp_multipliers areas = {0};
    remaining left = {0};
    bool done = sp_multipliers_create(o->cover, &areas, error) && remaining_create(o->list, alive, &left, error) &&
                (!u || price_by(o, u, alive, &left, price, error)) && price_by(o, &areas, alive, &left, price, error);
    if (done && sp_cover_goes_on(o->cover)) {
        if (u)
            mix(o, &left);
        o->least = o->target;
        sift(o, &left);
        done = list_items(o, &left, error);
    }
    sp_multipliers_free(&areas);
    remaining_free(&left);
    return done;
}

bool sp_tuples_find_items(sp_tuples *o, const sp_multipliers *u, const float *found, sp_error *error)
{
    const sp_candidate_list *list = o->list;
    /* inequalities hold for no more nozzles than they were made for */
    bool holds = !u->inequalities || o->water / o->lightest <= u->inequalities->nozzles ||
                 o->cover->nozzles <= u->inequalities->nozzles;
    uint8_t *alive = malloc(list->count + 1);
    float *price = calloc(list->count + 1, sizeof *price);
    bool done = (alive && price) || sp_fail_memory(error);
    if (done)
        memset(alive, 1, list->count);
    if (done && holds) {
        o->rest[0] = o->cover->base + sp_cover_rest(o->cover, u);
        fill_prices(o, 0, list->kind_start, found);
        raise_floor(o, found, price);
        shut_out(o, 0, list->kind_start, found, alive);
    }
    done = done && price_left(o, holds ? u : NULL, alive, price, error);
    free(alive);
    free(price);
    return done;
}
