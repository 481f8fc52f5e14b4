/* Where the liquid ends, and how it is spread over the surface, against what can be worked out by hand. */
#include "shapes.h"

static const sp_nozzle_type ball = {.name = "ball",
                                    .pattern = SP_PATTERN_FULL_CONE,
                                    .angle = 2 * M_PI,
                                    .flow = 1e-4,
                                    .at = 2e5,
                                    .exponent = 0.5,
                                    .cv = 0.95};

enum { LID, FLOOR, WALLS, PARTS };

/* A cube of 2 m about the origin, its front inside. */
static sp_mesh *cube(bool lidded)
{
    static const sp_vec3 x = {2, 0, 0}, y = {0, 2, 0}, z = {0, 0, 2};
    shape s = shape_create();
    shape_part(&s, "lid");
    if (lidded)
        shape_sheet(&s, sp_v(-1, -1, 1), y, x, 1);
    shape_part(&s, "floor");
    shape_sheet(&s, sp_v(-1, -1, -1), x, y, 1);
    shape_part(&s, "walls");
    shape_sheet(&s, sp_v(-1, -1, -1), y, z, 1);
    shape_sheet(&s, sp_v(-1, -1, -1), z, x, 1);
    shape_sheet(&s, sp_v(1, -1, -1), z, y, 1);
    shape_sheet(&s, sp_v(-1, 1, -1), x, z, 1);
    return shape_mesh(&s);
}

typedef struct {
    sp_mesh *mesh;
    sp_surface surfaces[PARTS];
    sp_setup setup;
} fixture;

static void open_fixture(fixture *f, bool lidded, sp_method method)
{
    *f = (fixture){.mesh = cube(lidded), .setup = sp_setup_default()};
    for (size_t i = 0; i < PARTS; i++)
        f->surfaces[i] = (sp_surface){.clean = true, .restitution = 0, .rebound = 1};
    f->setup.mesh = f->mesh;
    f->setup.surfaces = f->surfaces;
    f->setup.fidelity.trajectory = SP_TRAJECTORY_LINE;
    f->setup.fidelity.method = method;
    f->setup.fidelity.texel = 0.1;
    f->setup.fidelity.jets = 100000;
}

/* Of a ball in the middle, as shares of its flow. */
static sp_balance balance_of(const fixture *f, int threads)
{
    sp_error error = {0};
    sp_setup setup = f->setup;
    setup.run.threads = threads;
    sp_evaluator *evaluator = sp_evaluator_create(&setup, &error);
    sp_nozzle nozzle = {.type = &ball, .axis = sp_v(0, 0, 1), .pressure = 2e5};
    sp_layout *layout = sp_layout_create(&nozzle, 1, &error);
    sp_coverage *coverage = sp_evaluate(evaluator, layout, &error);
    assert_string_equal(error.message, "");
    assert_int_equal(coverage->balance.known, setup.fidelity.method == SP_METHOD_FORWARD);
    assert_true(sp_evaluate_balance(evaluator, layout, coverage, &error));
    sp_balance balance = coverage->balance;
    assert_true(balance.known);
    double flow = coverage->flow, sum = balance.clean + balance.other + balance.left + balance.unfollowed;
    assert_true(fabs(sum - flow) < 1e-9 * flow);
    sp_coverage_destroy(coverage);
    sp_layout_destroy(layout);
    sp_evaluator_destroy(evaluator);
    return (sp_balance){true, balance.clean / flow, balance.other / flow, balance.left / flow,
                        balance.unfollowed / flow};
}

static void assert_shares(const sp_balance *found, double clean, double other, double left, double unfollowed)
{
    if (fabs(found->clean - clean) > 1e-3 || fabs(found->other - other) > 1e-3 || fabs(found->left - left) > 1e-3 ||
        fabs(found->unfollowed - unfollowed) > 1e-3)
        fail_msg("clean %g, other %g, left %g, unfollowed %g", found->clean, found->other, found->left,
                 found->unfollowed);
}

/* Each face is seen under a sixth of the sphere. */
static void a_sixth_leaves_where_the_lid_is_missing(void **state)
{
    (void)state;
    for (int forward = 0; forward < 2; forward++) {
        fixture f;
        open_fixture(&f, false, forward ? SP_METHOD_FORWARD : SP_METHOD_INVERSE);
        f.surfaces[FLOOR].clean = false;
        sp_balance one = balance_of(&f, 1), three = balance_of(&f, 3);
        assert_shares(&one, 4.0 / 6, 1.0 / 6, 1.0 / 6, 0);
        assert_true(one.clean == three.clean && one.other == three.other && one.left == three.left);
        sp_mesh_destroy(f.mesh);
    }
}

/* Half stays where it lands, half flies on: of what flies on half again, and what then would fly on is not followed. */
static void what_is_thrown_back_for_the_last_time_is_not_followed(void **state)
{
    (void)state;
    for (int reflections = 0; reflections < 3; reflections++) {
        fixture f;
        open_fixture(&f, true, reflections ? SP_METHOD_FORWARD : SP_METHOD_INVERSE);
        f.setup.fidelity.reflections = reflections;
        for (size_t i = 0; i < PARTS; i++)
            f.surfaces[i] = (sp_surface){.clean = true, .restitution = 0.5, .rebound = 0.5};
        sp_balance balance = balance_of(&f, 2);
        double unfollowed = pow(0.5, reflections + 1);
        assert_shares(&balance, 1 - unfollowed, 0, 0, unfollowed);
        sp_mesh_destroy(f.mesh);
    }
}

/* The dry side of a clean wall takes liquid and is not clean for it. */
static void a_dry_side_is_other_surface(void **state)
{
    (void)state;
    fixture f;
    open_fixture(&f, true, SP_METHOD_INVERSE);
    f.setup.cavity = SP_CAVITY_OUTSIDE;
    sp_balance balance = balance_of(&f, 2);
    assert_shares(&balance, 0, 1, 0, 0);
    sp_mesh_destroy(f.mesh);
}

/* 5 % of the surface gets less than the 5th percentile and 95 % more, in any order in which one adds them up. */
static void assert_percentile(const sp_patches *patches, const sp_coverage *coverage)
{
    double below = 0, up_to = 0, lowest = INFINITY, highest = 0, liquid = 0;
    for (size_t i = 0; i < patches->count; i++) {
        double flux = coverage->deposits.flux[i];
        below += flux < coverage->flux_p05 ? patches->area[i] : 0;
        up_to += flux <= coverage->flux_p05 ? patches->area[i] : 0;
        lowest = fmin(lowest, flux);
        highest = fmax(highest, flux);
        liquid += flux * patches->area[i];
    }
    assert_true(coverage->flux_p05 > lowest && coverage->flux_p05 < coverage->flux_mean);
    assert_true(below <= 0.05 * patches->total_area && up_to >= 0.05 * patches->total_area);
    assert_true(coverage->flux_min == lowest && coverage->flux_max == highest);
    assert_true(fabs(coverage->flux_mean * patches->total_area - liquid) < 1e-9 * liquid);
}

/* From the middle to near a wall, so that what gets little is little of the surface, and more. */
static void the_percentile_of_the_flux_is_by_area(void **state)
{
    (void)state;
    fixture f;
    open_fixture(&f, true, SP_METHOD_INVERSE);
    sp_error error = {0};
    sp_evaluator *evaluator = sp_evaluator_create(&f.setup, &error);
    for (int i = 0; i < 20; i++) {
        sp_nozzle nozzle = {
            .type = &ball, .position = sp_v(0.045 * i, 0.2, 0.1), .axis = sp_v(0, 0, 1), .pressure = 2e5};
        sp_layout *layout = sp_layout_create(&nozzle, 1, &error);
        sp_coverage *coverage = sp_evaluate(evaluator, layout, &error);
        assert_non_null(coverage);
        assert_percentile(sp_evaluator_patches(evaluator), coverage);
        sp_coverage_destroy(coverage);
        sp_layout_destroy(layout);
    }
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(f.mesh);
}

/* In the middle; above the lid; in the lid; in the lid's corner. Where no cavity is named only walls are refused. */
static void a_nozzle_stands_in_the_liquid(void **state)
{
    (void)state;
    static const sp_vec3 places[] = {{0, 0, 0}, {0, 0, 3}, {0.2, 0.1, 1}, {1, 1, 1}};
    static const bool stands[3][4] = {
        {true, true, false, false}, {true, false, false, false}, {false, true, false, false}};
    static const sp_cavity_kind cavities[] = {SP_CAVITY_NONE, SP_CAVITY_POINT, SP_CAVITY_OUTSIDE};
    for (int c = 0; c < 3; c++) {
        fixture f;
        open_fixture(&f, true, SP_METHOD_INVERSE);
        f.setup.cavity = cavities[c];
        f.setup.cavity_point = sp_v(0.1, 0, 0);
        sp_error error = {0};
        sp_evaluator *evaluator = sp_evaluator_create(&f.setup, &error);
        for (int i = 0; i < 4; i++) {
            sp_nozzle nozzle = {
                .name = "N1", .type = &ball, .position = places[i], .axis = sp_v(0, 0, 1), .pressure = 2e5};
            error = (sp_error){0};
            assert_int_equal(sp_evaluator_admits(evaluator, &nozzle, &error), stands[c][i]);
            assert_true(stands[c][i] || (error.kind == SP_ERROR_INPUT && strstr(error.message, "N1")));
        }
        sp_evaluator_destroy(evaluator);
        sp_mesh_destroy(f.mesh);
    }
}

/* Most of what it sees is sky, but it sees the cavity's point: it sprays into the tank from above. */
static void a_nozzle_may_stand_above_an_open_tank(void **state)
{
    (void)state;
    fixture f;
    open_fixture(&f, false, SP_METHOD_INVERSE);
    f.setup.cavity = SP_CAVITY_POINT;
    f.setup.cavity_point = sp_v(0, 0, 0);
    sp_error error = {0};
    sp_evaluator *evaluator = sp_evaluator_create(&f.setup, &error);
    sp_nozzle nozzle = {.type = &ball, .position = sp_v(0, 0.2, 1.5), .axis = sp_v(0, 0, -1), .pressure = 2e5};
    assert_true(sp_evaluator_admits(evaluator, &nozzle, &error));
    nozzle.position = sp_v(3, 0, -0.5);
    assert_false(sp_evaluator_admits(evaluator, &nozzle, &error));
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(f.mesh);
}

/* Two bodies with the cavity's point between: in either, whichever way they are turned, what parts the two is named,
 * and with a point beyond both that comes first, but of a nozzle that is out there too. */
static void where_the_cavity_lies_is_reported_of_a_nozzle_elsewhere(void **state)
{
    (void)state;
    static const struct {
        sp_vec3 nozzle, point;
        const char *told;
    } cases[] = {
        {{0.5, 0.5, 0.5}, {2, 0.5, 0.5}, "within part \"left\", and the cavity's point [2 m, 0.5 m, 0.5 m] is not"},
        {{3.5, 0.5, 0.5}, {2, 0.5, 0.5}, "within part \"right\", and"},
        {{3.5, 0.5, 0.5}, {2, 0.5, 3}, "cavity: the point (2 m, 0.5 m, 3 m) lies outside the geometry's box"},
        {{0.5, 0.5, 0.5}, {3.5, 0.5, 0.5}, "N1 at [0.5 m, 0.5 m, 0.5 m] is not inside the cavity"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        shape s = shape_create();
        shape_part(&s, "left");
        shape_box(&s, sp_v(0, 0, 0), sp_v(1, 1, 1), false);
        shape_part(&s, "right");
        shape_box(&s, sp_v(3, 0, 0), sp_v(4, 1, 1), true);
        fixture f = {.mesh = shape_mesh(&s), .setup = sp_setup_default()};
        f.surfaces[0] = f.surfaces[1] = (sp_surface){.clean = true, .rebound = 1};
        f.setup.mesh = f.mesh;
        f.setup.surfaces = f.surfaces;
        f.setup.fidelity.texel = 0.1;
        f.setup.cavity = SP_CAVITY_POINT;
        f.setup.cavity_point = cases[i].point;
        sp_error error = {0};
        sp_evaluator *evaluator = sp_evaluator_create(&f.setup, &error);
        sp_nozzle nozzle = {
            .name = "N1", .type = &ball, .position = cases[i].nozzle, .axis = sp_v(0, 0, 1), .pressure = 2e5};
        assert_non_null(evaluator);
        assert_false(sp_evaluator_admits(evaluator, &nozzle, &error));
        if (!strstr(error.message, cases[i].told))
            fail_msg("case %zu: no '%s' in %s", i, cases[i].told, error.message);
        sp_evaluator_destroy(evaluator);
        sp_mesh_destroy(f.mesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sixth_leaves_where_the_lid_is_missing),
        cmocka_unit_test(what_is_thrown_back_for_the_last_time_is_not_followed),
        cmocka_unit_test(a_dry_side_is_other_surface),
        cmocka_unit_test(the_percentile_of_the_flux_is_by_area),
        cmocka_unit_test(a_nozzle_stands_in_the_liquid),
        cmocka_unit_test(a_nozzle_may_stand_above_an_open_tank),
        cmocka_unit_test(where_the_cavity_lies_is_reported_of_a_nozzle_elsewhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
