/* Layouts looked at one by one against every layout there is, on instances small enough to try them all. */
#include "exhaustive.h"
#include "stored.h"

#include "bound/bit_rows.h"
#include "bound/tuples.h"

#ifdef SPRAYPLAN_SANITIZE
#define INSTANCES 8
#else
#define INSTANCES 60
#endif
#define PLENTY_OF_WORK 1e12

/* Some of what rows bring becomes parts that they cover by themselves, some of that beside what they bring to all. */
static void add_edges(instance *in, uint64_t *random)
{
    sp_error error = {0};
    sp_rows with = {0};
    size_t texels = in->cover.texel_count;
    uint32_t *texel = malloc(2 * texels * sizeof *texel);
    float *share = malloc(2 * texels * sizeof *share);
    for (size_t c = 0; c < in->rows.count; c++) {
        size_t count = 0;
        for (size_t i = in->rows.start[c]; i < in->rows.start[c + 1]; i++) {
            double dice = instance_random(random);
            if (dice < 0.3) {
                texel[count] = in->rows.texel[i];
                share[count++] = -(float)fmax(0.01, instance_random(random));
            }
            if (dice > 0.2) {
                texel[count] = in->rows.texel[i];
                share[count++] = in->rows.share[i];
            }
        }
        assert_true(sp_rows_add(&with, c, in->rows.port[c], in->rows.tier[c], texel, share, count, &error));
    }
    free(texel);
    free(share);
    sp_rows_free(&in->rows);
    in->rows = with;
    in->cover.whole = false;
}

/* The most that any layout within the water covers. */
typedef struct {
    const instance *in;
    size_t water, nozzles, chosen[EVERY_MOST];
    double *sum, *dry, best;
} brute;

static double brute_covered(brute *b, size_t count)
{
    const sp_rows *rows = &b->in->rows;
    double area = b->in->cover.base;
    for (size_t t = 0; t < b->in->cover.texel_count; t++) {
        b->sum[t] = 0;
        b->dry[t] = 1;
    }
    for (size_t i = 0; i < count; i++)
        for (size_t k = rows->start[b->chosen[i]]; k < rows->start[b->chosen[i] + 1]; k++)
            if (rows->share[k] > 0)
                b->sum[rows->texel[k]] += (double)rows->share[k];
            else
                b->dry[rows->texel[k]] *= 1 + (double)rows->share[k];
    for (size_t t = 0; t < b->in->cover.texel_count; t++)
        area += (b->sum[t] >= 1 ? 1 : 1 - b->dry[t]) * (double)b->in->area[t];
    return area;
}

static void brute_try(brute *b, size_t count, size_t first, size_t water)
{
    const instance *in = b->in;
    b->best = fmax(b->best, brute_covered(b, count));
    if (count == b->nozzles || count == EVERY_MOST)
        return;
    for (size_t c = first; c < in->rows.count; c++) {
        size_t more = water + in->cover.weight[in->rows.tier[c]];
        bool taken = false;
        for (size_t i = 0; i < count; i++)
            taken |= in->rows.port[c] != SP_NO_PORT && in->rows.port[b->chosen[i]] == in->rows.port[c];
        if (taken || more > b->water)
            continue;
        b->chosen[count] = c;
        brute_try(b, count + 1, in->cover.repeats ? c : c + 1, more);
    }
}

static double best_of(const instance *in, size_t water)
{
    size_t texels = in->cover.texel_count + 1;
    brute b = {.in = in, .water = water, .nozzles = in->cover.nozzles};
    b.sum = malloc(texels * sizeof *b.sum);
    b.dry = malloc(texels * sizeof *b.dry);
    brute_try(&b, 0, 0, 0);
    free(b.sum);
    free(b.dry);
    return b.best;
}

/* Multipliers that hold, good or not: none, those that a bound was proved with, or any at all; or that hold for one
 * nozzle alone, and are of no use. */
static void set_multipliers(instance *in, int way, size_t water, sp_valid_inequalities *inequalities, sp_multipliers *u,
                            uint64_t *random)
{
    sp_error error = {0};
    stored s = {&in->cover, &in->rows, 8};
    sp_pricer pricer = stored_pricer(&s);
    sp_bound bound;
    assert_true(sp_multipliers_create(&in->cover, u, &error));
    if (way == 3) {
        sp_valid_inequalities_create(1, inequalities);
        u->inequalities = inequalities;
        for (size_t t = 0; t < in->cover.texel_count; t++) {
            u->plain[t] = 0;
            u->strengthened[t] = in->area[t];
            u->kind[t] = SP_INEQUALITY_ALL_OR_NOTHING;
        }
    }
    if (way == 1) {
        assert_true(sp_bound_create(&in->cover, &pricer, &bound, &error));
        for (int round = 0; round < 4; round++)
            assert_true(sp_bound_lower(&bound, water, &error));
        sp_multipliers_copy(&in->cover, &bound.dual.multipliers, u);
        *inequalities = bound.inequalities;
        u->inequalities = u->inequalities ? inequalities : NULL;
        sp_bound_free(&bound);
    }
    if (way == 2) {
        sp_valid_inequalities_create(in->cover.nozzles, inequalities);
        u->inequalities = in->cover.whole ? NULL : inequalities;
        for (size_t t = 0; t < in->cover.texel_count; t++) {
            double part = u->inequalities ? fmax(0, instance_random(random) - 0.5) : 0;
            u->plain[t] = (float)(instance_random(random) * (1 - part)) * in->area[t];
            u->strengthened[t] = (float)part * in->area[t];
            u->kind[t] = (uint8_t)(instance_random(random) * (double)inequalities->kinds);
        }
    }
}

static sp_tuples *tuples_of(const stored_line *s, size_t water, double floor, double bound, const sp_multipliers *u)
{
    sp_error error = {0};
    float *price = malloc((s->list.count + 1) * sizeof *price);
    uint8_t *alive = malloc(s->list.count + 1);
    memset(alive, 1, s->list.count + 1);
    assert_true(s->list.price(s->list.user, u, alive, price, &error));
    const sp_tuple_task task = {water, floor, bound, s->list.count, u, price};
    sp_tuples *tuples = sp_tuples_create(s->cover, &s->list, &task, &error);
    assert_non_null(tuples);
    free(price);
    free(alive);
    return tuples;
}

/* Targets above and below the best, from the highest down. */
static void check(instance *in, size_t water, const sp_multipliers *u, uint64_t *random)
{
    static const double parts[] = {1.2, 1.02, 1.0001, 0.97, 0.8, 0.5};
    sp_error error = {0};
    stored_line s;
    double best = best_of(in, water), floor = (0.3 + 0.2 * instance_random(random)) * best;
    stored_line_create(&in->cover, &in->rows, &s);
    sp_tuples *tuples = tuples_of(&s, water, floor, 2 * best, u);
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        sp_tuple_answer answer;
        double target = parts[i] * best;
        assert_true(sp_tuples_bound(tuples, target, PLENTY_OF_WORK, &answer, &error));
        assert_true(answer.complete);
        assert_true(answer.bound >= best);
        assert_true(answer.bound <= fmax(target, best * (1 + 1e-5)));
        /* the same however many look, and with less than it takes nothing is said */
        in->cover.threads = 3;
        sp_tuple_answer other;
        assert_true(sp_tuples_bound(tuples, target, PLENTY_OF_WORK, &other, &error));
        assert_true(other.complete && other.bound == answer.bound);
        assert_true(sp_tuples_bound(tuples, target, other.work * 0.99, &other, &error));
        assert_true(other.complete == (other.work == 0));
        in->cover.threads = 1;
    }
    sp_tuples_destroy(tuples);
    stored_line_free(&s);
}

static void no_layout_covers_more(void **state)
{
    (void)state;
    uint64_t random = 5;
    for (uint64_t i = 0; i < INSTANCES; i++) {
        instance in;
        sp_valid_inequalities inequalities;
        sp_multipliers u;
        size_t water = 26 + i % 30;
        instance_create(&in, 12, 14, i % 2, 1 + i % 4, water, i % 3, 0.1 + 0.03 * (double)(i % 20), 9177 + 1000 * i);
        in.cover.base = i % 5 ? 0 : 0.1;
        for (size_t t = 0; t < in.cover.texel_count; t++)
            in.area[t] *= (float)(i % 7 ? 1 : instance_random(&random) < 0.1 ? 0 : instance_random(&random));
        if (i % 4 > 1)
            add_edges(&in, &random);
        if (i % 6 == 5)
            in.cover.repeats = false;
        water -= i % 8 == 7 ? 14 : 0;
        set_multipliers(&in, (int)(i / 2 % 4), water, &inequalities, &u, &random);
        check(&in, water, &u, &random);
        sp_multipliers_free(&u);
        instance_free(&in);
    }
}

static bool goes_on_for(void *user)
{
    size_t *left = user;
    return *left && (*left)--;
}

/* Wherever it is broken off, also before any candidate has its set, nothing is claimed that does not hold. */
static void what_is_broken_off_proves_nothing(void **state)
{
    (void)state;
    uint64_t random = 29;
    sp_error error = {0};
    instance in;
    sp_valid_inequalities inequalities;
    sp_multipliers u;
    instance_create(&in, 12, 14, false, 3, 40, 0, 0.3, 4711);
    set_multipliers(&in, 0, 40, &inequalities, &u, &random);
    double best = best_of(&in, 40);
    bool complete = false;
    for (size_t asked = 0; !complete; asked++) {
        stored_line s;
        sp_tuple_answer answer;
        size_t left = asked;
        stored_line_create(&in.cover, &in.rows, &s);
        sp_tuples *tuples = tuples_of(&s, 40, 0.3 * best, 2 * best, &u);
        in.cover.goes_on = goes_on_for;
        in.cover.user = &left;
        assert_true(sp_tuples_bound(tuples, 0.5 * best, PLENTY_OF_WORK, &answer, &error));
        complete = answer.complete;
        assert_true(asked > 2 || !complete);
        assert_true(!complete || answer.bound >= best);
        in.cover.goes_on = NULL;
        sp_tuples_destroy(tuples);
        stored_line_free(&s);
    }
    sp_multipliers_free(&u);
    instance_free(&in);
}

/* Unions, counted bit by bit. */
static void sets_are_counted_upwards(void **state)
{
    (void)state;
    uint64_t random = 17;
    for (size_t texels = 1; texels < 400; texels += 37) {
        sp_error error = {0};
        bool alike = texels % 2; /* then no larger texel of the word makes up for what one is rounded by */
        float area[400], share[400];
        uint32_t texel[400];
        for (size_t t = 0; t < texels; t++) {
            area[t] = instance_random(&random) < 0.1 ? 0 : alike ? 0.37f : (float)instance_random(&random);
            texel[t] = (uint32_t)t;
        }
        sp_cover cover = {.texel_count = texels, .area = area};
        sp_rows rows = {0};
        for (int r = 0; r < 2; r++) {
            for (size_t t = 0; t < texels; t++)
                share[t] = (float)(2 * instance_random(&random) - 1) + 1e-9f;
            assert_true(sp_rows_add(&rows, 0, 0, 0, texel, share, texels, &error));
        }
        sp_bit_rows sets;
        assert_true(sp_bit_rows_create(&cover, &sets, &error));
        for (int r = 0; r < 2; r++)
            assert_true(sp_bit_rows_add(&sets, &cover, &rows, r, 0.4, &error));
        double gain = 0, edge = 0, whole = 0;
        for (size_t t = 0; t < texels; t++) {
            bool had = rows.share[t] >= 0.4f, has = rows.share[texels + t] >= 0.4f;
            gain += has && !had ? (double)area[t] : 0;
            edge += rows.share[texels + t] < 0 && !had ? -(double)rows.share[texels + t] * (double)area[t] : 0;
            whole += (double)area[t];
        }
        assert_true(sp_bit_rows_gain(&sets, 1, sets.bits) >= gain);
        /* texels of a word count as its largest, of which there are few words here */
        assert_true(sp_bit_rows_gain(&sets, 1, sets.bits) <= fmax(gain * 1.6, gain + whole / 3) + 1e-3);
        assert_true(sp_bit_rows_edge(&sets, 1, sets.bits) >= edge);
        assert_true(sp_bit_rows_edge(&sets, 1, sets.bits) <= edge * 1.00001 + 1e-12);
        sp_bit_rows_free(&sets);
        sp_rows_free(&rows);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_layout_covers_more),
        cmocka_unit_test(what_is_broken_off_proves_nothing),
        cmocka_unit_test(sets_are_counted_upwards),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
