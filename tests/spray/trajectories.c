/* Types whose liquid flies in a way of its own: as a scene of that way has it, whatever the scene's, and beside others.
 */
#include "shapes.h"

#define WAYS 3
static const sp_trajectory ways[WAYS] = {SP_TRAJECTORY_LINE, SP_TRAJECTORY_PARABOLA, SP_TRAJECTORY_DRAG};

static const sp_nozzle_type slow_cone = {.name = "cone",
                                         .pattern = SP_PATTERN_FULL_CONE,
                                         .angle = 1.5,
                                         .flow = 1e-4,
                                         .at = 2e4,
                                         .exponent = 0.5,
                                         .cv = 0.95,
                                         .drop = 5e-4};

typedef struct {
    sp_mesh *mesh;
    sp_surface surfaces[SHAPE_PARTS];
    sp_setup setup;
} room;

/* A box with a post in it that stands in the way. */
static void make_room(room *r)
{
    shape s = shape_create();
    shape_part(&s, "walls");
    shape_box(&s, sp_v(-1, -1, 0), sp_v(1, 1, 2), true);
    shape_part(&s, "post");
    shape_box(&s, sp_v(0.3, -0.2, 0.1), sp_v(0.5, 0.2, 1.5), false);
    *r = (room){.mesh = shape_mesh(&s), .setup = sp_setup_default()};
    for (size_t i = 0; i < SHAPE_PARTS; i++)
        r->surfaces[i] = (sp_surface){.clean = true, .rebound = 0.5};
    r->setup.mesh = r->mesh;
    r->setup.surfaces = r->surfaces;
    r->setup.fidelity.texel = 0.2;
    r->setup.run.threads = 1;
    r->setup.fidelity.jets = 500;
    r->setup.criterion = (sp_criterion){.flux = 1e-6, .impact_speed = 1, .incidence = 1.4};
}

static sp_nozzle nozzle_of(const sp_nozzle_type *type, double x)
{
    return (sp_nozzle){.name = "N", .type = type, .position = {x, 0.1, 1.3}, .axis = {0.8, 0, 0.6}, .pressure = 2e4};
}

static sp_coverage *evaluate(room *r, sp_trajectory scene, sp_method method, const sp_nozzle *nozzles, size_t count)
{
    sp_error error = {0};
    r->setup.fidelity.trajectory = scene;
    r->setup.fidelity.method = method;
    for (size_t i = 0; i < SHAPE_PARTS; i++)
        r->surfaces[i].restitution = method == SP_METHOD_FORWARD ? 0.3 : 0;
    r->setup.fidelity.reflections = method == SP_METHOD_FORWARD ? 2 : 0; /* walls throw some back */
    sp_evaluator *evaluator = sp_evaluator_create(&r->setup, &error);
    sp_layout *layout = sp_layout_create(nozzles, count, &error);
    sp_coverage *coverage = sp_evaluate(evaluator, layout, &error);
    assert_string_equal(error.message, "");
    assert_non_null(coverage);
    /* points and jets of drops take long */
    bool drops = scene == SP_TRAJECTORY_DRAG || nozzles[0].type->trajectory == SP_TRAJECTORY_DRAG;
    assert_true(drops || method == SP_METHOD_FORWARD ||
                sp_measure_error(evaluator, layout, coverage, SP_TRAJECTORY_AUTO, 7, &coverage->measured, &error));
    assert_true((drops && scene != SP_TRAJECTORY_LINE) || sp_evaluate_balance(evaluator, layout, coverage, &error));
    sp_layout_destroy(layout);
    sp_evaluator_destroy(evaluator);
    return coverage;
}

static void assert_same(const sp_coverage *a, const sp_coverage *b)
{
    size_t count = a->deposits.count;
    assert_int_equal(count, b->deposits.count);
    assert_memory_equal(a->deposits.flux, b->deposits.flux, count * sizeof *a->deposits.flux);
    assert_memory_equal(a->deposits.speed, b->deposits.speed, count * sizeof *a->deposits.speed);
    assert_memory_equal(a->deposits.covered, b->deposits.covered, count * sizeof *a->deposits.covered);
    if (a->balance.known && b->balance.known)
        assert_true(a->balance.clean == b->balance.clean && a->balance.left == b->balance.left);
    if (a->measured.known && b->measured.known)
        assert_true(a->measured.estimate == b->measured.estimate);
}

static void a_type_flies_its_own_way_in_any_scene(void **state)
{
    (void)state;
    static const sp_method methods[] = {SP_METHOD_INVERSE, SP_METHOD_FORWARD};
    room r;
    make_room(&r);
    for (int m = 0; m < 2; m++) {
        double clean[WAYS];
        for (int own = 0; own < WAYS; own++) {
            sp_nozzle_type type = slow_cone;
            sp_nozzle nozzle = nozzle_of(&type, -0.6);
            sp_coverage *wanted = evaluate(&r, ways[own], methods[m], &nozzle, 1);
            clean[own] = wanted->covered_area;
            type.trajectory = ways[own];
            for (int scene = 0; scene < WAYS; scene++) {
                sp_coverage *found = evaluate(&r, ways[scene], methods[m], &nozzle, 1);
                assert_same(wanted, found);
                sp_coverage_destroy(found);
            }
            sp_coverage_destroy(wanted);
        }
        /* or the ways would not be told apart */
        assert_true(clean[0] != clean[1] && clean[1] != clean[2] && clean[0] != clean[2]);
    }
    sp_mesh_destroy(r.mesh);
}

/* What nozzles of three ways bring adds up, also as members of one cluster. */
static void ways_mix(void **state)
{
    (void)state;
    room r;
    make_room(&r);
    sp_nozzle_type types[WAYS];
    sp_nozzle nozzles[WAYS];
    sp_member members[WAYS];
    sp_coverage *alone[WAYS];
    for (int i = 0; i < WAYS; i++) {
        types[i] = slow_cone;
        types[i].trajectory = ways[i];
        nozzles[i] = nozzle_of(&types[i], -0.6);
        members[i] = (sp_member){.type = types[i], .axis = {0, 0, 1}, .share = 1};
        alone[i] = evaluate(&r, SP_TRAJECTORY_PARABOLA, SP_METHOD_INVERSE, &nozzles[i], 1);
    }
    sp_nozzle_type cluster = slow_cone;
    cluster.pattern = SP_PATTERN_CLUSTER;
    cluster.angle = 0;
    cluster.flow *= WAYS;
    cluster.members = members;
    cluster.member_count = WAYS;
    sp_nozzle body = nozzle_of(&cluster, -0.6);
    sp_coverage *all[] = {evaluate(&r, SP_TRAJECTORY_LINE, SP_METHOD_INVERSE, nozzles, WAYS),
                          evaluate(&r, SP_TRAJECTORY_LINE, SP_METHOD_INVERSE, &body, 1)};
    for (int k = 0; k < 2; k++) {
        for (size_t p = 0; p < all[k]->deposits.count; p++) {
            double sum = 0;
            for (int i = 0; i < WAYS; i++)
                sum += alone[i]->deposits.flux[p];
            assert_true(fabs(all[k]->deposits.flux[p] - sum) <= 1e-12 * sum);
        }
        sp_coverage_destroy(all[k]);
    }
    for (int i = 0; i < WAYS; i++)
        sp_coverage_destroy(alone[i]);
    sp_mesh_destroy(r.mesh);
}

/* Where lines stand for parabolas nothing is bounded that has a way of its own. */
static void own_ways_are_not_bounded(void **state)
{
    (void)state;
    room r;
    make_room(&r);
    r.setup.fidelity.trajectory = SP_TRAJECTORY_LINE;
    r.setup.fidelity.method = SP_METHOD_INVERSE;
    sp_error error = {0};
    sp_evaluator *evaluator = sp_evaluator_create(&r.setup, &error);
    sp_nozzle_type type = slow_cone;
    sp_nozzle nozzle = nozzle_of(&type, -0.6);
    double bound[2];
    for (int own = 0; own < 2; own++) {
        type.trajectory = own ? SP_TRAJECTORY_PARABOLA : SP_TRAJECTORY_AUTO;
        sp_layout *layout = sp_layout_create(&nozzle, 1, &error);
        assert_true(sp_bound_lines(evaluator, layout, &bound[own], NULL, &error));
        sp_layout_destroy(layout);
    }
    assert_true(bound[0] < 1);
    assert_true(bound[1] == 1);
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(r.mesh);
}

static void drops_want_air(void **state)
{
    (void)state;
    room r;
    make_room(&r);
    r.setup.air.viscosity = 0;
    sp_error error = {0};
    sp_evaluator *evaluator = sp_evaluator_create(&r.setup, &error);
    assert_non_null(evaluator);
    sp_nozzle_type type = slow_cone;
    type.trajectory = SP_TRAJECTORY_DRAG;
    sp_nozzle nozzle = nozzle_of(&type, -0.6);
    sp_layout *layout = sp_layout_create(&nozzle, 1, &error);
    assert_null(sp_evaluate(evaluator, layout, &error));
    assert_non_null(strstr(error.message, "expected air"));
    sp_layout_destroy(layout);
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(r.mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_type_flies_its_own_way_in_any_scene),
        cmocka_unit_test(ways_mix),
        cmocka_unit_test(own_ways_are_not_bounded),
        cmocka_unit_test(drops_want_air),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
