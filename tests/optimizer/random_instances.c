/* The gap between bound and a layout found by greedy and exchange, on random instances of a size that matters. With
 * arguments CANDIDATES EDGE ROUNDS it only measures that size. */
#include "instance.h"

#include "bound.h"

#include <stdio.h>
#include <time.h>

#define NOZZLES 12
#define WATER 120
#define SEED 88172645463325252u
#ifdef SPRAYPLAN_SANITIZE
#define CANDIDATES 300
#define EDGE 50
#else
#define CANDIDATES 2000
#define EDGE 141
#endif

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

/* The candidate of most gain, per water to the given power; `credit` for what is on the way. */
static size_t best_row(layout *l, double credit, double power, double *most)
{
    const sp_rows *rows = &l->in->rows;

    for (size_t c = 0; c < rows->count; c++) {
        double gain = 0;
        for (size_t i = rows->start[c]; i < rows->start[c + 1]; i++) {
            float had = l->wet[rows->texel[i]], has = had + rows->share[i];
            if (!is_wet(had))
                gain += (double)l->in->area[rows->texel[i]] * (is_wet(has) ? 1 : credit * (double)rows->share[i]);
        }
        bool fits = l->water + l->in->weight[rows->tier[c]] <= WATER;
        l->gain[c] = fits ? gain / pow(l->in->weight[rows->tier[c]], power) : -1;
    }
    size_t best = 0;
    for (size_t c = 1; c < rows->count; c++)
        if (l->gain[c] > l->gain[best])
            best = c;
    *most = l->gain[best];
    return best;
}

/* Greedy, then single exchanges until none helps; the area covered. */
static double find(layout *l, double power)
{
    double most;
    for (l->count = 0; l->count < NOZZLES; l->count++) {
        size_t best = best_row(l, 0.2, power, &most);
        if (most <= 0)
            break;
        put(l, best, 1);
        l->chosen[l->count] = best;
    }
    double area = covered(l);
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

static double best_found(const instance *in)
{
    static const double powers[] = {1, 0.5, 0};
    double best = 0;
    for (int i = 0; i < 3; i++) {
        layout l = {.in = in};
        l.wet = calloc(in->cover.texel_count, sizeof *l.wet);
        l.gain = malloc(in->rows.count * sizeof *l.gain);
        best = fmax(best, find(&l, powers[i]));
        free(l.wet);
        free(l.gain);
    }
    return best;
}

static double measure(size_t candidates, size_t edge, bool single, double plenty, size_t rounds)
{
    instance in;
    sp_error error = {0};
    instance_create(&in, candidates, edge, single, NOZZLES, WATER, 0, plenty, SEED);
    in.cover.threads = 2;
    double start = seconds(), found = best_found(&in), searched = seconds();
    sp_stored stored = {&in.cover, &in.rows, 300};
    sp_pricer pricer = sp_stored_pricer(&stored);
    sp_bound bound;
    assert_true(sp_bound_create(&in.cover, &pricer, &bound, &error));
    for (size_t round = 0; round < rounds; round++)
        assert_true(sp_bound_lower(&bound, WATER, &error));
    double area = bound.by_water[WATER], gap = 1 - found / area;
    print_message(
        "%zu candidates, %zu texels, %s, plenty %g: found %.4f in %.1f s, bound %.4f in %.1f s, gap %.2f %%\n",
        candidates, edge * edge, single ? "single" : "sum", plenty, found, searched - start, area, seconds() - searched,
        100 * gap);
    assert_true(area >= found);
    sp_bound_free(&bound);
    instance_free(&in);
    return gap;
}

static void one_nozzle_alone(void **state)
{
    (void)state;
    assert_true(measure(CANDIDATES, EDGE, true, 1, 6) <= 0.05);
}

static void all_together(void **state)
{
    (void)state;
    assert_true(measure(CANDIDATES, EDGE, false, 1, 6) <= 0.15);
}

int main(int count, char **arguments)
{
    if (count == 4) {
        for (int single = 0; single < 2; single++)
            for (int plenty = 0; plenty < 2; plenty++)
                measure(strtoul(arguments[1], NULL, 10), strtoul(arguments[2], NULL, 10), single, plenty ? 1 : 0.33,
                        strtoul(arguments[3], NULL, 10));
        return 0;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_nozzle_alone),
        cmocka_unit_test(all_together),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
