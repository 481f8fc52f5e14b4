/* Clusters taken apart: where their patterns stand, how they point and what each sprays. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <sprayplan/nozzle.h>

#include <string.h>

static const sp_fluid water = {1000, 1e-3, 72e-3};
static const sp_vec3 up = {0, 0, 1};

static sp_nozzle_type cluster_of(sp_member *members, size_t count)
{
    return (sp_nozzle_type){.name = "ball",
                            .pattern = SP_PATTERN_CLUSTER,
                            .flow = 1e-3,
                            .at = 2e5,
                            .exponent = 0.5,
                            .cv = 0.95,
                            .member_count = count,
                            .members = members};
}

static sp_member stream(sp_vec3 axis, double share)
{
    return (sp_member){
        .type = {.pattern = SP_PATTERN_SOLID_STREAM, .angle = 0.04}, .axis = sp_unit(axis), .share = share};
}

static void assert_vector(sp_vec3 a, sp_vec3 b)
{
    if (!(sp_distance(a, b) <= 1e-12))
        fail_msg("(%g %g %g) is not (%g %g %g)", a.x, a.y, a.z, b.x, b.y, b.z);
}

/* Equal in every byte. */
static void assert_same(const sp_nozzle *a, const sp_nozzle *b)
{
    assert_memory_equal(&a->position, &b->position, sizeof a->position);
    assert_memory_equal(&a->axis, &b->axis, sizeof a->axis);
    assert_true(a->roll == b->roll && a->pressure == b->pressure && a->jets == b->jets);
    assert_true(sp_nozzle_flow(a, &water) == sp_nozzle_flow(b, &water));
    assert_true(sp_nozzle_speed(a, &water) == sp_nozzle_speed(b, &water));
    assert_true(sp_nozzle_angle(a) == sp_nozzle_angle(b));
}

static void a_plain_nozzle_is_its_own_pattern(void **state)
{
    (void)state;
    sp_nozzle_type fan = {
        .pattern = SP_PATTERN_FLAT_FAN, .angle = 1, .thickness = 0.1, .flow = 1e-3, .at = 2e5, .exponent = 0.5};
    sp_nozzle nozzle = {
        .name = "N1", .type = &fan, .axis = sp_unit(sp_v(1, 2, -3)), .roll = 0.3, .pressure = 3e5, .angle = 0.9};
    sp_nozzle pattern;
    assert_int_equal(sp_nozzle_pattern_count(&nozzle), 1);
    sp_nozzle_patterns(&nozzle, &water, up, &pattern);
    assert_memory_equal(&nozzle, &pattern, sizeof nozzle);
}

static void one_member_is_the_plain_nozzle(void **state)
{
    (void)state;
    sp_member member = {
        .type = {.pattern = SP_PATTERN_FLAT_FAN, .angle = 1, .thickness = 0.1}, .axis = {0, 0, 1}, .share = 0.3};
    sp_nozzle_type cluster = cluster_of(&member, 1), fan = member.type;
    fan.flow = cluster.flow;
    fan.at = cluster.at;
    fan.exponent = cluster.exponent;
    fan.cv = cluster.cv;
    for (int i = 0; i < 1000; i++) {
        sp_nozzle plain = {.name = "N1",
                           .type = &fan,
                           .position = sp_v(cos(i), sin(i), i / 7.0),
                           .axis = sp_unit(sp_v(cos(3 * i), sin(2 * i), i % 3 - 1)),
                           .roll = i / 11.0,
                           .pressure = 1e5 + 77 * i,
                           .flow = i % 2 ? 0 : 1e-5 * i,
                           .jets = (uint64_t)(i % 5)};
        sp_nozzle body = plain, pattern;
        body.type = &cluster;
        sp_nozzle_patterns(&body, &water, up, &pattern);
        assert_same(&pattern, &plain);
    }
}

/* In whatever way the body is turned, a member's frame is turned along. */
static void members_turn_with_the_body(void **state)
{
    (void)state;
    for (int i = 0; i < 2000; i++) {
        sp_vec3 upwards = i % 2 ? up : sp_v(0, 1, 0);
        sp_member member = stream(sp_v(sin(5 * i), cos(7 * i), i % 9 == 0 ? 1e9 : i % 5 - 2), 1);
        member.offset = sp_v(0.01, -0.02, 0.03);
        member.roll = i / 3.0;
        sp_nozzle_type cluster = cluster_of(&member, 1);
        sp_vec3 axis = i % 7 ? sp_unit(sp_v(cos(i), sin(2 * i), sin(3 * i))) : sp_scale(upwards, i % 4 ? -1 : 1);
        sp_nozzle nozzle = {
            .type = &cluster, .position = sp_v(1, 2, 3), .axis = axis, .roll = -i / 4.0, .pressure = 2e5};
        sp_nozzle pattern;
        sp_nozzle_patterns(&nozzle, &water, upwards, &pattern);
        sp_frame body = sp_nozzle_frame(axis, nozzle.roll, upwards),
                 own = sp_nozzle_frame(member.axis, member.roll, up);
        sp_frame found = sp_nozzle_frame(pattern.axis, pattern.roll, upwards);
        const sp_vec3 inside[3] = {own.x, own.y, own.z}, outside[3] = {found.x, found.y, found.z};
        for (int k = 0; k < 3; k++) {
            sp_vec3 d = inside[k];
            sp_vec3 turned = sp_along(sp_along(sp_scale(body.x, d.x), d.y, body.y), d.z, body.z);
            if (!(sp_distance(turned, outside[k]) < 1e-9))
                fail_msg("%d: axis %d is %g off", i, k, sp_distance(turned, outside[k]));
        }
        sp_vec3 off = sp_sub(pattern.position, nozzle.position);
        assert_float_equal(sp_dot(off, body.x), 0.01, 1e-12);
        assert_float_equal(sp_dot(off, body.y), -0.02, 1e-12);
        assert_float_equal(sp_dot(off, body.z), 0.03, 1e-12);
    }
}

/* A ball that hangs: what is in front of it points down, its x lies level. */
static void a_ball_that_hangs(void **state)
{
    (void)state;
    sp_member members[2] = {stream(sp_v(0, 0, 1), 1), stream(sp_v(1, 0, 0), 3)};
    members[1].offset = sp_v(0.014, 0, 0);
    sp_nozzle_type ball = cluster_of(members, 2);
    sp_nozzle nozzle = {
        .name = "N1", .type = &ball, .position = sp_v(0, 0, 2), .axis = sp_v(0, 0, -1), .pressure = 2e5};
    sp_nozzle patterns[2];
    sp_frame body = sp_nozzle_frame(nozzle.axis, 0, up);
    assert_int_equal(sp_nozzle_pattern_count(&nozzle), 2);
    sp_nozzle_patterns(&nozzle, &water, up, patterns);
    assert_vector(patterns[0].axis, sp_v(0, 0, -1));
    assert_vector(patterns[1].axis, body.x);
    assert_vector(patterns[1].position, sp_along(sp_v(0, 0, 2), 0.014, body.x));
    assert_string_equal(patterns[1].name, "N1");
    assert_float_equal(sp_nozzle_flow(&patterns[0], &water), 0.25e-3, 1e-15);
    assert_float_equal(sp_nozzle_flow(&patterns[1], &water), 0.75e-3, 1e-15);
    assert_float_equal(sp_nozzle_speed(&patterns[1], &water), 19, 1e-12);
    assert_float_equal(sp_nozzle_angle(&nozzle), M_PI + 0.04, 1e-12);
    assert_float_equal(sp_nozzle_cone(&nozzle), M_PI + 0.04, 1e-12);
}

static void jets_are_shared(void **state)
{
    (void)state;
    sp_member members[3] = {stream(sp_v(0, 0, 1), 1), stream(sp_v(1, 0, 0), 1), stream(sp_v(0, 1, 0), 1)};
    sp_nozzle_type ball = cluster_of(members, 3);
    for (uint64_t jets = 0; jets < 100; jets++) {
        sp_nozzle nozzle = {.type = &ball, .axis = up, .pressure = 2e5, .jets = jets}, patterns[3];
        sp_nozzle_patterns(&nozzle, &water, up, patterns);
        uint64_t all = 0, least = jets > 3 ? jets / 3 : jets > 0;
        for (int i = 0; i < 3; i++) {
            assert_true(patterns[i].jets >= least && patterns[i].jets <= least + 1);
            all += patterns[i].jets;
        }
        assert_true(all == jets || (jets > 0 && jets < 3));
    }
}

static void what_is_no_cluster_is_refused(void **state)
{
    (void)state;
    sp_member member = stream(sp_v(0, 0, 1), 1);
    sp_nozzle_type ball = cluster_of(&member, 1);
    sp_error error = {0};
    assert_true(sp_type_is_valid(&ball, &error));
    ball.member_count = 0;
    assert_false(sp_type_is_valid(&ball, &error));
    assert_string_equal(error.message, "type ball: a cluster, expected 1 to 1000 members");
    ball.member_count = 1;
    member.share = NAN;
    error = (sp_error){0};
    assert_false(sp_type_is_valid(&ball, &error));
    member.share = 1;
    member.type.pattern = SP_PATTERN_CLUSTER;
    assert_false(sp_type_is_valid(&ball, &error));
    assert_int_equal(error.kind, SP_ERROR_ARGUMENT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_plain_nozzle_is_its_own_pattern),
        cmocka_unit_test(one_member_is_the_plain_nozzle),
        cmocka_unit_test(members_turn_with_the_body),
        cmocka_unit_test(a_ball_that_hangs),
        cmocka_unit_test(jets_are_shared),
        cmocka_unit_test(what_is_no_cluster_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
