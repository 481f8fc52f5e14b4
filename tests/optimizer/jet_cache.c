/* Nozzles whose jets were flown are kept: what layouts cover is what evaluating them says, whatever was measured
 * before. */
#include "bouncing_room.h"

#include "search/jet_cache.h"

#define NOZZLES 5
#define JETS 4000

typedef struct {
    room room;
    sp_nozzle_type type;
    sp_nozzle nozzles[NOZZLES];
    sp_jet_cache cache;
} job;

/* A box of walls that throw liquid back, four cones in a row, and the first of them again. */
static void job_open(job *j)
{
    *j = (job){.type = room_cone("cone", 90 * DEGREE, 4)};
    bouncing_room_open(&j->room, 0.1, JETS);
    for (int i = 0; i < NOZZLES; i++)
        j->nozzles[i] = (sp_nozzle){.name = "N",
                                    .type = &j->type,
                                    .position = sp_v(-0.6 + 0.4 * (i % (NOZZLES - 1)), 0.1, 1),
                                    .axis = sp_v(0, 0, -1),
                                    .pressure = 2e5};
}

static void job_close(job *j)
{
    sp_jet_cache_free(&j->cache);
    room_close(&j->room);
}

static double flown_area(job *j, const sp_nozzle *nozzles, size_t count, uint64_t jets)
{
    sp_error error = {0};
    double area = -1;
    sp_layout *layout = sp_layout_create(nozzles, count, &error);
    assert_non_null(layout);
    assert_true(sp_jet_cache_area(&j->cache, j->room.evaluator, jets, BOUNCES, layout, &area, &error));
    sp_layout_destroy(layout);
    return area;
}

static double evaluated_area(const job *j, const sp_nozzle *nozzles, size_t count)
{
    sp_error error = {0};
    return room_area_of(&j->room, sp_layout_create(nozzles, count, &error));
}

/* Nozzles first to end of the row, forwards and backwards, so that some are known and some are not. */
static void layouts_cover_what_evaluating_them_says(void **state)
{
    (void)state;
    job j;
    job_open(&j);
    assert_true(flown_area(&j, NULL, 0, 0) == 0);
    for (int turn = 0; turn < 2; turn++)
        for (size_t first = 0; first < NOZZLES; first++)
            for (size_t end = NOZZLES; end > first; end--) {
                double area = evaluated_area(&j, j.nozzles + first, end - first);
                assert_true(area > 0);
                assert_true(flown_area(&j, j.nozzles + first, end - first, 0) == area);
            }
    job_close(&j);
}

static void what_was_flown_is_not_flown_again(void **state)
{
    (void)state;
    job j;
    job_open(&j);
    flown_area(&j, j.nozzles, NOZZLES, 0);
    assert_int_equal(j.cache.count, NOZZLES - 1);
    flown_area(&j, j.nozzles + 1, 2, 0);
    assert_int_equal(j.cache.count, NOZZLES - 1);
    job_close(&j);
}

/* One that has jets of its own is another, if it stands where the other does. */
static void jets_of_its_own_are_flown(void **state)
{
    (void)state;
    job j;
    job_open(&j);
    double area = flown_area(&j, j.nozzles, 1, 0);
    j.nozzles[0].jets = JETS / 8;
    assert_true(flown_area(&j, j.nozzles, 1, 0) != area);
    assert_true(flown_area(&j, j.nozzles, 1, 0) == evaluated_area(&j, j.nozzles, 1));
    job_close(&j);
}

/* What is asked for last stays. */
static void most_are_forgotten_in_the_end(void **state)
{
    (void)state;
    job j;
    job_open(&j);
    double area = flown_area(&j, j.nozzles, 1, 10);
    for (int i = 1; i <= SP_JET_CACHE_MOST; i++) {
        sp_nozzle other = j.nozzles[0];
        other.position.y -= 1e-3 * i;
        flown_area(&j, &other, 1, 10);
        assert_true(flown_area(&j, j.nozzles, 1, 10) == area);
        assert_true(j.cache.count <= SP_JET_CACHE_MOST);
    }
    assert_int_equal(j.cache.count, SP_JET_CACHE_MOST);
    assert_true(j.cache.nozzles[SP_JET_CACHE_MOST - 1].nozzle.position.y == j.nozzles[0].position.y);
    job_close(&j);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(layouts_cover_what_evaluating_them_says), cmocka_unit_test(what_was_flown_is_not_flown_again),
        cmocka_unit_test(jets_of_its_own_are_flown), cmocka_unit_test(most_are_forgotten_in_the_end)};
    return cmocka_run_group_tests_name("jet_cache", tests, NULL, NULL);
}
