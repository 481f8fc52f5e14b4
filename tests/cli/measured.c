/* A measured nozzle as its user runs it: the shipped image in every command that takes it. */
#include "workplace.h"

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
             "'s/type: cone/type: full-cone-90-24-measured/' room.yaml >image.yaml && sed -e "
             "'s/full-cone-90-24-measured/full-cone-90-24/' image.yaml >even.yaml && sed -e 's/flux: 1/film: 1 "
             "L\\/min\\/m, flux: 1/' image.yaml >film.yaml",
             workplace, SOURCE_DIR, SOURCE_DIR);
    return system(line);
}

static json_t *first_layout(const char *arguments)
{
    json_t *object = expect_json(arguments, 0);
    json_t *layout = json_incref(json_array_get(json_object_get(object, "layouts"), 0));
    json_decref(object);
    return layout;
}

static double number(const json_t *object, const char *key)
{
    assert_true(json_is_number(json_object_get(object, key)));
    return json_number_value(json_object_get(object, key));
}

/* The generator's, to the byte. */
static void the_image_is_as_it_is_made(void **state)
{
    (void)state;
    char line[2048];
    snprintf(line, sizeof line, "cd '%s' && '%s/scenes/heavy_rim' made.exr && cmp made.exr heavy_rim.exr", workplace,
             BINARY_DIR);
    assert_int_equal(system(line), 0);
}

static void both_evaluators_take_it(void **state)
{
    (void)state;
    json_t *jets = first_layout("simulate image.yaml --set simulate.evaluator=forward --set simulate.jets=100000 "
                                "--set simulate.reflections=0 --json");
    json_t *both = expect_json("compare image.yaml even.yaml --json", 0), *layouts = json_object_get(both, "layouts");
    json_t *own = json_array_get(layouts, 0), *even = json_array_get(layouts, 1);
    assert_true(fabs(number(own, "coverage") - number(jets, "coverage")) < 0.02);
    assert_true(number(own, "coverage") - number(even, "coverage") > 0.01); /* farther than its catalogue says */
    double angle = number(json_array_get(json_object_get(own, "nozzles"), 0), "angle_rad");
    assert_true(fabs(angle - 100 * M_PI / 180) < 1e-9);
    json_decref(jets);
    json_decref(both);
}

static void film_runs_down_from_it(void **state)
{
    (void)state;
    json_t *layout = first_layout("simulate film.yaml --json");
    assert_true(number(json_object_get(layout, "film"), "covered_area_m2") > 0);
    json_decref(layout);
}

static void its_report_names_the_image(void **state)
{
    (void)state;
    outcome result = run_program("simulate image.yaml -o out");
    assert_int_equal(result.status, 0);
    forget(&result);
    char *report = read_file("out/report.html", NULL), *layout = read_file("out/layout.yaml", NULL);
    assert_non_null(report);
    assert_non_null(strstr(report, "of type full-cone-90-24-measured as it was measured, by the image heavy_rim.exr"));
    assert_non_null(strstr(layout, "../measured.yaml"));
    free(report);
    free(layout);
    char *told = read_file("out/result.json", NULL);
    json_t *before = json_loads(told, 0, NULL), *after = first_layout("simulate out/layout.yaml --json");
    json_t *layouts = json_object_get(before, "layouts");
    assert_true(number(json_array_get(layouts, 0), "coverage") == number(after, "coverage"));
    json_decref(before);
    json_decref(after);
    free(told);
}

static void placement_says_that_it_refuses_it(void **state)
{
    (void)state;
    outcome result = run_program("place image.yaml --set 'place.types=[full-cone-90-24-measured]'");
    assert_int_equal(result.status, 3);
    assert_non_null(strstr(result.err, "types: found 'full-cone-90-24-measured', which is measured"));
    forget(&result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_image_is_as_it_is_made),
        cmocka_unit_test(both_evaluators_take_it),
        cmocka_unit_test(film_runs_down_from_it),
        cmocka_unit_test(its_report_names_the_image),
        cmocka_unit_test(placement_says_that_it_refuses_it),
    };
    return cmocka_run_group_tests(tests, open_with_image, close_workplace);
}
