/* report: what pictures and model show; figures stay. */
#include "results.h"

static void expect_other(const char *one, const char *other, const char *file, bool same)
{
    char path[2][256];
    size_t size[2];
    snprintf(path[0], sizeof path[0], "%s/%s", one, file);
    snprintf(path[1], sizeof path[1], "%s/%s", other, file);
    char *bytes[2] = {read_file(path[0], &size[0]), read_file(path[1], &size[1])};
    assert_true(bytes[0] && bytes[1]);
    assert_int_equal(size[0] == size[1] && memcmp(bytes[0], bytes[1], size[0]) == 0, same);
    free(bytes[0]);
    free(bytes[1]);
}

static void pictures_and_model_follow_and_figures_stay(void **state)
{
    (void)state;
    ensure("flux", "simulate room.yaml " COARSE);
    ensure("speed", "simulate room.yaml " COARSE " --set report.quantity=speed --set report.scale=linear");
    ensure("charts", "simulate room.yaml " COARSE " --set report.quantity=charts --set report.wireframe=true");
    json_t *flux = json_file("flux/result.json"), *speed = json_file("speed/result.json");
    json_object_del(flux, "stages");
    json_object_del(speed, "stages");
    assert_true(json_equal(flux, speed));
    json_decref(flux);
    json_decref(speed);
    const char *const others[] = {"speed", "charts"};
    for (int i = 0; i < 2; i++) {
        expect_other("flux", others[i], "coverage.png", false);
        expect_other("flux", others[i], "model.glb", false);
        expect_other("flux", others[i], "deposits.exr", true);
    }
    char *layout = read_file("speed/layout.yaml", NULL);
    assert_non_null(strstr(layout, "quantity: speed"));
    assert_non_null(strstr(layout, "scale: linear"));
    free(layout);
}

static void compare_shows_what_the_first_scene_asks_for(void **state)
{
    (void)state;
    ensure("flux", "simulate room.yaml " COARSE);
    ensure("speed", "simulate room.yaml " COARSE " --set report.quantity=speed --set report.scale=linear");
    ensure("compared", "compare flux/result.json speed/layout.yaml flux/layout.yaml");
    char *page = read_file("compared/report.html", NULL);
    assert_non_null(strstr(page, ">Impact speed, mean, m/s</text>"));
    free(page);
    expect("simulate room.yaml --set report.quantity=fast", 3, "",
           "report.quantity=fast: quantity: found 'fast', expected flux, speed, speed_max, incidence, incidence_min, "
           "impact, impact_max, jets, covered or charts\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_and_model_follow_and_figures_stay),
        cmocka_unit_test(compare_shows_what_the_first_scene_asks_for),
    };
    return cmocka_run_group_tests(tests, open_workplace, close_workplace);
}
