/* Jets, deposits, coverage figures and shadows against what can be worked out by hand. */
#include "shapes.h"

typedef struct {
    sp_mesh *mesh;
    sp_surface surfaces[SHAPE_PARTS];
    sp_setup setup;
} fixture;

static const sp_nozzle_type cone = {.name = "cone",
                                    .pattern = SP_PATTERN_FULL_CONE,
                                    .angle = M_PI / 2,
                                    .flow = 1e-4,
                                    .at = 2e5,
                                    .exponent = 0.5,
                                    .cv = 0.95};

static sp_nozzle nozzle_at(sp_vec3 position, sp_vec3 axis)
{
    return (sp_nozzle){.type = &cone, .position = position, .axis = axis, .pressure = 2e5};
}

/* Straight jets, forward, one reflective surface per part as the test sets it. */
static fixture fixture_of(shape *s)
{
    fixture f = {.mesh = shape_mesh(s), .setup = sp_setup_default()};
    for (size_t i = 0; i < SHAPE_PARTS; i++)
        f.surfaces[i] = (sp_surface){.clean = true, .restitution = 0, .rebound = 1};
    f.setup.mesh = f.mesh;
    f.setup.run.threads = 2;
    f.setup.fidelity.trajectory = SP_TRAJECTORY_LINE;
    f.setup.fidelity.method = SP_METHOD_FORWARD;
    f.setup.fidelity.texel = 0.02;
    f.setup.fidelity.jets = 200000;
    return f;
}

static shape floor_shape(double half)
{
    shape s = shape_create();
    shape_part(&s, "floor");
    shape_sheet(&s, sp_v(-half, -half, 0), sp_v(2 * half, 0, 0), sp_v(0, 2 * half, 0), 1);
    return s;
}

static sp_coverage *evaluate(fixture *f, const sp_nozzle *nozzles, size_t count, sp_evaluator **evaluator)
{
    f->setup.surfaces = f->surfaces;
    sp_error error = {0};
    *evaluator = sp_evaluator_create(&f->setup, &error);
    assert_string_equal(error.message, "");
    sp_layout *layout = sp_layout_create(nozzles, count, &error);
    sp_coverage *coverage = sp_evaluate(*evaluator, layout, &error);
    assert_string_equal(error.message, "");
    assert_non_null(coverage);
    sp_layout_destroy(layout);
    return coverage;
}

/* Σ of a density over the patches, m³/s. */
static double liquid(const sp_evaluator *evaluator, const double *flux)
{
    const sp_patches *patches = sp_evaluator_patches(evaluator);
    double sum = 0;
    for (size_t i = 0; i < patches->count; i++)
        sum += flux[i] * patches->area[i];
    return sum;
}

static void assert_near(double found, double expected, double relative)
{
    if (!(fabs(found - expected) <= relative * fabs(expected)))
        fail_msg("found %.9g, expected %.9g within %g", found, expected, relative);
}

static void cone_on_floor(void **state)
{
    (void)state;
    shape s = floor_shape(1.5);
    fixture f = fixture_of(&s);
    sp_nozzle nozzle = nozzle_at(sp_v(0, 0, 1), sp_v(0, 0, -1));
    sp_evaluator *evaluator;
    sp_coverage *coverage = evaluate(&f, &nozzle, 1, &evaluator);
    /* A disc of radius 1, read high by about 4/π texel/R. */
    assert_near(coverage->covered_area, M_PI * (1 + 4 / M_PI * 0.02), 0.01);
    assert_near(coverage->area, 9, 1e-9);
    assert_near(coverage->fraction, coverage->covered_area / 9, 1e-12);
    assert_near(coverage->flow, 1e-4, 1e-12);
    assert_near(coverage->area_per_water, coverage->covered_area / 1e-4, 1e-12);
    assert_near(liquid(evaluator, coverage->deposits.flux), 1e-4, 1e-9);
    assert_near(coverage->flux_mean, 1e-4 / 9, 1e-9);
    assert_true(coverage->flux_min == 0 && coverage->flux_p05 == 0);

    const sp_patches *patches = sp_evaluator_patches(evaluator);
    double solid_angle = 2 * M_PI * (1 - cos(M_PI / 4)), speed = 0.95 * sqrt(2 * 2e5 / 1000);
    size_t compared = 0;
    double square = 0;
    for (size_t i = 0; i < patches->count; i++) {
        double r = hypot(patches->point[i].x, patches->point[i].y), angle = atan(r);
        if (r > 0.9 || patches->area[i] < 0.99 * 0.02 * 0.02)
            continue;
        double flux = 1e-4 / solid_angle * pow(cos(angle), 3);
        square += pow(coverage->deposits.flux[i] / flux - 1, 2);
        assert_near(coverage->deposits.speed[i], speed, 1e-9);
        assert_near(coverage->deposits.speed_max[i], speed, 1e-9);
        assert_true(fabs(coverage->deposits.incidence[i] - angle) < 0.02);
        assert_true(coverage->deposits.incidence_min[i] <= coverage->deposits.incidence[i] + 1e-12);
        assert_true(coverage->deposits.impact_max[i] >= coverage->deposits.impact[i] * (1 - 1e-12));
        assert_near(coverage->deposits.impact[i], 1000 * pow(speed * cos(angle), 2), 0.05);
        compared++;
    }
    assert_true(compared > 5000);
    assert_true(sqrt(square / (double)compared) < 0.15); /* some fifteen jets a texel; were they random, 0.26 */
    sp_coverage_destroy(coverage);
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(f.mesh);
}

/* The flux falls as cos³: the criterion draws a smaller circle, as do incidence and a speed that nothing reaches. */
static void criteria_draw_their_circles(void **state)
{
    (void)state;
    shape s = floor_shape(1.5);
    fixture f = fixture_of(&s);
    sp_nozzle nozzle = nozzle_at(sp_v(0, 0, 1), sp_v(0, 0, -1));
    double solid_angle = 2 * M_PI * (1 - cos(M_PI / 4)), radius = 0.7;
    f.setup.criterion.flux = 1e-4 / solid_angle * pow(cos(atan(radius)), 3);
    f.setup.fidelity.jets = 2000000;
    sp_evaluator *evaluator;
    sp_coverage *coverage = evaluate(&f, &nozzle, 1, &evaluator);
    assert_near(coverage->covered_area, M_PI * radius * radius, 0.01);
    sp_coverage_destroy(coverage);
    sp_evaluator_destroy(evaluator);

    f.setup.criterion.flux = 0;
    f.setup.criterion.incidence = atan(radius);
    coverage = evaluate(&f, &nozzle, 1, &evaluator);
    assert_near(coverage->covered_area, M_PI * radius * radius, 0.02);
    assert_near(liquid(evaluator, coverage->deposits.flux), 1e-4, 1e-9);
    double counted = 1e-4 * (1 - cos(atan(radius))) / (1 - cos(M_PI / 4));
    assert_near(liquid(evaluator, coverage->deposits.counted), counted, 0.001);
    sp_coverage_destroy(coverage);
    sp_evaluator_destroy(evaluator);

    f.setup.criterion.impact_speed = 19.1;
    coverage = evaluate(&f, &nozzle, 1, &evaluator);
    assert_true(coverage->covered_area == 0);
    sp_coverage_destroy(coverage);
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(f.mesh);
}

static void single_takes_the_best_nozzle(void **state)
{
    (void)state;
    shape s = floor_shape(1.5);
    fixture f = fixture_of(&s);
    sp_nozzle nozzles[2] = {nozzle_at(sp_v(0, 0, 1), sp_v(0, 0, -1)), nozzle_at(sp_v(0, 0, 1), sp_v(0, 0, -1))};
    nozzles[1].flow = 3e-4;
    sp_evaluator *evaluator;
    sp_coverage *sum = evaluate(&f, nozzles, 2, &evaluator);
    assert_near(liquid(evaluator, sum->deposits.counted), 4e-4, 1e-9);
    sp_evaluator_destroy(evaluator);
    f.setup.criterion.combine = SP_COMBINE_SINGLE;
    sp_coverage *single = evaluate(&f, nozzles, 2, &evaluator);
    assert_near(liquid(evaluator, single->deposits.counted), 3e-4, 1e-9);
    assert_near(liquid(evaluator, single->deposits.flux), 4e-4, 1e-9);
    sp_coverage_destroy(sum);
    sp_coverage_destroy(single);
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(f.mesh);
}

static void linear_splat_keeps_the_sum_and_is_smoother(void **state)
{
    (void)state;
    double spread[2];
    for (int linear = 0; linear < 2; linear++) {
        shape s = floor_shape(1.5);
        fixture f = fixture_of(&s);
        f.setup.fidelity.splat = linear ? SP_SPLAT_LINEAR : SP_SPLAT_NEAREST;
        sp_nozzle nozzle = nozzle_at(sp_v(0, 0, 1), sp_v(0, 0, -1));
        sp_evaluator *evaluator;
        sp_coverage *coverage = evaluate(&f, &nozzle, 1, &evaluator);
        assert_near(liquid(evaluator, coverage->deposits.flux), 1e-4, 1e-9);
        const sp_patches *patches = sp_evaluator_patches(evaluator);
        double jets = 0, square = 0;
        for (size_t i = 0; i < patches->count; i++) {
            jets += coverage->deposits.jets[i];
            double r = hypot(patches->point[i].x, patches->point[i].y);
            double expected = 1e-4 / (2 * M_PI * (1 - cos(M_PI / 4))) * pow(cos(atan(r)), 3);
            if (r < 0.9)
                square += pow(coverage->deposits.flux[i] / expected - 1, 2);
        }
        assert_near(jets, 200000, 1e-9);
        spread[linear] = square;
        sp_coverage_destroy(coverage);
        sp_evaluator_destroy(evaluator);
        sp_mesh_destroy(f.mesh);
    }
    assert_true(spread[1] < spread[0]);
}

/* A cone that points up at a mirror covers the floor as from its image above the ceiling. */
static void mirror_ceiling(void **state)
{
    (void)state;
    shape s = floor_shape(2);
    shape_part(&s, "ceiling");
    shape_sheet(&s, sp_v(-2, -2, 1), sp_v(4, 0, 0), sp_v(0, 4, 0), 3);
    fixture f = fixture_of(&s);
    f.surfaces[1] = (sp_surface){.clean = false, .restitution = 1, .rebound = 0.5};
    f.setup.fidelity.reflections = 1;
    sp_nozzle nozzle = nozzle_at(sp_v(0, 0, 0.5), sp_v(0, 0, 1));
    sp_evaluator *evaluator;
    sp_coverage *coverage = evaluate(&f, &nozzle, 1, &evaluator);
    assert_near(coverage->area, 16, 1e-9);
    assert_near(coverage->covered_area, M_PI * 2.25 * (1 + 4 / M_PI * 0.02 / 1.5), 0.01);
    assert_near(liquid(evaluator, coverage->deposits.flux), 0.5e-4, 1e-9);
    sp_coverage_destroy(coverage);
    sp_evaluator_destroy(evaluator);
    f.setup.fidelity.reflections = 0;
    coverage = evaluate(&f, &nozzle, 1, &evaluator);
    assert_true(coverage->covered_area == 0);
    sp_coverage_destroy(coverage);
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(f.mesh);
}

/* Thrown straight down from 1 m a jet bounces with half its speed on the same triangle: it comes back at that speed. */
static void bounces_on_one_triangle(void **state)
{
    (void)state;
    shape s = floor_shape(1);
    fixture f = fixture_of(&s);
    f.surfaces[0].restitution = 0.5;
    f.surfaces[0].rebound = 0.25;
    f.setup.fidelity.trajectory = SP_TRAJECTORY_PARABOLA;
    f.setup.fidelity.reflections = 2;
    f.setup.fidelity.jets = 1;
    sp_nozzle nozzle = nozzle_at(sp_v(0.3, -0.2, 1), sp_v(0, 0, -1));
    nozzle.angle = 1e-9;
    nozzle.speed = 2;
    sp_evaluator *evaluator;
    sp_coverage *coverage = evaluate(&f, &nozzle, 1, &evaluator);
    assert_near(liquid(evaluator, coverage->deposits.flux), 1e-4 * (1 + 0.25 + 0.0625), 1e-9);
    double impact = sqrt(4 + 2 * 9.81);
    for (size_t i = 0; i < coverage->deposits.count; i++) {
        if (coverage->deposits.jets[i] == 0)
            continue;
        assert_near(coverage->deposits.jets[i], 3, 1e-12);
        assert_near(coverage->deposits.speed_max[i], impact, 1e-9);
        assert_near(coverage->deposits.speed[i], impact * (1 + 0.25 / 2 + 0.0625 / 4) / (1 + 0.25 + 0.0625), 1e-9);
    }
    sp_coverage_destroy(coverage);
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(f.mesh);
}

/* Of a sheet between two nozzles each side takes its own liquid; a dry outside takes none. */
static void sides_are_apart(void **state)
{
    (void)state;
    shape s = shape_create();
    shape_part(&s, "sheet");
    shape_sheet(&s, sp_v(-1, -1, 0), sp_v(2, 0, 0), sp_v(0, 2, 0), 1);
    shape_part(&s, "box");
    shape_box(&s, sp_v(-3, -3, -3), sp_v(3, 3, 3), true);
    fixture f = fixture_of(&s);
    f.surfaces[1].clean = false;
    f.setup.cavity = SP_CAVITY_POINT;
    f.setup.cavity_point = sp_v(0.1, 0.2, 1);
    sp_nozzle nozzles[3] = {nozzle_at(sp_v(0, 0, 0.5), sp_v(0, 0, -1)), nozzle_at(sp_v(0, 0, -0.25), sp_v(0, 0, 1)),
                            nozzle_at(sp_v(0, 0, 9), sp_v(0, 0, -1))};
    nozzles[1].flow = 2e-4;
    sp_evaluator *evaluator;
    sp_coverage *coverage = evaluate(&f, nozzles, 3, &evaluator);
    assert_near(coverage->area, 8, 1e-9);
    const sp_patches *patches = sp_evaluator_patches(evaluator);
    double front = 0, back = 0;
    for (size_t i = 0; i < patches->count; i++)
        *(patches->side[i] == SP_SIDE_FRONT ? &front : &back) += coverage->deposits.flux[i] * patches->area[i];
    assert_near(front, 1e-4, 1e-9);
    assert_near(back, 2e-4, 1e-9);
    sp_coverage_destroy(coverage);
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(f.mesh);
}

static void same_bytes_for_any_number_of_threads(void **state)
{
    (void)state;
    sp_coverage *coverages[2];
    for (int i = 0; i < 2; i++) {
        shape s = floor_shape(1.5);
        shape_part(&s, "ball");
        shape_sphere(&s, 0.3, false, 24);
        fixture f = fixture_of(&s);
        f.surfaces[0].restitution = f.surfaces[1].restitution = 0.6;
        f.setup.fidelity.trajectory = SP_TRAJECTORY_PARABOLA;
        f.setup.fidelity.splat = SP_SPLAT_LINEAR;
        f.setup.run.threads = i == 0 ? 1 : 3;
        f.setup.cavity = SP_CAVITY_OUTSIDE;
        sp_nozzle nozzle = nozzle_at(sp_v(0.5, 0, 1), sp_v(0, 0, -1));
        sp_evaluator *evaluator;
        coverages[i] = evaluate(&f, &nozzle, 1, &evaluator);
        sp_evaluator_destroy(evaluator);
        sp_mesh_destroy(f.mesh);
    }
    const sp_deposits *a = &coverages[0]->deposits, *b = &coverages[1]->deposits;
    size_t bytes = a->count * sizeof(double);
    assert_int_equal(a->count, b->count);
    assert_memory_equal(a->flux, b->flux, bytes);
    assert_memory_equal(a->counted, b->counted, bytes);
    assert_memory_equal(a->speed, b->speed, bytes);
    assert_memory_equal(a->incidence, b->incidence, bytes);
    assert_memory_equal(a->impact, b->impact, bytes);
    assert_true(coverages[0]->fraction == coverages[1]->fraction && coverages[0]->flux_p05 == coverages[1]->flux_p05);
    sp_coverage_destroy(coverages[0]);
    sp_coverage_destroy(coverages[1]);
}

static bool stop_at_jets(void *user, const char *stage, double done)
{
    (void)user;
    (void)done;
    return strcmp(stage, "jets") != 0;
}

static void can_be_interrupted(void **state)
{
    (void)state;
    shape s = floor_shape(1);
    fixture f = fixture_of(&s);
    f.setup.surfaces = f.surfaces;
    f.setup.run.progress = stop_at_jets;
    sp_error error = {0};
    sp_evaluator *evaluator = sp_evaluator_create(&f.setup, &error);
    sp_nozzle nozzle = nozzle_at(sp_v(0, 0, 1), sp_v(0, 0, -1));
    sp_layout *layout = sp_layout_create(&nozzle, 1, &error);
    assert_int_equal(error.kind, SP_OK);
    assert_null(sp_evaluate(evaluator, layout, &error));
    assert_int_equal(error.kind, SP_ERROR_INTERRUPTED);
    sp_layout_destroy(layout);
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(f.mesh);
}

/* A cone over a plate leaves one shadow all around it, to which patches at its edge belong whole. */
static void no_shadow_is_larger_than_all_that_is_dry(void **state)
{
    (void)state;
    shape s = shape_create();
    shape_part(&s, "plate");
    shape_sheet(&s, sp_v(-0.5, -0.5, 0), sp_v(1, 0, 0), sp_v(0, 1, 0), 1);
    fixture f = fixture_of(&s);
    f.setup.fidelity.method = SP_METHOD_INVERSE;
    size_t larger = 0;
    for (int i = 0; i < 8; i++) {
        f.setup.fidelity.texel = 0.05 + 0.01 * i;
        sp_nozzle nozzle = nozzle_at(sp_v(0, 0, 0.4), sp_v(0, 0, -1));
        sp_evaluator *evaluator;
        sp_coverage *coverage = evaluate(&f, &nozzle, 1, &evaluator);
        const sp_patches *patches = sp_evaluator_patches(evaluator);
        sp_shadow *shadows = NULL;
        size_t count = 0;
        sp_error error = {0};
        double whole = 0, dry = coverage->area - coverage->covered_area;
        assert_true(sp_shadows(evaluator, coverage, NULL, &shadows, &count, &error));
        assert_int_equal(count, 1);
        for (size_t p = 0; p < patches->count; p++)
            whole += coverage->deposits.covered[p] ? 0 : patches->area[p];
        larger += whole > dry * (1 + 1e-9);
        assert_true(shadows[0].area <= dry);
        assert_near(shadows[0].area, fmin(whole, dry), 1e-9);
        free(shadows);
        sp_coverage_destroy(coverage);
        sp_evaluator_destroy(evaluator);
    }
    assert_true(larger > 0);
    sp_mesh_destroy(f.mesh);
}

/* A cone over a strip leaves both its ends dry: two shadows, the larger one first. */
static void shadows_are_found(void **state)
{
    (void)state;
    shape s = shape_create();
    shape_part(&s, "left");
    shape_sheet(&s, sp_v(-3, -0.1, 0), sp_v(3, 0, 0), sp_v(0, 0.2, 0), 1);
    shape_part(&s, "right");
    shape_sheet(&s, sp_v(0, -0.1, 0), sp_v(2, 0, 0), sp_v(0, 0.2, 0), 1);
    fixture f = fixture_of(&s);
    sp_nozzle nozzle = nozzle_at(sp_v(0, 0, 1), sp_v(0, 0, -1));
    sp_evaluator *evaluator;
    sp_coverage *coverage = evaluate(&f, &nozzle, 1, &evaluator);
    sp_shadow *shadows = NULL;
    size_t count = 0;
    sp_error error = {0};
    assert_true(sp_shadows(evaluator, coverage, NULL, &shadows, &count, &error));
    assert_int_equal(count, 2);
    assert_near(shadows[0].area, 0.4, 0.05);
    assert_near(shadows[1].area, 0.2, 0.1);
    assert_near(shadows[0].centroid.x, -2, 0.02);
    assert_near(shadows[1].centroid.x, 1.5, 0.02);
    assert_string_equal(f.mesh->parts[shadows[0].part].name, "left");
    assert_string_equal(f.mesh->parts[shadows[1].part].name, "right");
    assert_true(shadows[0].reachable_area == -1);
    /* a patch at the edge is a shadow's as a whole or not at all, and covered by its share */
    assert_near(shadows[0].area + shadows[1].area + coverage->covered_area, coverage->area, 1e-3);
    free(shadows);

    const sp_patches *patches = sp_evaluator_patches(evaluator);
    sp_reason *reasons = calloc(patches->count, sizeof *reasons);
    for (size_t i = 0; i < patches->count; i++) {
        double x = patches->point[i].x;
        reasons[i] = x > -2 ? SP_REASON_ATTAINABLE : x > -2.3 ? SP_REASON_FLUX : SP_REASON_SLANTED;
    }
    assert_true(sp_shadows(evaluator, coverage, reasons, &shadows, &count, &error));
    assert_near(shadows[0].reachable_area, 0.2, 0.1);
    assert_near(shadows[1].reachable_area, shadows[1].area, 1e-12);
    assert_int_equal(shadows[0].reason, SP_REASON_SLANTED); /* 0.7 m of 1 m */
    assert_int_equal(shadows[1].reason, SP_REASON_ATTAINABLE);
    free(shadows);
    free(reasons);
    for (size_t i = 0; i < patches->count; i++)
        coverage->deposits.covered[i] = true;
    assert_true(sp_shadows(evaluator, coverage, NULL, &shadows, &count, &error));
    assert_int_equal(count, 0);
    assert_null(shadows);
    sp_coverage_destroy(coverage);
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(f.mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cone_on_floor),
        cmocka_unit_test(criteria_draw_their_circles),
        cmocka_unit_test(single_takes_the_best_nozzle),
        cmocka_unit_test(linear_splat_keeps_the_sum_and_is_smoother),
        cmocka_unit_test(mirror_ceiling),
        cmocka_unit_test(bounces_on_one_triangle),
        cmocka_unit_test(sides_are_apart),
        cmocka_unit_test(same_bytes_for_any_number_of_threads),
        cmocka_unit_test(can_be_interrupted),
        cmocka_unit_test(shadows_are_found),
        cmocka_unit_test(no_shadow_is_larger_than_all_that_is_dry),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
