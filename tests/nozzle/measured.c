/* Measured patterns: images against the functions that they are of, against one another, and against what is drawn from
 * them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <sprayplan/nozzle.h>

#include <stdlib.h>

/* Liquid per steradian in any measure; azimuth, polar angle over half of the angle: 0 to 1. */
typedef double profile(double azimuth, double polar, double half_angle);

static double even(double azimuth, double polar, double half_angle)
{
    (void)azimuth, (void)polar, (void)half_angle;
    return 0.3;
}
static double cosine_squared(double azimuth, double polar, double half_angle)
{
    (void)azimuth;
    return pow(cos(polar * half_angle), 2);
}
static double lopsided(double azimuth, double polar, double half_angle)
{
    (void)half_angle;
    return polar * (1 + 0.8 * cos(azimuth - 1));
}
static double inner_cone(double azimuth, double polar, double half_angle)
{
    (void)azimuth, (void)half_angle;
    return polar < 0.5;
}
/* a sheet along x, with a gap in its middle */
static double fan(double azimuth, double polar, double half_angle)
{
    double across = sin(polar * half_angle) * sin(azimuth);
    return polar > 0.2 && fabs(across) < 0.03 ? 2 : 0;
}
static double speckled(double azimuth, double polar, double half_angle)
{
    (void)half_angle;
    double noise = sin(1e4 * azimuth + 3e4 * polar) * 1e4;
    return noise - floor(noise) < 0.3 ? 0 : noise - floor(noise);
}
/* one pixel of any image, off the middle and off the edge */
static double spot(double azimuth, double polar, double half_angle)
{
    (void)azimuth, (void)polar, (void)half_angle;
    return 0;
}

typedef struct {
    profile *profile;
    size_t columns, rows;
    double angle; /* deg */
} image;

static const image images[] = {
    {even, 1, 1, 90},
    {even, 7, 3, 360},
    {even, 4096, 1, 180},
    {cosine_squared, 1, 90, 120},
    {cosine_squared, 36, 45, 179},
    {lopsided, 72, 45, 90},
    {lopsided, 72, 90, 300},
    {inner_cone, 1, 180, 120},
    {fan, 360, 90, 90},
    {speckled, 90, 45, 100},
    {speckled, 31, 17, 360},
    {spot, 64, 33, 90},
    {spot, 3, 1, 1e-3},
    {spot, 4096, 1, 45},
    {spot, 256, 512, 60},
    {spot, 16, 16, 360},
};
#define IMAGES (sizeof images / sizeof *images)

static double deg(double degrees)
{
    return degrees * M_PI / 180;
}

static sp_patternation *measure(const image *own)
{
    float *values = calloc(own->columns * own->rows, sizeof *values);
    assert_non_null(values);
    for (size_t j = 0; j < own->rows; j++)
        for (size_t i = 0; i < own->columns; i++)
            values[j * own->columns + i] =
                (float)own->profile(2 * M_PI * ((double)i + 0.5) / (double)own->columns,
                                    ((double)j + 0.5) / (double)own->rows, deg(own->angle) / 2);
    if (own->profile == spot)
        values[(own->rows / 3) * own->columns + own->columns / 3] = 5;
    sp_error error = {0};
    sp_patternation *patternation = sp_patternation_create(values, own->columns, own->rows, deg(own->angle), &error);
    if (!patternation)
        fail_msg("%s", error.message);
    free(values);
    return patternation;
}

static sp_spray spray_of(const sp_patternation *patternation)
{
    sp_nozzle_type type = {.pattern = SP_PATTERN_MEASURED, .patternation = patternation};
    return sp_spray_create(&type, 0);
}

static sp_patternation *patternations[IMAGES];

static int measure_all(void **state)
{
    (void)state;
    for (size_t k = 0; k < IMAGES; k++)
        patternations[k] = measure(&images[k]);
    return 0;
}

static int forget_all(void **state)
{
    (void)state;
    for (size_t k = 0; k < IMAGES; k++)
        sp_patternation_destroy(patternations[k]);
    return 0;
}

static sp_vec3 at(double azimuth, double polar)
{
    return sp_v(sin(polar) * cos(azimuth), sin(polar) * sin(azimuth), cos(polar));
}

static sp_vec3 to_world(const sp_frame *frame, sp_vec3 d)
{
    return sp_along(sp_along(sp_scale(frame->x, d.x), d.y, frame->y), d.z, frame->z);
}

/* Between nodes, which are at the pixels' middles, the axis and the edge, the density goes evenly with azimuth and
 * height 1 - cos: there its mean is that of the middle. */
static void all_liquid_is_there(void **state)
{
    (void)state;
    for (size_t k = 0; k < IMAGES; k++) {
        const image *own = &images[k];
        sp_spray spray = spray_of(patternations[k]);
        double sum = 0, step = deg(own->angle) / 2 / (double)own->rows, most = 0;
        for (size_t j = 0; j <= own->rows; j++) {
            double low = j ? ((double)j - 0.5) * step : 0,
                   high = j < own->rows ? low + (j ? 1 : 0.5) * step : low + 0.5 * step;
            double below = pow(sin(low / 2), 2), above = pow(sin(high / 2), 2),
                   middle = 2 * asin(sqrt((below + above) / 2));
            for (size_t i = 0; i < own->columns; i++) {
                double density = sp_spray_intensity(&spray, at(2 * M_PI * (double)i / (double)own->columns, middle));
                sum += density * 2 * (above - below) * 2 * M_PI / (double)own->columns;
                most = fmax(most, density);
            }
        }
        if (fabs(sum - 1) > 1e-6)
            fail_msg("image %zu holds %.9f of the liquid", k, sum);
        assert_true(most <= (1 + 1e-12) / spray.solid_angle);
    }
}

/* Whatever the breadth over which it is averaged, also where what sprays is much less broad. */
static void means_hold_all_liquid(void **state)
{
    (void)state;
    enum { PLACES = 20000 };
    static const double breadths[] = {0.02, 0.19};
    sp_frame frame = sp_nozzle_frame(sp_v(0.3, -0.2, 0.9), 0.4, sp_v(0, 0, 1));
    sp_nozzle_type cone = {.pattern = SP_PATTERN_FULL_CONE};
    for (size_t k = 0; k < IMAGES; k++) {
        sp_spray spray = spray_of(patternations[k]);
        for (size_t b = 0; b < 2; b++) {
            double sum = 0, most = fmin(M_PI, spray.high + sp_spray_fringe(breadths[b]));
            sp_spray around = sp_spray_create(&cone, 2 * most);
            for (uint64_t i = 0; i < PLACES; i++) {
                sp_vec3 world = to_world(&frame, sp_spray_direction(&around, i, PLACES, 1));
                double density = sp_spray_density(&spray, &frame, world, breadths[b]);
                double share = sp_spray_share(&spray, &frame, world, breadths[b]);
                assert_true(share >= 0 && share <= 1 && density >= 0 && (share > 0) == (density > 0));
                assert_true(density <= share / spray.solid_angle * (1 + 1e-6));
                sum += density * around.solid_angle / PLACES;
            }
            if (fabs(sum - 1) > 0.006)
                fail_msg("image %zu over %g rad: %.5f of the liquid", k, breadths[b], sum);
        }
    }
}

/* An image of one value, or of many equal ones, is a full cone: to the bit where it sprays. */
static void even_images_are_full_cones(void **state)
{
    (void)state;
    static const image cones[] = {
        {even, 1, 1, 90}, {even, 36, 45, 90}, {even, 5, 2, 200}, {even, 1, 4, 360}, {even, 2, 1, 1e-3}};
    sp_frame frame = sp_nozzle_frame(sp_v(0, 0, 1), 0, sp_v(0, 0, 1));
    for (size_t k = 0; k < sizeof cones / sizeof *cones; k++) {
        sp_patternation *patternation = measure(&cones[k]);
        sp_nozzle_type type = {.pattern = SP_PATTERN_FULL_CONE};
        sp_spray spray = spray_of(patternation), cone = sp_spray_create(&type, deg(cones[k].angle));
        sp_frame turned = sp_nozzle_frame(sp_v(0, 0, 1), M_PI / (double)cones[k].columns, sp_v(0, 0, 1));
        assert_true(fabs(sp_spray_reach(&spray) / sp_spray_reach(&cone) - 1) < 1e-12);
        assert_true(fabs(spray.solid_angle / cone.solid_angle - 1) < 1e-6); /* values are floats */
        for (uint64_t i = 0; i < 2000; i++) {
            double polar = fmin(M_PI, 1.1 * cone.outer) * (double)i / 2000;
            sp_vec3 d = at(2.4 * (double)i, polar), jet = sp_spray_direction(&cone, i, 2000, 1);
            sp_vec3 same = to_world(&turned, jet); /* whose azimuths begin at the first column's middle */
            assert_true(sp_distance(same, sp_spray_direction(&spray, i, 2000, 1)) < 1e-11 * cone.outer + 1e-15);
            assert_true((sp_spray_intensity(&spray, d) > 0) == (sp_spray_intensity(&cone, d) > 0));
            assert_true(fabs(sp_spray_margin(&spray, d) - sp_spray_margin(&cone, d)) < 1e-12);
            double apart = sp_spray_share(&spray, &frame, d, 0.02) - sp_spray_share(&cone, &frame, d, 0.02);
            if (fabs(apart) > 0.2 || (sp_spray_margin(&cone, d) > 0.06 && apart != 0))
                fail_msg("cone %zu at %g rad: share %g apart", k, polar, apart);
        }
        sp_patternation_destroy(patternation);
    }
}

/* cos² of the polar angle comes to (1 - cos³) 2π/3, and is told to second order in the rows. */
static void a_smooth_profile_is_reported(void **state)
{
    (void)state;
    static const image coarse = {cosine_squared, 1, 15, 120}, fine = {cosine_squared, 8, 60, 120};
    sp_patternation *of[2] = {measure(&coarse), measure(&fine)};
    sp_frame frame = sp_nozzle_frame(sp_v(0, 1, 1), 0.2, sp_v(0, 0, 1));
    double worst[2] = {0, 0}, blurred = 0, all = 2 * M_PI / 3 * (1 - pow(cos(deg(60)), 3));
    for (int k = 0; k < 2; k++) {
        sp_spray spray = spray_of(of[k]);
        for (double polar = 0; polar < deg(58); polar += 0.003) {
            double expected = pow(cos(polar), 2) / all;
            sp_vec3 d = at(polar * 100, polar), world = to_world(&frame, d);
            worst[k] = fmax(worst[k], fabs(sp_spray_intensity(&spray, d) - expected) * all);
            if (k == 1 && polar < deg(55))
                blurred = fmax(blurred, fabs(sp_spray_density(&spray, &frame, world, 0.02) - expected) * all);
        }
    }
    print_message("cos² from 15 rows within %.2g, from 60 within %.2g, over .02 rad %.2g of the most\n", worst[0],
                  worst[1], blurred);
    assert_true(worst[0] < 4e-3 && worst[1] < 2.5e-4 && blurred < 7e-4);
    for (int k = 0; k < 2; k++)
        sp_patternation_destroy(of[k]);
}

/* polar (1 + .8 cos(azimuth - 1)): the liquid leans towards the azimuth 1, as the frame's x and y say, and turns with
 * the roll. Its mean level part is .4 of the mean of the polar angle's sine. */
static void azimuth_is_from_x_towards_y(void **state)
{
    (void)state;
    enum { JETS = 20000, STEPS = 2000 };
    static const image lean = {lopsided, 72, 90, 90};
    sp_patternation *patternation = measure(&lean);
    sp_spray spray = spray_of(patternation);
    double all = 0, level = 0;
    for (int i = 0; i < STEPS; i++) {
        double polar = deg(45) * (i + 0.5) / STEPS;
        all += polar * sin(polar);
        level += polar * sin(polar) * sin(polar);
    }
    for (double roll = 0; roll < 4; roll += 1.3) {
        sp_frame frame = sp_nozzle_frame(sp_v(0, 0, 1), roll, sp_v(0, 0, 1)); /* x is the world's at roll 0 */
        sp_vec3 mean = sp_v(0, 0, 0);
        for (uint64_t i = 0; i < JETS; i++)
            mean = sp_along(mean, 1.0 / JETS, to_world(&frame, sp_spray_direction(&spray, i, JETS, 3)));
        double expected = 0.4 * level / all, towards = roll + 1;
        if (fabs(mean.x - expected * cos(towards)) > 1e-3 || fabs(mean.y - expected * sin(towards)) > 1e-3)
            fail_msg("roll %g: mean %g %g, expected %g %g", roll, mean.x, mean.y, expected * cos(towards),
                     expected * sin(towards));
        sp_vec3 most = to_world(&frame, at(1, deg(40))), least = to_world(&frame, at(1 + M_PI, deg(40)));
        double ratio = sp_spray_density(&spray, &frame, most, 0.01) / sp_spray_density(&spray, &frame, least, 0.01);
        assert_true(fabs(ratio / 9 - 1) < 0.01);
    }
    sp_patternation_destroy(patternation);
}

/* In parts of the sphere, chi-square against the density's integral: drawn at random it would be about one a part, but
 * directions are spread evenly. */
static void jets_follow_the_liquid(void **state)
{
    (void)state;
    enum { JETS = 20000, RINGS = 6, SECTORS = 8, FINE = 40 };
    for (size_t k = 0; k < IMAGES; k++) {
        sp_spray spray = spray_of(patternations[k]);
        double expected[RINGS][SECTORS] = {{0}}, found[RINGS][SECTORS] = {{0}}, chi2 = 0;
        double edge = 1 - cos(spray.high);
        int parts = 0;
        for (int i = 0; i < RINGS * FINE; i++)
            for (int n = 0; n < SECTORS * FINE; n++) {
                double polar = 2 * asin(sqrt(edge / 2 * (i + 0.5) / (RINGS * FINE)));
                double density = sp_spray_intensity(&spray, at(2 * M_PI * (n + 0.5) / (SECTORS * FINE), polar));
                expected[i / FINE][n / FINE] += JETS * density * edge * 2 * M_PI / (RINGS * FINE * SECTORS * FINE);
            }
        for (uint64_t i = 0; i < JETS; i++) {
            sp_vec3 d = sp_spray_direction(&spray, i, JETS, 3);
            double turn = atan2(d.y, d.x) / (2 * M_PI);
            assert_true(fabs(sp_length(d) - 1) < 1e-12 && sp_spray_intensity(&spray, d) > 0);
            double ring = 2 * pow(sin(0.5 * atan2(hypot(d.x, d.y), d.z)), 2) / edge * RINGS;
            found[(int)fmin(RINGS - 1, ring)][(int)fmin(SECTORS - 1, (turn - floor(turn)) * SECTORS)]++;
        }
        for (int i = 0; i < RINGS; i++)
            for (int n = 0; n < SECTORS; n++)
                if (expected[i][n] > 1) {
                    chi2 += pow(found[i][n] - expected[i][n], 2) / expected[i][n];
                    parts++;
                }
        bool told = 2 * images[k].columns <= SECTORS * FINE && 2 * images[k].rows <= RINGS * FINE; /* by the integral */
        if (told && !(chi2 < 3))
            fail_msg("image %zu: chi-square %g of %d parts", k, chi2, parts);
    }
}

/* Bounds hold for the image and for means over directions between. */
static void densities_are_bounds(void **state)
{
    (void)state;
    sp_frame frame = sp_nozzle_frame(sp_v(0, 0, 1), 0, sp_v(0, 0, 1)); /* the world's */
    for (size_t k = 0; k < IMAGES; k++) {
        sp_spray spray = spray_of(patternations[k]);
        double half = deg(images[k].angle) / 2, breadth = 0.01 * half, fringe = sp_spray_fringe(breadth);
        for (int i = 0; i < 400; i++) {
            double polar = fmin(M_PI, 1.1 * half) * i / 400, least, most;
            sp_spray_densities(&spray, fmax(0, polar - fringe), fmin(M_PI, polar + fringe), &least, &most);
            sp_vec3 d = at(17.3 * i, polar);
            double density = sp_spray_intensity(&spray, d), mean = sp_spray_density(&spray, &frame, d, breadth);
            if (!(least <= density * (1 + 1e-9) && density <= most * (1 + 1e-9)) ||
                !(least <= mean * (1 + 1e-6) && mean <= most * (1 + 1e-6)))
                fail_msg("image %zu at %g rad: %g and %g, said to be %g to %g", k, polar, density, mean, least, most);
            sp_spray_densities(&spray, polar, polar, &least, &most);
            density = sp_spray_intensity(&spray, at(1, polar));
            assert_true(images[k].columns > 1 || polar >= half || least >= 0.999 * density);
        }
    }
}

static void refuse(const float *values, size_t columns, size_t rows, double angle, const char *expected)
{
    sp_error error = {0};
    assert_null(sp_patternation_create(values, columns, rows, angle, &error));
    assert_string_equal(error.message, expected);
}

static void what_is_no_pattern_is_refused(void **state)
{
    (void)state;
    float values[6] = {1, 2, 0, 3, 0, 1};
    refuse(values, 0, 1, 1, "0 x 1 values found, expected 1 x 1 to 4096 x 1024");
    refuse(values, 1, 1025, 1, "1 x 1025 values found, expected 1 x 1 to 4096 x 1024");
    refuse(values, 3, 2, 7, "an angle of 7 rad found, expected 1e-06 to 2 pi");
    refuse(values, 3, 2, NAN, "an angle of nan rad found, expected 1e-06 to 2 pi");
    refuse(values, 3, 2, 1e-7, "an angle of 1e-07 rad found, expected 1e-06 to 2 pi");
    values[4] = -1;
    refuse(values, 3, 2, 1, "-1 found in column 2 of row 2, expected finite values of 0 or more");
    values[4] = NAN;
    refuse(values, 3, 2, 1, "nan found in column 2 of row 2, expected finite values of 0 or more");
    values[4] = INFINITY;
    refuse(values, 3, 2, 1, "inf found in column 2 of row 2, expected finite values of 0 or more");
    const float none[2] = {0, 0};
    refuse(none, 1, 2, 1, "no value above 0 found, expected some liquid");
    sp_nozzle_type type = {.name = "m", .pattern = SP_PATTERN_MEASURED};
    sp_error error = {0};
    assert_false(sp_type_is_valid(&type, &error));
    assert_string_equal(error.message, "type m: measured, expected a patternation");
    sp_patternation_destroy(NULL);
}

/* The least and the greatest numbers that an image may hold. */
static void extreme_values_are_reported(void **state)
{
    (void)state;
    const float tiny[4] = {1e-45f, 0, 1e-45f, 1e-45f}, huge[4] = {3e38f, 3e38f, 3e38f, 1e-45f};
    const float *const values[] = {tiny, huge};
    for (int k = 0; k < 2; k++) {
        sp_error error = {0};
        sp_patternation *patternation = sp_patternation_create(values[k], 2, 2, 1, &error);
        assert_non_null(patternation);
        sp_spray spray = spray_of(patternation);
        assert_true(spray.solid_angle > 0.1 && spray.solid_angle < 1);
        assert_true(fabs(sp_length(sp_spray_direction(&spray, 3, 10, 1)) - 1) < 1e-12);
        sp_patternation_destroy(patternation);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_liquid_is_there),         cmocka_unit_test(means_hold_all_liquid),
        cmocka_unit_test(even_images_are_full_cones),  cmocka_unit_test(a_smooth_profile_is_reported),
        cmocka_unit_test(azimuth_is_from_x_towards_y), cmocka_unit_test(jets_follow_the_liquid),
        cmocka_unit_test(densities_are_bounds),        cmocka_unit_test(what_is_no_pattern_is_refused),
        cmocka_unit_test(extreme_values_are_reported),
    };
    return cmocka_run_group_tests(tests, measure_all, forget_all);
}
