/* The example of a spray ball, as its user runs it: one nozzle in every list, nearly all of the vessel wet by film. */
#include "results.h"

#include <math.h>

#ifdef SPRAYPLAN_SANITIZE
#define FEW "--set simulate.texel=100mm --set simulate.trajectory=parabola"
#else
#define FEW "--set simulate.texel=50mm --set simulate.trajectory=parabola"
#endif

static int open_with_ball(void **state)
{
    char line[4096];
    if (open_workplace(state))
        return -1;
    snprintf(line, sizeof line,
             "cd '%s' && cp '%s/scenes/spray_ball.yaml' '%s/scenes/balls.yaml' . && '%s/scenes/plain_vessel' "
             "plain_vessel.obj",
             workplace, SOURCE_DIR, SOURCE_DIR, BINARY_DIR);
    return system(line);
}

static json_t *first_layout(const json_t *object)
{
    return json_array_get(json_object_get(object, "layouts"), 0);
}

static void film_cleans_what_the_ball_does_not_hit(void **state)
{
    (void)state;
    json_t *object = expect_json("simulate spray_ball.yaml " FEW " --threads 1 --json", 0);
    const json_t *layout = first_layout(object), *film = json_object_get(layout, "film"),
                 *nozzles = json_object_get(layout, "nozzles");
    double covered = number(layout, "covered_area_m2"), area = covered / number(layout, "coverage");
    assert_true(number(layout, "coverage") > 0.98);
    assert_true(covered - number(film, "covered_area_m2") < 0.05 * area);
    assert_true(fabs(number(film, "per_girth_l_min_m") - 25.2) < 0.5);
    assert_true(fabs(number(layout, "water_l_min") - 95) < 1e-9);
    assert_int_equal(json_array_size(nozzles), 1);
    assert_true(fabs(number(json_array_get(nozzles, 0), "angle_rad") - 86 * M_PI / 180) < 1e-9);
    json_t *again = expect_again(object, "simulate spray_ball.yaml " FEW " --threads 3 --json", 0);
    assert_true(json_equal(layout, first_layout(again)));
    json_decref(again);
    json_decref(object);
}

/* A ball beside cones: `place` chooses among both, and a ball that is kept counts. */
static void place_takes_balls(void **state)
{
    (void)state;
    char scene[2048];
    const char *at = strstr(room_yaml, "place:\n");
    snprintf(scene, sizeof scene, "%.*splace:\n  types: [spray-ball]\n%s", (int)(at - room_yaml), room_yaml,
             at + strlen("place:\n"));
    write_file("types.yaml", scene);
    static const char ball[] =
        "nozzles:\n"
        "  - {name: full-cone-90-12, pattern: full_cone, angle: 90 deg, flow: 9 L/min, at: 2 bar}\n"
        "  - {name: cone, pattern: full_cone, angle: 90 deg, flow: 9 L/min, at: 2 bar}\n"
        "  - {name: spray-ball, pattern: cluster, flow: 30 L/min, at: 2 bar,\n"
        "     members: [{pattern: full_cone, angle: 80 deg, ring: {count: 6, polar: 80 deg, radius: 20 mm}}]}\n";
    write_file("catalogue.yaml", ball);
    json_t *object = expect_json("place types.yaml -o balls --json", 0), *layouts = json_object_get(object, "layouts"),
           *proposed = json_array_get(layouts, json_array_size(layouts) - 1),
           *nozzles = json_object_get(proposed, "nozzles");
    assert_true(json_array_size(nozzles) > 0);
    for (size_t i = 0; i < json_array_size(nozzles); i++)
        assert_string_equal(json_string_value(json_object_get(json_array_get(nozzles, i), "type")), "spray-ball");
    json_t *again = expect_json("simulate balls/layout.yaml --json", 0);
    assert_true(number(first_layout(again), "coverage") == number(proposed, "coverage"));
    json_decref(again);
    json_decref(object);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(film_cleans_what_the_ball_does_not_hit),
        cmocka_unit_test(place_takes_balls),
    };
    return cmocka_run_group_tests(tests, open_with_ball, close_workplace);
}
