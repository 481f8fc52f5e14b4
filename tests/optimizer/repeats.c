/* A nozzle again where one is: the edges of both lie in one place, so that the second covers nothing more, and none is
 * proposed. Hollow cones and streams thinner than a texel are all edge. */
#include "small_room.h"

#define COPIES 6

static sp_nozzle_type thin_cone(void)
{
    sp_nozzle_type type = room_cone("thin", 70 * DEGREE, 5);
    type.pattern = SP_PATTERN_HOLLOW_CONE;
    type.hollow = 0.99;
    return type;
}

static sp_nozzle_type thin_stream(void)
{
    sp_nozzle_type type = room_cone("stream", 1 * DEGREE, 5);
    type.pattern = SP_PATTERN_SOLID_STREAM;
    return type;
}

static void open_with(job *j, sp_nozzle_type type, double flux, sp_combine combine)
{
    job_open_coarse(j, 0.1);
    room_close(&j->room);
    room_builder b = {0};
    room_box(&b, sp_v(-1, -0.7, 0), sp_v(1, 0.7, 1.2), "walls", "lid");
    j->room.setup.criterion.flux = flux;
    j->room.setup.criterion.combine = combine;
    room_open(&j->room, &b, 0.1);
    j->types[0] = type;
    j->options.type_count = 1;
}

static sp_layout *copies_of(const job *j, size_t count)
{
    sp_nozzle nozzles[COPIES] = {0};
    sp_error error = {0};
    for (size_t i = 0; i < count; i++) {
        nozzles[i] = (sp_nozzle){.type = &j->types[0],
                                 .position = sp_v(0.1, 0.05, 0.9),
                                 .axis = sp_unit(sp_v(0.2, 0.1, -1)),
                                 .roll = 0.6,
                                 .pressure = PRESSURE};
        snprintf(nozzles[i].name, sizeof nozzles[i].name, "N%zu", i);
    }
    sp_layout *layout = sp_layout_create(nozzles, count, &error);
    assert_non_null(layout);
    return layout;
}

/* Asserts that copies cover what one does, and that nothing is lost without one of several. */
static void expect_as_one(const job *j, bool forward)
{
    double covered = 0;
    for (size_t count = 1; count <= COPIES; count += COPIES - 1) {
        sp_error error = {0};
        sp_layout *layout = copies_of(j, count);
        sp_coverage *coverage = forward ? sp_evaluate_forward(j->room.evaluator, layout, 0, 20000 * count, &error)
                                        : sp_evaluate_inverse(j->room.evaluator, layout, &error);
        assert_non_null(coverage);
        sp_contributions *parts = sp_contributions_create(j->room.evaluator, layout, coverage, &error);
        assert_non_null(parts);
        if (count == 1)
            covered = coverage->covered_area;
        assert_true(covered > 0);
        assert_float_equal(coverage->covered_area, covered, 1e-12);
        for (size_t i = 0; i < count && !forward; i++) {
            assert_float_equal(parts->alone[i], covered, 1e-12);
            assert_float_equal(parts->lost[i], count == 1 ? covered : 0, 1e-12);
        }
        sp_contributions_destroy(parts);
        sp_coverage_destroy(coverage);
        sp_layout_destroy(layout);
    }
}

static void copies_cover_what_one_does(void **state)
{
    (void)state;
    const sp_nozzle_type types[] = {thin_cone(), thin_stream()};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        for (int single = 0; single <= 1; single++) {
            job j;
            open_with(&j, types[i], 0, single ? SP_COMBINE_SINGLE : SP_COMBINE_SUM);
            expect_as_one(&j, false);
            expect_as_one(&j, true);
            room_close(&j.room);
        }
}

/* Of two alike and one beside them one of the two counts besides the third. */
static void a_third_adds_its_own(void **state)
{
    (void)state;
    job j;
    sp_error error = {0};
    open_with(&j, thin_cone(), 0, SP_COMBINE_SUM);
    sp_layout *layout = copies_of(&j, 3);
    layout->nozzles[1].axis = sp_v(0, 0, -1);
    sp_coverage *three = sp_evaluate_inverse(j.room.evaluator, layout, &error);
    assert_non_null(three);
    sp_contributions *parts = sp_contributions_create(j.room.evaluator, layout, three, &error);
    assert_non_null(parts);
    layout->count = 2;
    sp_coverage *two = sp_evaluate_inverse(j.room.evaluator, layout, &error);
    assert_non_null(two);
    assert_float_equal(three->covered_area, two->covered_area, 1e-12);
    assert_float_equal(parts->lost[0], 0, 1e-12);
    assert_float_equal(parts->lost[2], 0, 1e-12);
    assert_float_equal(parts->lost[1], two->covered_area - parts->alone[0], 1e-12);
    sp_contributions_destroy(parts);
    sp_coverage_destroy(two);
    sp_coverage_destroy(three);
    sp_layout_destroy(layout);
    room_close(&j.room);
}

/* One mounting point, one pose, four nozzles allowed; and a line of poses, each of which is taken once at most. */
static void no_pose_is_proposed_twice(void **state)
{
    (void)state;
    for (int single = 0; single <= 1; single++)
        for (int line = 0; line <= 1; line++) {
            job j;
            sp_error error = {0};
            open_with(&j, thin_cone(), 0, single ? SP_COMBINE_SINGLE : SP_COMBINE_SUM);
            j.mounts[0].axis = sp_unit(sp_v(0.2, 0.1, -1));
            if (!line)
                j.mounts[0].to = j.mounts[0].from;
            j.options.max_nozzles = 9;
            j.options.objective = SP_OBJECTIVE_MAX_COVERAGE;
            sp_proposal *proposal = sp_place(j.room.evaluator, &j.options, &error);
            assert_string_equal(error.message, "");
            assert_int_equal(proposal->layout->count, line ? 5 : 1);
            for (size_t i = 0; i < proposal->layout->count; i++)
                assert_false(sp_layout_repeats(proposal->layout, i, &j.room.setup.liquid));
            sp_proposal_destroy(proposal);
            room_close(&j.room);
        }
}

/* Where flux adds up, two do in one pose what one does not. */
static void a_pose_is_taken_twice_where_flux_adds_up(void **state)
{
    (void)state;
    job j;
    sp_error error = {0};
    open_with(&j, room_cone("wide", 100 * DEGREE, 5), 3.2 * LITRES_PER_MINUTE, SP_COMBINE_SUM);
    j.mounts[0].to = j.mounts[0].from = sp_v(0, 0, 1);
    j.options.max_nozzles = 2;
    j.options.objective = SP_OBJECTIVE_MAX_COVERAGE;
    sp_proposal *proposal = sp_place(j.room.evaluator, &j.options, &error);
    assert_string_equal(error.message, "");
    assert_int_equal(proposal->layout->count, 2);
    assert_true(sp_layout_repeats(proposal->layout, 1, &j.room.setup.liquid));
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

static double covered_by(const job *j, const sp_layout *layout, bool forward)
{
    sp_error error = {0};
    sp_coverage *coverage = forward ? sp_evaluate_forward(j->room.evaluator, layout, 0, 20000 * layout->count, &error)
                                    : sp_evaluate_inverse(j->room.evaluator, layout, &error);
    assert_non_null(coverage);
    double area = coverage->covered_area;
    sp_coverage_destroy(coverage);
    return area;
}

/* Two cones whose edges lie in one place, of other types and flows: what the weaker one covers the stronger one does.
 */
static void the_stronger_one_stands_for_both(void **state)
{
    (void)state;
    static const double fluxes[] = {0, 2 * LITRES_PER_MINUTE, 4 * LITRES_PER_MINUTE};
    for (size_t f = 0; f < 3; f++)
        for (int forward = 0; forward <= 1; forward++) {
            job j;
            open_with(&j, room_cone("weak", 70 * DEGREE, 5), fluxes[f], SP_COMBINE_SINGLE);
            j.types[1] = room_cone("strong", 70 * DEGREE, 9);
            sp_layout *layout = copies_of(&j, 2);
            layout->nozzles[1].type = &j.types[1];
            double both = covered_by(&j, layout, forward), weak, strong;
            assert_true(sp_layout_repeats(layout, 0, &j.room.setup.liquid));
            assert_false(sp_layout_repeats(layout, 1, &j.room.setup.liquid));
            layout->nozzles[0].type = &j.types[1];
            layout->nozzles[1].type = &j.types[0];
            assert_float_equal(covered_by(&j, layout, forward), both, 1e-12);
            layout->count = 1;
            strong = covered_by(&j, layout, forward);
            layout->nozzles[0].type = &j.types[0];
            weak = covered_by(&j, layout, forward);
            assert_true(weak > 0 && strong >= weak);
            if (!forward)
                assert_float_equal(both, strong, 1e-12);
            sp_layout_destroy(layout);
            room_close(&j.room);
        }
}

/* One pose, and three types that cover the same: the one of least water does, and no second gains by its edges. */
static void the_weakest_that_does_is_proposed(void **state)
{
    (void)state;
    for (int single = 0; single <= 1; single++) {
        job j;
        sp_error error = {0};
        open_with(&j, room_cone("strong", 70 * DEGREE, 20), 0, single ? SP_COMBINE_SINGLE : SP_COMBINE_SUM);
        j.types[1] = room_cone("weak", 70 * DEGREE, 5);
        j.types[2] = room_cone("middle", 70 * DEGREE, 7);
        j.options.type_count = 3;
        j.mounts[0].axis = sp_unit(sp_v(0.2, 0.1, -1));
        j.mounts[0].to = j.mounts[0].from;
        j.options.max_nozzles = 9;
        j.options.objective = SP_OBJECTIVE_MAX_COVERAGE;
        sp_proposal *proposal = sp_place(j.room.evaluator, &j.options, &error);
        assert_string_equal(error.message, "");
        assert_int_equal(proposal->layout->count, 1);
        assert_ptr_equal(proposal->layout->nozzles[0].type, &j.types[1]);
        assert_int_equal(proposal->front_count, 1);
        sp_proposal_destroy(proposal);
        room_close(&j.room);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(copies_cover_what_one_does),       cmocka_unit_test(a_third_adds_its_own),
        cmocka_unit_test(no_pose_is_proposed_twice),        cmocka_unit_test(a_pose_is_taken_twice_where_flux_adds_up),
        cmocka_unit_test(the_stronger_one_stands_for_both), cmocka_unit_test(the_weakest_that_does_is_proposed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
