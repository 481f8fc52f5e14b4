/* Jets too few for the texels: said on the terminal, in the report and in result.json, with how much it comes to. */
#include "workplace.h"

#include <math.h>

#define FORWARD "simulate room.yaml --set simulate.evaluator=forward "

static double fidelity_of(json_t *object, const char *key)
{
    return json_number_value(json_object_get(json_object_get(object, "fidelity"), key));
}

static void too_few_jets_are_reported(void **state)
{
    (void)state;
    outcome few = run_program(FORWARD "--set simulate.jets=5000 -o few");
    assert_int_equal(few.status, 0);
    assert_non_null(strstr(few.out, "warning: 0.005 million jets a nozzle are fewer than the "));
    char *page = read_file("few/report.html", NULL);
    assert_non_null(page);
    assert_non_null(strstr(page, "texels so short want "));
    free(page);
    forget(&few);
    json_t *object = expect_json(FORWARD "--set simulate.jets=5000 --json", 0);
    assert_true(fidelity_of(object, "jets_wanted_per_nozzle") > 5000);
    json_decref(object);
}

static void enough_are_not(void **state)
{
    (void)state;
    outcome enough = run_program(FORWARD "-o enough");
    assert_int_equal(enough.status, 0);
    assert_null(strstr(enough.out, "warning"));
    forget(&enough);
    json_t *object = expect_json(FORWARD "--json", 0);
    assert_null(json_object_get(json_object_get(object, "fidelity"), "jets_wanted_per_nozzle"));
    json_decref(object);
}

/* With the same jets a texel of a tenth is worse, and the error measured says so. */
static void a_shorter_texel_is_not_silently_worse(void **state)
{
    (void)state;
    json_t *truth =
        expect_json("simulate room.yaml --set simulate.evaluator=inverse --set 'simulate.texel=10 mm' --json", 0);
    double coverage =
        json_number_value(json_object_get(json_array_get(json_object_get(truth, "layouts"), 0), "coverage"));
    json_decref(truth);
    static const char *const texels[] = {"40 mm", "4 mm"};
    double off[2], told[2];
    for (int i = 0; i < 2; i++) {
        char line[256];
        snprintf(line, sizeof line, FORWARD "--set simulate.jets=300000 --set 'simulate.texel=%s' --json", texels[i]);
        json_t *object = expect_json(line, 0);
        json_t *layout = json_array_get(json_object_get(object, "layouts"), 0);
        off[i] = fabs(json_number_value(json_object_get(layout, "coverage")) - coverage);
        told[i] = fidelity_of(object, "error_estimate");
        print_message("texel %s: off by %.2f points, told as %.2f, %.3g jets wanted\n", texels[i], 100 * off[i],
                      100 * told[i], fidelity_of(object, "jets_wanted_per_nozzle"));
        assert_true(off[i] <= told[i] + 0.002); /* the inverse evaluation is off as well */
        json_decref(object);
    }
    assert_true(off[1] > off[0] + 0.01 && told[1] > told[0] + 0.01);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(too_few_jets_are_reported),
        cmocka_unit_test(enough_are_not),
        cmocka_unit_test(a_shorter_texel_is_not_silently_worse),
    };
    return cmocka_run_group_tests(tests, open_workplace, close_workplace);
}
