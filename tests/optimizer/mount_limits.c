/* Mounts that take only so many nozzles, against every layout that they allow. */
#include "small_room.h"

#ifdef SPRAYPLAN_SANITIZE
#define LIMITED_TEXEL 0.2
#else
#define LIMITED_TEXEL 0.1
#endif

/* The line of five places, which takes `most`, and a port in the lid. */
static void open_limited(job *j, size_t most)
{
    job_open_coarse(j, LIMITED_TEXEL);
    j->mounts[0].most = most;
    j->mounts[1] =
        (sp_mount){.kind = SP_MOUNT_PORT, .name = "P1", .position = sp_v(0.1, -0.4, 1), .axis = sp_v(0, 0, -1)};
    j->options.mount_count = 2;
    j->options.max_nozzles = 3;
    j->options.objective = SP_OBJECTIVE_MAX_COVERAGE;
    j->options.coverage = 1;
    j->options.refine = (sp_refine){0};
}

/* Pose 0 to 9 on the line, 10 and 11 in the port; -1: no nozzle. */
static sp_nozzle any_nozzle_of(const job *j, int pose)
{
    sp_nozzle nozzle = nozzle_of(j, pose % 10);
    if (pose >= 10)
        nozzle.position = j->mounts[1].position;
    return nozzle;
}

/* What a layout of up to two nozzles on the line and one in the port does. */
typedef struct {
    double area, flow;
    size_t line; /* nozzles on the line */
} tried;

/* The layout of these poses; false where they are none. */
static bool try_one(const job *j, const int poses[3], tried *found)
{
    sp_nozzle nozzles[3];
    size_t count = 0;
    *found = (tried){0};
    for (int i = 0; i < 3; i++) {
        if (poses[i] < 0)
            continue;
        found->line += poses[i] < 10;
        nozzles[count] = any_nozzle_of(j, poses[i]);
        found->flow += nozzles[count++].type->flow;
    }
    if (count == 0)
        return false;
    found->area = area_of(j, nozzles, count);
    return true;
}

enum { MOST_LAYOUTS = 200 }; /* 66 on the line, with nothing or one of two in the port */

static size_t try_all(const job *j, tried layouts[MOST_LAYOUTS])
{
    size_t count = 0;
    for (int a = -1; a < 10; a++)
        for (int b = -1; b <= a; b++)
            for (int port = -1; port < 2; port++) {
                const int poses[] = {a, b, port < 0 ? -1 : 10 + port};
                count += try_one(j, poses, &layouts[count]);
            }
    return count;
}

/* The most that those cover that have no more than `most` on the line and no more water. */
static double most_area(const tried *layouts, size_t count, size_t most, double water)
{
    double area = 0;
    for (size_t i = 0; i < count; i++)
        if (layouts[i].line <= most && layouts[i].flow <= water * (1 + 1e-9))
            area = fmax(area, layouts[i].area);
    return area;
}

static double least_water(const tried *layouts, size_t count, size_t most, double area)
{
    double water = INFINITY;
    for (size_t i = 0; i < count; i++)
        if (layouts[i].line <= most && layouts[i].area >= area)
            water = fmin(water, layouts[i].flow);
    return water;
}

static size_t on_line(const sp_proposal *proposal)
{
    size_t count = 0;
    for (size_t i = 0; i < proposal->layout->count; i++) {
        bool fitting = proposal->layout->nozzles[i].position.y > 0;
        assert_true(proposal->fittings[i] == fitting);
        count += fitting;
    }
    return count;
}

static void check_limit(size_t most, const tried *layouts, size_t count)
{
    job j;
    open_limited(&j, most);
    j.options.prove = true;
    sp_proposal *proposal = job_place(&j);
    const sp_certificate *certificate = &proposal->certificate;
    double best = most_area(layouts, count, most, proposal->coverage->flow);
    assert_true(on_line(proposal) <= most);
    assert_true(proposal->coverage->covered_area >= best * (1 - 1e-6));
    assert_true(certificate->computed);
    assert_true(certificate->area_bound + 1e-5 >= best);
    assert_true(certificate->water_bound <=
                least_water(layouts, count, most, certificate->counted - 1e-5) * (1 + 1e-9));
    /* a limit of one the proof knows, too: else the bound would be what more cover */
    if (most == 1)
        assert_true(certificate->area_bound <= best * 1.02);
    for (size_t i = 0; i < proposal->front_count; i++) {
        const sp_front_point *point = &proposal->front[i];
        assert_true(point->fittings <= most && point->fittings <= point->nozzles);
        assert_true(point->bound + 1e-5 >= most_area(layouts, count, most, point->flow));
    }
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

static void no_more_than_allowed_and_nothing_beyond_the_bound(void **state)
{
    (void)state;
    static tried layouts[MOST_LAYOUTS];
    job j;
    open_limited(&j, 0);
    size_t count = try_all(&j, layouts);
    room_close(&j.room);
    /* there is something to keep them from */
    assert_true(most_area(layouts, count, 2, INFINITY) > 1.02 * most_area(layouts, count, 1, INFINITY));
    check_limit(1, layouts, count);
    check_limit(2, layouts, count);
}

/* Refinement moves a nozzle within its mount and adds none. */
static void refinement_keeps_the_limit(void **state)
{
    (void)state;
    job j;
    open_limited(&j, 1);
    j.options.refine = sp_place_options_default().refine;
    sp_proposal *proposal = job_place(&j);
    assert_true(on_line(proposal) <= 1);
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

/* A name that a port has which is not to be used goes to no other nozzle. */
static void ports_left_out_keep_their_names(void **state)
{
    (void)state;
    job j;
    open_limited(&j, 2);
    j.options.mount_count = 1;
    j.options.others = &j.mounts[1];
    j.options.other_count = 1;
    sp_proposal *proposal = job_place(&j);
    assert_int_equal(proposal->layout->count, 2);
    for (size_t i = 0; i < proposal->layout->count; i++)
        assert_string_not_equal(proposal->layout->nozzles[i].name, "P1");
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

static sp_proposal proposal_of(sp_coverage *coverage, sp_objective objective, double covered, double water)
{
    *coverage = (sp_coverage){.area = 10, .covered_area = covered, .fraction = covered / 10, .flow = water};
    return (sp_proposal){.objective = objective, .coverage = coverage, .asked_area = 9, .outlay = water};
}

static void the_best_is_chosen_by_the_objective(void **state)
{
    (void)state;
    /* covered m² of 10, of which 9 are asked for, with so much water */
    static const struct {
        double covered[3], water[3];
        size_t best[3]; /* by objective */
    } cases[] = {
        {{9.5, 9.9, 9.2}, {20, 30, 19.5}, {0, 2, 1}}, /* all reach it */
        {{8.9, 9.9, 9.1}, {1, 30, 29}, {1, 2, 1}},    /* what does not is left behind, however thrifty */
        {{8.9, 8.95, 8}, {1, 30, 0.5}, {1, 1, 1}},    /* none does: most coverage */
        {{8.985, 8.99, 8}, {1, 30, 0.5}, {0, 0, 1}},  /* to a tenth of a point, where water counts */
        {{9.5, 9.5, 9.5}, {20, 19, 19}, {1, 1, 1}},   /* equal coverage: less water, then the first */
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
        for (int objective = 0; objective < 3; objective++) {
            sp_coverage coverages[3];
            sp_proposal proposals[3];
            const sp_proposal *list[3];
            for (size_t i = 0; i < 3; i++) {
                proposals[i] =
                    proposal_of(&coverages[i], (sp_objective)objective, cases[k].covered[i], cases[k].water[i]);
                list[i] = &proposals[i];
            }
            size_t best = cases[k].best[objective];
            assert_int_equal(sp_place_best(list, 3), best);
            for (size_t i = 0; i < 3; i++) /* the same order tells what beats a proposal */
                assert_false(sp_place_is_beaten(list[best], &coverages[i], cases[k].water[i]));
            assert_int_equal(sp_place_is_beaten(list[0], &coverages[best], cases[k].water[best]), best != 0);
        }
}

/* Each covers all but as much as the next better one, with less water: the last is too far from the first. */
static void little_by_little_nothing_is_given_away(void **state)
{
    (void)state;
    static const double covered[] = {8.974, 8.99, 8.982}, water[] = {10, 30, 20};
    sp_coverage coverages[3];
    sp_proposal proposals[3];
    for (size_t i = 0; i < 3; i++)
        proposals[i] = proposal_of(&coverages[i], SP_OBJECTIVE_MIN_WATER, covered[i], water[i]);
    for (size_t first = 0; first < 3; first++) {
        const sp_proposal *list[3];
        for (size_t i = 0; i < 3; i++)
            list[i] = &proposals[(first + i) % 3];
        assert_ptr_equal(list[sp_place_best(list, 3)], &proposals[2]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_more_than_allowed_and_nothing_beyond_the_bound),
        cmocka_unit_test(refinement_keeps_the_limit),
        cmocka_unit_test(ports_left_out_keep_their_names),
        cmocka_unit_test(the_best_is_chosen_by_the_objective),
        cmocka_unit_test(little_by_little_nothing_is_given_away),
    };
    return cmocka_run_group_tests_name("limits of mounts", tests, NULL, NULL);
}
