/* What is lost without a nozzle, against evaluating the layout without it, whatever liquid does and whatever counts. */
#include "shapes.h"

#include "spray/alone.h"

#include <math.h>

#define NOZZLES 4

/* A room of 1 m, its front inside, with a plate in the middle that moves where there is a sweep. */
typedef struct {
    sp_mesh *mesh;
    sp_surface surfaces[SHAPE_PARTS];
    sp_setup setup;
    sp_evaluator *evaluator;
} room;

static void room_open(room *r, sp_method method, sp_criterion criterion, double restitution, sp_sweep sweep)
{
    shape s = shape_create();
    sp_error error = {0};
    shape_part(&s, "room");
    shape_box(&s, sp_v(0, 0, 0), sp_v(1, 1, 1), true);
    shape_part(&s, "plate");
    shape_sheet(&s, sp_v(0.3, 0.3, 0.4), sp_v(0.3, 0, 0), sp_v(0, 0.3, 0), 1);
    *r = (room){.mesh = shape_mesh(&s), .setup = sp_setup_default()};
    for (int i = 0; i < 2; i++)
        r->surfaces[i] = (sp_surface){true, restitution, 1, i == 1 && sweep.speed > 0};
    r->setup.mesh = r->mesh;
    r->setup.surfaces = r->surfaces;
    r->setup.cavity = criterion.film > 0 ? SP_CAVITY_POINT : SP_CAVITY_NONE;
    r->setup.cavity_point = sp_v(0.5, 0.5, 0.6);
    r->setup.criterion = criterion;
    r->setup.sweep = sweep;
    r->setup.fidelity.texel = 0.05;
    r->setup.fidelity.method = method;
    r->setup.fidelity.trajectory = SP_TRAJECTORY_PARABOLA;
    r->setup.fidelity.reflections = restitution > 0 ? 2 : 0;
    r->setup.fidelity.jets = 5000;
    r->setup.fidelity.accuracy = 0.1;
    r->evaluator = sp_evaluator_create(&r->setup, &error);
    assert_string_equal(error.message, "");
    assert_non_null(r->evaluator);
}

static void room_close(room *r)
{
    sp_evaluator_destroy(r->evaluator);
    sp_mesh_destroy(r->mesh);
}

static sp_nozzle_type rated(sp_pattern pattern, double angle)
{
    return (sp_nozzle_type){.name = "type",
                            .pattern = pattern,
                            .angle = angle,
                            .thickness = 0.3,
                            .flow = 5e-5,
                            .at = 1e5,
                            .exponent = 0.5,
                            .cv = 0.95};
}

/* Two cones of which one lies in the other, a fan and a solid stream. */
static sp_layout *four(const sp_nozzle_type types[NOZZLES])
{
    static const sp_vec3 places[NOZZLES] = {{0.45, 0.5, 0.8}, {0.55, 0.5, 0.8}, {0.2, 0.7, 0.5}, {0.5, 0.2, 0.3}};
    static const sp_vec3 axes[NOZZLES] = {{0, 0, -1}, {0, 0, -1}, {0.6, 0.8, 0}, {0, -0.6, -0.8}};
    sp_error error = {0};
    sp_layout *layout = sp_layout_create(NULL, NOZZLES, &error);
    assert_non_null(layout);
    for (int i = 0; i < NOZZLES; i++)
        layout->nozzles[i] = (sp_nozzle){
            .name = "N", .type = &types[i], .position = places[i], .axis = axes[i], .roll = 0.3, .pressure = 1e5};
    return layout;
}

static double covered(const room *r, const sp_nozzle *nozzles, size_t count)
{
    sp_error error = {0};
    sp_layout *layout = sp_layout_create(nozzles, count, &error);
    sp_coverage *coverage = sp_evaluate(r->evaluator, layout, &error);
    assert_string_equal(error.message, "");
    assert_non_null(coverage);
    double area = coverage->covered_area;
    sp_coverage_destroy(coverage);
    sp_layout_destroy(layout);
    return area;
}

static void near(double value, double expected)
{
    if (!(fabs(value - expected) <= 1e-9))
        fail_msg("%.12g found, %.12g expected", value, expected);
}

/* What the nozzles cover, from what each does alone. */
static double joined(const room *r, const sp_layout *layout)
{
    sp_error error = {0};
    sp_alone all, one;
    assert_true(sp_alone_create(r->evaluator, NULL, &all, &error));
    for (size_t i = 0; i < layout->count; i++) {
        const sp_layout single = {.count = 1, .nozzles = &layout->nozzles[i]};
        sp_coverage *coverage = sp_evaluate(r->evaluator, &single, &error);
        assert_true(coverage && sp_alone_create(r->evaluator, coverage, &one, &error));
        sp_alone_join(r->evaluator, &all, &one, !sp_layout_repeats(layout, i, &r->setup.liquid));
        sp_alone_free(&one);
        sp_coverage_destroy(coverage);
    }
    double area = sp_alone_covered(r->evaluator, &all);
    sp_alone_free(&all);
    return area;
}

static void compare(const room *r, const sp_layout *layout)
{
    sp_error error = {0};
    sp_coverage *coverage = sp_evaluate(r->evaluator, layout, &error);
    sp_contributions *does = sp_contributions_create(r->evaluator, layout, coverage, &error);
    assert_string_equal(error.message, "");
    assert_non_null(does);
    double worth = 0, shared = 0;
    for (size_t i = 0; i < NOZZLES; i++) {
        sp_nozzle others[NOZZLES];
        memcpy(others, layout->nozzles, sizeof others);
        others[i] = others[NOZZLES - 1];
        near(does->alone[i], covered(r, &layout->nozzles[i], 1));
        near(does->lost[i], coverage->covered_area - covered(r, others, NOZZLES - 1));
        worth += does->lost[i];
        shared += fabs(does->alone[i] - does->lost[i]);
    }
    assert_true(worth > 0.01 && shared > 0.01);
    near(joined(r, layout), coverage->covered_area);
    sp_contributions_destroy(does);
    sp_coverage_destroy(coverage);
}

static void lost_is_what_evaluating_without_it_says(void **state)
{
    (void)state;
    sp_member members[2] = {{.type = rated(SP_PATTERN_FULL_CONE, 0.6), .axis = {0, 0, 1}, .share = 1},
                            {.type = rated(SP_PATTERN_FULL_CONE, 0.9), .axis = {0, 0.6, 0.8}, .share = 2}};
    sp_nozzle_type types[NOZZLES] = {rated(SP_PATTERN_CLUSTER, 0), rated(SP_PATTERN_FULL_CONE, 0.8),
                                     rated(SP_PATTERN_FLAT_FAN, 1.2), rated(SP_PATTERN_SOLID_STREAM, 0.1)};
    types[0].member_count = 2;
    types[0].members = members;
    const sp_sweep rest = {0}, pass = {.from = {-0.1, 0, 0}, .to = {0.1, 0, 0}, .speed = 0.1};
    static const sp_criterion any = {0, 0, M_PI / 2, SP_COMBINE_SUM, 0}, much = {1e-4, 1, 1.4, SP_COMBINE_SUM, 0},
                              single = {1e-4, 1, 1.4, SP_COMBINE_SINGLE, 0},
                              film = {1e-4, 1, 1.4, SP_COMBINE_SUM, 2e-5};
    const struct {
        const sp_criterion *criterion;
        sp_method method;
        double restitution;
        sp_sweep sweep;
    } cases[] = {
        {&any, SP_METHOD_INVERSE, 0, rest},    {&much, SP_METHOD_INVERSE, 0, rest},
        {&single, SP_METHOD_INVERSE, 0, rest}, {&film, SP_METHOD_INVERSE, 0, rest},
        {&much, SP_METHOD_FORWARD, 0.5, rest}, {&single, SP_METHOD_FORWARD, 0.5, rest},
        {&film, SP_METHOD_FORWARD, 0, rest},   {&much, SP_METHOD_INVERSE, 0, pass},
    };
    sp_layout *layout = four(types);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        room r;
        room_open(&r, cases[i].method, *cases[i].criterion, cases[i].restitution, cases[i].sweep);
        compare(&r, layout);
        room_close(&r);
    }
    sp_layout_destroy(layout);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(lost_is_what_evaluating_without_it_says)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
