/* Clusters in the evaluators: a body does what its patterns do as nozzles of their own, and is one nozzle all the same.
 */
#include "shapes.h"

#include <sprayplan/place.h>

#include <stdio.h>

#define HOLES 9

static const sp_surface surfaces[SHAPE_PARTS] = {{true, 0, 1, false}};

/* A room of 1 m, its front inside. */
typedef struct {
    sp_mesh *mesh;
    sp_setup setup;
    sp_evaluator *evaluator;
} room;

static room room_of(sp_method method, sp_criterion criterion)
{
    shape s = shape_create();
    shape_part(&s, "room");
    shape_box(&s, sp_v(0, 0, 0), sp_v(1, 1, 1), true);
    room r = {.mesh = shape_mesh(&s), .setup = sp_setup_default()};
    r.setup.mesh = r.mesh;
    r.setup.surfaces = surfaces;
    r.setup.cavity = criterion.film > 0 ? SP_CAVITY_POINT : SP_CAVITY_NONE; /* which takes longer to find */
    r.setup.cavity_point = sp_v(0.5, 0.5, 0.5);
    r.setup.criterion = criterion;
    r.setup.fidelity.texel = 0.04;
    r.setup.fidelity.method = method;
    r.setup.fidelity.trajectory = SP_TRAJECTORY_PARABOLA;
    r.setup.fidelity.reflections = 0;
    r.setup.fidelity.jets = 5000;
    r.setup.fidelity.accuracy = 0.1;
    return r;
}

static void room_build(room *r)
{
    sp_error error = {0};
    r->evaluator = sp_evaluator_create(&r->setup, &error);
    assert_string_equal(error.message, "");
    assert_non_null(r->evaluator);
}

static void room_close(room *r)
{
    sp_evaluator_destroy(r->evaluator);
    sp_mesh_destroy(r->mesh);
}

/* By whatever the room's method is. */
static sp_coverage *cover(const room *r, const sp_nozzle *nozzles, size_t count)
{
    sp_error error = {0};
    sp_layout *layout = sp_layout_create(nozzles, count, &error);
    sp_coverage *coverage = sp_evaluate(r->evaluator, layout, &error);
    assert_string_equal(error.message, "");
    assert_non_null(coverage);
    sp_layout_destroy(layout);
    return coverage;
}

static const sp_criterion any = {0, 0, M_PI / 2, SP_COMBINE_SUM, 0}, plenty = {1e-5, 1, 1.4, SP_COMBINE_SUM, 0},
                          alone = {1e-5, 1, 1.4, SP_COMBINE_SINGLE, 0}, film = {1e-5, 1, 1.4, SP_COMBINE_SUM, 2e-5};

static sp_nozzle_type rated(sp_pattern pattern, double angle)
{
    return (sp_nozzle_type){.name = "type",
                            .pattern = pattern,
                            .angle = angle,
                            .hollow = 0.5,
                            .thickness = 0.3,
                            .flow = 5e-4,
                            .at = 1e5,
                            .exponent = 0.5,
                            .cv = 0.95};
}

/* Three rings of holes of all patterns, which look every way. */
static sp_nozzle_type ball(sp_member members[HOLES])
{
    static const sp_pattern patterns[] = {SP_PATTERN_SOLID_STREAM, SP_PATTERN_FLAT_FAN, SP_PATTERN_FULL_CONE,
                                          SP_PATTERN_HOLLOW_CONE};
    for (int i = 0; i < HOLES; i++) {
        double longitude = i * 0.7, z = cos(0.3 + i * 0.28), level = sqrt(1 - z * z);
        sp_vec3 axis = sp_v(level * cos(longitude), level * sin(longitude), z);
        members[i] = (sp_member){.type = rated(patterns[i % 4], i % 4 ? 1.1 : 0.2),
                                 .offset = sp_scale(axis, 0.02),
                                 .axis = sp_unit(axis),
                                 .roll = i,
                                 .share = 1 + i % 2};
    }
    sp_nozzle_type type = rated(SP_PATTERN_CLUSTER, 0);
    type.member_count = HOLES;
    type.members = members;
    return type;
}

static sp_nozzle hung(const sp_nozzle_type *type)
{
    return (sp_nozzle){.name = "N1",
                       .type = type,
                       .position = sp_v(0.45, 0.52, 0.6),
                       .axis = sp_unit(sp_v(0.2, 0.1, -1)),
                       .roll = 0.4,
                       .pressure = 1e5,
                       .jets = 7000};
}

static void assert_same_column(const char *what, const double *a, const double *b, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (memcmp(&a[i], &b[i], sizeof a[i]) != 0)
            fail_msg("%s of patch %zu: %.17g and %.17g", what, i, a[i], b[i]);
}

/* To the last bit; means alone are added up in another order where there are other nozzles. */
static void assert_same(const sp_coverage *a, const sp_coverage *b)
{
    const sp_deposits *p = &a->deposits, *q = &b->deposits;
    assert_true(p->count > 1000 && p->count == q->count);
    assert_same_column("flux", p->flux, q->flux, p->count);
    assert_same_column("counted flux", p->counted, q->counted, p->count);
    assert_same_column("jets", p->jets, q->jets, p->count);
    assert_same_column("speed", p->speed, q->speed, p->count);
    assert_same_column("incidence", p->incidence, q->incidence, p->count);
    assert_same_column("even flux", p->even, q->even, p->count);
    assert_same_column("dry share", p->dry, q->dry, p->count);
    assert_same_column("film", p->film, q->film, p->count);
    assert_same_column("share", p->share, q->share, p->count);
    assert_true(a->covered_area == b->covered_area && a->fraction > 0);
    assert_true(a->film.known == b->film.known && a->film.area == b->film.area && a->film.held == b->film.held);
}

/* Everything that takes a layout, told of both. */
static void assert_same_besides(const room *r, const sp_nozzle *one, const sp_nozzle *other, sp_coverage *coverage)
{
    sp_error error = {0};
    sp_layout *a = sp_layout_create(one, 1, &error), *b = sp_layout_create(other, 1, &error);
    sp_measured_error measured[2];
    sp_borderline borderline[2];
    double bound[2];
    assert_true(sp_measure_error(r->evaluator, a, coverage, SP_TRAJECTORY_AUTO, 1, &measured[0], &error));
    assert_true(sp_measure_error(r->evaluator, b, coverage, SP_TRAJECTORY_AUTO, 1, &measured[1], &error));
    assert_true(measured[0].misjudged == measured[1].misjudged && measured[0].points == measured[1].points);
    assert_true(sp_find_borderline(r->evaluator, a, coverage, NULL, &borderline[0], &error));
    assert_true(sp_find_borderline(r->evaluator, b, coverage, NULL, &borderline[1], &error));
    assert_true(borderline[0].area == borderline[1].area);
    assert_true(sp_bound_lines(r->evaluator, a, &bound[0], NULL, &error));
    assert_true(sp_bound_lines(r->evaluator, b, &bound[1], NULL, &error));
    assert_true(bound[0] == bound[1] && bound[0] > 0);
    sp_balance before = {0};
    coverage->balance = before;
    assert_true(sp_evaluate_balance(r->evaluator, a, coverage, &error));
    before = coverage->balance;
    coverage->balance.known = false;
    assert_true(sp_evaluate_balance(r->evaluator, b, coverage, &error));
    assert_true(before.clean == coverage->balance.clean && before.clean > 0);
    sp_layout_destroy(a);
    sp_layout_destroy(b);
}

static void one_member_is_the_plain_nozzle(void **state)
{
    (void)state;
    static const sp_pattern patterns[] = {SP_PATTERN_FLAT_FAN, SP_PATTERN_HOLLOW_CONE, SP_PATTERN_SOLID_STREAM};
    const sp_criterion *const criteria[] = {&any, &alone, &film};
    for (int i = 0; i < 6; i++) {
        room r = room_of(i < 3 ? SP_METHOD_INVERSE : SP_METHOD_FORWARD, *criteria[i % 3]);
        room_build(&r);
        sp_nozzle_type plain = rated(patterns[i % 3], 0.9), cluster = rated(SP_PATTERN_CLUSTER, 0);
        sp_member member = {.type = plain, .axis = {0, 0, 1}, .share = 7};
        cluster.member_count = 1;
        cluster.members = &member;
        sp_nozzle one = hung(&plain), other = hung(&cluster);
        sp_coverage *a = cover(&r, &one, 1), *b = cover(&r, &other, 1);
        assert_same(a, b);
        assert_true(a->flow == b->flow);
        if (i < 2)
            assert_same_besides(&r, &one, &other, b);
        sp_coverage_destroy(a);
        sp_coverage_destroy(b);
        room_close(&r);
    }
}

static void a_ball_is_its_holes(void **state)
{
    (void)state;
    const sp_criterion *const criteria[] = {&any, &plenty, &film};
    for (int i = 0; i < 4; i++) {
        room r = room_of(i < 3 ? SP_METHOD_INVERSE : SP_METHOD_FORWARD, *criteria[i % 3]);
        r.setup.up = i % 2 ? sp_v(0, 1, 0) : sp_v(0, 0, 1);
        room_build(&r);
        sp_member members[HOLES];
        sp_nozzle_type type = ball(members);
        sp_nozzle whole = hung(&type), holes[HOLES];
        sp_nozzle_patterns(&whole, &r.setup.liquid, r.setup.up, holes);
        sp_coverage *a = cover(&r, &whole, 1), *b = cover(&r, holes, HOLES);
        assert_same(a, b);
        assert_true(a->flow == type.flow);
        assert_true(fabs(a->flow - b->flow) < 1e-12 * a->flow);
        assert_true(fabs(a->balance.clean - b->balance.clean) < 1e-12 * a->flow);
        sp_coverage_destroy(a);
        sp_coverage_destroy(b);
        room_close(&r);
    }
}

/* Cones from one place at the floor, each of .6 of what the floor beneath needs. */
static void members_do_it_together(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        room r = room_of(i ? SP_METHOD_FORWARD : SP_METHOD_INVERSE, alone);
        r.setup.criterion.incidence = 0.4;
        r.setup.criterion.flux = 5e-4 / 0.6 / 0.8; /* a cone's flow, on the 0.8 m² that it hits at most */
        room_build(&r);
        sp_nozzle_type cone = rated(SP_PATTERN_FULL_CONE, 0.6), type = rated(SP_PATTERN_CLUSTER, 0);
        sp_member members[2] = {{.type = cone, .axis = {0, 0, 1}, .share = 1},
                                {.type = cone, .axis = {0, 0, 1}, .share = 1}};
        type.member_count = 2;
        type.members = members;
        sp_nozzle body = hung(&type), single[2] = {hung(&cone), hung(&cone)};
        body.axis = single[0].axis = single[1].axis = sp_v(0, 0, -1);
        double area = M_PI * pow(0.6 * tan(0.3), 2); /* of the floor that is hit */
        body.flow = r.setup.criterion.flux * area * 1.4;
        single[0].flow = single[1].flow = body.flow / 2;
        sp_coverage *together = cover(&r, &body, 1), *apart = cover(&r, single, 2);
        assert_true(together->fraction * 6 > 0.8 * area);
        assert_true(apart->covered_area == 0);
        assert_true(together->flow == apart->flow);
        sp_measured_error measured;
        sp_error error = {0};
        sp_layout layout = {1, &body}, two = {2, single};
        if (!i) {
            assert_true(sp_measure_error(r.evaluator, &layout, together, SP_TRAJECTORY_AUTO, 1, &measured, &error));
            assert_true(measured.misjudged < 0.005);
            assert_true(sp_measure_error(r.evaluator, &two, apart, SP_TRAJECTORY_AUTO, 1, &measured, &error));
            assert_true(measured.misjudged == 0);
        }
        sp_coverage_destroy(together);
        sp_coverage_destroy(apart);
        room_close(&r);
    }
}

static void forward_agrees_with_inverse(void **state)
{
    (void)state;
    room r = room_of(SP_METHOD_INVERSE, plenty);
    room_build(&r);
    sp_member members[HOLES];
    sp_nozzle_type type = ball(members);
    sp_nozzle whole = hung(&type);
    sp_layout layout = {1, &whole};
    sp_error error = {0};
    sp_coverage *inverse = cover(&r, &whole, 1),
                *forward = sp_evaluate_forward(r.evaluator, &layout, 0, 200000, &error);
    assert_non_null(forward);
    if (!(inverse->fraction > 0.2 && inverse->fraction < 0.9))
        fail_msg("%g covered", inverse->fraction);
    if (!(fabs(forward->fraction - inverse->fraction) < 0.01))
        fail_msg("%.4f by jets, %.4f inverse", forward->fraction, inverse->fraction);
    assert_true(sp_evaluate_balance(r.evaluator, &layout, inverse, &error));
    assert_true(fabs(inverse->balance.clean - type.flow) < 1e-9 * type.flow);
    sp_coverage_destroy(inverse);
    sp_coverage_destroy(forward);
    room_close(&r);
}

/* As many as are asked for, and the same bytes from any number of threads. */
static void jets_and_threads(void **state)
{
    (void)state;
    sp_coverage *found[2];
    for (int i = 0; i < 2; i++) {
        room r = room_of(SP_METHOD_FORWARD, alone);
        r.setup.run.threads = i ? 3 : 1;
        room_build(&r);
        sp_member members[HOLES];
        sp_nozzle_type type = ball(members);
        sp_nozzle whole = hung(&type);
        found[i] = cover(&r, &whole, 1);
        double jets = 0;
        for (size_t p = 0; p < found[i]->deposits.count; p++)
            jets += found[i]->deposits.jets[p];
        assert_true(jets == 7000);
        room_close(&r);
    }
    assert_same(found[0], found[1]);
    sp_coverage_destroy(found[0]);
    sp_coverage_destroy(found[1]);
}

static void holes_in_a_wall_are_refused(void **state)
{
    (void)state;
    room r = room_of(SP_METHOD_INVERSE, any);
    r.setup.cavity = SP_CAVITY_POINT;
    room_build(&r);
    sp_member members[HOLES];
    sp_nozzle_type type = ball(members);
    sp_nozzle whole = hung(&type);
    sp_error error = {0};
    assert_true(sp_evaluator_admits(r.evaluator, &whole, &error));
    members[3].offset = sp_v(0, 0, 2);
    assert_false(sp_evaluator_admits(r.evaluator, &whole, &error));
    assert_int_equal(error.kind, SP_ERROR_INPUT);
    assert_non_null(strstr(error.message, "N1"));
    members[3].share = 0;
    error = (sp_error){0};
    sp_layout layout = {1, &whole};
    assert_null(sp_evaluate(r.evaluator, &layout, &error));
    assert_int_equal(error.kind, SP_ERROR_ARGUMENT);
    room_close(&r);
}

/* At the depths at which its holes would stick in the lid there is no candidate; a port at another serves. */
static void holes_in_a_wall_are_not_placed(void **state)
{
    (void)state;
    room r = room_of(SP_METHOD_INVERSE, any);
    r.setup.cavity = SP_CAVITY_POINT;
    room_build(&r);
    sp_member members[HOLES];
    sp_nozzle_type type = ball(members);
    const sp_nozzle_type *types[1] = {&type};
    const double pressure = 1e5;
    sp_mount mount = {.kind = SP_MOUNT_PORT,
                      .name = "P1",
                      .position = sp_v(0.5, 0.5, 1),
                      .axis = sp_v(0, 0, -1),
                      .depth_from = 0.01,
                      .depth_to = 0.03,
                      .depth_spacing = 0.02};
    sp_place_options options = sp_place_options_default();
    options.mounts = &mount;
    options.mount_count = options.type_count = options.pressure_count = 1;
    options.pressures = &pressure;
    options.types = types;
    members[0].offset = sp_v(0, 0, -0.02); /* above the body */
    type.flow_min = type.flow_max = type.flow;
    sp_error error = {0};
    sp_proposal *proposal = sp_place(r.evaluator, &options, &error);
    assert_string_equal(error.message, "");
    assert_int_equal(proposal->layout->count, 1);
    assert_true(fabs(proposal->layout->nozzles[0].position.z - 0.97) < 1e-12);
    sp_proposal_destroy(proposal);
    type.member_count = 0;
    assert_null(sp_place(r.evaluator, &options, &error));
    assert_string_equal(error.message, "type type: a cluster, expected 1 to 1000 members");
    room_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_member_is_the_plain_nozzle),
        cmocka_unit_test(a_ball_is_its_holes),
        cmocka_unit_test(members_do_it_together),
        cmocka_unit_test(forward_agrees_with_inverse),
        cmocka_unit_test(jets_and_threads),
        cmocka_unit_test(holes_in_a_wall_are_refused),
        cmocka_unit_test(holes_in_a_wall_are_not_placed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
