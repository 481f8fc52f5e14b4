#include <sprayplan/result.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#define PATH BINARY_DIR "/figures-test.json"
#define LAYOUT "\"name\": \"manual\", \"water_l_min\": 60, \"covered_area_m2\": 4, \"coverage\": 0.8, \"nozzles\": []"

static sp_figures *read_text(const char *text, size_t *count, sp_error *error)
{
    FILE *file = fopen(PATH, "wb");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
    *error = (sp_error){0};
    sp_figures *figures = sp_figures_read(PATH, count, error);
    unlink(PATH);
    return figures;
}

static void reads_what_design_says(void **state)
{
    (void)state;
    sp_error error;
    size_t count;
    sp_figures *figures = read_text(
        "{\"sprayplan\": \"0.1.0\", \"geometry\": {\"triangles\": 12, \"area_m2\": 6, \"clean_area_m2\": 5},"
        " \"fidelity\": {\"trajectory\": \"line\", \"evaluator\": \"forward\", \"reflections\": 2, "
        "\"jets_per_nozzle\": 99,"
        " \"texel_m\": 0.01, \"error_estimate\": 0.02, \"misjudged\": 0.03, \"error_bound\": 0.06}, \"unknown\": [1, "
        "2], \"layouts\": ["
        "{" LAYOUT
        "}, {\"name\": \"b\\u00e4d\\u0007\", \"water_l_min\": 30, \"coverage\": 0.9, \"covered_area_m2\": 4.5,"
        " \"error_estimate\": 0.01, \"borderline_m2\": 0.04,"
        " \"coverage_of_attainable\": 0.95, \"flux_l_min_m2\": {\"min\": 0, \"mean\": 6},"
        " \"shadows\": [{\"area_m2\": 0.5, \"centroid_m\": [1, 2, 3], \"part\": \"lid\", \"reachable\": false,"
        " \"remedy\": {\"type\": \"cone\", \"port\": \"P1\", \"position_m\": [0, 1, 2], \"covers_m2\": 0.25, "
        "\"water_l_min\": 12}},"
        " {}],"
        " \"nozzles\": [{\"name\": \"N1\", \"type\": \"t\", \"order_code\": \"c\", \"url\": \"http://u\","
        " \"position_m\": [0, 0, 1.5], \"axis\": [0, 0, -1],"
        " \"roll_rad\": -0.5, \"pressure_pa\": 200000, \"flow_l_min\": 30}]}]}",
        &count, &error);
    assert_non_null(figures);
    assert_int_equal(count, 2);
    assert_int_equal(figures[0].triangles, 12);
    assert_true(isnan(figures[0].attainable_area) && isnan(figures[0].of_attainable) && isnan(figures[0].flux_max));
    assert_true(fabs(figures[0].flow - 1e-3) < 1e-15);
    assert_true(figures[0].error_estimate == 0.02 && figures[1].error_estimate == 0.01);
    assert_true(isnan(figures[0].borderline) && figures[1].borderline == 0.04);
    assert_true(figures[0].misjudged == 0.03 && figures[1].misjudged == 0.03);
    assert_true(figures[0].error_bound == 0.06 && figures[1].error_bound == 0.06);
    assert_string_equal(figures[1].evaluator, "forward");
    assert_int_equal(figures[1].jets, 99);
    assert_string_equal(figures[1].name, "b\xc3\xa4"
                                         "d\xef\xbf\xbd");
    assert_int_equal(figures[1].shadow_count, 2);
    assert_int_equal(figures[1].shadows[0].reachable, 0);
    assert_int_equal(figures[1].shadows[1].reachable, -1);
    assert_true(figures[1].shadows[0].centroid.z == 3);
    const sp_remedy_figures *remedy = &figures[1].shadows[0].remedy;
    assert_true(remedy->known && !figures[1].shadows[1].remedy.known);
    assert_string_equal(remedy->type, "cone");
    assert_string_equal(remedy->port, "P1");
    assert_true(remedy->position.y == 1 && remedy->area == 0.25 && fabs(remedy->flow - 2e-4) < 1e-18);
    assert_string_equal(figures[1].nozzles[0].type, "t");
    assert_string_equal(figures[1].nozzles[0].order_code, "c");
    assert_string_equal(figures[1].nozzles[0].url, "http://u");
    assert_true(isnan(figures[1].nozzles[0].angle));
    assert_false(figures[0].criterion_known || figures[1].criterion_known);
    assert_true(figures[1].nozzles[0].position.z == 1.5);
    assert_true(fabs(figures[1].flux_mean - 1e-4) < 1e-18);
    sp_figures_destroy(figures, count);
}

/* Of the whole, or of a layout of its own; of goods a dose. What is not there was not asked for. */
static void reads_what_was_asked_for(void **state)
{
    (void)state;
    sp_error error;
    size_t count;
    sp_figures *figures = read_text(
        "{\"sprayplan\": \"0.1.0\", \"criterion\": {\"flux_l_min_m2\": 6, \"impact_speed_m_s\": 2, \"combine\": "
        "\"single\"}, \"layouts\": [{" LAYOUT "}, {" LAYOUT ", \"pass_s\": 20, \"criterion\": {\"dose_l_m2\": 2, "
        "\"incidence_rad\": 1, \"combine\": \"sum\", \"film_l_min_m\": 30}}, {" LAYOUT ", \"criterion\": {}}]}",
        &count, &error);
    char clause[SP_CRITERION_TEXT];
    assert_non_null(figures);
    assert_true(figures[0].criterion_known && figures[1].criterion_known && figures[2].criterion_known);
    assert_float_equal(figures[0].criterion.flux, 1e-4, 1e-18);
    assert_true(figures[0].criterion.incidence == M_PI / 2 && figures[0].criterion.film == 0);
    assert_float_equal(figures[1].criterion.flux, 1e-4, 1e-18);
    sp_criterion_clause(&figures[0], clause);
    assert_string_equal(clause, "at least 6 L/min/m2, at least 2 m/s by one nozzle alone");
    sp_criterion_clause(&figures[1], clause);
    assert_string_equal(clause, "at least 2 L/m2, at most 57.3 deg from the normal, or film of at least 30 L/min/m");
    sp_criterion_clause(&figures[2], clause);
    assert_string_equal(clause, "any liquid");
    assert_false(sp_figures_share_criterion(figures, 2));
    assert_true(sp_figures_share_criterion(figures, 1));
    sp_figures_destroy(figures, count);
}

static void rejects(const char *text, const char *in_message)
{
    sp_error error;
    size_t count;
    assert_null(read_text(text, &count, &error));
    assert_int_equal(error.kind, SP_ERROR_INPUT);
    assert_int_equal(count, 0);
    assert_string_equal(error.file, PATH);
    if (!strstr(error.message, in_message))
        fail_msg("\"%s\" does not speak of \"%s\"", error.message, in_message);
}

#define HEAD "{\"sprayplan\": \"0.1.0\", \"layouts\": "

static void rejects_bad_input(void **state)
{
    (void)state;
    rejects("", "JSON");
    rejects("{\"sprayplan\": \"0.1.0\"", "JSON");
    rejects("[]", "an object");
    rejects("{\"layouts\": [{" LAYOUT "}]}", "sprayplan: missing");
    rejects("{\"sprayplan\": 3, \"layouts\": [{" LAYOUT "}]}", "sprayplan: found 3");
    rejects("{\"sprayplan\": \"0.1.0\"}", "layouts: missing");
    rejects(HEAD "{}}", "layouts: found an object");
    rejects(HEAD "[]}", "0 entries");
    rejects(HEAD "[7]}", "layouts[0]: found 7");
    rejects(HEAD "[{" LAYOUT "}, {}]}", "layouts[1].name: missing");
    rejects(HEAD "[{" LAYOUT ", \"name\": \"twice\"}]}", "duplicate");
    rejects(HEAD "[{\"name\": \"a\", \"water_l_min\": -1, \"coverage\": 0, \"nozzles\": []}]}",
            "water_l_min: found -1");
    rejects(HEAD "[{\"name\": \"a\", \"water_l_min\": 1, \"coverage\": 1.5, \"nozzles\": []}]}", "coverage: found 1.5");
    rejects(HEAD "[{\"name\": \"a\", \"water_l_min\": 1e999, \"coverage\": 1, \"nozzles\": []}]}", "JSON");
    rejects(HEAD "[{\"name\": \"a\", \"water_l_min\": \"1\", \"coverage\": 1, \"nozzles\": []}]}", "found a text");
    rejects(HEAD "[{\"name\": \"a\", \"coverage\": 1, \"nozzles\": []}]}", "water_l_min: missing");
    rejects(HEAD "[{\"name\": \"a\", \"water_l_min\": 1, \"coverage\": 1}]}", "nozzles: missing");
    rejects(HEAD "[{\"name\": \"a\", \"water_l_min\": 1, \"covered_area_m2\": 1, \"coverage\": 1, \"nozzles\": "
                 "[{\"name\": \"N\", \"type\": \"t\", \"url\": \"javascript:alert(1)\"}]}]}",
            "layouts[0].nozzles[0].url: found a text, expected an http or https address");
    rejects(HEAD "[{" LAYOUT ", \"shadows\": 1}]}", "layouts[0].shadows");
    rejects(HEAD "[{" LAYOUT ", \"shadows\": [{}, 4]}]}", "layouts[0].shadows[1]: found 4");
    rejects(HEAD "[{" LAYOUT ", \"shadows\": [{\"centroid_m\": [1, 2]}]}]}", "shadows[0].centroid_m");
    rejects(HEAD "[{" LAYOUT ", \"shadows\": [{\"reachable\": 1}]}]}", "shadows[0].reachable");
    rejects(HEAD "[{" LAYOUT ", \"shadows\": [{\"remedy\": 1}]}]}", "shadows[0].remedy");
    rejects(HEAD "[{" LAYOUT ", \"shadows\": [{\"remedy\": {\"covers_m2\": -1}}]}]}", "shadows[0].remedy.covers_m2");
    rejects(HEAD "[{" LAYOUT ", \"flux_l_min_m2\": {\"p05\": -2}}]}", "flux_l_min_m2.p05");
    rejects(HEAD "[{" LAYOUT ", \"geometry\": {\"triangles\": 0.5}}]}", "layouts[0].geometry.triangles");
    rejects(HEAD "[{\"name\": \"a\", \"water_l_min\": 1, \"coverage\": 1, \"error_estimate\": 2, \"nozzles\": []}]}",
            "layouts[0].error_estimate: found 2");
    rejects("{\"fidelity\": {\"evaluator\": \"magic\"}, \"sprayplan\": \"\", \"layouts\": [{" LAYOUT "}]}",
            "fidelity.evaluator");
    rejects(HEAD "[{" LAYOUT ", \"criterion\": {\"incidence_rad\": 3}}]}",
            "layouts[0].criterion.incidence_rad: found 3");
    rejects(HEAD "[{" LAYOUT ", \"criterion\": {\"combine\": \"most\"}}]}", "layouts[0].criterion.combine");
    rejects(HEAD "[{" LAYOUT ", \"criterion\": {\"dose_l_m2\": 3}}]}", "layouts[0].criterion.dose_l_m2");
    rejects("{\"sprayplan\": \"\", \"layouts\": [{\"name\": \"a\\u0000b\"}]}", "JSON");
}

static void rejects_every_cut(void **state)
{
    (void)state;
    const char *whole = HEAD "[{" LAYOUT ", \"shadows\": [{\"area_m2\": 1}]}]}";
    char text[512];
    for (size_t length = 0; length < strlen(whole); ++length) {
        snprintf(text, sizeof text, "%.*s", (int)length, whole);
        rejects(text, "");
    }
}

static void rejects_what_is_no_file(void **state)
{
    (void)state;
    size_t count;
    sp_error error = {0};
    assert_null(sp_figures_read(BINARY_DIR "/none.json", &count, &error));
    assert_int_equal(error.kind, SP_ERROR_INPUT);
    error = (sp_error){0};
    assert_null(sp_figures_read(BINARY_DIR, &count, &error));
    assert_int_equal(error.kind, SP_ERROR_INPUT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_what_design_says),  cmocka_unit_test(reads_what_was_asked_for),
        cmocka_unit_test(rejects_bad_input),       cmocka_unit_test(rejects_every_cut),
        cmocka_unit_test(rejects_what_is_no_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
