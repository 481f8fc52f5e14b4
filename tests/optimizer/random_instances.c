/* The gap between bound and a layout found by greedy, exchange and kicks, on random instances of a size that matters.
 * With arguments CANDIDATES EDGE ROUNDS KICKS it only measures that size: rounds of the bound, kicks of the search. */
#include "stored.h"

#include <stdio.h>
#include <time.h>

#define NOZZLES 12
#define WATER 120
#define SEED 88172645463325252u
#ifdef SPRAYPLAN_SANITIZE
#define CANDIDATES 300
#define EDGE 50
#define KICKS 2
#else
#define CANDIDATES 2000
#define EDGE 141
#define KICKS 20
#endif
#define ROUNDS 6
#define LOOKED_AT 64 /* candidates of those that a sample of their texels promises most of */
#define SAMPLE 3000  /* texels of a candidate, about */

typedef struct {
    const instance *in;
    float *wet;
    double *gain; /* [candidates] */
    size_t chosen[NOZZLES], count, water;
} layout;

static double seconds(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static void put(layout *l, size_t row, float sign)
{
    const sp_rows *rows = &l->in->rows;
    for (size_t i = rows->start[row]; i < rows->start[row + 1]; i++)
        l->wet[rows->texel[i]] += sign * rows->share[i];
    l->water += sign > 0 ? l->in->weight[rows->tier[row]] : -(size_t)l->in->weight[rows->tier[row]];
}

/* Shares that have come and gone leave rounding behind. */
static bool is_wet(float wet)
{
    return wet >= 1 - 1e-5f;
}

static double covered(const layout *l)
{
    double area = 0;
    for (size_t t = 0; t < l->in->cover.texel_count; t++)
        area += is_wet(l->wet[t]) ? (double)l->in->area[t] : 0;
    return area;
}

/* What every stride-th texel of a row, from the first on, adds; `credit` for what is on the way. */
static double gain_of(const layout *l, size_t row, double credit, size_t stride)
{
    const sp_rows *rows = &l->in->rows;
    double gain = 0;
    for (size_t i = rows->start[row]; i < rows->start[row + 1]; i += stride) {
        float had = l->wet[rows->texel[i]], has = had + rows->share[i];
        if (!is_wet(had))
            gain += (double)l->in->area[rows->texel[i]] * (is_wet(has) ? 1 : credit * (double)rows->share[i]);
    }
    return gain * (double)stride;
}

/* The candidate of most gain, per water to the given power, of those that a sample promises most of. */
static size_t best_row(layout *l, double credit, double power, double *most)
{
    const sp_rows *rows = &l->in->rows;
    size_t stride = rows->used / (rows->count * SAMPLE) + 1, best = 0;
    for (size_t c = 0; c < rows->count; c++) {
        bool fits = l->water + l->in->weight[rows->tier[c]] <= WATER;
        l->gain[c] = fits ? gain_of(l, c, credit, stride) / pow(l->in->weight[rows->tier[c]], power) : -1;
    }
    *most = -1;
    for (size_t looked = 0; looked < (stride > 1 ? LOOKED_AT : 1); looked++) {
        size_t next = 0;
        for (size_t c = 1; c < rows->count; c++)
            if (l->gain[c] > l->gain[next])
                next = c;
        if (l->gain[next] < 0)
            break;
        double gain = gain_of(l, next, credit, 1) / pow(l->in->weight[rows->tier[next]], power);
        l->gain[next] = -1;
        if (gain > *most) {
            *most = gain;
            best = next;
        }
    }
    return best;
}

static void fill(layout *l, double credit, double power)
{
    double most;
    while (l->count < NOZZLES) {
        size_t best = best_row(l, credit, power, &most);
        if (most <= 0)
            break;
        put(l, best, 1);
        l->chosen[l->count++] = best;
    }
}

/* Single exchanges until none helps; the area covered. */
static double exchange(layout *l)
{
    double most, area = covered(l);
    for (bool better = true; better;) {
        better = false;
        for (size_t k = 0; k < l->count; k++) {
            size_t before = l->chosen[k];
            put(l, before, -1);
            double without = covered(l);
            size_t best = best_row(l, 0, 0, &most);
            bool gains = without + most > area + 1e-9;
            l->chosen[k] = gains ? best : before;
            put(l, l->chosen[k], 1);
            better |= gains;
            area = gains ? without + most : area;
        }
    }
    return area;
}

/* Takes one to three nozzles out, fills up by some measure of gain, exchanges; stays where that is no worse. */
static double kick(layout *l, double area, uint64_t *seed)
{
    size_t chosen[NOZZLES], count = l->count, drop = 1 + (size_t)(3 * instance_random(seed));
    double power = instance_random(seed), credit = 0.5 * instance_random(seed);
    memcpy(chosen, l->chosen, sizeof chosen);
    for (; drop && l->count; drop--) {
        size_t k = (size_t)((double)l->count * instance_random(seed));
        put(l, l->chosen[k], -1);
        l->chosen[k] = l->chosen[--l->count];
    }
    if (instance_random(seed) < 0.5) {
        size_t any = (size_t)((double)l->in->rows.count * instance_random(seed));
        if (l->count < NOZZLES && l->water + l->in->weight[l->in->rows.tier[any]] <= WATER) {
            put(l, any, 1);
            l->chosen[l->count++] = any;
        }
    }
    fill(l, credit, power);
    double now = exchange(l);
    if (now >= area)
        return now;
    while (l->count)
        put(l, l->chosen[--l->count], -1);
    for (; l->count < count; l->count++)
        put(l, l->chosen[l->count] = chosen[l->count], 1);
    return area;
}

/* `kicks` of them, after the best of three starts. */
static double best_found(const instance *in, size_t kicks)
{
    static const double powers[] = {1, 0.5, 0};
    layout best = {0};
    double area = -1;
    uint64_t seed = 99;
    for (int i = 0; i < (kicks ? 3 : 1); i++) {
        layout l = {.in = in};
        l.wet = calloc(in->cover.texel_count, sizeof *l.wet);
        l.gain = malloc(in->rows.count * sizeof *l.gain);
        fill(&l, 0.2, powers[i]);
        double now = exchange(&l);
        layout worse = now > area ? best : l;
        best = now > area ? l : best;
        area = fmax(area, now);
        free(worse.wet);
        free(worse.gain);
    }
    for (size_t k = 0; k < kicks; k++)
        area = kick(&best, area, &seed);
    free(best.wet);
    free(best.gain);
    return area;
}

typedef struct {
    size_t candidates, edge, rounds, kicks;
} effort;

static double measure(effort e, bool single, double plenty)
{
    instance in;
    sp_error error = {0};
    instance_create(&in, e.candidates, e.edge, single, NOZZLES, WATER, 0, plenty, SEED);
    in.cover.threads = 2;
    double start = seconds(), found = best_found(&in, e.kicks), searched = seconds();
    stored all = {&in.cover, &in.rows, 300};
    sp_pricer pricer = stored_pricer(&all);
    sp_bound bound;
    assert_true(sp_bound_create(&in.cover, &pricer, &bound, &error));
    for (size_t round = 0; round < e.rounds; round++)
        assert_true(sp_bound_lower(&bound, WATER, &error));
    double area = bound.by_water[WATER], bounded = seconds();
    print_message(
        "%zu candidates, %zu texels, %s, plenty %g: found %.4f in %.1f s; bound %.4f in %.1f s, gap %.2f %%\n",
        e.candidates, e.edge * e.edge, single ? "single" : "sum", plenty, found, searched - start, area,
        bounded - searched, 100 * (1 - found / area));
    assert_true(area >= found);
    sp_bound_free(&bound);
    instance_free(&in);
    return 1 - found / area;
}

static const effort usual = {CANDIDATES, EDGE, ROUNDS, KICKS};

static void one_nozzle_alone(void **state)
{
    (void)state;
    assert_true(measure(usual, true, 1) <= 0.05);
}

static void all_together(void **state)
{
    (void)state;
    assert_true(measure(usual, false, 1) <= 0.15);
}

int main(int count, char **arguments)
{
    if (count == 5) {
        effort e;
        size_t *const values[] = {&e.candidates, &e.edge, &e.rounds, &e.kicks};
        for (int i = 0; i < 4; i++)
            *values[i] = strtoul(arguments[i + 1], NULL, 10);
        for (int single = 0; single < 2; single++)
            for (int plenty = 0; plenty < 2; plenty++)
                measure(e, single, plenty ? 1 : 0.33);
        return 0;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_nozzle_alone),
        cmocka_unit_test(all_together),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
