/* The report's viewer as a reader uses it: both designs are drawn, asked and told by mouse and keyboard. */
#include "browser.h"

#include <sprayplan/sprayplan.h>

#include <math.h>

static json_t *found;   /* what the page's reader saw */
static sp_scene *scene; /* the proposal */
static sp_evaluator *evaluator;
static sp_coverage *coverage;

static int use_the_viewer(void **state)
{
    if (place_once(state) != 0)
        return -1;
    if (!has_browser())
        return 0;
    found =
        read_with("viewer.js", "placed/report.html", "--window-size=1200,900 --virtual-time-budget=60000 --dump-dom");
    sp_error error = {0};
    char path[1024];
    snprintf(path, sizeof path, "%s/placed/layout.yaml", workplace);
    scene = sp_scene_load(path, &error);
    evaluator = sp_evaluator_create(sp_scene_setup(scene), &error);
    coverage = sp_evaluate(evaluator, sp_scene_layout(scene), &error);
    return found && coverage ? 0 : -1;
}

static int put_away(void **state)
{
    json_decref(found);
    sp_coverage_destroy(coverage);
    sp_evaluator_destroy(evaluator);
    sp_scene_destroy(scene);
    return close_workplace(state);
}

static double number(const json_t *of, const char *key)
{
    return json_number_value(json_object_get(of, key));
}

static void it_opens_without_requests_or_messages(void **state)
{
    (void)state;
    skip_without_browser();
    assert_opened(found);
}

static void both_designs_are_drawn(void **state)
{
    (void)state;
    skip_without_browser();
    for (size_t i = 0; i < 2; i++)
        assert_true(number(json_array_get(json_object_get(found, "first"), i), "drawn") > 5000);
}

static bool looks_alike(const json_t *one, const json_t *other)
{
    return json_equal(one, other);
}

static void another_quantity_changes_pixels_and_bar(void **state)
{
    (void)state;
    skip_without_browser();
    json_t *quantities = json_object_get(found, "quantities");
    size_t count = json_array_size(quantities);
    assert_int_equal(count, 8);
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < i; k++) {
            const json_t *one = json_array_get(quantities, i), *other = json_array_get(quantities, k);
            assert_false(looks_alike(json_object_get(one, "seen"), json_object_get(other, "seen")));
            assert_string_not_equal(json_string_value(json_object_get(one, "bar")),
                                    json_string_value(json_object_get(other, "bar")));
        }
}

static bool says(const json_t *of, const char *what)
{
    const char *said = json_string_value(json_object_get(of, "said"));
    return said && strstr(said, what);
}

static void scales_change_pixels_ticks_and_words(void **state)
{
    (void)state;
    skip_without_browser();
    static const char *const words[] = {"logarithmic", "linear", "stepped at 1 L/min per m\xc2\xb2"};
    const json_t *scales = json_object_get(found, "scales");
    assert_int_equal(json_array_size(scales), 3);
    for (size_t i = 0; i < 3; i++) {
        const json_t *scale = json_array_get(scales, i), *ticks = json_object_get(scale, "ticks");
        assert_false(json_is_true(json_object_get(scale, "disabled")));
        if (!says(scale, words[i]))
            fail_msg("said %s", json_string_value(json_object_get(scale, "said")));
        for (size_t k = 0; k < i; k++) {
            assert_false(
                looks_alike(json_object_get(scale, "seen"), json_object_get(json_array_get(scales, k), "seen")));
            assert_false(json_equal(ticks, json_object_get(json_array_get(scales, k), "ticks")));
        }
    }
    const json_t *step = json_object_get(json_array_get(scales, 2), "ticks");
    assert_int_equal(json_array_size(step), 1);
    assert_string_equal(json_string_value(json_array_get(step, 0)), "1"); /* as the scene asks */
    assert_true(json_is_true(json_object_get(found, "unasked")));
}

static void other_colours_change_pixels_and_bar(void **state)
{
    (void)state;
    skip_without_browser();
    const json_t *plain = json_array_get(json_object_get(found, "scales"), 0);
    const json_t *other = json_object_get(found, "cividis");
    assert_true(says(other, "in cividis"));
    assert_false(looks_alike(json_object_get(plain, "seen"), json_object_get(other, "seen")));
    assert_true(json_equal(json_object_get(plain, "ticks"), json_object_get(other, "ticks")));
    const char *ramp = json_string_value(json_object_get(other, "ramp"));
    assert_non_null(strstr(ramp, "rgb(0, 34, 78)")); /* its ends, as its authors print them */
    assert_non_null(strstr(ramp, "rgb(254, 232, 56)"));
}

static void layers_come_and_go(void **state)
{
    (void)state;
    skip_without_browser();
    static const char *const names[] = {"Wireframe", "Jets"};
    const json_t *first = json_object_get(found, "first");
    for (size_t i = 0; i < 2; i++) {
        const json_t *layer = json_object_get(json_object_get(found, "layers"), names[i]);
        const json_t *on = json_object_get(layer, "on"), *off = json_object_get(layer, "off");
        const json_t *by_key = json_object_get(layer, "byKey");
        for (size_t side = 0; side < 2; side++)
            assert_false(looks_alike(json_array_get(json_object_get(on, "seen"), side), json_array_get(first, side)));
        assert_true(looks_alike(json_object_get(off, "seen"), first));
        assert_true(looks_alike(json_object_get(by_key, "seen"), json_object_get(on, "seen")));
        assert_true(json_is_true(json_object_get(layer, "checked")));
        assert_true(says(on, names[i]) && says(off, "off"));
    }
}

static void a_chosen_nozzle_shows_its_jets(void **state)
{
    (void)state;
    skip_without_browser();
    const json_t *jets = json_object_get(found, "jets");
    assert_false(looks_alike(json_array_get(jets, 0), json_array_get(jets, 1)));
    assert_true(looks_alike(json_array_get(jets, 1), json_array_get(jets, 2)));
}

static void keys_reach_lists_and_say_what_they_chose(void **state)
{
    (void)state;
    skip_without_browser();
    static const char *const words[] = {"linear", "in cividis", "Impact speed"};
    const json_t *chosen = json_object_get(found, "byKeys");
    for (size_t i = 0; i < 3; i++) {
        const char *said = json_string_value(json_array_get(chosen, i));
        if (!said || !strstr(said, words[i]))
            fail_msg("key %zu said %s", i, said ? said : "nothing");
    }
    assert_true(json_is_true(json_object_get(found, "named")));
}

static void the_corner_shows_axes_and_length(void **state)
{
    (void)state;
    skip_without_browser();
    const json_t *corner = json_object_get(found, "corner");
    const char *far = json_string_value(json_array_get(corner, 0)),
               *near = json_string_value(json_array_get(corner, 1));
    assert_true(strchr(far, 'x') && strchr(far, 'y') && strchr(far, 'z') && strstr(far, "mm"));
    if (!(strtod(near + strcspn(near, "0123456789"), NULL) < strtod(far + strcspn(far, "0123456789"), NULL)))
        fail_msg("from afar %s, from near %s", far, near);
}

/* "12.3 L/min per m²"; 0 for "none". */
static double leading_number(const char *text)
{
    text += strcspn(text, "0123456789");
    return strtod(text, NULL);
}

static const char *last_cell(const json_t *pick, size_t row)
{
    const json_t *cells = json_array_get(json_object_get(pick, "rows"), row);
    return json_string_value(json_array_get(cells, json_array_size(cells) - 1));
}

/* A step of a scale of 254: over five decades, and told in two digits, or over all of it, and told in three. Half a
 * step is rounded, or a whole one where half would lead past what is asked for. */
static void expect_figure(const char *text, double value, double step, bool ratio)
{
    double told = leading_number(text);
    double allowed = ratio ? value * (step + 0.05) : step + 0.006 * value;
    if (strncmp(text, "at most", 7) == 0)
        assert_true(value <= told * 1.05);
    else if (ratio && strncmp(text, "at least", 8) != 0 && strncmp(text, "about ", 6) != 0)
        fail_msg("told %s as if it were exact", text);
    else if (!(fabs(told - value) <= allowed))
        fail_msg("told %s, expected %g", text, value);
}

static void a_point_is_reported_as_it_is(void **state)
{
    (void)state;
    skip_without_browser();
    const sp_patches *patches = sp_evaluator_patches(evaluator);
    const sp_deposits *deposits = &coverage->deposits;
    double fastest = 0;
    size_t asked = 0;
    for (size_t i = 0; i < deposits->count; i++)
        fastest = fmax(fastest, deposits->speed[i]);
    for (size_t i = 0; i < json_array_size(json_object_get(found, "picks")); i++) {
        const json_t *pick = json_array_get(json_object_get(found, "picks"), i);
        size_t patch = (size_t)number(pick, "patch");
        assert_true(patch < patches->count);
        char part[64];
        sp_vec3 at;
        const char *text = json_string_value(json_object_get(pick, "text"));
        assert_int_equal(sscanf(text, "%63s at %lf, %lf, %lf m", part, &at.x, &at.y, &at.z), 4);
        assert_true(sp_distance(at, patches->point[patch]) <= 1.5 * patches->length[patch]);
        if (!(deposits->flux[patch] > 0)) {
            assert_string_equal(last_cell(pick, 0), "none");
            continue;
        }
        asked++;
        expect_figure(last_cell(pick, 0), 6e4 * deposits->flux[patch], 5 * log(10) / 254, true);
        assert_int_equal(leading_number(last_cell(pick, 0)) >= 1, 6e4 * deposits->flux[patch] >= 1);
        expect_figure(last_cell(pick, 1), deposits->speed[patch], 5 * fastest / 254, false);
        expect_figure(last_cell(pick, 2), deposits->incidence[patch] * 180 / M_PI, 90.0 / 254, false);
        expect_figure(last_cell(pick, 3), deposits->impact[patch], 5 * log(10) / 254, true);
        assert_int_equal(leading_number(last_cell(pick, 4)) >= 50, deposits->covered[patch]);
    }
    assert_true(asked >= 5);
}

/* What the page says of every patch's flux is on the side of the criterion where that is. */
static void no_figure_contradicts_the_criterion(void **state)
{
    (void)state;
    skip_without_browser();
    const json_t *told = json_object_get(found, "fluxes");
    const sp_deposits *deposits = &coverage->deposits;
    assert_int_equal(json_array_size(told), deposits->count);
    size_t near = 0;
    for (size_t i = 0; i < deposits->count; i++) {
        const char *text = json_string_value(json_array_get(told, i));
        double flux = 6e4 * deposits->flux[i], read = strcmp(text, "none") ? leading_number(text) : 0;
        if ((read >= 1) != (flux >= 1))
            fail_msg("patch %zu: told %s, is %.9g, asked for 1", i, text, flux);
        near += fabs(flux - 1) < 0.023;
    }
    assert_true(near > 0); /* as far as steps round */
    static const char *const places[] = {"0.000", "-0.001"};
    for (size_t i = 0; i < 2; i++)
        assert_string_equal(json_string_value(json_array_get(json_object_get(found, "places"), i)), places[i]);
}

static void keys_turn_and_fit(void **state)
{
    (void)state;
    skip_without_browser();
    assert_true(json_is_true(json_object_get(found, "focused")));
    const json_t *picks = json_object_get(found, "picks");
    assert_string_not_equal(json_string_value(json_object_get(json_array_get(picks, 0), "text")),
                            json_string_value(json_object_get(json_array_get(picks, 23), "text")));
    assert_true(looks_alike(json_object_get(found, "first"), json_object_get(found, "fitted")));
}

static void names_do_not_lie_over_each_other(void **state)
{
    (void)state;
    skip_without_browser();
    const json_t *crowd = json_object_get(found, "crowd");
    assert_true(number(crowd, "all") == 60 && number(crowd, "shown") >= 1 && number(crowd, "shown") < 60);
    assert_false(json_is_true(json_object_get(crowd, "overlaps")));
    assert_true(json_is_true(json_object_get(crowd, "chosen")));
}

static void rows_of_the_tables_act(void **state)
{
    (void)state;
    skip_without_browser();
    const json_t *nozzle = json_object_get(found, "nozzle"), *shadow = json_object_get(found, "shadow");
    assert_non_null(nozzle);
    assert_non_null(strstr(json_string_value(json_object_get(nozzle, "text")), "N1"));
    assert_false(looks_alike(json_object_get(nozzle, "seen"), json_object_get(found, "first")));
    assert_non_null(shadow);
    assert_non_null(strstr(json_string_value(json_object_get(shadow, "text")), "region 1"));
    assert_false(looks_alike(json_object_get(shadow, "seen"), json_object_get(found, "first")));
}

/* Where jets were flown, as many of each patch as arrive there, to a step of the scale. */
static void jets_that_arrive_are_shown(void **state)
{
    (void)state;
    skip_without_browser();
    outcome result = run_program("simulate room.yaml -o jets --quiet --set simulate.evaluator=forward --set "
                                 "simulate.jets=40000");
    assert_int_equal(result.status, 0);
    forget(&result);
    json_t *told = read_with("jets.js", "jets/report.html", "--virtual-time-budget=60000 --dump-dom");
    assert_opened(told);
    assert_non_null(strstr(json_string_value(json_object_get(told, "bar")), "Jets that arrive"));
    sp_error error = {0};
    char path[1024];
    snprintf(path, sizeof path, "%s/jets/layout.yaml", workplace);
    sp_scene *flown = sp_scene_load(path, &error);
    sp_evaluator *by_jets = sp_evaluator_create(sp_scene_setup(flown), &error);
    sp_coverage *hit = sp_evaluate(by_jets, sp_scene_layout(flown), &error);
    const json_t *said = json_object_get(told, "said");
    assert_int_equal(json_array_size(said), hit->deposits.count);
    double all = 0;
    for (size_t i = 0; i < hit->deposits.count; i++) {
        const char *words = json_string_value(json_array_get(said, i));
        double jets = hit->deposits.jets[i], read = strcmp(words, "none") ? strtod(words, NULL) : 0;
        if (!(fabs(read - jets) <= (jets < 20 ? 1e-9 : 0.5 + 0.02 * jets)))
            fail_msg("patch %zu: %s said, %g jets", i, words, jets);
        all += jets;
    }
    assert_true(all > 1000);
    sp_coverage_destroy(hit);
    sp_evaluator_destroy(by_jets);
    sp_scene_destroy(flown);
    json_decref(told);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_opens_without_requests_or_messages),
        cmocka_unit_test(both_designs_are_drawn),
        cmocka_unit_test(another_quantity_changes_pixels_and_bar),
        cmocka_unit_test(scales_change_pixels_ticks_and_words),
        cmocka_unit_test(other_colours_change_pixels_and_bar),
        cmocka_unit_test(layers_come_and_go),
        cmocka_unit_test(a_chosen_nozzle_shows_its_jets),
        cmocka_unit_test(keys_reach_lists_and_say_what_they_chose),
        cmocka_unit_test(the_corner_shows_axes_and_length),
        cmocka_unit_test(a_point_is_reported_as_it_is),
        cmocka_unit_test(no_figure_contradicts_the_criterion),
        cmocka_unit_test(keys_turn_and_fit),
        cmocka_unit_test(names_do_not_lie_over_each_other),
        cmocka_unit_test(rows_of_the_tables_act),
        cmocka_unit_test(jets_that_arrive_are_shown),
    };
    return cmocka_run_group_tests(tests, use_the_viewer, put_away);
}
