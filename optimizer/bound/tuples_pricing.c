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

/* What candidates could add to the sums of prices by the k-th multipliers, `price` by position: the best of each kind.
 */
static void fill_prices(sp_tuples *o, size_t k, const float *price)
{
    const sp_candidate_list *list = o->list;
    const double *lighter = NULL;
    for (size_t kind = list->kind_count; kind-- > 0;) {
        float best = 0;
        double *most = sp_tuples_of_kind(o, o->most_priced[k], kind);
        size_t end = list->weight[kind] <= o->water ? list->kind_start[kind + 1] : 0;
#pragma omp parallel for num_threads(list->threads) reduction(max : best)
        for (size_t i = list->kind_start[kind]; i < end; i++)
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
    return (o->rest[k] + priced + most) * UPWARDS > o->target;
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
    return (o->rest[k] + price + o->most_priced[k][(o->water - o->list->weight[kind]) / o->unit]) * UPWARDS;
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

/* Leaves alive what the k-th multipliers do. */
static void shut_out(const sp_tuples *o, size_t k, const float *price, uint8_t *alive)
{
    const sp_candidate_list *list = o->list;
    for (size_t kind = 0; kind < list->kind_count; kind++) {
        bool fits = list->weight[kind] <= o->water;
        size_t left = fits ? o->water - list->weight[kind] : 0;
#pragma omp parallel for num_threads(list->threads)
        for (size_t i = list->kind_start[kind]; i < list->kind_start[kind + 1]; i++)
            alive[i] &= fits && priced_above(o, k, (double)price[i], 0, left);
    }
}

/* Prices what is alive anew, exactly. */
static bool price_by(sp_tuples *o, const sp_multipliers *u, const uint8_t *alive, float *price, sp_error *error)
{
    assert(o->priced < BY_MULTIPLIERS);
    o->rest[o->priced++] = o->cover->base + sp_cover_rest(o->cover, u);
    return o->list->price(o->list->user, u, alive, price, error);
}

/* Multipliers between the first two: what holds for both does for these, and the best completions by one need not be
 * those by the other. */
static void mix(sp_tuples *o, float *const price[BY_MULTIPLIERS])
{
    for (; o->priced < BY_MULTIPLIERS; o->priced++) {
        double part = (double)(o->priced - 1) / (BY_MULTIPLIERS - 1);
        o->rest[o->priced] = part * o->rest[0] + (1 - part) * o->rest[1];
#pragma omp parallel for num_threads(o->list->threads)
        for (size_t i = 0; i < o->list->count; i++) {
            double mean = part * (double)price[0][i] + (1 - part) * (double)price[1][i];
            price[o->priced][i] = nextafterf((float)mean, INFINITY);
        }
    }
}

/* The candidates that the multipliers left. */
static bool list_items(sp_tuples *o, const uint8_t *alive, float *const price[BY_MULTIPLIERS], sp_error *error)
{
    const sp_candidate_list *list = o->list;
    for (size_t r = 0; r < list->run_count; r++) {
        size_t kind = sp_candidate_list_kind(list, list->run_start[r]);
        assert(list->run_start[r + 1] <= list->kind_start[kind + 1]);
        for (size_t i = list->run_start[r]; i < list->run_start[r + 1]; i++) {
            if (!alive[i])
                continue;
            if (!sp_grow(&o->items, &o->capacity, o->count + 1, sizeof *o->items))
                return sp_fail_memory(error);
            sp_tuple_item *own = &o->items[o->count++];
            *own = (sp_tuple_item){.position = i,
                                   .kind = kind,
                                   .weight = list->weight[kind],
                                   .set = NO_SET,
                                   .port = list->run_port[r],
                                   .above = INFINITY};
            for (size_t k = 0; k < o->priced; k++) {
                own->price[k] = price[k][i];
                own->above = fminf(own->above, nextafterf((float)above_by(o, k, (double)price[k][i], kind), INFINITY));
            }
        }
    }
    return true;
}

/* Shuts out by all multipliers what could not be part of a layout above the target. */
static void sift(sp_tuples *o, uint8_t *alive, float *const price[BY_MULTIPLIERS])
{
    for (int round = 0; round < SIFTED; round++)
        for (size_t k = 0; k < o->priced; k++) {
#pragma omp parallel for num_threads(o->list->threads)
            for (size_t i = 0; i < o->list->count; i++)
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
    const sp_candidate_list *list = o->list;
    for (size_t kind = 0; kind < list->kind_count; kind++)
#pragma omp parallel for num_threads(list->threads)
        for (size_t i = list->kind_start[kind]; i < list->kind_start[kind + 1]; i++)
            above[i] = list->weight[kind] > o->water ? 0 : (float)above_by(o, 0, (double)found[i], kind);
    o->target = sp_tuples_target_for(o, o->most, above, list->count);
}

/* What is left by prices as they were found, then by all. */
static bool price_items(sp_tuples *o, const sp_multipliers *u, const float *found, uint8_t *alive,
                        float *const price[BY_MULTIPLIERS], sp_error *error)
{
    sp_multipliers areas = {0};
    bool done = sp_multipliers_create(o->cover, &areas, error);
    /* inequalities hold for no more nozzles than they were made for */
    bool holds = !u->inequalities || o->water / o->lightest <= u->inequalities->nozzles ||
                 o->cover->nozzles <= u->inequalities->nozzles;
    if (done && holds) {
        o->rest[0] = o->cover->base + sp_cover_rest(o->cover, u);
        fill_prices(o, 0, found);
        raise_floor(o, found, price[0]);
        shut_out(o, 0, found, alive);
        done = price_by(o, u, alive, price[0], error);
    }
    done = done && price_by(o, &areas, alive, price[o->priced], error);
    sp_multipliers_free(&areas);
    if (!done || !sp_cover_goes_on(o->cover))
        return done;
    if (holds)
        mix(o, price);
    o->least = o->target;
    sift(o, alive, price);
    return list_items(o, alive, price, error);
}

bool sp_tuples_find_items(sp_tuples *o, const sp_multipliers *u, const float *found, sp_error *error)
{
    size_t positions = o->list->count + 1;
    uint8_t *alive = malloc(positions);
    float *price[BY_MULTIPLIERS];
    bool done = alive != NULL;
    for (size_t k = 0; k < BY_MULTIPLIERS; k++) {
        price[k] = calloc(positions, sizeof *price[k]);
        done &= price[k] != NULL;
    }
    if (done)
        memset(alive, 1, positions);
    done = (done || sp_fail_memory(error)) && price_items(o, u, found, alive, price, error);
    free(alive);
    for (size_t k = 0; k < BY_MULTIPLIERS; k++)
        free(price[k]);
    return done;
}
