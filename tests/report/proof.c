/* The chart of the front, and what the page and result.json say of its proof. */
#define FOLDER BINARY_DIR "/report-proof-test"
#include "written.h"

/* The height of the chart of the front, in its own units. */
static double chart_height(const sp_result *result)
{
    sp_error error = {0};
    char *html = sp_report_html(result, &error);
    const char *chart = strstr(html, "<svg class=\"chart\" viewBox=\"0 0 ");
    double width = 0, height = 0;
    assert_true(chart && sscanf(chart, "<svg class=\"chart\" viewBox=\"0 0 %lf %lf", &width, &height) == 2);
    free(html);
    return height;
}

/* Where much water covers little, so that the corner has points in it, the legend stands below the chart. */
static void the_legend_leaves_points_alone(void **state)
{
    const fixture *f = *state;
    sp_result result = f->result;
    sp_proposal proposal = f->proposal;
    sp_front_point front[3];
    result.proposal = &proposal;
    proposal.front = front;
    memcpy(front, f->front, sizeof front);
    double clean = sp_evaluator_patches(f->evaluator)->total_area;
    for (int i = 0; i < 3; i++)
        front[i].area = (0.9 + 0.01 * i) * clean;
    front[0].outlay = 1e-9;
    double within = chart_height(&result);
    front[2].outlay *= 2;
    front[2].area = 0.5 * clean;
    front[1].area = front[0].area = 0.1 * clean;
    assert_true(chart_height(&result) > within);
}

/* The words of the report are the promise: rounded so that they stay true. */
static void what_jets_say_otherwise_is_a_warning(void **state)
{
    (void)state;
    fixture *f = *state;
    sp_proposal proposal = f->proposal;
    sp_result result = f->result;
    sp_error error = {0};
    result.proposal = &proposal;
    for (int agrees = 0; agrees < 2; agrees++) {
        proposal.forward_check = (sp_forward_check){.computed = true,
                                                    .texels = 20011,
                                                    .jets = 2000000,
                                                    .coverage = 0.1152,
                                                    .difference = agrees ? 0.0049 : -0.4137,
                                                    .tolerance = 0.01,
                                                    .agrees = agrees};
        char *html = sp_report_html(&result, &error), *text = sp_result_json(&result, &error);
        assert_non_null(html);
        assert_non_null(strstr(html, "counted again by 2 million jets, on 20011 texels, the proposal hits as much as "
                                     "the criterion asks for on 11.5&nbsp;%"));
        assert_true((strstr(html, "id=\"doubt\"") == NULL) == (agrees == 1));
        assert_non_null(strstr(html, agrees ? "finds 11.0&nbsp;%" : "which the search uses, 52.9&nbsp;%"));
        json_t *all = json_loads(text, JSON_REJECT_DUPLICATES, NULL), *check = json_object_get(all, "forward_check");
        EXPECT_KEYS(check, "coverage", "difference", "tolerance", "agrees", "jets", "texels");
        assert_true(json_is_boolean(json_object_get(check, "agrees")));
        assert_true(json_is_true(json_object_get(check, "agrees")) == (agrees == 1));
        assert_true(real_of(check, "coverage") == 0.1152);
        json_decref(all);
        free(html);
        free(text);
    }
}

/* A bound holds for what costs as much as its point or less: it is drawn to the point's left, none beyond the last. */
static void assert_bounds_end_at_their_points(const char *html)
{
    const char *bound = strstr(html, "<path class=\"bound\"") + strlen("<path class=\"bound\"");
    const char *point = strstr(html, "<circle class=\"point\"");
    double last = INFINITY, start, y, x, cx;
    int read = 0;
    assert_true(sscanf(bound, " d=\"M70 %lf%n", &start, &read) == 1 && read > 0);
    for (int i = 0; i < 3; i++) {
        bound += read;
        assert_true(sscanf(bound, "V%lfH%lf%n", &y, &x, &read) == 2);
        assert_true(point && sscanf(point, "<circle class=\"point\" cx=\"%lf\"", &cx) == 1);
        assert_true(x == cx && y < last && (i > 0 || y == start));
        last = y;
        point = strstr(point + 1, "<circle class=\"point\"");
    }
    assert_int_equal(bound[read], '"');
}

typedef struct {
    sp_front_point front[3];
    sp_proposal proposal;
    sp_result result;
} proved_result;

/* The fixture's result with bounds along the front, and a certificate. */
static void prove(const fixture *f, proved_result *p)
{
    *p = (proved_result){.proposal = f->proposal, .result = f->result};
    for (int i = 0; i < 3; i++) {
        p->front[i] = f->front[i];
        p->front[i].counted = 6 + i;
        p->front[i].bound = 8 + 0.5 * i;
        p->front[i].every_aim_bound = 9 + 0.25 * i;
    }
    p->result.proposal = &p->proposal;
    p->proposal.front = p->front;
    p->proposal.certificate = (sp_certificate){
        .computed = true,
        .texels = 20011,
        .candidates = 123456,
        .own = 7,
        .whole = 10,
        .counted = 8.0401,
        .area_bound = 9.0001,
        .water_bound = 31.29 / 6e4,
        .gap = 0.10667,
        .every_aim = {.computed = true, .places = 56, .area_bound = 9.5, .water_bound = 23.45 / 6e4, .gap = 0.1537}};
}

/* The caller frees. */
static json_t *proved_json(const proved_result *p)
{
    sp_error error = {0};
    char *text = sp_result_json(&p->result, &error);
    assert_non_null(text);
    json_t *all = json_loads(text, JSON_REJECT_DUPLICATES, NULL);
    free(text);
    return all;
}

static void without_a_certificate_nothing_is_claimed(void **state)
{
    const fixture *f = *state;
    sp_error error = {0};
    char *html = sp_report_html(&f->result, &error);
    assert_non_null(strstr(html, "is not known"));
    assert_null(strstr(html, "id=\"certificate\""));
    assert_null(strstr(html, "class=\"bound\""));
    free(html);
}

static void the_page_says_what_is_proved(void **state)
{
    const fixture *f = *state;
    sp_error error = {0};
    proved_result p;
    prove(f, &p);
    char *html = sp_report_html(&p.result, &error);
    assert_non_null(strstr(html,
                           "Among these 123456 candidate poses and the proposal&#39;s own, on 20011 texels, no layout "
                           "reaches 80.5&nbsp;% with less than 31.2&nbsp;L/min. Poses between candidates are not "
                           "covered."));
    assert_non_null(
        strstr(html, "That share of the surface to be cleaned, attainable or not, rounded up, is what the proposal"));
    assert_non_null(strstr(html, "no layout reaches more than 90.1&nbsp;%: at most 10.7&nbsp;% of what"));
    assert_bounds_end_at_their_points(html);
    assert_null(strstr(html, "is not known"));
    assert_null(strstr(html, "More water is allowed"));
    free(html);
    /* of as much coverage as can be that is not the bound asked for */
    p.proposal.objective = SP_OBJECTIVE_MAX_COVERAGE;
    for (int more = 0; more < 2; more++) {
        p.proposal.max_water = (more ? 1.01 : 1) * p.proposal.coverage->flow;
        html = sp_report_html(&p.result, &error);
        assert_true((strstr(html, "More water is allowed than the proposal takes.") != NULL) == more);
        free(html);
    }
    p.proposal.objective = SP_OBJECTIVE_MIN_WATER;
    /* not those that the search says it looked at */
    p.proposal.candidates = 200000;
    html = sp_report_html(&p.result, &error);
    assert_non_null(strstr(html, "Among these 123456 candidate poses (of 200000; the others are in ports that kept "
                                 "nozzles hold, or were not traced in time) and the proposal"));
    free(html);
}

static void a_certificate_is_reported_in_full(void **state)
{
    const fixture *f = *state;
    proved_result p;
    prove(f, &p);
    json_t *all = proved_json(&p), *certificate = json_object_get(all, "certificate");
    EXPECT_KEYS(certificate, "method", "coverage", "coverage_bound_same_water", "water_bound_same_coverage_l_min",
                "gap", "candidates", "own_poses", "texels", "every_aim");
    assert_true(fabs(real_of(certificate, "coverage_bound_same_water") - 0.90001) < 1e-12);
    assert_true(fabs(real_of(certificate, "water_bound_same_coverage_l_min") - 31.29) < 1e-9);
    assert_true(fabs(real_of(certificate, "coverage") - 0.80401) < 1e-12);
    assert_true(real_of(certificate, "gap") == 0.10667);
    const json_t *every = json_object_get(certificate, "every_aim");
    assert_true(fabs(real_of(every, "water_bound_same_coverage_l_min") - 23.45) < 1e-9);
    assert_true(fabs(real_of(every, "coverage_bound_same_water") - 0.95) < 1e-12);
    assert_true(real_of(every, "gap") == 0.1537 && real_of(every, "mounting_points") == 56);
    json_decref(all);
}

static void bounds_along_the_front_are_reported(void **state)
{
    const fixture *f = *state;
    proved_result p;
    prove(f, &p);
    json_t *all = proved_json(&p), *points = json_object_get(all, "front");
    EXPECT_KEYS(json_array_get(points, 0), "water_l_min", "coverage", "nozzles", "coverage_on_texels", "coverage_bound",
                "coverage_bound_every_aim");
    for (size_t i = 0; i < 3; i++) {
        const json_t *point = json_array_get(points, i);
        assert_true(fabs(real_of(point, "water_l_min") - 6e4 * p.front[i].flow) < 1e-9);
        assert_true(fabs(real_of(point, "coverage_on_texels") - p.front[i].counted / 10) < 1e-12);
        assert_true(fabs(real_of(point, "coverage_bound") - p.front[i].bound / 10) < 1e-12);
        assert_true(fabs(real_of(point, "coverage_bound_every_aim") - p.front[i].every_aim_bound / 10) < 1e-12);
    }
    json_decref(all);
}

/* The chart's section of a result of two alternatives, of which `proved` many have a certificate, the proposed one
 * last; the caller frees. */
static char *chart_of_alternatives(const fixture *f, size_t proved)
{
    sp_error error = {0};
    bool fittings[4] = {true};
    sp_proposal proposals[2] = {f->proposal, f->proposal};
    sp_front_point front[3];
    memcpy(front, f->front, sizeof front);
    for (int i = 0; i < 3; i++)
        front[i].counted = front[i].bound = front[i].every_aim_bound = 8;
    sp_design designs[2] = {f->designs[1], f->designs[2]};
    for (size_t i = 0; i < 2; i++) {
        designs[i].name = i ? "of two" : "of one";
        designs[i].alternative = &proposals[i];
        proposals[i].layout = f->layouts[1 + i];
        proposals[i].coverage = f->coverages[1 + i];
        proposals[i].front = front;
        proposals[i].fittings = fittings;
        if (i < proved)
            proposals[i].certificate = (sp_certificate){
                .computed = true, .whole = 10, .counted = 8, .area_bound = 9, .water_bound = 5e-4, .gap = 0.1};
    }
    sp_result result = f->result;
    result.designs = designs;
    result.design_count = 2;
    result.proposal = &proposals[1];
    result.picture_share = -1;
    char *html = sp_report_html(&result, &error), *chart = html ? strstr(html, "<section id=\"front\">") : NULL;
    if (!chart)
        fail_msg("%s", error.message);
    *strstr(chart, "</section>") = 0;
    chart = strdup(chart);
    free(html);
    return chart;
}

/* Whichever alternative is proposed. */
static void lines_that_are_drawn_are_explained(void **state)
{
    static const char entry[] = ">Proved: none covers more</text>", dashed[] = "The dashed line is what no layout",
                      unknown[] = "how far the best possible may lie above is not known";
    for (size_t proved = 0; proved < 3; proved++) {
        char *chart = chart_of_alternatives(*state, proved);
        assert_int_equal(occurrences(chart, "<path class=\"bound\""), proved ? proved + 1 : 0);
        assert_int_equal(occurrences(chart, entry), proved > 0);
        assert_int_equal(occurrences(chart, dashed), proved > 0);
        assert_int_equal(occurrences(chart, unknown), proved == 1);
        assert_int_equal(occurrences(chart, "How far the best possible may lie above is not known"), proved == 0);
        free(chart);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_legend_leaves_points_alone),
        cmocka_unit_test(what_jets_say_otherwise_is_a_warning),
        cmocka_unit_test(without_a_certificate_nothing_is_claimed),
        cmocka_unit_test(the_page_says_what_is_proved),
        cmocka_unit_test(a_certificate_is_reported_in_full),
        cmocka_unit_test(bounds_along_the_front_are_reported),
        cmocka_unit_test(lines_that_are_drawn_are_explained),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
