/* A measured nozzle as its user runs it, with the image that is shipped. */
#include "results.h"

#include <sprayplan/image.h>

#include <math.h>

/* Texels are long: nothing here depends on them. */
static int open_with_image(void **state)
{
    char line[4096];
    if (open_workplace(state))
        return -1;
    snprintf(line, sizeof line,
             "cd '%s' && cp '%s/scenes/measured.yaml' '%s/scenes/heavy_rim.exr' . && sed -e "
             "'s/catalogue.yaml/measured.yaml/' -e 's/texel: [0-9]*/texel: 100/' -e "
             "'s/type: cone/type: full-cone-90-24-measured/' -e 's/flux: 1/film: 1 L\\/min\\/m, flux: 1/' room.yaml "
             ">image.yaml",
             workplace, SOURCE_DIR, SOURCE_DIR);
    return system(line);
}

static float *values_of(const char *folder, const char *name, int *count)
{
    char path[1024];
    sp_error error = {0};
    snprintf(path, sizeof path, "%s/%s", folder, name);
    sp_image image = sp_image_read(path, 100, 100, (const char *const[]){"liquid", "speed"}, &error);
    assert_non_null(image.values);
    *count = image.width * image.height;
    return image.values;
}

/* By the generator. */
static void the_image_is_as_it_is_made(void **state)
{
    (void)state;
    char line[2048];
    int count[2];
    snprintf(line, sizeof line, "cd '%s' && '%s/scenes/heavy_rim' made.exr", workplace, BINARY_DIR);
    assert_int_equal(system(line), 0);
    float *made = values_of(workplace, "made.exr", &count[0]),
          *shipped = values_of(workplace, "heavy_rim.exr", &count[1]);
    assert_int_equal(count[0], 72 * 50);
    assert_int_equal(count[1], 72 * 50);
    for (int i = 0; i < count[0]; i++)
        assert_true(fabsf(made[i] - shipped[i]) <= 1e-6f);
    free(made);
    free(shipped);
}

static void the_report_names_the_image(void **state)
{
    (void)state;
    outcome result = run_program("simulate image.yaml -o out");
    assert_int_equal(result.status, 0);
    forget(&result);
    char *report = read_file("out/report.html", NULL), *told = read_file("out/result.json", NULL);
    assert_non_null(strstr(report, "of type full-cone-90-24-measured as it was measured, by the image heavy_rim.exr"));
    json_t *object = json_loads(told, 0, NULL), *layouts = json_object_get(object, "layouts");
    json_t *own = json_array_get(layouts, 0);
    assert_true(number(json_object_get(own, "film"), "covered_area_m2") > 0);
    double angle = number(json_array_get(json_object_get(own, "nozzles"), 0), "angle_rad");
    assert_true(fabs(angle - 100 * M_PI / 180) < 1e-9);
    json_decref(object);
    free(report);
    free(told);
}

static void it_is_placed(void **state)
{
    (void)state;
    json_t *object = expect_json("place image.yaml --set 'place.types=[full-cone-90-24-measured]' --set "
                                 "place.max_nozzles=1 --set place.coverage=0.1 --set place.refine=none --json",
                                 0);
    json_t *proposed = json_array_get(json_object_get(object, "layouts"), 2);
    assert_string_equal(json_string_value(json_object_get(proposed, "name")), "proposed");
    assert_true(number(proposed, "coverage") >= 0.1);
    json_decref(object);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_image_is_as_it_is_made),
        cmocka_unit_test(the_report_names_the_image),
        cmocka_unit_test(it_is_placed),
    };
    return cmocka_run_group_tests(tests, open_with_image, close_workplace);
}
