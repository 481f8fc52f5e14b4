/* Bounds against every layout there is, on instances small enough to try them all. */
#include "exhaustive.h"
#include "stored.h"

#define ROUNDS 6
#ifdef SPRAYPLAN_SANITIZE
#define INSTANCES 6
#else
#define INSTANCES 40
#endif

/* The instance's bounds against all its layouts; adds how far the last one lies above. */
static void check_instance(instance *in, size_t start_rows, double *looseness)
{
    sp_error error = {0};
    size_t water = in->cover.water;
    every_layout t;
    every_layout_create(in, &t);
    stored all = {&in->cover, &in->rows, 4};
    sp_pricer pricer = stored_pricer(&all);
    sp_bound bound;
    assert_true(sp_bound_create(&in->cover, &pricer, &bound, &error));
    for (size_t c = 0; c < start_rows; c++)
        assert_true(sp_rows_add(&bound.rows, in->rows.key[c], in->rows.port[c], in->rows.tier[c],
                                in->rows.texel + in->rows.start[c], in->rows.share + in->rows.start[c],
                                in->rows.start[c + 1] - in->rows.start[c], &error));
    /* whether multipliers are sought on groups of texels first or not */
    bound.coarse = start_rows % 2 ? 60 : 0;
    assert_true(sp_bound_lower_single(&bound, &error));
    /* a level of the inequalities is all that it may lie above, where no more than one fits */
    for (size_t w = 0; w <= water && w < 2 * bound.lightest; w++) {
        assert_true(bound.by_water[w] >= t.by_water[w]);
        assert_true(bound.by_water[w] <= t.by_water[w] + 0.02);
    }
    for (size_t w = water; w > water / 4; w -= 4) {
        for (int round = 0; round < ROUNDS; round++) {
            assert_true(sp_bound_lower(&bound, w, &error));
            assert_true(bound.proved >= t.by_water[w]);
            assert_true(bound.by_water[w] <= bound.proved);
        }
    }
    for (size_t w = 0; w <= water; w++)
        assert_true(bound.by_water[w] >= t.by_water[w]);
    for (size_t w = 0; w < water; w++)
        assert_true(bound.by_water[w] <= bound.by_water[w + 1]);
    size_t least = 0;
    while (t.by_water[least] < t.by_water[water])
        least++;
    assert_true(sp_bound_water(&bound, t.by_water[water]) <= least);
    *looseness += bound.by_water[water] / t.by_water[water] - 1;
    sp_bound_free(&bound);
    every_layout_free(&t);
}

static void never_below_the_optimum(void **state)
{
    (void)state;
    for (int single = 0; single < 2; single++) {
        double looseness = 0;
        for (uint64_t i = 0; i < INSTANCES; i++) {
            instance in;
            instance_create(&in, 12, 14, single, 1 + i % 4, 26 + i % 30, i % 3, 0.1 + 0.03 * (double)(i % 20),
                            77 + 1000 * i);
            in.cover.repeats = i % 2 ? in.cover.repeats : false;
            check_instance(&in, i % 5, &looseness);
            instance_free(&in);
        }
        print_message("%s: on average %.1f %% above the optimum\n", single ? "single" : "sum",
                      100 * looseness / INSTANCES);
        /* and worth something: on average not far above it */
        assert_true(looseness / INSTANCES < (single ? 0.02 : 0.6));
    }
}

/* More nozzles than are counted: the bounds hold, and where the water lets in four, they are on average as good as if
 * these were counted. */
static void more_nozzles_than_are_counted(void **state)
{
    (void)state;
    double total[2] = {0};
    for (uint64_t i = 0; i < 6; i++) {
        sp_error error = {0};
        double bounds[2];
        instance in;
        every_layout t;
        instance_create(&in, 12, 14, i % 2, 4, 32, i % 3, 0.5, 99 + i);
        in.cover.repeats = true;
        every_layout_create(&in, &t);
        for (int many = 0; many < 2; many++) {
            in.cover.nozzles = many ? 3 * SP_KNAPSACK_COUNTED : 4;
            stored all = {&in.cover, &in.rows, 4};
            sp_pricer pricer = stored_pricer(&all);
            sp_bound bound;
            assert_true(sp_bound_create(&in.cover, &pricer, &bound, &error));
            for (int round = 0; round < ROUNDS; round++)
                assert_true(sp_bound_lower(&bound, 32, &error));
            for (size_t w = 0; w <= 32; w++)
                assert_true(bound.by_water[w] >= t.by_water[w]);
            bounds[many] = bound.by_water[32];
            sp_bound_free(&bound);
        }
        total[0] += bounds[0];
        total[1] += bounds[1];
        every_layout_free(&t);
        instance_free(&in);
    }
    assert_true(total[1] < 1.1 * total[0]);
}

static bool runs_out(void *user)
{
    size_t *left = user;
    bool on = *left > 0;
    *left -= on;
    return on;
}

/* Wherever it breaks off, what was proved stays true, and nothing else is. */
static void breaking_off_proves_nothing_false(void **state)
{
    (void)state;
    size_t broken = 0;
    for (size_t asked = 0; asked < 12; asked++) {
        sp_error error = {0};
        size_t left = asked;
        instance in;
        every_layout t;
        instance_create(&in, 12, 14, false, 4, 40, 1, 0.4, 4711);
        every_layout_create(&in, &t);
        in.cover.goes_on = runs_out;
        in.cover.user = &left;
        stored all = {&in.cover, &in.rows, 4};
        sp_pricer pricer = stored_pricer(&all);
        sp_bound bound;
        assert_true(sp_bound_create(&in.cover, &pricer, &bound, &error));
        for (int round = 0; round < 3; round++) {
            double before = bound.by_water[40];
            size_t proofs = bound.proofs;
            assert_true(sp_bound_lower(&bound, 40, &error));
            assert_int_equal(bound.proofs, proofs + bound.complete);
            assert_true(bound.complete ? bound.proved >= t.by_water[40] : bound.by_water[40] == before);
            broken += !bound.complete;
        }
        assert_true(left == 0 || bound.complete);
        for (size_t w = 0; w <= 40; w++)
            assert_true(bound.by_water[w] >= t.by_water[w]);
        sp_bound_free(&bound);
        every_layout_free(&t);
        instance_free(&in);
    }
    assert_true(broken > 3 && broken < 36);
}

/* On groups of texels first the bound comes as low in steps that are a quarter as long. */
static void groups_of_texels_lead_as_far(void **state)
{
    (void)state;
    double total[2] = {0};
    for (uint64_t i = 0; i < 4; i++)
        for (int coarse = 0; coarse < 2; coarse++) {
            sp_error error = {0};
            instance in;
            instance_create(&in, 200, 40, i % 2, 5, 50, i % 3, 0.5, 31 + i);
            stored all = {&in.cover, &in.rows, 200};
            sp_pricer pricer = stored_pricer(&all);
            sp_bound bound;
            assert_true(sp_bound_create(&in.cover, &pricer, &bound, &error));
            bound.iterations = coarse ? 50 : 150;
            bound.coarse = coarse ? 400 : 0;
            for (int round = 0; round < 3; round++)
                assert_true(sp_bound_lower(&bound, 50, &error));
            total[coarse] += bound.by_water[50];
            sp_bound_free(&bound);
            instance_free(&in);
        }
    print_message("texels alone %.4f, groups first %.4f\n", total[0], total[1]);
    assert_true(total[1] < 1.02 * total[0]);
}

/* Discs that do not touch: the bound is the optimum. */
static void tight_where_nothing_overlaps(void **state)
{
    (void)state;
    enum { ROWS = 6, EACH = 10 };
    float area[ROWS * EACH];
    const uint32_t weight[2] = {3, 4};
    for (size_t t = 0; t < ROWS * EACH; t++)
        area[t] = 0.5f + (float)(t / EACH);
    sp_cover cover = {.texel_count = ROWS * EACH,
                      .area = area,
                      .base = 2,
                      .tier_count = 2,
                      .weight = weight,
                      .nozzles = 4,
                      .water = 14,
                      .threads = 1};
    sp_rows rows = {0};
    sp_error error = {0};
    for (uint32_t c = 0; c < ROWS; c++) {
        uint32_t texels[EACH];
        float shares[EACH];
        for (uint32_t t = 0; t < EACH; t++) {
            texels[t] = c * EACH + t;
            shares[t] = 1;
        }
        assert_true(sp_rows_add(&rows, c, SP_NO_PORT, c % 2, texels, shares, EACH, &error));
    }
    stored all = {&cover, &rows, ROWS};
    sp_pricer pricer = stored_pricer(&all);
    sp_bound bound;
    assert_true(sp_bound_create(&cover, &pricer, &bound, &error));
    for (int round = 0; round < ROUNDS; round++)
        assert_true(sp_bound_lower(&bound, 14, &error));
    /* the four largest, of 3 + 4 + 3 + 4: 25 + 35 + 45 + 55 */
    assert_true(bound.by_water[14] >= 162);
    assert_true(bound.by_water[14] <= 162 * (1 + 1e-6));
    assert_true(bound.by_water[0] <= 2 * (1 + 1e-6));
    assert_int_equal(sp_bound_water(&bound, 162), 14);
    assert_true(sp_bound_water(&bound, 1e6) == SIZE_MAX);
    sp_bound_free(&bound);
    sp_rows_free(&rows);
}

/* More rows than are kept may be there before the first solve. */
static void hundreds_of_rows_may_come_first(void **state)
{
    (void)state;
    sp_error error = {0};
    instance in;
    instance_create(&in, 800, 60, false, 4, 40, 1, 0.3, 99);
    stored all = {&in.cover, &in.rows, 40};
    sp_pricer pricer = stored_pricer(&all);
    double proved[2];
    for (int first = 0; first < 2; first++) {
        sp_bound bound;
        assert_true(sp_bound_create(&in.cover, &pricer, &bound, &error));
        for (size_t c = 0; first && c < in.rows.count; c++)
            assert_true(sp_rows_add(&bound.rows, in.rows.key[c], in.rows.port[c], in.rows.tier[c],
                                    in.rows.texel + in.rows.start[c], in.rows.share + in.rows.start[c],
                                    in.rows.start[c + 1] - in.rows.start[c], &error));
        for (int round = 0; round < 12; round++)
            assert_true(sp_bound_lower(&bound, 40, &error));
        proved[first] = bound.by_water[40];
        sp_bound_free(&bound);
    }
    /* They are a head start: no looser after as many rounds, and of the same thing. */
    assert_true(proved[1] < 1.02 * proved[0] && proved[1] > 0.8 * proved[0]);
    instance_free(&in);
}

static void threads_do_not_matter(void **state)
{
    (void)state;
    float *price[2];
    double *by_water[2];
    for (int i = 0; i < 2; i++) {
        sp_error error = {0};
        instance in;
        instance_create(&in, 120, 40, false, 6, 70, 2, 0.3, 5);
        in.cover.threads = i ? 3 : 1;
        stored all = {&in.cover, &in.rows, 20};
        sp_pricer pricer = stored_pricer(&all);
        sp_bound bound;
        assert_true(sp_bound_create(&in.cover, &pricer, &bound, &error));
        for (int round = 0; round < 3; round++)
            assert_true(sp_bound_lower(&bound, 70, &error));
        price[i] = bound.dual.multipliers.plain;
        by_water[i] = bound.by_water;
        bound.dual.multipliers.plain = NULL;
        bound.by_water = NULL;
        sp_bound_free(&bound);
        instance_free(&in);
    }
    assert_memory_equal(price[0], price[1], 1600 * sizeof *price[0]);
    assert_memory_equal(by_water[0], by_water[1], 71 * sizeof *by_water[0]);
    for (int i = 0; i < 2; i++) {
        free(price[i]);
        free(by_water[i]);
    }
}

/* The same by trying every choice: ports first, then free ones tier by tier. */
static double pick(const sp_offers *o, const double *left, size_t nozzles, size_t port, const size_t *used)
{
    double best = 0;
    if (!nozzles)
        return 0;
    if (port < o->port_count) {
        best = pick(o, left, nozzles, port + 1, used);
        for (size_t k = 0; k < o->tier_count; k++) {
            double rest = *left - o->weight[k];
            if (o->port[port * o->tier_count + k] > 0 && rest >= 0)
                best = fmax(best, o->port[port * o->tier_count + k] + pick(o, &rest, nozzles - 1, port + 1, used));
        }
        return best;
    }
    for (size_t k = 0; k < o->tier_count; k++) {
        double rest = *left - o->weight[k];
        size_t at = o->repeats ? 0 : used[k], next[4];
        memcpy(next, used, sizeof next);
        next[k]++;
        if (rest >= 0 && at < o->most && o->free[k * o->most + at] > 0)
            best = fmax(best, o->free[k * o->most + at] + pick(o, &rest, nozzles - 1, port, next));
    }
    return best;
}

static void the_knapsack_is_the_best_choice(void **state)
{
    (void)state;
    uint64_t seed = 4711;
    const uint32_t weight[4] = {2, 3, 5, 7};
    for (int i = 0; i < 60; i++) {
        sp_offers offers;
        sp_error error = {0};
        assert_true(sp_offers_create(4, weight, (size_t)i % 3, 4, i % 2, &offers, &error));
        for (int k = 0; k < 14; k++) {
            size_t port = (size_t)(3 * instance_random(&seed));
            sp_offers_add(&offers, port < offers.port_count ? port : SIZE_MAX, (size_t)(4 * instance_random(&seed)),
                          instance_random(&seed));
        }
        sp_knapsack counted, many;
        assert_true(sp_knapsack_create(4, 18, &counted, &error));
        assert_true(sp_knapsack_create(SP_KNAPSACK_COUNTED + 1, 18, &many, &error));
        sp_knapsack_fill(&counted, &offers, 18);
        sp_knapsack_fill(&many, &offers, 18);
        for (size_t n = 0; n <= 4; n++)
            for (size_t w = 0; w <= 18; w++) {
                double left = (double)w, best = pick(&offers, &left, n, 0, (const size_t[4]){0});
                double value = sp_knapsack_value(&counted, n, w), loose = sp_knapsack_value(&many, n, w);
                assert_true(value >= best && value <= best * (1 + 1e-9));
                assert_true(loose >= best);
                /* water for one nozzle at a time: their number says nothing more */
                assert_true(n == 0 || w > 3 || loose <= best * (1 + 1e-9));
            }
        sp_knapsack_free(&counted);
        sp_knapsack_free(&many);
        sp_offers_free(&offers);
    }
}

/* Ports besides those of `from`, at each of which tier k is worth `price[k]`. */
static void add_ports(const sp_offers *from, size_t more, const double price[4], sp_offers *offers)
{
    sp_error error = {0};
    assert_true(sp_offers_create(4, from->weight, from->port_count + more, from->most, from->repeats, offers, &error));
    memcpy(offers->free, from->free, 4 * from->most * sizeof *from->free);
    memcpy(offers->port, from->port, 4 * from->port_count * sizeof *from->port);
    for (size_t p = from->port_count; p < offers->port_count; p++)
        for (size_t k = 0; k < 4; k++)
            sp_offers_add(offers, p, k, price[k]);
}

/* By how much further ports raise what they raise most, as a share. */
static double raised_by(const sp_offers *from, size_t more, const double price[4], size_t nozzles)
{
    sp_error error = {0};
    sp_offers offers;
    sp_knapsack before, after;
    double most = 0;
    add_ports(from, more, price, &offers);
    assert_true(sp_knapsack_create(nozzles, 18, &before, &error) && sp_knapsack_create(nozzles, 18, &after, &error));
    sp_knapsack_fill(&before, from, 18);
    sp_knapsack_fill(&after, &offers, 18);
    for (size_t n = 1; n <= nozzles; n++)
        for (size_t w = 1; w <= 18; w++) {
            double value = sp_knapsack_value(&before, n, w);
            if (value > 0)
                most = fmax(most, sp_knapsack_value(&after, n, w) / value - 1);
            else if (sp_knapsack_value(&after, n, w) > 0)
                most = INFINITY;
        }
    sp_knapsack_free(&before);
    sp_knapsack_free(&after);
    sp_offers_free(&offers);
    return most;
}

/* Any number of nozzles that are worth no more leave all values as they are; one worth a little more raises one. */
static void idle_nozzles_raise_no_value(void **state)
{
    (void)state;
    uint64_t seed = 815;
    const uint32_t weight[4] = {2, 3, 5, 7};
    size_t above = 0;
    for (int i = 0; i < 60; i++) {
        size_t nozzles = i % 3 ? 4 : SP_KNAPSACK_COUNTED + 1;
        sp_error error = {0};
        sp_offers offers;
        sp_knapsack knapsack;
        double idle[4];
        assert_true(sp_offers_create(4, weight, 6, 4, i % 2, &offers, &error));
        for (int k = 0; k < 40; k++)
            sp_offers_add(&offers, k % 8 ? (size_t)(6 * instance_random(&seed)) : SIZE_MAX,
                          (size_t)(4 * instance_random(&seed)), instance_random(&seed));
        assert_true(sp_knapsack_create(nozzles, 18, &knapsack, &error));
        sp_knapsack_fill(&knapsack, &offers, 18);
        assert_true(isinf(sp_knapsack_idle(&knapsack, 19)));
        for (size_t k = 0; k < 4; k++)
            idle[k] = sp_knapsack_idle(&knapsack, weight[k]);
        assert_true(raised_by(&offers, 3, idle, nozzles) <= 1e-9);
        for (size_t k = 0; k < 4; k++) {
            double more[4] = {0};
            more[k] = idle[k] + 1e-3;
            above += idle[k] > 0;
            assert_true(raised_by(&offers, 1, more, nozzles) > 1e-6);
        }
        sp_knapsack_free(&knapsack);
        sp_offers_free(&offers);
    }
    assert_true(above > 60);
}

enum { SPAN_TEXELS = 29 };

/* A candidate with all that texels from `first` on need. */
static void add_span(sp_rows *rows, uint64_t key, size_t port, uint32_t tier, uint32_t first, uint32_t count)
{
    sp_error error = {0};
    uint32_t texels[SPAN_TEXELS];
    float shares[SPAN_TEXELS];
    for (uint32_t i = 0; i < count; i++) {
        texels[i] = first + i;
        shares[i] = 1;
    }
    assert_true(sp_rows_add(rows, key, port, tier, texels, shares, count, &error));
}

/* A candidate that ports leave no use for by what the first few offer, and that another one of theirs makes useful:
 * what is left out is known only once all else is on offer. */
static void what_is_left_out_is_so_of_all_offers(void **state)
{
    (void)state;
    sp_error error = {0};
    const uint32_t weight[2] = {1, 2};
    float area[SPAN_TEXELS];
    for (size_t t = 0; t < SPAN_TEXELS; t++)
        area[t] = 1;
    const sp_cover cover = {.texel_count = SPAN_TEXELS,
                            .area = area,
                            .tier_count = 2,
                            .weight = weight,
                            .port_count = 2,
                            .nozzles = 2,
                            .water = 2,
                            .whole = true,
                            .threads = 1};
    sp_rows rows = {0};
    stored all = {&cover, &rows, 4};
    sp_pricer pricer = stored_pricer(&all);
    sp_bound bound;
    assert_true(sp_bound_create(&cover, &pricer, &bound, &error));
    for (int few = 0; few < 2; few++) {
        add_span(few ? &bound.rows : &rows, 0, 0, 0, 0, 10);
        add_span(few ? &bound.rows : &rows, 1, 0, 1, 0, 20);
    }
    add_span(&rows, 2, 1, 0, 20, 9);
    add_span(&rows, 3, 0, 0, 0, 15);
    assert_true(sp_bound_lower_single(&bound, &error));
    assert_true(bound.by_water[2] >= 24 && bound.by_water[2] < 24 + 1e-6);
    sp_bound_free(&bound);
    sp_rows_free(&rows);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(idle_nozzles_raise_no_value),       cmocka_unit_test(what_is_left_out_is_so_of_all_offers),
        cmocka_unit_test(the_knapsack_is_the_best_choice),   cmocka_unit_test(never_below_the_optimum),
        cmocka_unit_test(more_nozzles_than_are_counted),     cmocka_unit_test(groups_of_texels_lead_as_far),
        cmocka_unit_test(breaking_off_proves_nothing_false), cmocka_unit_test(tight_where_nothing_overlaps),
        cmocka_unit_test(hundreds_of_rows_may_come_first),   cmocka_unit_test(threads_do_not_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
