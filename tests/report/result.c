/* What result.json tells, and what is read back from it. */
#define FOLDER BINARY_DIR "/report-result-test"
#include "written.h"

static void result_json_has_the_keys_of_the_contract(void **state)
{
    size_t size;
    const fixture *f = *state;
    write_report(f);
    char *text = read_whole("result.json", &size);
    json_t *all = json_loads(text, JSON_REJECT_DUPLICATES, NULL);
    EXPECT_KEYS(all, "sprayplan", "command", "scene", "inputs", "geometry", "criterion", "fidelity", "layouts",
                "target", "front", "front_by_nozzles", "stages");
    EXPECT_KEYS(json_object_get(all, "geometry"), "triangles", "area_m2", "clean_area_m2", "attainable_area_m2",
                "unattainable_m2", "unattainable_by_part", "account");
    EXPECT_KEYS(json_object_get(json_object_get(all, "geometry"), "account"), "left_out_triangles", "closed_shells",
                "turned_shells", "open_shells", "open_shells_m2", "inside_m2", "touching_m2", "wet_on_both_sides_m2",
                "outdoors_m2");
    EXPECT_KEYS(json_object_get(json_object_get(all, "geometry"), "unattainable_m2"), "no_line_of_reach",
                "reflection_only", "too_slow", "too_slanted", "too_little_flux");
    EXPECT_KEYS(json_object_get(all, "criterion"), "flux_l_min_m2", "incidence_rad", "combine");
    EXPECT_KEYS(json_object_get(all, "fidelity"), "trajectory", "evaluator", "reflections", "texel_m", "error_estimate",
                "misjudged");
    json_t *layouts = json_object_get(all, "layouts");
    assert_int_equal(json_array_size(layouts), 3);
    json_t *manual = json_array_get(layouts, 0);
    EXPECT_KEYS(manual, "name", "water_l_min", "covered_area_m2", "coverage", "error_estimate", "misjudged",
                "coverage_of_attainable", "area_per_water", "flux_l_min_m2", "liquid_l_min", "parts", "shadows",
                "nozzles");
    EXPECT_KEYS(json_array_get(json_object_get(manual, "parts"), 0), "part", "area_m2", "covered_area_m2", "coverage");
    EXPECT_KEYS(json_array_get(json_object_get(all, "inputs"), 0), "file", "sha256");
    EXPECT_KEYS(json_object_get(manual, "flux_l_min_m2"), "min", "mean", "p05", "max");
    EXPECT_KEYS(json_array_get(json_object_get(manual, "shadows"), 0), "area_m2", "centroid_m", "part", "reachable",
                "lack", "nozzle");
    EXPECT_KEYS(json_array_get(json_object_get(manual, "nozzles"), 0), "name", "type", "position_m", "axis", "roll_rad",
                "angle_rad", "pressure_pa", "flow_l_min", "speed_m_s", "alone_m2", "lost_without_m2");
    EXPECT_KEYS(json_array_get(json_object_get(all, "front"), 0), "water_l_min", "coverage", "nozzles");
    assert_int_equal(json_array_size(json_object_get(all, "front_by_nozzles")), 3);
    EXPECT_KEYS(json_array_get(json_object_get(all, "front_by_nozzles"), 0), "nozzles", "water_l_min", "coverage");
    EXPECT_KEYS(json_array_get(json_object_get(all, "stages"), 0), "name", "seconds", "processor_seconds");
    double water = json_number_value(json_object_get(manual, "water_l_min"));
    assert_true(fabs(water - 6e4 * f->coverages[0]->flow) < 1e-9 * water);
    assert_true(json_number_value(json_object_get(manual, "coverage")) == f->coverages[0]->fraction);
    double worst = 0;
    for (int i = 0; i < 3; i++)
        worst = fmax(worst, f->coverages[i]->measured.estimate);
    assert_true(json_number_value(json_object_get(json_object_get(all, "fidelity"), "error_estimate")) == worst);
    assert_true(json_number_value(json_object_get(manual, "error_estimate")) == f->coverages[0]->measured.estimate);
    static const char *const keys[] = {"on_clean_surface", "on_other_surface", "left", "not_followed"};
    double liquid = 0;
    for (size_t i = 0; i < 4; i++)
        liquid += json_number_value(json_object_get(json_object_get(manual, "liquid_l_min"), keys[i]));
    assert_true(fabs(liquid - water) < 1e-9 * water);
    json_decref(all);
    free(text);
}

/* One that is looked for and helps, and one of which no candidate covers any. */
static void remedies_are_reported(void **state)
{
    const fixture *f = *state;
    sp_error error = {0};
    sp_remedy remedies[2] = {{.nozzle = f->layouts[2]->nozzles[0], .in_port = true, .area = 0.01, .flow = 2e-4}};
    strcpy(remedies[0].nozzle.name, "P<1>");
    sp_design design = f->designs[0];
    design.remedies = remedies;
    design.remedy_count = 2;
    sp_result result = {.command = "place", .scene = "vessel.yaml", .design_count = 1, .designs = &design};
    char *html = sp_report_html(&result, &error), *text = sp_result_json(&result, &error);
    assert_true(html && text);
    assert_non_null(strstr(html, "One more nozzle</th>"));
    assert_non_null(strstr(html, " in P&lt;1&gt; at "));
    assert_non_null(strstr(html, "&nbsp;% for 12&nbsp;L/min</td>"));
    assert_non_null(strstr(html, "<td class=\"text\">none</td>"));
    json_t *all = json_loads(text, JSON_REJECT_DUPLICATES, NULL),
           *layout = json_array_get(json_object_get(all, "layouts"), 0);
    const json_t *shadows = json_object_get(layout, "shadows");
    const json_t *first = json_object_get(json_array_get(shadows, 0), "remedy");
    EXPECT_KEYS(first, "type", "port", "position_m", "covers_m2", "water_l_min");
    assert_true(fabs(real_of(first, "water_l_min") - 12) < 1e-9 && real_of(first, "covers_m2") == 0.01);
    EXPECT_KEYS(json_object_get(json_array_get(shadows, 1), "remedy"), "covers_m2");
    assert_null(json_object_get(json_array_get(shadows, 2), "remedy"));
    json_decref(all);
    free(text);
    free(html);
}

/* What is out of reach is so for reasons that add up to it; unknown ones are not told. */
static void reasons_add_up(void **state)
{
    const fixture *f = *state;
    sp_error error = {0};
    char *html = sp_report_html(&f->result, &error), *text = sp_result_json(&f->result, &error);
    json_t *all = json_loads(text, JSON_REJECT_DUPLICATES, NULL), *geometry = json_object_get(all, "geometry");
    const json_t *missing = json_object_get(geometry, "unattainable_m2");
    double lines = real_of(missing, "no_line_of_reach"), slanted = real_of(missing, "too_slanted");
    assert_true(lines > 0 && slanted > 1.5 * lines);
    assert_true(fabs(real_of(geometry, "clean_area_m2") - real_of(geometry, "attainable_area_m2") - lines - slanted) <
                1e-9);
    assert_true(real_of(missing, "reflection_only") == 0 && real_of(missing, "too_slow") == 0);
    const char *list = strstr(html, "<ul id=\"reasons\">"), *first = list ? strstr(list, "too slanted: ") : NULL;
    const char *second = list ? strstr(list, "no line of reach: ") : NULL;
    assert_true(first && second && first < second);
    assert_null(strstr(list, "too slow: "));
    json_t *shadow;
    size_t i, told = 0;
    json_array_foreach(json_object_get(json_array_get(json_object_get(all, "layouts"), 0), "shadows"), i, shadow)
    {
        const char *reason = json_string_value(json_object_get(shadow, "reason"));
        assert_true(!reason == json_is_true(json_object_get(shadow, "reachable")));
        told += reason && !strcmp(reason, "too_slanted");
    }
    assert_true(told > 0);
    json_decref(all);
    free(text);
    free(html);

    sp_proposal proposal = f->proposal;
    sp_result result = f->result;
    proposal.reasons = NULL;
    result.proposal = &proposal;
    text = sp_result_json(&result, &error);
    assert_non_null(strstr(text, "attainable_area_m2"));
    assert_null(strstr(text, "unattainable_m2"));
    assert_null(strstr(text, "\"reason\""));
    assert_null(strstr(text, "unattainable_by_part"));
    free(text);
    html = sp_report_html(&result, &error);
    assert_non_null(strstr(html, "of every allowed nozzle, or was not looked into: "));
    assert_null(strstr(html, "are attainable, so that"));
    free(html);
}

/* Each by a value of its own, so that no two can be confused and none be off by a factor. */
static void flux_is_reported_as_it_is(void **state)
{
    const fixture *f = *state;
    static const char *const keys[] = {"min", "p05", "mean", "max"};
    sp_error error = {0};
    sp_coverage coverage = *f->coverages[0];
    coverage.flux_min = 0.5 / 6e4;
    coverage.flux_p05 = 1.25 / 6e4;
    coverage.flux_mean = 7.5 / 6e4;
    coverage.flux_max = 80 / 6e4;
    const double expected[] = {0.5, 1.25, 7.5, 80};
    sp_design design = f->designs[0];
    design.coverage = &coverage;
    sp_result result = {.command = "simulate", .scene = "vessel.yaml", .design_count = 1, .designs = &design};
    char *text = sp_result_json(&result, &error);
    json_t *all = json_loads(text, JSON_REJECT_DUPLICATES, NULL);
    const json_t *flux = json_object_get(json_array_get(json_object_get(all, "layouts"), 0), "flux_l_min_m2");
    for (size_t i = 0; i < 4; i++)
        assert_true(fabs(real_of(flux, keys[i]) - expected[i]) < 1e-9);
    json_decref(all);
    free(text);
}

static void same_rows(const sp_figures *a, const sp_figures *b)
{
    assert_int_equal(a->part_count, 2);
    assert_int_equal(b->part_count, 2);
    for (size_t k = 0; k < 2; k++) {
        assert_string_equal(a->parts[k].part, b->parts[k].part);
        same_real(a->parts[k].area, b->parts[k].area);
        same_real(a->parts[k].covered, b->parts[k].covered);
    }
    for (size_t k = 0; k < a->shadow_count; k++) {
        assert_int_equal(a->shadows[k].lack, b->shadows[k].lack);
        assert_string_equal(a->shadows[k].nozzle, b->shadows[k].nozzle);
    }
    for (size_t k = 0; k < a->nozzle_count; k++) {
        assert_true(a->nozzles[k].alone > 0);
        same_real(a->nozzles[k].alone, b->nozzles[k].alone);
        same_real(a->nozzles[k].lost, b->nozzles[k].lost);
    }
}

/* What is read back from result.json is what was written. */
static void figures_survive_the_file(void **state)
{
    const fixture *f = *state;
    sp_error error = {0};
    size_t count;
    write_report(f);
    sp_figures *written = sp_result_figures(&f->result, &error);
    sp_figures *read = sp_figures_read(FOLDER "/result.json", &count, &error);
    assert_non_null(read);
    assert_int_equal(count, 3);
    assert_true(written[0].missing_count > 0 && written[0].flux_mean > 0 && written[0].landed_clean > 0);
    for (size_t i = 0; i < 3; i++) {
        const sp_figures *a = &written[i], *b = &read[i];
        assert_int_equal(a->missing_count, b->missing_count);
        for (size_t k = 0; k < a->missing_count; k++) {
            assert_string_equal(a->missing[k].part, b->missing[k].part);
            same_real(a->missing[k].area, b->missing[k].area);
            for (sp_reason reason = SP_REASON_NO_LINE; reason < SP_REASONS; reason++)
                same_real(a->missing[k].areas[reason], b->missing[k].areas[reason]);
        }
        const double first[] = {a->flow,         a->covered_area, a->coverage,   a->of_attainable,  a->area_per_water,
                                a->flux_min,     a->flux_mean,    a->flux_p05,   a->flux_max,       a->landed_clean,
                                a->landed_other, a->left,         a->unfollowed, a->attainable_area};
        const double second[] = {b->flow,         b->covered_area, b->coverage,   b->of_attainable,  b->area_per_water,
                                 b->flux_min,     b->flux_mean,    b->flux_p05,   b->flux_max,       b->landed_clean,
                                 b->landed_other, b->left,         b->unfollowed, b->attainable_area};
        for (size_t k = 0; k < sizeof first / sizeof *first; k++)
            same_real(first[k], second[k]);
        assert_true(a->criterion_known && b->criterion_known && sp_same_criterion(a, b));
        same_rows(a, b);
    }
    sp_figures_destroy(written, 3);
    sp_figures_destroy(read, count);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(result_json_has_the_keys_of_the_contract),
        cmocka_unit_test(remedies_are_reported),
        cmocka_unit_test(reasons_add_up),
        cmocka_unit_test(flux_is_reported_as_it_is),
        cmocka_unit_test(figures_survive_the_file),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
