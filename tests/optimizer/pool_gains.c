/* What the pool's poses gain, kept up over layouts that grow and shrink, against layouts that are given each of them.
 */
#include "prepared.h"
#include "recount_scenes.h"

#include "search/pool_gains.h"

#include <string.h>

#define POSES 40
#define STEPS 24
#define NOZZLES 5
#define TEXEL 0.1

typedef struct {
    recount_scene scene;
    sp_evaluator *evaluator; /* as searches have it, of surface that is only run over, too */
    prepared ready;
    sp_search exact; /* without credit */
    sp_pool pool;
    sp_pool_gains gains;
    sp_partial partial;
    uint64_t state;
} job;

static size_t draw(job *j, size_t count)
{
    j->state = j->state * 6364136223846793005u + 1442695040888963407u;
    return (size_t)((j->state >> 33) % count);
}

/* Poses of all sites and variants, drawn at random. */
static void fill_pool(job *j)
{
    sp_error error = {0};
    const sp_candidates *candidates = &j->ready.candidates;
    for (size_t i = 0; i < POSES; i++) {
        sp_pose pose = {(uint32_t)draw(j, j->ready.sites.count), (uint32_t)draw(j, candidates->variant_count), 0, 0};
        uint32_t mount = j->ready.sites.items[pose.site].mount;
        pose.axis = (uint32_t)draw(j, sp_candidates_axes(candidates, mount, pose.variant)->count);
        pose.roll = (uint32_t)draw(j, candidates->variants[pose.variant].roll_count);
        assert_true(sp_pool_add(&j->pool, pose, &error));
    }
    sp_pool_settle(&j->pool);
}

static void job_open(job *j, void (*scene)(recount_scene *, double), int threads)
{
    sp_error error = {0};
    *j = (job){.state = 7};
    scene(&j->scene, TEXEL);
    j->scene.options.run.threads = threads;
    j->evaluator = sp_evaluator_resample(j->scene.room.evaluator, TEXEL, &error);
    assert_non_null(j->evaluator);
    prepare(&j->ready, j->evaluator, &j->scene.options);
    j->exact = j->ready.search;
    j->exact.credit = 0;
    fill_pool(j);
    assert_true(sp_pool_gains_create(&j->ready.search, &j->pool, &j->gains, &error));
    assert_true(sp_partial_create(&j->ready.search, &j->partial, &error));
}

static void job_close(job *j)
{
    sp_partial_free(&j->partial);
    sp_pool_gains_free(&j->gains);
    sp_pool_free(&j->pool);
    prepared_free(&j->ready);
    sp_evaluator_destroy(j->evaluator);
    scene_close(&j->scene);
}

/* What the layout's value rises by with one more pose. */
static double gain_with(const sp_search *search, const sp_partial *partial, sp_pose pose)
{
    sp_error error = {0};
    sp_partial copy;
    assert_true(sp_partial_copy(search, partial, &copy, &error));
    double before = copy.value;
    assert_true(sp_partial_add_pose(search, &copy, pose, &error));
    double gain = copy.value - before;
    sp_partial_free(&copy);
    return gain;
}

/* Asks for the best, and tries all of the pool. */
static void check_best(job *j, const sp_search *search, double power, double budget)
{
    sp_error error = {0};
    sp_pose best;
    double gain, most = 0, tie = 2 * SP_SCORE_TIE * search->all;
    assert_true(sp_pool_best(search, &j->gains, &j->partial, power, budget, &best, &gain, &error));
    for (size_t i = 0; i < j->pool.count; i++) {
        sp_pose pose = j->pool.items[i];
        uint32_t mount = j->ready.sites.items[pose.site].mount;
        if (!sp_partial_affords(search, &j->partial, mount, pose.variant, budget) ||
            !sp_partial_has_place(search, &j->partial, mount))
            continue;
        double own = gain_with(search, &j->partial, pose), price = sp_merit_price(search, &pose, power);
        most = fmax(most, own > tie ? own / price : 0);
        assert_true(fabs(j->gains.score[i] - own) < tie);
        assert_true(gain > 0 || own <= tie);
    }
    if (gain <= 0)
        return;
    assert_true(fabs(gain_with(search, &j->partial, best) - gain) < tie);
    assert_true(gain + tie >= most * sp_merit_price(search, &best, power));
}

/* Takes one out, or puts one in. */
static void change(job *j)
{
    sp_error error = {0};
    const sp_search *search = &j->ready.search;
    sp_pose pose = j->pool.items[draw(j, j->pool.count)];
    sp_partial copy;
    if (j->partial.count == NOZZLES || (j->partial.count && draw(j, 3) == 0))
        sp_partial_remove(search, &j->partial, draw(j, j->partial.count));
    else if (sp_partial_has_place(search, &j->partial, j->ready.sites.items[pose.site].mount))
        assert_true(sp_partial_add_pose(search, &j->partial, pose, &error));
    /* a copy is poured anew */
    assert_true(sp_partial_copy(search, &j->partial, &copy, &error));
    assert_memory_equal(copy.hit, j->partial.hit, search->patch_count * sizeof *copy.hit);
    assert_memory_equal(copy.wet, j->partial.wet, search->patch_count * sizeof *copy.wet);
    assert_memory_equal(copy.dry, j->partial.dry, search->patch_count * sizeof *copy.dry);
    assert_true(copy.flow >= j->partial.flow && copy.flow <= j->partial.flow);
    sp_partial_free(&copy);
}

static void gains_are_those_of_layouts(void **state)
{
    (void)state;
    static void (*const scenes[])(recount_scene *, double) = {
        fans_in_a_hall,  hollow_cones_in_a_hall, ports_and_kept,    one_alone,        off_the_wall,
        film_over_boxes, film_and_one_alone,     bodies_and_boxes,  bodies_and_film,  goods_in_a_chamber,
        any_liquid,      parts_and_parabolas,    streams_in_a_hall, measured_patterns};
    for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++) {
        job j;
        job_open(&j, scenes[s], 1);
        for (int i = 0; i < STEPS; i++) {
            double budget = draw(&j, 3) ? INFINITY : j.partial.outlay * 1.3;
            sp_partial_refresh(&j.ready.search, &j.partial);
            change(&j);
            check_best(&j, draw(&j, 2) ? &j.exact : &j.ready.search, 0.5 * (double)draw(&j, 3), budget);
        }
        job_close(&j);
    }
}

/* The same bits on any number of threads. */
static void threads_agree(void **state)
{
    (void)state;
    job one, many;
    job_open(&one, film_over_boxes, 1);
    job_open(&many, film_over_boxes, 3);
    for (int i = 0; i < STEPS; i++) {
        sp_error error = {0};
        sp_pose poses[2];
        double gains[2];
        change(&one);
        change(&many);
        assert_true(sp_pool_best(&one.exact, &one.gains, &one.partial, 1, INFINITY, &poses[0], &gains[0], &error));
        assert_true(sp_pool_best(&many.exact, &many.gains, &many.partial, 1, INFINITY, &poses[1], &gains[1], &error));
        assert_memory_equal(&gains[0], &gains[1], sizeof gains[0]);
    }
    job_close(&many);
    job_close(&one);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(gains_are_those_of_layouts), cmocka_unit_test(threads_agree)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
