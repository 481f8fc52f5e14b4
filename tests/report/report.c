#include "tank.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <jansson.h>

#define FOLDER BINARY_DIR "/report-test"

typedef struct {
    sp_mesh *mesh;
    sp_evaluator *evaluator;
    sp_layout *layouts[3];
    sp_coverage *coverages[3];
    sp_contributions *contributions[3];
    sp_design designs[3];
    sp_front_point front[3];
    sp_stage stages[2];
    sp_proposal proposal;
    sp_result result;
} fixture;

static const sp_input read_once = {"<i>.yaml", "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"};

static int set_up(void **state)
{
    static fixture f;
    sp_error error = {0};
    f.mesh = tank_mesh(48, &error);
    sp_setup setup = tank_setup(f.mesh, 0.02);
    f.evaluator = sp_evaluator_create(&setup, &error);
    f.layouts[0] = sp_layout_create(tank_manual, 3, &error);
    f.layouts[1] = sp_layout_create(tank_proposed, 3, &error);
    f.layouts[2] = sp_layout_create(tank_proposed, 4, &error);
    const char *const names[] = {"manual", "greedy", "proposed"};
    for (int i = 0; i < 3; i++) {
        f.coverages[i] = sp_evaluate(f.evaluator, f.layouts[i], &error);
        sp_evaluate_balance(f.evaluator, f.layouts[i], f.coverages[i], &error);
        sp_measure_error(f.evaluator, f.layouts[i], f.coverages[i], SP_TRAJECTORY_AUTO, 1, &f.coverages[i]->measured,
                         &error);
        f.contributions[i] = sp_contributions_create(f.evaluator, f.layouts[i], f.coverages[i], &error);
        f.designs[i] = (sp_design){.name = names[i],
                                   .evaluator = f.evaluator,
                                   .layout = f.layouts[i],
                                   .coverage = f.coverages[i],
                                   .contributions = f.contributions[i]};
    }
    if (error.kind != SP_OK) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    size_t patches = sp_evaluator_patches(f.evaluator)->count;
    bool *attainable = malloc(patches);
    memcpy(attainable, f.coverages[2]->deposits.covered, patches);
    sp_reason *reasons = malloc(patches * sizeof *reasons);
    for (size_t i = 0; i < patches; i++)
        reasons[i] = attainable[i] ? SP_REASON_ATTAINABLE : i % 3 ? SP_REASON_SLANTED : SP_REASON_NO_LINE;
    for (int i = 0; i < 3; i++)
        f.front[i] = (sp_front_point){f.coverages[2]->flow * (i + 1) / 3,
                                      f.coverages[2]->covered_area * (0.7 + 0.1 * i),
                                      (size_t)i + 1,
                                      NAN,
                                      NAN,
                                      NAN,
                                      0,
                                      f.coverages[2]->flow * (i + 1) / 3};
    f.stages[0] = (sp_stage){"visibility", 1.25, 2.25};
    f.stages[1] = (sp_stage){"refine", 2.5, 4.75};
    f.proposal = (sp_proposal){.layout = f.layouts[2],
                               .coverage = f.coverages[2],
                               .greedy = f.layouts[1],
                               .greedy_coverage = f.coverages[1],
                               .attainable = attainable,
                               .reasons = reasons,
                               .attainable_area = 5,
                               .asked_area = 99,
                               .target_area = 50,
                               .positions = 100,
                               .candidates = 4000,
                               .front_count = 3,
                               .front = f.front,
                               .by_number_count = 3,
                               .by_number = f.front,
                               .stage_count = 2,
                               .stages = f.stages};
    f.result = (sp_result){.command = "place",
                           .scene = "vessel <script>alert(1)</script> & \"co\".yaml",
                           .design_count = 3,
                           .designs = f.designs,
                           .proposal = &f.proposal,
                           .input_count = 1,
                           .inputs = &read_once,
                           .command_line = "sprayplan place '<b>.yaml'",
                           .date = "2026-11-24 12:00 UTC"};
    *state = &f;
    return 0;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    for (int i = 0; i < 3; i++) {
        sp_layout_destroy(f->layouts[i]);
        sp_coverage_destroy(f->coverages[i]);
        sp_contributions_destroy(f->contributions[i]);
    }
    free(f->proposal.attainable);
    free(f->proposal.reasons);
    sp_evaluator_destroy(f->evaluator);
    sp_mesh_destroy(f->mesh);
    return 0;
}

static char *read_whole(const char *name, size_t *size)
{
    char path[1024];
    snprintf(path, sizeof path, FOLDER "/%s", name);
    FILE *file = fopen(path, "rb");
    if (!file)
        return NULL;
    fseek(file, 0, SEEK_END);
    long length = ftell(file);
    rewind(file);
    char *bytes = malloc((size_t)length + 1);
    assert_int_equal(fread(bytes, 1, (size_t)length, file), (size_t)length);
    fclose(file);
    bytes[length] = 0;
    *size = (size_t)length;
    return bytes;
}

static void write_report(const fixture *f)
{
    sp_error error = {0};
    sp_output *output = sp_output_open(FOLDER, &error);
    assert_non_null(output);
    if (!sp_report_write(&f->result, output, &error))
        fail_msg("%s", error.message);
    assert_true(sp_output_commit(output, &error));
}

static const char *const files[] = {
    "result.json",         "report.html",         "nozzles.csv",         "coverage.png",     "deposits.exr",
    "model.glb",           "coverage-manual.png", "deposits-manual.exr", "model-manual.glb", "coverage-greedy.png",
    "deposits-greedy.exr", "model-greedy.glb",    "surface.vtp",         "texels.vtp",       "nozzles.stl",
    "swabs.csv",           "nozzles-all.csv"};
#define FILES (sizeof files / sizeof *files)

static void the_same_bytes_every_time(void **state)
{
    char *first[FILES];
    size_t first_size[FILES], size;
    write_report(*state);
    for (size_t i = 0; i < FILES; i++) {
        first[i] = read_whole(files[i], &first_size[i]);
        assert_non_null(first[i]);
        assert_true(first_size[i] > 100);
    }
    write_report(*state);
    for (size_t i = 0; i < FILES; i++) {
        char *again = read_whole(files[i], &size);
        assert_int_equal(size, first_size[i]);
        assert_memory_equal(again, first[i], size);
        free(again);
        free(first[i]);
    }
}

static size_t occurrences(const char *text, const char *part)
{
    size_t count = 0;
    for (; (text = strstr(text, part)); text += strlen(part))
        count++;
    return count;
}

static void the_page_stands_alone(void **state)
{
    (void)state;
    size_t size;
    char *page = read_whole("report.html", &size);
    assert_int_equal(strlen(page), size);
    /* the viewer's data and its script; whatever names hold ends neither, and the page may ask for nothing */
    assert_int_equal(occurrences(page, "<script"), 2);
    assert_int_equal(occurrences(page, "</script"), 2);
    assert_non_null(strstr(page, "N3 \\u003cb>"));
    assert_non_null(strstr(page, "content=\"default-src 'none'; "));
    assert_int_equal(occurrences(page, "src=\"http"), 0);
    assert_int_equal(occurrences(page, "<link"), 0);
    /* three views of three designs, each with words for who cannot see it */
    assert_int_equal(occurrences(page, "href=\"data:image/webp;base64,"), 9);
    assert_int_equal(occurrences(page, "<image "), 9);
    assert_true(occurrences(page, "<svg ") >= 9);
    assert_int_equal(occurrences(page, "<svg "), occurrences(page, " role=\"img\" aria-label=\""));
    free(page);
}

/* One, two and three. */
static void coverage_is_told_by_number_of_nozzles(void **state)
{
    const fixture *f = *state;
    sp_error error = {0};
    sp_figures *figures = sp_result_figures(&f->result, &error);
    size_t size;
    char *page = read_whole("report.html", &size), row[200];
    const char *table = strstr(page, "<section id=\"counts\">");
    assert_non_null(table);
    for (size_t i = 0; i < 3; i++) {
        snprintf(row, sizeof row, ">%zu</th><td>%.1f&nbsp;%%</td><td>%.1f&nbsp;L/min</td>", i + 1,
                 100 * f->front[i].area / figures[2].clean_area, 6e4 * f->front[i].flow);
        table = strstr(table, row);
        if (!table)
            fail_msg("no row %s", row);
    }
    sp_figures_destroy(figures, f->result.design_count);
    free(page);
}

/* The main figures beside their errors, parts from the least covered on, shadows by number, samples, and what all was
 * made of. */
static void the_page_says_what_paper_needs(void **state)
{
    const fixture *f = *state;
    sp_error error = {0};
    sp_figures *figures = sp_result_figures(&f->result, &error);
    size_t size, numbered;
    char *page = read_whole("report.html", &size), text[200];
    snprintf(text, sizeof text, "covers <strong>%.1f&nbsp;%%&nbsp;\xc2\xb1&nbsp;%.1f</strong>",
             100 * figures[2].coverage, ceil(1e3 * figures[2].error_estimate) / 10);
    assert_non_null(strstr(page, text));
    const sp_part_figures *parts = figures[2].parts;
    bool shell_first = parts[0].covered / parts[0].area < parts[1].covered / parts[1].area;
    const char *table = strstr(page, "<section id=\"parts\">");
    assert_non_null(table);
    assert_true((strstr(table, ">shell</th>") < strstr(table, ">dip &lt;tube&gt;</th>")) == shell_first);
    assert_non_null(strstr(page, "<section id=\"contributions\">"));
    numbered = occurrences(page, "<text class=\"number\"");
    assert_true(numbered >= 3 && numbered == occurrences(page, "<circle class=\"shadow\""));
    assert_non_null(strstr(page, "<section id=\"swabs\">"));
    assert_non_null(strstr(page, "&lt;i&gt;.yaml</th><td class=\"text digest\">ba7816bf8f01cfea"));
    assert_non_null(strstr(page, ", 2026-11-24 12:00 UTC, by <code>sprayplan place &#39;&lt;b&gt;.yaml&#39;</code>."));
    sp_figures_destroy(figures, 3);
    free(page);
}

/* Tables that paper needs, number by number: what each nozzle does, and why shadows are dry and who is nearest. */
static void the_page_says_what_nozzles_do_and_shadows_lack(void **state)
{
    const fixture *f = *state;
    sp_error error = {0};
    sp_figures *figures = sp_result_figures(&f->result, &error);
    size_t size, lines = 0;
    char *page = read_whole("report.html", &size), text[300];
    const char *table = strstr(page, "<section id=\"contributions\">"), *end = strstr(table, "</section>");
    for (size_t d = 0; d < 3; d++)
        for (size_t i = 0; i < figures[d].nozzle_count; i++) {
            const sp_nozzle_figures *nozzle = &figures[d].nozzles[i];
            snprintf(text, sizeof text, "<td>%.1f</td><td>%.3f</td><td>%.1f</td><td>%.3f</td><td>%.2f</td></tr>",
                     6e4 * nozzle->flow, nozzle->alone, 100 * nozzle->alone / figures[d].clean_area, nozzle->lost,
                     100 * nozzle->lost / figures[d].clean_area);
            table = strstr(table, text);
            if (!table || table > end)
                fail_msg("no row %s", text);
        }
    table = strstr(page, "<section id=\"shadows\">");
    for (size_t i = 0; i < figures[0].shadow_count && i < 10; i++) {
        snprintf(text, sizeof text, "<td class=\"text\">%s</td><td class=\"text\">%s</td>",
                 sp_lack_text(figures[0].shadows[i].lack),
                 *figures[0].shadows[i].nozzle ? figures[0].shadows[i].nozzle : "\xe2\x80\x93");
        table = strstr(table, text);
        if (!table)
            fail_msg("no row %s", text);
        table += strlen(text);
    }
    char *csv = read_whole("swabs.csv", &size);
    lines = occurrences(csv, "\n");
    table = strstr(page, "<section id=\"swabs\">");
    assert_int_equal(occurrences(table, "<td class=\"text lack\">"), lines - 1);
    free(csv);
    free(page);
    sp_figures_destroy(figures, 3);
}

static void names_from_strangers_stay_text(void **state)
{
    (void)state;
    size_t size;
    char *page = read_whole("report.html", &size);
    assert_non_null(strstr(page, "vessel &lt;script&gt;alert(1)&lt;/script&gt; &amp; "));
    assert_non_null(strstr(page, "N3 &lt;b&gt;"));
    assert_non_null(strstr(page, "<a href=\"https://example.com/f?a=1&amp;b=2\" rel=\"noopener noreferrer\">"
                                 "flat-fan-90 &amp; co</a></td><td class=\"text\">F&lt;90&gt;</td>"));
    assert_non_null(strstr(page, "<td class=\"text\">full-cone-120</td><td class=\"text\"></td>"));
    assert_non_null(strstr(page, "dip &lt;tube&gt;"));
    assert_non_null(strstr(page, "<dt>Measured error</dt><dd>Manual \xc2\xb1"));
    assert_null(strstr(page, "N3 <b>"));
    assert_null(strstr(page, "dip <tube>"));
    free(page);
}

static void expect_keys(const json_t *object, const char *const *keys, size_t count)
{
    assert_true(json_is_object(object));
    for (size_t i = 0; i < count; i++)
        if (!json_object_get(object, keys[i]))
            fail_msg("no key %s", keys[i]);
    assert_int_equal(json_object_size(object), count);
}

#define EXPECT_KEYS(object, ...)                                                                                       \
    do {                                                                                                               \
        static const char *const keys[] = {__VA_ARGS__};                                                               \
        expect_keys(object, keys, sizeof keys / sizeof *keys);                                                         \
    } while (0)

static void result_json_has_the_keys_of_the_contract(void **state)
{
    size_t size;
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
    const fixture *f = *state;
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

static double real_of(const json_t *object, const char *key)
{
    return json_number_value(json_object_get(object, key));
}

/* One that is looked for and helps, and one of which no candidate covers any. */
static void remedies_are_told(void **state)
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
static void flux_is_told_as_it_is(void **state)
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

static void same_real(double a, double b)
{
    assert_true((isnan(a) && isnan(b)) || fabs(a - b) <= 1e-12 * fabs(a));
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

/* By name, with the pictures, for which there was no time either. */
static void what_was_left_out_is_named(void **state)
{
    const fixture *f = *state;
    static const char *const left_out[] = {"the page's pictures"};
    sp_error error = {0};
    sp_proposal proposal = f->proposal;
    sp_result result = f->result;
    double seconds = -1;
    proposal.interrupted = true;
    proposal.cut_count = 2;
    strcpy(proposal.cut[0], "exchange");
    strcpy(proposal.cut[1], "front");
    result.proposal = &proposal;
    result.left_out = left_out;
    result.left_out_count = 1;
    result.picture_share = -1;
    char *html = sp_report_html(&result, &error), *text = sp_result_json(&result, &error);
    assert_non_null(strstr(html, "The search was stopped before its end (exchange, front); this is"));
    assert_non_null(strstr(html, "Cut short or left out: exchange, front, the page&#39;s pictures."));
    assert_null(strstr(html, "id=\"pictures\""));
    json_t *json = json_loads(text, 0, NULL), *cut = json_object_get(json, "cut_short");
    assert_int_equal(json_array_size(cut), 3);
    assert_string_equal(json_string_value(json_array_get(cut, 2)), left_out[0]);
    assert_true(sp_report_picture_time(&result, &seconds, &error));
    assert_true(seconds > 0);
    json_decref(json);
    free(html);
    free(text);
}

/* What is written over a picture keeps its place and size on the page, however few pixels the picture has. */
static void smaller_pictures_have_the_same_labels(void **state)
{
    const fixture *f = *state;
    sp_error error = {0};
    sp_result result = f->result;
    char *full = sp_report_html(&result, &error);
    result.picture_share = 0.3;
    char *small = sp_report_html(&result, &error);
    assert_true(full && small && strlen(small) < strlen(full));
    const char *a = full, *b = small;
    static const char *const over[] = {"<svg class=\"view\" viewBox=", "<circle class=\"nozzle\"",
                                       "<text class=\"name\""};
    size_t compared = 0;
    for (size_t k = 0; k < sizeof over / sizeof *over; k++, a = full, b = small)
        while ((a = strstr(a, over[k])) && (b = strstr(b, over[k]))) {
            assert_memory_equal(a, b, strcspn(a, ">"));
            a++, b++, compared++;
        }
    assert_true(compared > 20);
    assert_null(strstr(full, "class=\"shadow\" cx=\"0.0\""));
    assert_null(strstr(small, "class=\"shadow\" cx=\"0.0\""));
    free(full);
    free(small);
}

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

/* Before anything else: how much, why, and of which parts. */
static void what_is_out_of_reach_is_said_first(void **state)
{
    const fixture *f = *state;
    sp_error error = {0};
    char *html = sp_report_html(&f->result, &error), text[200];
    sp_figures *figures = sp_result_figures(&f->result, &error);
    const char *first = strstr(html, "<p id=\"out-of-reach\" class=\"warning\">");
    assert_true(first && first < strstr(html, "class=\"headline\""));
    assert_true(strstr(html, "<section id=\"attainable\">") < strstr(html, "<section id=\"figures\">"));
    const char *warning = strstr(html, "The coverage asked for is not reached");
    snprintf(text, sizeof text, "no more than %.2f&nbsp;%% are attainable, so that %.1f&nbsp;%% were aimed at",
             ceil(1e4 * figures[2].attainable_area / figures[2].clean_area) / 100, 5000 / figures[2].clean_area);
    assert_true(warning && strstr(warning, text));
    const char *table = strstr(html, "<caption>Out of reach, ");
    assert_non_null(table);
    for (size_t i = 0; i < figures[2].missing_count; i++) {
        double sum = 0;
        for (sp_reason reason = 0; reason < SP_REASONS; reason++)
            sum += figures[2].missing[i].areas[reason];
        same_real(sum, figures[2].missing[i].area);
        snprintf(text, sizeof text, "%.4f</td></tr>", figures[2].missing[i].area);
        assert_non_null(strstr(table, text));
    }
    sp_figures_destroy(figures, f->result.design_count);
    free(html);
}

/* What the engineer's nozzles cover counts as attainable; that no allowed nozzle reaches it is told. */
static void what_own_nozzles_alone_reach_is_told(void **state)
{
    const fixture *f = *state;
    sp_error error = {0};
    sp_result result = f->result;
    sp_proposal proposal = f->proposal;
    const sp_patches *patches = sp_evaluator_patches(f->evaluator);
    double covered = 0;
    proposal.attainable = malloc(patches->count * sizeof *proposal.attainable);
    memset(proposal.attainable, true, patches->count);
    result.proposal = &proposal;
    char *html = sp_report_html(&result, &error);
    assert_null(strstr(html, "id=\"beyond\""));
    free(html);
    memset(proposal.attainable, false, patches->count);
    proposal.reasons = calloc(patches->count, sizeof *proposal.reasons);
    for (size_t k = 0; k < patches->count; k++) {
        bool any = false;
        proposal.reasons[k] = SP_REASON_NO_LINE;
        for (size_t i = 0; i < result.design_count; i++)
            any = any || result.designs[i].coverage->deposits.covered[k];
        covered += any ? patches->area[k] : 0;
    }
    sp_figures *figures = sp_result_figures(&result, &error);
    assert_true(covered > SP_BEYOND_TOLD * patches->total_area);
    same_real(figures[2].beyond_area, covered);
    same_real(figures[2].missing_area[SP_REASON_NO_LINE], patches->total_area - covered);
    html = sp_report_html(&result, &error);
    assert_non_null(strstr(html, "<p id=\"beyond\" class=\"warning\">"));
    free(html);
    sp_figures_destroy(figures, result.design_count);
    free(proposal.attainable);
    free(proposal.reasons);
}

/* What liquid gets to, and too little of, more nozzles might reach: no fault of the vessel. */
static void limits_are_told_from_faults(void **state)
{
    fixture *f = *state;
    size_t patches = sp_evaluator_patches(f->evaluator)->count;
    sp_reason *mixed = malloc(patches * sizeof *mixed), *little = malloc(patches * sizeof *little);
    sp_proposal proposal = f->proposal;
    sp_result result = f->result;
    sp_error error = {0};
    assert_true(mixed && little);
    for (size_t i = 0; i < patches; i++) {
        little[i] = f->proposal.reasons[i] == SP_REASON_ATTAINABLE ? SP_REASON_ATTAINABLE : SP_REASON_FLUX;
        mixed[i] = i % 2 ? little[i] : f->proposal.reasons[i];
    }
    result.proposal = &proposal;
    result.picture_share = -1;
    const struct {
        sp_reason *reasons;
        size_t nozzles;
        const char *says, *lacks;
    } cases[] = {
        {little, 1, "with no more than 1 nozzle (max_nozzles) and 40 L/min (max_water)", "is a fault of the"},
        {mixed, 2, "with no more than 2 nozzles (max_nozzles) and 40 L/min (max_water)", " What is out of reach"},
        {mixed, 2, " What else is out of reach", " What is out of reach"},
        {f->proposal.reasons, 1, " What is out of reach", "for the limits alone"},
    };
    proposal.max_water = 40 / 6e4;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        proposal.reasons = cases[i].reasons;
        proposal.max_nozzles = cases[i].nozzles;
        char *html = sp_report_html(&result, &error);
        assert_non_null(html);
        assert_non_null(strstr(html, cases[i].says));
        assert_null(strstr(html, cases[i].lacks));
        free(html);
    }
    free(mixed);
    free(little);
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

static void a_certificate_is_told_in_full(void **state)
{
    fixture *f = *state;
    sp_error error = {0};
    char *html = sp_report_html(&f->result, &error), *text;
    assert_non_null(strstr(html, "is not known"));
    assert_null(strstr(html, "id=\"certificate\""));
    assert_null(strstr(html, "class=\"bound\""));
    free(html);
    sp_proposal proposal = f->proposal;
    sp_front_point front[3];
    for (int i = 0; i < 3; i++) {
        front[i] = f->front[i];
        front[i].counted = 6 + i;
        front[i].bound = 8 + 0.5 * i;
        front[i].every_aim_bound = 9 + 0.25 * i;
    }
    proposal.front = front;
    proposal.certificate = (sp_certificate){
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
    sp_result result = f->result;
    result.proposal = &proposal;
    html = sp_report_html(&result, &error);
    assert_non_null(strstr(html,
                           "Among these 123456 candidate poses and the proposal&#39;s own, on 20011 texels, no layout "
                           "reaches 80.5&nbsp;% with less than 31.2&nbsp;L/min. Poses between candidates are not "
                           "covered."));
    assert_non_null(
        strstr(html, "That share of the surface to be cleaned, attainable or not, rounded up, is what the proposal"));
    assert_non_null(strstr(html, "no layout reaches more than 90.1&nbsp;%: at most 10.7&nbsp;% of what"));
    assert_bounds_end_at_their_points(html);
    assert_null(strstr(html, "is not known"));
    free(html);
    text = sp_result_json(&result, &error);
    json_t *all = json_loads(text, JSON_REJECT_DUPLICATES, NULL), *certificate = json_object_get(all, "certificate");
    EXPECT_KEYS(certificate, "method", "coverage", "coverage_bound_same_water", "water_bound_same_coverage_l_min",
                "gap", "candidates", "own_poses", "texels", "every_aim");
    EXPECT_KEYS(json_array_get(json_object_get(all, "front"), 0), "water_l_min", "coverage", "nozzles",
                "coverage_on_texels", "coverage_bound", "coverage_bound_every_aim");
    assert_true(fabs(json_number_value(json_object_get(certificate, "coverage_bound_same_water")) - 0.90001) < 1e-12);
    assert_true(fabs(real_of(certificate, "water_bound_same_coverage_l_min") - 31.29) < 1e-9);
    assert_true(fabs(real_of(certificate, "coverage") - 0.80401) < 1e-12);
    assert_true(real_of(certificate, "gap") == 0.10667);
    const json_t *every = json_object_get(certificate, "every_aim");
    assert_true(fabs(real_of(every, "water_bound_same_coverage_l_min") - 23.45) < 1e-9);
    assert_true(fabs(real_of(every, "coverage_bound_same_water") - 0.95) < 1e-12);
    assert_true(real_of(every, "gap") == 0.1537 && real_of(every, "mounting_points") == 56);
    for (size_t i = 0; i < 3; i++) {
        const json_t *point = json_array_get(json_object_get(all, "front"), i);
        assert_true(fabs(real_of(point, "water_l_min") - 6e4 * front[i].flow) < 1e-9);
        assert_true(fabs(real_of(point, "coverage_on_texels") - front[i].counted / 10) < 1e-12);
        assert_true(fabs(real_of(point, "coverage_bound") - front[i].bound / 10) < 1e-12);
        assert_true(fabs(real_of(point, "coverage_bound_every_aim") - front[i].every_aim_bound / 10) < 1e-12);
    }
    json_decref(all);
    free(text);
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

/* Notes tell of columns that are there, and why one has no answers. */
static void notes_on_shadows_fit_their_columns(void **state)
{
    const fixture *f = *state;
    sp_error error = {0};
    sp_remedy remedy = {.nozzle = f->layouts[2]->nozzles[0], .area = 0.01, .flow = 2e-4};
    sp_design design = f->designs[0];
    sp_result result = {.command = "simulate", .scene = "v.yaml", .design_count = 1, .designs = &design};
    result.picture_share = -1;
    char *html = sp_report_html(&result, &error);
    assert_non_null(strstr(html, "<section id=\"shadows\">"));
    assert_null(strstr(html, "One more nozzle"));
    assert_null(strstr(html, "what each nozzle brings was not worked out"));
    free(html);
    design.remedies = &remedy;
    design.remedy_count = 1;
    design.contributions = NULL;
    html = sp_report_html(&result, &error);
    assert_non_null(strstr(html, "One more nozzle: of the candidates"));
    assert_non_null(strstr(html, "; a dash: none does, or what each nozzle brings was not worked out."));
    free(html);
}

/* "80 %" and the like, which must not part at a line's end. */
static void a_number_keeps_its_per_cent_sign(void **state)
{
    const fixture *f = *state;
    sp_error error = {0};
    bool fittings[4] = {true};
    sp_proposal proposal = f->proposal;
    sp_design design = f->designs[2];
    sp_result result = f->result;
    proposal.fittings = fittings;
    proposal.asked_area = 0.8 * f->coverages[2]->area;
    design.name = "of one";
    design.alternative = &proposal;
    result.proposal = &proposal;
    result.designs = &design;
    result.design_count = 1;
    result.picture_share = -1;
    char *html = sp_report_html(&result, &error);
    const char *head = strstr(html, "</strong> is proposed: ");
    assert_non_null(head);
    assert_non_null(strstr(head, " the 80&nbsp;% asked for, "));
    assert_null(strstr(head, "80 % asked"));
    free(html);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_same_bytes_every_time),
        cmocka_unit_test(the_page_stands_alone),
        cmocka_unit_test(coverage_is_told_by_number_of_nozzles),
        cmocka_unit_test(the_page_says_what_paper_needs),
        cmocka_unit_test(the_page_says_what_nozzles_do_and_shadows_lack),
        cmocka_unit_test(names_from_strangers_stay_text),
        cmocka_unit_test(result_json_has_the_keys_of_the_contract),
        cmocka_unit_test(reasons_add_up),
        cmocka_unit_test(remedies_are_told),
        cmocka_unit_test(flux_is_told_as_it_is),
        cmocka_unit_test(figures_survive_the_file),
        cmocka_unit_test(what_was_left_out_is_named),
        cmocka_unit_test(smaller_pictures_have_the_same_labels),
        cmocka_unit_test(the_legend_leaves_points_alone),
        cmocka_unit_test(what_is_out_of_reach_is_said_first),
        cmocka_unit_test(what_own_nozzles_alone_reach_is_told),
        cmocka_unit_test(limits_are_told_from_faults),
        cmocka_unit_test(what_jets_say_otherwise_is_a_warning),
        cmocka_unit_test(a_certificate_is_told_in_full),
        cmocka_unit_test(lines_that_are_drawn_are_explained),
        cmocka_unit_test(notes_on_shadows_fit_their_columns),
        cmocka_unit_test(a_number_keeps_its_per_cent_sign),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
