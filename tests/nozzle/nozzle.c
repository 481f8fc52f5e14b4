/* Flow, speed, frame, pattern and sampling of nozzles. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <sprayplan/nozzle.h>

#include <string.h>

static const sp_fluid water = {1000, 1e-3, 72e-3};

static sp_nozzle_type cone_type(sp_pattern pattern, double angle)
{
    return (sp_nozzle_type){.name = "cone",
                            .pattern = pattern,
                            .angle = angle,
                            .hollow = 0.75,
                            .thickness = 0.05,
                            .flow = 12e-3 / 60,
                            .at = 2e5,
                            .exponent = 0.5,
                            .cv = 0.95};
}

static void flow_follows_the_root_of_pressure(void **state)
{
    (void)state;
    sp_nozzle_type type = cone_type(SP_PATTERN_FULL_CONE, 1);
    sp_nozzle nozzle = {.type = &type, .pressure = 8e5};
    assert_float_equal(sp_nozzle_flow(&nozzle, &water), 2 * 12e-3 / 60, 1e-15);
    sp_fluid heavy = {1210, 1e-3, 72e-3};
    assert_float_equal(sp_nozzle_flow(&nozzle, &heavy), 2 * 12e-3 / 60 / 1.1, 1e-15);
    type.exponent = 0.46;
    assert_float_equal(sp_nozzle_flow(&nozzle, &water), 2e-4 * pow(4, 0.46), 1e-15);
    nozzle.flow = 3e-4;
    assert_float_equal(sp_nozzle_flow(&nozzle, &heavy), 3e-4, 0);
}

static void speed_follows_bernoulli(void **state)
{
    (void)state;
    sp_nozzle_type type = cone_type(SP_PATTERN_FULL_CONE, 1);
    sp_nozzle nozzle = {.type = &type, .pressure = 2e5};
    assert_float_equal(sp_nozzle_speed(&nozzle, &water), 19, 1e-12);
    const sp_fluid brine = {.density = 4e5 / (18 * 18)};
    assert_float_equal(sp_nozzle_speed(&nozzle, &brine), 0.95 * 18, 1e-12);
    nozzle.speed = 7;
    assert_float_equal(sp_nozzle_speed(&nozzle, &water), 7, 0);
    assert_float_equal(sp_nozzle_angle(&nozzle), 1, 0);
    nozzle.angle = 0.5;
    assert_float_equal(sp_nozzle_angle(&nozzle), 0.5, 0);
}

static void layout_copies_and_sums(void **state)
{
    (void)state;
    sp_nozzle_type type = cone_type(SP_PATTERN_FULL_CONE, 1);
    sp_nozzle nozzles[2] = {{.name = "a", .type = &type, .pressure = 2e5}, {.name = "b", .type = &type, .flow = 1e-4}};
    sp_error error = {0};
    sp_layout *layout = sp_layout_create(nozzles, 2, &error);
    assert_non_null(layout);
    nozzles[0].pressure = 0;
    assert_float_equal(sp_layout_flow(layout, &water), 3e-4, 1e-15);
    sp_layout_destroy(layout);
    layout = sp_layout_create(NULL, 0, &error);
    assert_non_null(layout);
    assert_float_equal(sp_layout_flow(layout, &water), 0, 0);
    sp_layout_destroy(layout);
    sp_layout_destroy(NULL);
}

static void assert_vector(sp_vec3 a, sp_vec3 b)
{
    if (sp_distance(a, b) > 1e-12)
        fail_msg("(%g %g %g) is not (%g %g %g)", a.x, a.y, a.z, b.x, b.y, b.z);
}

static void frame_follows_the_design(void **state)
{
    (void)state;
    sp_vec3 z_up = sp_v(0, 0, 1), y_up = sp_v(0, 1, 0);
    sp_frame f = sp_nozzle_frame(sp_v(1, 0, 0), 0, z_up);
    assert_vector(f.x, sp_v(0, 1, 0));
    assert_vector(f.y, sp_v(0, 0, 1));
    f = sp_nozzle_frame(sp_v(0, 0, -1), 0, z_up); /* world y × axis */
    assert_vector(f.x, sp_v(-1, 0, 0));
    assert_vector(f.y, sp_v(0, 1, 0));
    f = sp_nozzle_frame(sp_v(0, 1, 0), 0, y_up); /* world z × axis */
    assert_vector(f.x, sp_v(-1, 0, 0));
    assert_vector(f.y, sp_v(0, 0, 1));
    f = sp_nozzle_frame(sp_v(1e-7, 0, 1), 0, z_up);
    assert_true(sp_distance(f.x, sp_v(1, 0, 0)) < 1e-6);
    f = sp_nozzle_frame(sp_v(1e-5, 0, 1), 0, z_up);
    assert_true(sp_distance(f.x, sp_v(0, 1, 0)) < 1e-6);
    f = sp_nozzle_frame(sp_v(1, 0, 0), M_PI / 2, z_up); /* x turns towards y */
    assert_vector(f.x, sp_v(0, 0, 1));
    assert_vector(f.y, sp_v(0, -1, 0));
    f = sp_nozzle_frame(sp_v(1, 2, -3), 0.7, z_up);
    assert_vector(sp_cross(f.x, f.y), f.z);
}

static const sp_spray sprays[] = {
    {.kind = SP_PATTERN_FULL_CONE, .outer = 0.8},
    {.kind = SP_PATTERN_FULL_CONE, .outer = M_PI},
    {.kind = SP_PATTERN_HOLLOW_CONE, .inner = 0.6, .outer = 0.8},
    {.kind = SP_PATTERN_FLAT_FAN, .half_width = 0.5, .half_thickness = 0.03},
    {.kind = SP_PATTERN_FLAT_FAN, .half_width = 2.5, .half_thickness = 0.4},
    {.kind = SP_PATTERN_FLAT_FAN, .half_width = M_PI, .half_thickness = 0.2},
    {.kind = SP_PATTERN_SOLID_STREAM, .outer = 0.0087},
};
static const size_t spray_count = sizeof sprays / sizeof *sprays;

/* The sprays above, made from types. */
static sp_spray spray_of(size_t i)
{
    const sp_spray *s = &sprays[i];
    sp_nozzle_type type = {
        .pattern = s->kind, .hollow = s->inner / fmax(s->outer, 1e-9), .thickness = 2 * s->half_thickness};
    return sp_spray_create(&type, 2 * fmax(s->outer, s->half_width));
}

/* Over the whole sphere the intensity must integrate to one, and nothing may lie outside the reach. */
static void intensity_integrates_to_one(void **state)
{
    (void)state;
    for (size_t s = 0; s < spray_count; s++) {
        sp_spray spray = spray_of(s),
                 sphere = {.kind = SP_PATTERN_FULL_CONE, .outer = fmin(M_PI, 1.2 * sp_spray_reach(&spray))};
        sp_spray_settle(&sphere);
        const uint64_t n = 400000;
        double sum = 0, reach = sp_spray_reach(&spray);
        for (uint64_t i = 0; i < n; i++) {
            sp_vec3 d = sp_spray_direction(&sphere, i, n, 3);
            double intensity = sp_spray_intensity(&spray, d);
            sum += intensity * sphere.solid_angle / (double)n;
            assert_true(intensity == 0 || d.z >= cos(reach) - 1e-12);
            assert_true((sp_spray_margin(&spray, d) >= 0) == (intensity > 0));
        }
        if (fabs(sum - 1) > 2e-3)
            fail_msg("spray %zu: %g", s, sum);
    }
}

/* Every jet is a unit vector inside the pattern, and each part of the pattern gets its share. */
static void directions_fill_the_pattern_evenly(void **state)
{
    (void)state;
    for (size_t s = 0; s < spray_count; s++) {
        sp_spray spray = spray_of(s);
        const uint64_t n = 20000;
        double right = 0, front = 0;
        sp_vec3 mean = {0, 0, 0};
        for (uint64_t i = 0; i < n; i++) {
            sp_vec3 d = sp_spray_direction(&spray, i, n, 7);
            assert_float_equal(sp_length(d), 1, 1e-14);
            assert_true(sp_spray_margin(&spray, d) > -1e-12);
            right += d.x > 0;
            front += d.y > 0;
            mean = sp_along(mean, 1.0 / (double)n, d);
        }
        assert_float_equal(right / (double)n, 0.5, 1e-3);
        assert_float_equal(front / (double)n, 0.5, 1e-3);
        double along = spray.kind == SP_PATTERN_FLAT_FAN
                           ? sin(spray.half_width) / spray.half_width *
                                 (spray.half_thickness + 0.5 * sin(2 * spray.half_thickness)) /
                                 (2 * sin(spray.half_thickness))
                           : 0.5 * (cos(spray.inner) + cos(spray.outer));
        assert_float_equal(mean.x, 0, 1e-3);
        assert_float_equal(mean.y, 0, 1e-3);
        assert_float_equal(mean.z, along, 1e-3);
    }
}

static void directions_follow_the_seed(void **state)
{
    (void)state;
    sp_spray spray = spray_of(0);
    sp_vec3 a = sp_spray_direction(&spray, 5, 100, 1), b = sp_spray_direction(&spray, 5, 100, 1);
    assert_memory_equal(&a, &b, sizeof a);
    b = sp_spray_direction(&spray, 5, 100, 2);
    assert_true(sp_distance(a, b) > 1e-9);
}

/* The lattice stays even where the region is thin: no two jets of a fan come nearer than half the mean spacing. */
static void jets_of_a_thin_fan_keep_their_distance(void **state)
{
    (void)state;
    sp_spray spray = spray_of(3);
    enum { n = 2000 };
    static sp_vec3 d[n];
    for (uint64_t i = 0; i < n; i++)
        d[i] = sp_spray_direction(&spray, i, n, 11);
    double nearest = INFINITY;
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < i; j++)
            nearest = fmin(nearest, sp_distance(d[i], d[j]));
    }
    assert_true(nearest > 0.5 * sqrt(spray.solid_angle / n));
}

/* The margin is the distance to the edge: walking that far along its gradient must arrive there. */
static void margin_is_a_distance(void **state)
{
    (void)state;
    for (size_t s = 0; s < spray_count; s++) {
        sp_spray spray = spray_of(s);
        sp_nozzle_type all = {.pattern = SP_PATTERN_FULL_CONE};
        sp_spray sphere = sp_spray_create(&all, 2 * M_PI);
        for (uint64_t i = 0; i < 2000; i++) {
            sp_vec3 a = sp_spray_direction(&sphere, i, 2000, 1);
            double margin = sp_spray_margin(&spray, a);
            for (uint64_t j = 0; j < 40; j++) { /* nothing within the margin lies on the other side */
                sp_vec3 side = sp_unit(sp_cross(a, sp_spray_direction(&sphere, j, 40, 9)));
                double step = 0.999 * fabs(margin);
                sp_vec3 b = sp_along(sp_scale(a, cos(step)), sin(step), side);
                assert_true(fabs(margin) >= 3.14 || sp_spray_margin(&spray, b) * margin >= 0);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flow_follows_the_root_of_pressure),
        cmocka_unit_test(speed_follows_bernoulli),
        cmocka_unit_test(layout_copies_and_sums),
        cmocka_unit_test(frame_follows_the_design),
        cmocka_unit_test(intensity_integrates_to_one),
        cmocka_unit_test(directions_fill_the_pattern_evenly),
        cmocka_unit_test(directions_follow_the_seed),
        cmocka_unit_test(jets_of_a_thin_fan_keep_their_distance),
        cmocka_unit_test(margin_is_a_distance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
