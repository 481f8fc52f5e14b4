/* Measured nozzles: an image of a full cone in the place of the built-in one, profiles whose flux on a floor is known,
 * jets beside the closed form, and clusters of images. */
#include "room_of_nozzles.h"

#define POINTS 0.001 /* of coverage */
#define SOME_JETS (JETS / 16)

/* Liquid per steradian in any measure at an azimuth and a polar angle, rad. */
typedef double profile(double azimuth, double polar);

static double even(double azimuth, double polar)
{
    (void)azimuth, (void)polar;
    return 1;
}
static double narrow_cone(double azimuth, double polar)
{
    (void)azimuth;
    return polar < deg(30);
}
static double cosine_squared(double azimuth, double polar)
{
    (void)azimuth;
    return pow(cos(polar), 2);
}
/* as made for the wall that a nozzle leans towards */
static double lopsided(double azimuth, double polar)
{
    return 1 + 0.9 * sin(polar) * cos(azimuth - 0.7);
}

/* `degrees` is the full angle; the caller destroys the patternation. */
static sp_nozzle_type measured(profile *profile, size_t columns, size_t rows, double degrees)
{
    float *values = malloc(columns * rows * sizeof *values);
    assert_non_null(values);
    for (size_t j = 0; j < rows; j++)
        for (size_t i = 0; i < columns; i++)
            values[j * columns + i] = (float)profile(2 * M_PI * ((double)i + 0.5) / (double)columns,
                                                     deg(degrees) / 2 * ((double)j + 0.5) / (double)rows);
    sp_error error = {0};
    sp_nozzle_type type = spray_type(SP_PATTERN_MEASURED, degrees);
    sp_patternation *patternation = sp_patternation_create(values, columns, rows, deg(degrees), &error);
    assert_no_error(&error);
    type.patternation = patternation;
    free(values);
    return type;
}

static void forget(sp_nozzle_type *type)
{
    sp_patternation_destroy((sp_patternation *)type->patternation);
}

/* Both evaluators find the built-in cone's coverage, within .1 points of it; `area`, m². */
static void assert_same(const char *what, const scene *s, const sp_nozzle_type *image, const sp_nozzle_type *cone)
{
    sp_evaluator *evaluator = scene_evaluator(s);
    for (int inverse = 0; inverse < 2; inverse++) {
        sp_nozzle nozzles[2] = {nozzle_at(image, place, body, 0), nozzle_at(cone, place, body, 0)};
        sp_coverage *by_image = scene_cover(evaluator, &nozzles[0], 1, inverse),
                    *built_in = scene_cover(evaluator, &nozzles[1], 1, inverse);
        print_message("%-34s %s: %.3f %%, built-in %.3f %%\n", what, inverse ? "inverse" : "forward",
                      100 * by_image->fraction, 100 * built_in->fraction);
        if (!(fabs(by_image->fraction - built_in->fraction) <= POINTS))
            fail_msg("%s: not as the built-in cone", what);
        assert_true(built_in->fraction > 0.05 && built_in->fraction < 0.9);
        sp_coverage_destroy(by_image);
        sp_coverage_destroy(built_in);
    }
    sp_evaluator_destroy(evaluator);
}

static void images_of_full_cones_are_full_cones(void **state)
{
    (void)state;
    sp_nozzle_type cone = spray_type(SP_PATTERN_FULL_CONE, 60), same = measured(even, 36, 30, 60),
                   inner = measured(narrow_cone, 1, 180, 90);
    scene s;
    open_room(&s, 0.03);
    s.setup.fidelity.jets = SOME_JETS;
    assert_same("cone of its image's angle", &s, &same, &cone);
    assert_same("inner cone, 180 rows", &s, &inner, &cone);
    s.setup.criterion.flux = 0;
    assert_same("without flux", &s, &same, &cone);
    assert_same("inner cone without flux, 180 rows", &s, &inner, &cone);
    scene_close(&s);
    forget(&same);
    forget(&inner);
}

/* Straight down from the height H cos² ϑ of 120 deg brings Q C cos⁵ϑ/H² to the floor, C = 3/(2π (1 - cos³ 60°)). */
static void a_profile_covers_what_it_should(void **state)
{
    (void)state;
    const double height = 0.7, polar = deg(40);
    sp_nozzle_type type = measured(cosine_squared, 1, 45, 120);
    sp_nozzle nozzle = nozzle_at(&type, sp_v(0.013, -0.007, height), sp_v(0, 0, -1), 0);
    double density = 3 / (2 * M_PI * (1 - pow(cos(deg(60)), 3))), radius = height * tan(polar);
    rectangle floor = level_rectangle(2, 2, 0);
    scene s;
    scene_open(&s, mesh_of_rectangles(&floor, 1), SP_TRAJECTORY_LINE, 0.01);
    s.setup.fidelity.jets = JETS / 4;
    s.setup.criterion.flux = type.flow * density * pow(cos(polar), 5) / (height * height);
    assert_covers("disc under cos²", &s, &nozzle, 1, M_PI * radius * radius, BY_BOTH);
    scene_close(&s);
    forget(&type);
}

/* On a floor under a lopsided image, patch by patch: its azimuth is from the frame's x towards its y, and follows axis
 * and roll. */
static void azimuth_follows_axis_and_roll(void **state)
{
    (void)state;
    sp_nozzle_type type = measured(lopsided, 180, 90, 90);
    double all = 2 * M_PI * (1 - cos(deg(45)));
    rectangle floor = level_rectangle(4, 4, 0);
    scene s;
    scene_open(&s, mesh_of_rectangles(&floor, 1), SP_TRAJECTORY_LINE, 0.02);
    sp_evaluator *evaluator = scene_evaluator(&s);
    for (double roll = 0; roll < 6; roll += 2.1) {
        sp_nozzle nozzle = nozzle_at(&type, sp_v(0.1, 0.2, 0.9), sp_v(0.3, -0.1, -1), 0);
        nozzle.roll = roll;
        sp_frame frame = sp_nozzle_frame(nozzle.axis, roll, sp_v(0, 0, 1));
        sp_coverage *coverage = scene_cover(evaluator, &nozzle, 1, true);
        const sp_patches *patches = sp_evaluator_patches(evaluator);
        double worst = 0;
        for (size_t i = 0; i < patches->count; i++) {
            sp_vec3 way = sp_sub(patches->point[i], nozzle.position);
            double distance = sp_length(way), polar = acos(sp_dot(way, frame.z) / distance);
            double turn = atan2(sp_dot(way, frame.y), sp_dot(way, frame.x));
            double flux = type.flow * lopsided(turn, polar) / all * (0.9 / distance) / (distance * distance);
            if (polar < deg(43))
                worst = fmax(worst, fabs(coverage->deposits.flux[i] / flux - 1));
        }
        print_message("roll %g: flux within %.2f %%\n", roll, 100 * worst);
        assert_true(worst < 0.02 * COARSER * COARSER);
        sp_coverage_destroy(coverage);
    }
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
    forget(&type);
}

/* Jets and the closed form agree, and no liquid is lost by either. */
static void jets_and_closed_form_agree(void **state)
{
    (void)state;
    sp_nozzle_type types[] = {measured(lopsided, 72, 45, 140), measured(cosine_squared, 8, 20, 300)};
    scene s;
    open_room(&s, 0.05);
    s.setup.fidelity.jets = JETS / 8 > 200000 ? JETS / 8 : 200000; /* enough where little more than asked for comes */
    sp_evaluator *evaluator = scene_evaluator(&s);
    for (size_t t = 0; t < 2; t++) {
        types[t].flow = 20e-3 / 60;
        sp_nozzle nozzle = nozzle_at(&types[t], place, body, 0);
        sp_coverage *closed = scene_cover(evaluator, &nozzle, 1, true),
                    *jets = scene_cover(evaluator, &nozzle, 1, false);
        const sp_patches *patches = sp_evaluator_patches(evaluator);
        double liquid = 0;
        for (size_t i = 0; i < patches->count; i++)
            liquid += closed->deposits.flux[i] * patches->area[i];
        print_message("image %zu: %.2f %% covered, by jets %.2f %%; %.3f %% of the liquid arrives\n", t,
                      100 * closed->fraction, 100 * jets->fraction, 100 * liquid / types[t].flow);
        assert_true(fabs(closed->fraction - jets->fraction) < 0.005 * COARSER * COARSER);
        assert_true(fabs(liquid / types[t].flow - 1) < 0.002 * COARSER * COARSER);
        assert_true(fabs(jets->balance.clean / types[t].flow - 1) < 1e-6);
        sp_coverage_destroy(closed);
        sp_coverage_destroy(jets);
        forget(&types[t]);
    }
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

/* A member of a cluster sprays as it would alone. */
static void a_member_may_be_measured(void **state)
{
    (void)state;
    sp_nozzle_type type = measured(lopsided, 36, 30, 100), cluster = spray_type(SP_PATTERN_CLUSTER, 0);
    sp_member member = {.type = type, .axis = {0, 0, 1}, .share = 1};
    cluster.member_count = 1;
    cluster.members = &member;
    scene s;
    open_room(&s, 0.1);
    s.setup.fidelity.jets = 20000;
    sp_evaluator *evaluator = scene_evaluator(&s);
    sp_nozzle nozzles[2] = {nozzle_at(&type, place, body, 0), nozzle_at(&cluster, place, body, 0)};
    assert_true(fabs(sp_nozzle_angle(&nozzles[1]) - deg(100)) < 1e-12);
    for (int inverse = 0; inverse < 2; inverse++) {
        sp_coverage *alone = scene_cover(evaluator, &nozzles[0], 1, inverse),
                    *member_of = scene_cover(evaluator, &nozzles[1], 1, inverse);
        assert_memory_equal(alone->deposits.flux, member_of->deposits.flux,
                            alone->deposits.count * sizeof *alone->deposits.flux);
        sp_coverage_destroy(alone);
        sp_coverage_destroy(member_of);
    }
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
    forget(&type);
}

/* Where it is proved that lines and parabolas say the same, they do, also where the image has gaps. */
static void bound_on_lines_holds(void **state)
{
    (void)state;
    sp_nozzle_type types[] = {measured(cosine_squared, 1, 45, 110), measured(lopsided, 36, 30, 110),
                              measured(narrow_cone, 1, 45, 110)};
    for (size_t t = 0; t < 6; t++) {
        sp_nozzle nozzle = nozzle_at(&types[t / 2], place, body, 25);
        double bound = assert_bound_on_lines("image", t / 2, &nozzle, t % 2 ? 1.0 / 60 / 1000 : 0);
        assert_true(bound < 0.4 * COARSER);
    }
    for (size_t t = 0; t < 3; t++)
        forget(&types[t]);
}

static void threads_change_nothing(void **state)
{
    (void)state;
    sp_nozzle_type type = measured(lopsided, 36, 30, 100);
    sp_nozzle nozzle = nozzle_at(&type, place, body, 0);
    assert_threads_change_nothing(&nozzle, 1);
    forget(&type);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(images_of_full_cones_are_full_cones),
        cmocka_unit_test(a_profile_covers_what_it_should),
        cmocka_unit_test(azimuth_follows_axis_and_roll),
        cmocka_unit_test(jets_and_closed_form_agree),
        cmocka_unit_test(a_member_may_be_measured),
        cmocka_unit_test(bound_on_lines_holds),
        cmocka_unit_test(threads_change_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
