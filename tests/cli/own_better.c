/* place says where it does not beat the engineer's own nozzles, and what its search does not count. */
#include "results.h"

#include <math.h>

#define BETTER "By the objective the scene's own nozzles are better than the proposal: they "

/* room.yaml, its own nozzle of that type, as `name`. */
static void write_room(const char *name, const char *type)
{
    char scene[sizeof room_yaml + 16];
    const char *at = strstr(room_yaml, "type: cone"), *after = at + strlen("type: cone");
    snprintf(scene, sizeof scene, "%.*stype: %s%s", (int)(at - room_yaml), room_yaml, type, after);
    write_file(name, scene);
}

/* What the terminal says of it; `why` NULL: that it says nothing. */
static void expect_better(const char *scene, const char *settings, const char *why)
{
    char arguments[512], sentence[200];
    snprintf(arguments, sizeof arguments, "place %s --set place.refine=none %s " COARSE, scene, settings);
    outcome done = run_program(arguments);
    snprintf(sentence, sizeof sentence, "\n" BETTER "%s.\n", why ? why : "");
    if (!strstr(done.out, why ? sentence : "layout ") || (!why && strstr(done.out, BETTER)))
        fail_msg("%s\n%s%s", arguments, done.out, done.err);
    forget(&done);
}

/* One ball of 20 L/min, where no more is allowed than one cone of 12, which covers less. */
static void what_beats_the_proposal_is_reported(void **state)
{
    (void)state;
    write_room("ball.yaml", "ball");
    expect_better("ball.yaml",
                  "--set 'place.types=[cone]' --set place.objective=max_coverage --set place.max_nozzles=1 "
                  "--set 'place.coverage=80 %'",
                  "cover what was asked for, which it does not");
    expect_better("ball.yaml",
                  "--set 'place.types=[cone]' --set place.objective=max_coverage --set place.max_nozzles=1 "
                  "--set 'place.coverage=10 %'",
                  "cover more");
}

static void what_does_not_or_is_beyond_the_limits_is_not(void **state)
{
    (void)state;
    write_room("ball.yaml", "ball");
    expect_better("room.yaml", "", NULL);
    expect_better("ball.yaml",
                  "--set 'place.types=[cone]' --set place.objective=max_coverage --set 'place.max_water=15 L/min'",
                  NULL);
}

static void the_page_shows_it_too(void **state)
{
    (void)state;
    write_room("cone.yaml", "cone");
    outcome done =
        run_program("place cone.yaml --set place.refine=none --set 'place.types=[ball]' "
                    "--set place.objective=min_water --set 'place.coverage=10 %' --no-live -o better " COARSE);
    assert_non_null(strstr(done.out, "\n" BETTER "cover what was asked for with less water.\n"));
    forget(&done);
    char *page = read_file("better/report.html", NULL);
    assert_non_null(strstr(page, "id=\"own-better\">By the objective the scene&#39;s own nozzles are better than the "
                                 "proposal: they "));
    assert_null(strstr(page, "id=\"thrown-back\""));
    free(page);
}

/* Where walls throw liquid back, search and proofs leave out what the figures count. */
static void what_the_search_does_not_count_is_reported(void **state)
{
    (void)state;
    static const char told[] = "The coverage of the layouts counts liquid that walls throw back. The search goes by "
                               "first impacts and puts the nozzles\nthat it found together anew with it; what is "
                               "counted again and proved below is by first impacts alone,\nand layouts may "
                               "cover more than that says.";
    char scene[sizeof room_yaml + 64];
    const char *at = strstr(room_yaml, "room.obj\n") + strlen("room.obj\n");
    snprintf(scene, sizeof scene, "%.*s    restitution: 0.5\n%s", (int)(at - room_yaml), room_yaml, at);
    write_file("bouncing.yaml", scene);
    static const char *const reflections[] = {"2", "0"};
    for (int i = 0; i < 2; i++) {
        char arguments[512];
        snprintf(arguments, sizeof arguments,
                 "place bouncing.yaml --set simulate.evaluator=forward --set simulate.reflections=%s "
                 "--set simulate.jets=2000 --set place.refine=none --no-live -o bouncing --force " COARSE,
                 reflections[i]);
        outcome done = run_program(arguments);
        char *page = read_file("bouncing/report.html", NULL);
        assert_int_equal(strstr(done.out, told) != NULL, i == 0);
        assert_int_equal(strstr(page, "id=\"thrown-back\">The coverage of the layouts counts liquid") != NULL, i == 0);
        assert_int_equal(strstr(page, "gets liquid to them, thrown back by walls or not") != NULL, i == 0);
        /* no line of what none covers more than where layouts do */
        assert_non_null(strstr(page, "<section id=\"certificate\">"));
        assert_int_equal(strstr(page, "<path class=\"bound\"") != NULL, i == 1);
        assert_int_equal(strstr(page, "What follows is by first impacts alone") != NULL, i == 0);
        free(page);
        forget(&done);
    }
}

/* A ball in the middle, which reaches the ceiling, as no cone at the mounts does: one share is attainable wherever it
 * is told, and what was aimed at is of what cones reach. */
static void what_own_nozzles_alone_reach_is_attainable_everywhere(void **state)
{
    (void)state;
    write_room("ball.yaml", "ball");
    outcome done = run_program("place ball.yaml --set 'place.types=[cone]' "
                               "--set place.refine=none --set place.max_nozzles=1 --no-live -o beyond " COARSE);
    assert_int_equal(done.status, 4);
    json_t *all = json_file("beyond/result.json"), *geometry = json_object_get(all, "geometry");
    const json_t *proposed = layout_named(all, "proposed"), *target = json_object_get(all, "target");
    double whole = number(geometry, "clean_area_m2"), aimed = 100 * number(target, "coverage_aimed_at");
    double attainable = 100 * number(geometry, "attainable_area_m2") / whole, told, allowed, covered, share;
    assert_non_null(strstr(done.out, "reached by the scene's own nozzles alone"));
    assert_int_equal(sscanf(done.err,
                            "sprayplan: 90 %% of the surface was asked for, of which nozzles that are allowed reach "
                            "no more than %lf %%; with what the scene's own reach %lf %% is attainable: the proposal "
                            "covers %lf %%, %lf %% of what",
                            &allowed, &told, &covered, &share),
                     4);
    assert_true(told > attainable - 1e-6 && told < attainable + 0.01);
    assert_true(aimed < 0.9 * attainable - 1 && 0.9 * allowed > aimed - 1e-6 && 0.9 * allowed < aimed + 0.1);
    assert_true(fabs(share - 100 * number(proposed, "coverage_of_attainable")) <= 0.05 + 1e-9);
    char *page = read_file("beyond/report.html", NULL), text[200];
    snprintf(text, sizeof text,
             "nozzles that are allowed reach no more than %.2f&nbsp;%%, so that %.1f&nbsp;%% were aimed at; with what "
             "the engineer&#39;s own reach %.2f&nbsp;%% are attainable; ",
             allowed, aimed, told);
    assert_non_null(strstr(page, text));
    free(page);
    json_decref(all);
    forget(&done);
}

/* With no time to look for more, that is said where it would be a matter of the nozzles allowed. */
static void what_the_time_did_not_allow_to_look_for_is_not_denied(void **state)
{
    (void)state;
    write_room("ball.yaml", "ball");
    outcome done = run_program("place ball.yaml --set 'place.types=[cone]' --set place.max_nozzles=1 --time-limit 0.01 "
                               "--no-live -o hurried " COARSE);
    assert_int_equal(done.status, 4);
    assert_non_null(strstr(done.out, "by none that is allowed, as far as the time allowed to look: "));
    assert_null(strstr(done.err, "no more than"));
    char *page = read_file("hurried/report.html", NULL);
    assert_non_null(strstr(page, ", as far as the time allowed to look: it counts as attainable."));
    assert_null(strstr(page, "no proposal can cover it"));
    free(page);
    forget(&done);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_beats_the_proposal_is_reported),
        cmocka_unit_test(what_does_not_or_is_beyond_the_limits_is_not),
        cmocka_unit_test(the_page_shows_it_too),
        cmocka_unit_test(what_own_nozzles_alone_reach_is_attainable_everywhere),
        cmocka_unit_test(what_the_time_did_not_allow_to_look_for_is_not_denied),
        cmocka_unit_test(what_the_search_does_not_count_is_reported),
    };
    return cmocka_run_group_tests_name("own nozzles better", tests, open_workplace, close_workplace);
}
