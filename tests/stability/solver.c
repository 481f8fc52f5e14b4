/* The search at its limits: the solver started where derivatives end, what is no number, an axis led through the
 * vertical, and very many candidates that are equally good. With a number as its argument the program places among so
 * many equal candidates instead. */
#include "../optimizer/floor.h"

#include "ceres/least_squares.h"
#include "refine/pose_parameters.h"

#include <stdio.h>

#ifdef SPRAYPLAN_SANITIZE
enum { EQUAL = 300 };
#else
enum { EQUAL = 1000 };
#endif

/* y = x² seen through |x|: a kink at 0, where the slope is told as 0; and a slope to come down. */
typedef struct {
    size_t calls;
    size_t broken_from; /* from this call on a residual is no number; 0: never */
    bool only_slopes;   /* or a slope is */
} asking;

static bool kinked(void *user, const double *x, double *residuals, double *jacobian)
{
    asking *own = user;
    bool broken = own->broken_from && ++own->calls >= own->broken_from;
    residuals[0] = fabs(x[0]);
    residuals[1] = x[0] + x[1] - 1;
    if (jacobian) {
        jacobian[0] = (x[0] > 0) - (x[0] < 0);
        jacobian[1] = 0;
        jacobian[2] = jacobian[3] = broken && own->only_slopes ? NAN : 1;
    }
    if (broken && !own->only_slopes)
        residuals[1] = NAN;
    return true;
}

static bool solve(asking *own, double x[2], double *cost, sp_error *error)
{
    sp_least_squares problem = {
        .unknowns = 2, .residuals = 2, .function = kinked, .user = own, .iterations = 100, .tolerance = 1e-14};
    *error = (sp_error){0};
    return sp_least_squares_solve(&problem, x, cost, error);
}

static void started_at_a_kink_and_at_the_optimum(void **state)
{
    (void)state;
    static const double starts[][2] = {{0, 0}, {-1e-300, 5}, {0, 1}, {1e8, -1e8}};
    for (size_t i = 0; i < sizeof starts / sizeof *starts; i++) {
        double x[2] = {starts[i][0], starts[i][1]}, cost = NAN;
        sp_error error;
        asking own = {0};
        assert_true(solve(&own, x, &cost, &error));
        print_message("from %g, %g: to %.1e, 1 %+.1e, cost %.1e\n", starts[i][0], starts[i][1], x[0], x[1] - 1, cost);
        assert_true(cost < 1e-12 && fabs(x[0]) < 1e-6 && fabs(x[1] - 1) < 1e-6);
    }
    double x[2] = {0, 1}, cost;
    sp_error error;
    assert_true(solve(&(asking){0}, x, &cost, &error) && x[0] == 0 && x[1] == 1 && cost == 0); /* it stays there */
}

/* Whenever it comes, and though the solver would step back from it. */
static void what_is_no_number_is_an_error(void **state)
{
    (void)state;
    for (int slopes = 0; slopes < 2; slopes++)
        for (size_t from = 1; from < 5; from++) {
            double x[2] = {-3, 7};
            sp_error error;
            asking own = {.broken_from = from, .only_slopes = slopes};
            assert_false(solve(&own, x, NULL, &error));
            assert_int_equal(error.kind, SP_ERROR_ARGUMENT);
            assert_true(x[0] == -3 && x[1] == 7);
        }
}

/* The aperture whose rim is just wet (tests/optimizer/refine.c), from the narrowest, the widest and the best. */
static void started_at_a_bound(void **state)
{
    (void)state;
    const double best = 76, starts[] = {40, 120, 76};
    for (size_t i = 0; i < 3; i++) {
        job j;
        job_open(&j, 6, 0.05, rim_flux(20 * LITRES_PER_MINUTE, 0.5 * best * DEGREE, 2));
        j.type.angle = starts[i] * DEGREE;
        j.type.angle_min = 40 * DEGREE;
        j.type.angle_max = 120 * DEGREE;
        j.options.refine.angle = INFINITY;
        sp_proposal *proposal = job_place(&j);
        double angle = sp_nozzle_angle(&proposal->layout->nozzles[0]) / DEGREE;
        print_message("from %g deg: %.2f deg, the best is %g\n", starts[i], angle, best);
        assert_true(fabs(angle - best) < 1.5);
        sp_proposal_destroy(proposal);
        room_close(&j.room);
    }
}

/* A fan led through straight down by the unknowns of its axis: its frame turns no faster than its axis, and what it
 * covers does not jump. With its roll as it is listed alone it would be turned by up to half a turn there. */
static void through_the_vertical(void **state)
{
    (void)state;
    job j;
    job_open(&j, 3, 0.05, 0);
    j.type.pattern = SP_PATTERN_FLAT_FAN;
    j.type.thickness = 10 * DEGREE;
    sp_vec3 start = sp_unit(sp_v(0.05, 0.02, -1)), aside = sp_unit(sp_cross(start, sp_v(0, 0, 1)));
    sp_nozzle nozzle = {
        .name = "n", .type = &j.type, .position = sp_v(0.1, 0, 1), .axis = start, .roll = 0.4, .pressure = 2e5};
    sp_pose_parameters parameters = {.start = nozzle,
                                     .origin = nozzle,
                                     .up = j.room.setup.up,
                                     .reference = sp_v(0, 0, -1),
                                     .tilt = 1,
                                     .axis_limit = 0.5,
                                     .across = {aside, sp_cross(start, aside)},
                                     .count = 2,
                                     .kind = {SP_UNKNOWN_AXIS, SP_UNKNOWN_AXIS},
                                     .move = {aside, sp_cross(start, aside)},
                                     .low = {-0.5, -0.5},
                                     .high = {0.5, 0.5}};
    double away = atan2(hypot(start.x, start.y), -start.z), way = parameters.move[1].z < 0 ? 1 : -1, last = 0;
    static const double steps[] = {-1e-2, -1e-5, -1e-6, -9e-7, -1e-8, -1e-13, 0, 1e-13, 1e-8, 9e-7, 1e-6, 1e-5, 1e-2};
    for (int beside = 0; beside < 3; beside++) {
        sp_frame before = {0};
        for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
            sp_error error = {0};
            sp_nozzle led = sp_pose_parameters_nozzle(&parameters, (double[]){beside * 5e-7, way * (away + steps[i])});
            sp_frame frame = sp_nozzle_frame(led.axis, led.roll, parameters.up);
            sp_layout *layout = sp_layout_create(&led, 1, &error);
            sp_coverage *coverage = sp_evaluate_inverse(j.room.evaluator, layout, &error);
            double step = i ? steps[i] - steps[i - 1] : 0;
            if (i && !(sp_distance(frame.x, before.x) <= 2 * step + 1e-9 &&
                       fabs(coverage->fraction - last) <= 2 * step + 1e-9))
                fail_msg("%g rad from the vertical: x turned by %g, coverage changed by %g over %g rad", steps[i],
                         sp_distance(frame.x, before.x), coverage->fraction - last, step);
            assert_true(i != 6 || beside || sp_distance(led.axis, sp_v(0, 0, -1)) < 1e-12);
            before = frame;
            last = coverage->fraction;
            sp_coverage_destroy(coverage);
            sp_layout_destroy(layout);
        }
    }
    room_close(&j.room);
}

/* A ball covers the floor from everywhere: one nozzle is enough, and of all that are equal it is the first. */
static void place_among_equals(size_t count)
{
    double place[2];
    for (int i = 0; i < 2; i++) {
        job j;
        job_open(&j, 1, 0.1, 0);
        j.type.angle = j.type.angle_min = j.type.angle_max = 2 * M_PI;
        j.mount.kind = SP_MOUNT_LINE;
        j.mount.from = sp_v(-0.3, 0.1, 1);
        j.mount.to = sp_v(0.3, 0.1, 1);
        j.mount.spacing = 0.6 / (double)(count - 1);
        j.options.max_nozzles = 3;
        j.options.run.threads = i ? 3 : 1;
        sp_proposal *proposal = job_place(&j);
        assert_int_equal(proposal->layout->count, 1);
        assert_true(proposal->coverage->fraction == 1);
        place[i] = proposal->layout->nozzles[0].position.x;
        sp_proposal_destroy(proposal);
        room_close(&j.room);
    }
    print_message("%zu equal candidates: all is covered from %.9g\n", count, place[0]);
    assert_true(place[0] == -0.3 && place[1] == -0.3);
}

static void equal_candidates(void **state)
{
    (void)state;
    place_among_equals(EQUAL);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(started_at_a_kink_and_at_the_optimum),
        cmocka_unit_test(what_is_no_number_is_an_error),
        cmocka_unit_test(started_at_a_bound),
        cmocka_unit_test(through_the_vertical),
        cmocka_unit_test(equal_candidates),
    };
    if (argc > 1) {
        place_among_equals(strtoull(argv[1], NULL, 10));
        return 0;
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
