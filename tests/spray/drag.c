/* Both evaluators with drag: one against the other, and what rebounds. */
#include "shapes.h"

#include "spray/drag/integrate.h"

static const sp_nozzle_type cone = {.name = "cone",
                                    .pattern = SP_PATTERN_FULL_CONE,
                                    .angle = 2,
                                    .flow = 1e-4,
                                    .at = 2e5,
                                    .exponent = 0.5,
                                    .cv = 0.95,
                                    .drop = 5e-4};

typedef struct {
    sp_mesh *mesh;
    sp_surface surfaces[SHAPE_PARTS];
    sp_setup setup;
} room;

static room room_of(shape *s)
{
    room r = {.mesh = shape_mesh(s), .setup = sp_setup_default()};
    for (size_t i = 0; i < SHAPE_PARTS; i++)
        r.surfaces[i] = (sp_surface){.clean = true, .rebound = 1};
    r.setup.mesh = r.mesh;
    r.setup.fidelity.trajectory = SP_TRAJECTORY_DRAG;
    r.setup.fidelity.method = SP_METHOD_INVERSE;
    r.setup.fidelity.texel = 0.05;
    r.setup.fidelity.jets = 20000;
    return r;
}

/* A box with a post in it, that stands in the way. */
static room box_with_post(void)
{
    shape s = shape_create();
    shape_part(&s, "walls");
    shape_box(&s, sp_v(-1, -1, 0), sp_v(1, 1, 2), true);
    shape_part(&s, "post");
    shape_box(&s, sp_v(0.3, -0.2, 0.1), sp_v(0.5, 0.2, 1.5), false);
    return room_of(&s);
}

static sp_coverage *evaluate(room *r, const sp_nozzle *nozzle, sp_method method, int threads, sp_evaluator **evaluator)
{
    sp_error error = {0};
    r->setup.surfaces = r->surfaces;
    r->setup.run.threads = threads;
    r->setup.fidelity.method = method;
    *evaluator = sp_evaluator_create(&r->setup, &error);
    sp_layout *layout = sp_layout_create(nozzle, 1, &error);
    sp_coverage *coverage = sp_evaluate(*evaluator, layout, &error);
    assert_string_equal(error.message, "");
    sp_layout_destroy(layout);
    return coverage;
}

/* m³/s on what lies on one side of a height, and its mean speed. */
static double part_of(const sp_evaluator *evaluator, const sp_coverage *coverage, double low, double high,
                      double *speed)
{
    const sp_patches *patches = sp_evaluator_patches(evaluator);
    double sum = 0;
    *speed = 0;
    for (size_t i = 0; i < patches->count; i++) {
        double flow = coverage->deposits.flux[i] * patches->area[i];
        bool within = patches->point[i].z >= low && patches->point[i].z < high;
        sum += within ? flow : 0;
        *speed += within && flow > 0 ? flow * coverage->deposits.speed[i] : 0;
    }
    *speed /= sum;
    return sum;
}

/* Fluxes, speeds and what stands in the way, in bands of height, of drops fine and coarse, aimed up, down and aside. */
static void both_evaluators_agree(void **state)
{
    (void)state;
    static const double drops[] = {4e-4, 2e-3};
    static const sp_vec3 axes[] = {{0, 0, -1}, {1, 0, 0.3}, {0, 0.2, 1}};
    room r = box_with_post();
    for (int i = 0; i < 6; i++) {
        sp_nozzle_type type = cone;
        type.drop = drops[i % 2];
        sp_nozzle nozzle = {
            .type = &type, .position = sp_v(-0.3, 0.1, 1.1), .axis = sp_unit(axes[i / 2]), .pressure = 2e5};
        sp_evaluator *one, *other;
        sp_coverage *inverse = evaluate(&r, &nozzle, SP_METHOD_INVERSE, 2, &one);
        sp_coverage *forward = evaluate(&r, &nozzle, SP_METHOD_FORWARD, 2, &other);
        for (int band = 0; band < 4; band++) {
            double low = band ? 0.5 * band : -1, high = band < 3 ? 0.5 * (band + 1) : 3, speed[2];
            double found = part_of(one, inverse, low, high, &speed[0]);
            double jets = part_of(other, forward, low, high, &speed[1]);
            if (fabs(found - jets) > 0.015 * 1e-4 || (jets > 0.05e-4 && fabs(speed[0] / speed[1] - 1) > 0.02))
                fail_msg("%d, band %d: %.4g and %.4g m³/s, %.4g and %.4g m/s", i, band, found, jets, speed[0],
                         speed[1]);
        }
        sp_coverage_destroy(inverse);
        sp_coverage_destroy(forward);
        sp_evaluator_destroy(one);
        sp_evaluator_destroy(other);
    }
    sp_mesh_destroy(r.mesh);
}

static void same_bytes_for_any_number_of_threads(void **state)
{
    (void)state;
    room r = box_with_post();
    r.surfaces[1].restitution = 0.5;
    r.setup.fidelity.reflections = 2;
    r.setup.fidelity.jets = 20000;
    sp_nozzle nozzle = {.type = &cone, .position = sp_v(-0.3, 0.1, 1.1), .axis = sp_v(1, 0, 0), .pressure = 2e5};
    for (int forward = 0; forward < 2; forward++) {
        sp_method method = forward ? SP_METHOD_FORWARD : SP_METHOD_INVERSE;
        r.setup.fidelity.reflections = forward ? 2 : 0;
        sp_evaluator *one, *three;
        sp_coverage *a = evaluate(&r, &nozzle, method, 1, &one), *b = evaluate(&r, &nozzle, method, 3, &three);
        size_t bytes = a->deposits.count * sizeof *a->deposits.flux;
        assert_memory_equal(a->deposits.flux, b->deposits.flux, bytes);
        assert_memory_equal(a->deposits.speed, b->deposits.speed, bytes);
        assert_memory_equal(&a->balance, &b->balance, sizeof a->balance);
        sp_coverage_destroy(a);
        sp_coverage_destroy(b);
        sp_evaluator_destroy(one);
        sp_evaluator_destroy(three);
    }
    sp_mesh_destroy(r.mesh);
}

/* The speed (m/s) upwards of a drop that has risen, or fallen, so far from where it had this speed upwards. */
static double speed_after(const sp_drag *drag, double speed, double rise)
{
    sp_march march = sp_march_from(drag, sp_v(0, 0, -9.81), sp_v(0, 0, 0), sp_v(0, 0, speed));
    sp_leg leg = sp_march_on(&march, 1e-9);
    while ((leg.to.point.z - rise) * rise < 0)
        leg = sp_march_on(&march, 1e-9);
    double low = 0, high = leg.time;
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (low + high);
        *((sp_leg_at(&leg, middle).point.z - rise) * rise < 0 ? &low : &high) = middle;
    }
    return sp_leg_at(&leg, low).velocity.z;
}

/* Drops that a floor throws back come to the ceiling as slow as they would be after both ways. A stream that has not
 * broken up when it meets the floor is drops from there. */
static void what_rebounds_feels_drag(void **state)
{
    (void)state;
    for (int stream = 0; stream < 2; stream++) {
        shape s = shape_create();
        shape_part(&s, "floor");
        shape_sheet(&s, sp_v(-1, -1, 0), sp_v(2, 0, 0), sp_v(0, 2, 0), 1);
        shape_part(&s, "ceiling");
        shape_sheet(&s, sp_v(-1, -1, 0.7), sp_v(2, 0, 0), sp_v(0, 2, 0), 1);
        room r = room_of(&s);
        r.surfaces[0].restitution = 0.9;
        r.setup.fidelity.reflections = 1;
        r.setup.fidelity.jets = 500;
        sp_nozzle_type type = cone;
        type.pattern = stream ? SP_PATTERN_SOLID_STREAM : SP_PATTERN_FULL_CONE;
        type.angle = 1e-3;
        type.drop = 1e-3;
        sp_nozzle nozzle = {
            .type = &type, .position = sp_v(0.013, 0.011, 0.3), .axis = sp_v(0, 0, -1), .pressure = 2e5};
        sp_drag drag = sp_drag_of(&nozzle, &r.setup.liquid, &r.setup.air);
        double speed = sp_nozzle_speed(&nozzle, &r.setup.liquid), least = stream ? 0.3 / speed : 0;
        assert_true(stream ? drag.delay > least : drag.delay == 0);
        double down = speed_after(&drag, -speed, -0.3);
        drag.delay = 0;
        double up = speed_after(&drag, -0.9 * down, 0.7), found[2];
        sp_evaluator *evaluator;
        sp_coverage *coverage = evaluate(&r, &nozzle, SP_METHOD_FORWARD, 2, &evaluator);
        part_of(evaluator, coverage, -1, 0.1, &found[0]);
        double arriving = part_of(evaluator, coverage, 0.6, 1, &found[1]);
        assert_true(fabs(arriving / 1e-4 - 1) < 1e-9);
        assert_true(fabs(found[0] / -down - 1) < 1e-5 && fabs(found[1] / up - 1) < 1e-5);
        assert_true(fabs(down) < sqrt(speed * speed + 2 * 9.81 * 0.3) * (stream ? 1 + 1e-9 : 0.97));
        assert_true(fabs(coverage->balance.clean / 1e-4 - 1) < 1e-9);
        sp_coverage_destroy(coverage);
        sp_evaluator_destroy(evaluator);
        sp_mesh_destroy(r.mesh);
    }
}

/* Mist goes nowhere but down: fine drops fall from where they stop, and none is lost or found. */
static void mist_falls(void **state)
{
    (void)state;
    room r = box_with_post();
    sp_nozzle_type type = cone;
    type.drop = 5e-6;
    sp_nozzle nozzle = {.type = &type, .position = sp_v(-0.3, 0.1, 1.1), .axis = sp_v(0, 0, 1), .pressure = 2e5};
    sp_evaluator *evaluator;
    r.setup.fidelity.jets = 2000;
    sp_coverage *coverage = evaluate(&r, &nozzle, SP_METHOD_FORWARD, 2, &evaluator);
    double speed, flow = part_of(evaluator, coverage, -1, 0.01, &speed);
    assert_true(fabs(flow / 1e-4 - 1) < 1e-9);
    assert_true(speed > 6e-4 && speed < 9e-4); /* Stokes: 7.6e-4 m/s */
    sp_coverage_destroy(coverage);
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(r.mesh);
}

static void drops_without_size_are_refused(void **state)
{
    (void)state;
    room r = box_with_post();
    sp_nozzle_type type = cone;
    type.drop = 0;
    sp_nozzle nozzle = {.type = &type, .position = sp_v(-0.3, 0.1, 1.1), .axis = sp_v(0, 0, 1), .pressure = 2e5};
    sp_error error = {0};
    r.setup.surfaces = r.surfaces;
    sp_evaluator *evaluator = sp_evaluator_create(&r.setup, &error);
    sp_layout *layout = sp_layout_create(&nozzle, 1, &error);
    assert_null(sp_evaluate(evaluator, layout, &error));
    assert_non_null(strstr(error.message, "trajectory: drag found with drops of 0 m"));
    error = (sp_error){0};
    assert_null(sp_evaluator_reach(evaluator, nozzle.position, (sp_launch){.speed = 10}, nozzle.axis, 1, &error));
    assert_int_equal(error.kind, SP_ERROR_ARGUMENT);
    sp_layout_destroy(layout);
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(r.mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_evaluators_agree),          cmocka_unit_test(same_bytes_for_any_number_of_threads),
        cmocka_unit_test(what_rebounds_feels_drag),       cmocka_unit_test(mist_falls),
        cmocka_unit_test(drops_without_size_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
