/* Images with speeds: their layers together are the image, and its mean speed everywhere its own. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <sprayplan/nozzle.h>

#include <stdio.h>
#include <string.h>

enum { COLUMNS = 12, ROWS = 9 };
#define ANGLE 1.8 /* rad */

static void fill(float *values, float *speeds, double slowest, double fastest)
{
    for (int j = 0; j < ROWS; j++)
        for (int i = 0; i < COLUMNS; i++) {
            double swing = 0.5 + 0.5 * sin(2 * M_PI * i / COLUMNS + 0.3 * j);
            values[j * COLUMNS + i] = (float)(i == 4 && j > 2 ? 0 : 1 + 0.7 * cos(0.5 * i + j));
            speeds[j * COLUMNS + i] = (float)(i == 4 && j > 2 ? NAN : slowest + (fastest - slowest) * swing);
        }
}

/* Of a pixel's middle. */
static sp_vec3 direction_of(int column, int row)
{
    double azimuth = 2 * M_PI * (column + 0.5) / COLUMNS, polar = 0.5 * ANGLE * (row + 0.5) / ROWS;
    return sp_v(sin(polar) * cos(azimuth), sin(polar) * sin(azimuth), cos(polar));
}

static double density(const sp_patternation *patternation, sp_vec3 direction)
{
    sp_nozzle_type type = {.pattern = SP_PATTERN_MEASURED, .angle = ANGLE, .patternation = patternation};
    sp_spray spray = sp_spray_create(&type, ANGLE);
    return sp_spray_intensity(&spray, direction);
}

static void layers_are_the_image(double slowest, double fastest, size_t least)
{
    float values[ROWS * COLUMNS], speeds[ROWS * COLUMNS];
    sp_speed_layer layers[SP_SPEEDS];
    sp_error error = {0};
    fill(values, speeds, slowest, fastest);
    size_t count = sp_patternation_layers(values, speeds, COLUMNS, ROWS, ANGLE, layers, &error);
    assert_string_equal(error.message, "");
    assert_in_range(count, least, SP_SPEEDS);
    sp_patternation *whole = sp_patternation_create(values, COLUMNS, ROWS, ANGLE, &error);
    double all = 0;
    for (size_t k = 0; k < count; k++) {
        all += layers[k].share;
        assert_true(layers[k].share > 0 && (k == 0 || layers[k].speed > layers[k - 1].speed));
    }
    assert_true(fabs(all - 1) < 1e-12);
    for (int j = 0; j < ROWS; j++)
        for (int i = 0; i < COLUMNS; i++) {
            sp_vec3 direction = direction_of(i, j);
            double liquid = 0, moving = 0, image = density(whole, direction);
            for (size_t k = 0; k < count; k++) {
                double own = layers[k].share * density(layers[k].patternation, direction);
                liquid += own;
                moving += own * layers[k].speed;
            }
            assert_true(fabs(liquid - image) <= 1e-6 * image + 1e-12);
            assert_true(!(image > 1e-9) || fabs(moving / liquid / (double)speeds[j * COLUMNS + i] - 1) < 1e-5);
        }
    for (size_t k = 0; k < count; k++)
        sp_patternation_destroy(layers[k].patternation);
    sp_patternation_destroy(whole);
}

static void layers_of_any_speeds_are_the_image(void **state)
{
    (void)state;
    layers_are_the_image(0.7, 0.7, 1);
    layers_are_the_image(0.699, 0.7, 2);
    layers_are_the_image(0.8, 1, 6);
    layers_are_the_image(0.5, 1, 12);
    layers_are_the_image(1e-3, 10, 12);
}

/* Between two speeds that are far apart nothing leaves: the layers there are left out. */
static void layers_without_liquid_are_left_out(void **state)
{
    (void)state;
    const float values[4] = {1, 2, 3, 2}, speeds[4] = {0.5f, 1, 1, 0.5f};
    sp_speed_layer layers[SP_SPEEDS];
    sp_error error = {0};
    assert_int_equal(sp_patternation_layers(values, speeds, 4, 1, 1, layers, &error), 2);
    assert_true(layers[0].speed == 0.5 && fabs(layers[1].speed - 1) < 1e-12);
    for (int k = 0; k < 2; k++)
        sp_patternation_destroy(layers[k].patternation);
}

static void refuse(const float *values, const float *speeds, const char *expected)
{
    sp_speed_layer layers[SP_SPEEDS];
    sp_error error = {0};
    assert_int_equal(sp_patternation_layers(values, speeds, 3, 2, 1, layers, &error), 0);
    assert_string_equal(error.message, expected);
}

static void wrong_speeds_are_named(void **state)
{
    (void)state;
    static const char expected[] = "a speed of %s found in column 2 of row 2, expected one above 0, up to 10 times the "
                                   "exit speed, where there is liquid";
    const char *const names[] = {"0", "-1", "nan", "10.5", "inf"};
    const float wrong[] = {0, -1, NAN, 10.5f, INFINITY};
    float values[6] = {1, 1, 1, 1, 1, 1}, speeds[6] = {1, 1, 1, 1, 1, 1};
    for (int i = 0; i < 5; i++) {
        char message[200];
        snprintf(message, sizeof message, expected, names[i]);
        speeds[4] = wrong[i];
        refuse(values, speeds, message);
    }
    values[0] = -1;
    refuse(values, speeds, "-1 found in column 1 of row 1, expected finite values of 0 or more");
    memset(values, 0, sizeof values);
    refuse(values, speeds, "no value above 0 found, expected some liquid");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(layers_of_any_speeds_are_the_image),
        cmocka_unit_test(layers_without_liquid_are_left_out),
        cmocka_unit_test(wrong_speeds_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
