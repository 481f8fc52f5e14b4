/* What a search still does that is out of time: a nozzle to show, and no word on what it has not looked into. */
#include "prepared.h"
#include "recount_scenes.h"

#include "attainable/attainable.h"
#include "attainable/moving_goods.h"
#include "scoring/footprints.h"
#include "scoring/strided.h"
#include "search/greedy.h"

#define TEXEL 0.15

static void the_strided_order_has_everything_once(void **state)
{
    (void)state;
    for (size_t count = 1; count <= 60; count++) {
        bool seen[60] = {false};
        for (size_t i = 0; i < count; i++) {
            size_t at = sp_strided(i, count);
            assert_true(at < count && !seen[at]);
            seen[at] = true;
        }
    }
}

static sp_deadline no_time(void)
{
    sp_deadline deadline = sp_deadline_start(&(sp_run){.time_limit = 1e6});
    sp_deadline_allow(&deadline, 0);
    return deadline;
}

/* The place that the first nozzle of a chamber gets, whose first mount costs so much. */
static uint32_t first_place(double cost, sp_deadline deadline, size_t *sites)
{
    recount_scene s;
    prepared ready;
    sp_pool pool = {0};
    sp_partial partial;
    sp_error error = {0};
    room_builder b;
    scene_begin(&s, &b, false);
    scene_type(&s, SP_PATTERN_FULL_CONE, 90, 0, 9);
    s.room.setup.criterion.flux = 1.2 * LITRES_PER_MINUTE;
    s.options.run.threads = 1;
    s.options.mount_count = 2;
    s.mounts[0].tilt = 0;
    s.mounts[0].spacing = 0.35;
    s.mounts[1] = s.mounts[0];
    s.mounts[0].to = s.mounts[0].from;
    s.mounts[0].cost = cost;
    scene_open(&s, &b, TEXEL);
    prepare(&ready, s.room.evaluator, &s.options);
    *sites = ready.sites.count;
    assert_true(sp_partial_create(&ready.search, &partial, &error));
    assert_true(sp_greedy(&ready.search, 1, 1e-3, 1, &deadline, &partial, &pool, &error));
    assert_int_equal(partial.count, 1);
    uint32_t site = partial.items[0].pose.site;
    sp_partial_free(&partial);
    sp_pool_free(&pool);
    prepared_free(&ready);
    scene_close(&s);
    return site;
}

/* The first place that was looked at, in a corner, or the next where that is too dear; at leisure a better one. */
static void a_first_nozzle_takes_no_whole_round(void **state)
{
    (void)state;
    size_t sites;
    assert_int_equal(first_place(0, no_time(), &sites), sp_strided(0, sites));
    assert_int_equal(first_place(2, no_time(), &sites), sp_strided(1, sites));
    sp_deadline leisure = sp_deadline_start(&(sp_run){0});
    uint32_t best = first_place(0, leisure, &sites);
    assert_true(best != sp_strided(0, sites) && best != sp_strided(1, sites));
}

/* Where film runs and where goods move that is all that no nozzle to keep covers; of bodies what lines lead to. */
static void check_unknown(void (*scene)(recount_scene *, double), bool lines)
{
    recount_scene s;
    prepared ready;
    sp_error error = {0};
    sp_deadline late = no_time();
    scene(&s, TEXEL);
    s.options.run.threads = 1;
    /* as searches have it, of surface that is only run over, too */
    sp_evaluator *coarse = sp_evaluator_resample(s.room.evaluator, TEXEL, &error);
    prepare(&ready, coarse, &s.options);
    size_t patches = sp_evaluator_patches(s.room.evaluator)->count, unknown = 0;
    sp_reason *reasons = calloc(patches, sizeof *reasons), *hurried = calloc(patches, sizeof *hurried);
    assert_true(!ready.search.footprints || sp_footprints_fill(ready.search.footprints, &ready.deadline, &error));
    assert_true(sp_attainable(s.room.evaluator, &ready.search, &ready.deadline, reasons, &error));
    assert_true(sp_attainable(s.room.evaluator, &ready.search, &late, hurried, &error));
    for (size_t p = 0; p < patches; p++) {
        assert_true(reasons[p] != SP_REASON_UNKNOWN && hurried[p] != SP_REASON_FLUX);
        assert_true(hurried[p] != SP_REASON_ATTAINABLE || reasons[p] == SP_REASON_ATTAINABLE);
        assert_true(hurried[p] == SP_REASON_UNKNOWN || hurried[p] == SP_REASON_ATTAINABLE || lines);
        unknown += hurried[p] == SP_REASON_UNKNOWN;
    }
    assert_true(unknown > 0 && sp_deadline_was_cut(&late, "attainable"));
    assert_false(sp_deadline_was_cut(&ready.deadline, "attainable"));
    free(reasons);
    free(hurried);
    prepared_free(&ready);
    sp_evaluator_destroy(coarse);
    scene_close(&s);
}

static void what_there_was_no_time_to_ask_is_unknown(void **state)
{
    (void)state;
    check_unknown(goods_in_a_chamber, false);
    check_unknown(film_over_boxes, false);
    check_unknown(bodies_and_boxes, true);
}

/* What fields have told stays, and what there is a share of time for is taken no more of. */
static void why_goods_stay_dry_is_told_whole_or_not(void **state)
{
    (void)state;
    recount_scene s;
    prepared ready;
    sp_error error = {0};
    sp_deadline late = no_time();
    bool whole;
    goods_in_a_chamber(&s, TEXEL);
    s.options.run.threads = 1;
    prepare(&ready, s.room.evaluator, &s.options);
    size_t patches = sp_evaluator_patches(s.room.evaluator)->count, unknown = 0;
    sp_reason *reasons = malloc(patches * sizeof *reasons);
    for (size_t p = 0; p < patches; p++)
        reasons[p] = p == 1 ? SP_REASON_ATTAINABLE : SP_REASON_UNKNOWN;
    assert_true(sp_moving_goods_reasons(s.room.evaluator, &ready.search, &late, reasons, &whole, &error));
    assert_false(whole);
    for (size_t p = 0; p < patches; p++)
        assert_int_equal(reasons[p], p == 1 ? SP_REASON_ATTAINABLE : SP_REASON_UNKNOWN);
    assert_true(sp_moving_goods_reasons(s.room.evaluator, &ready.search, &ready.deadline, reasons, &whole, &error));
    assert_true(whole);
    for (size_t p = 0; p < patches; p++)
        unknown += reasons[p] == SP_REASON_UNKNOWN;
    assert_int_equal(unknown, 0);
    free(reasons);
    prepared_free(&ready);
    scene_close(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_strided_order_has_everything_once),
        cmocka_unit_test(a_first_nozzle_takes_no_whole_round),
        cmocka_unit_test(what_there_was_no_time_to_ask_is_unknown),
        cmocka_unit_test(why_goods_stay_dry_is_told_whole_or_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
