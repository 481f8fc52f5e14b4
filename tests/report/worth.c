/* What each nozzle is worth, what shadows lack, parts, swabs and digests on a floor that can be worked out by hand: 2 m
 * square, a plate half way up over a part of it, nozzles 1 m above. */
#include <sprayplan/sprayplan.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TEXEL 0.02
#define FLOW (10 / 6e4)

static const sp_surface surfaces[2] = {{true, 0, 1, false}, {false, 0, 1, false}};
/* 120 degrees are π sr: at the angle t from the axis FLOW/π cos³t falls on the floor. */
static const sp_nozzle_type cone = {.name = "cone",
                                    .pattern = SP_PATTERN_FULL_CONE,
                                    .angle = 2 * M_PI / 3,
                                    .flow = FLOW,
                                    .at = 1e5,
                                    .exponent = 0.5,
                                    .cv = 1,
                                    .drop = 1e-3};
static const sp_nozzle middle = {
    .name = "N1", .type = &cone, .position = {0, 0, 1}, .axis = {0, 0, -1}, .pressure = 1e5};

typedef struct {
    sp_mesh *mesh;
    sp_evaluator *evaluator;
    sp_layout *layout;
    sp_coverage *coverage;
    sp_contributions *contributions;
    sp_design design;
} stage;

/* The floor, and with `plate` what shades x from 0.4 to 0.8, y from -0.4 to 0.4 m of it from above the middle. */
static sp_mesh *floor_mesh(bool plate, sp_error *error)
{
    static const sp_vec3 points[8] = {{-1, -1, 0},      {1, -1, 0},       {1, 1, 0},       {-1, 1, 0},
                                      {0.2, -0.2, 0.5}, {0.4, -0.2, 0.5}, {0.4, 0.2, 0.5}, {0.2, 0.2, 0.5}};
    static const uint32_t triangles[4][3] = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
    static const uint32_t parts[4] = {0, 0, 1, 1};
    static const char *const names[2] = {"=floor", "plate"};
    return sp_mesh_create(points, plate ? 8 : 4, triangles, plate ? 4 : 2, parts, names, plate ? 2 : 1, error);
}

static void open_stage(stage *s, bool plate, sp_criterion criterion, const sp_nozzle *nozzles, size_t count)
{
    sp_error error = {0};
    sp_setup setup = sp_setup_default();
    setup.mesh = s->mesh = floor_mesh(plate, &error);
    setup.surfaces = surfaces;
    setup.criterion = criterion;
    setup.fidelity.texel = TEXEL;
    setup.fidelity.trajectory = SP_TRAJECTORY_LINE;
    s->evaluator = sp_evaluator_create(&setup, &error);
    s->layout = sp_layout_create(nozzles, count, &error);
    s->coverage = s->evaluator ? sp_evaluate(s->evaluator, s->layout, &error) : NULL;
    if (!s->coverage)
        fail_msg("%s", error.message);
    s->contributions = sp_contributions_create(s->evaluator, s->layout, s->coverage, &error);
    assert_non_null(s->contributions);
    s->design = (sp_design){.name = "manual",
                            .evaluator = s->evaluator,
                            .layout = s->layout,
                            .coverage = s->coverage,
                            .contributions = s->contributions};
}

static void close_stage(stage *s)
{
    sp_contributions_destroy(s->contributions);
    sp_coverage_destroy(s->coverage);
    sp_layout_destroy(s->layout);
    sp_evaluator_destroy(s->evaluator);
    sp_mesh_destroy(s->mesh);
}

static void near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%.6g found, %.6g expected", value, expected);
}

static const sp_criterion anything = {.incidence = M_PI / 2};

/* Two sprays that do not touch: each is worth what it covers. */
static void sprays_apart_are_worth_what_they_cover(void **state)
{
    (void)state;
    sp_nozzle_type narrow = cone;
    narrow.angle = 2 * atan(0.3);
    sp_nozzle nozzles[2] = {middle, middle};
    for (int i = 0; i < 2; i++) {
        nozzles[i].type = &narrow;
        nozzles[i].position.x = i ? 0.5 : -0.5;
    }
    stage s;
    open_stage(&s, false, anything, nozzles, 2);
    for (int i = 0; i < 2; i++) {
        near(s.contributions->alone[i], M_PI * 0.09, 0.002);
        near(s.contributions->lost[i], s.contributions->alone[i], 1e-9);
    }
    near(s.contributions->alone[0] + s.contributions->alone[1], s.coverage->covered_area, 1e-9);
    close_stage(&s);
}

/* Two in one place: of any liquid either is worth nothing, of as much as only both bring each is worth all. */
static void twins_are_worth_nothing_or_all(void **state)
{
    (void)state;
    const sp_nozzle twins[2] = {middle, middle};
    stage s;
    open_stage(&s, false, anything, twins, 2);
    for (int i = 0; i < 2; i++) {
        near(s.contributions->alone[i], 4, 1e-6);
        near(s.contributions->lost[i], 0, 1e-9);
    }
    close_stage(&s);
    /* cos³t = 1/2 where one brings half of what it brings to the middle: t = 37.5 deg */
    open_stage(&s, false, (sp_criterion){.flux = FLOW / M_PI, .incidence = M_PI / 2}, twins, 2);
    for (int i = 0; i < 2; i++) {
        near(s.contributions->alone[i], 0, 0.002);
        near(s.contributions->lost[i], M_PI * (cbrt(4) - 1), 0.02);
    }
    close_stage(&s);
}

static void without_the_only_one_all_is_lost(void **state)
{
    (void)state;
    stage s;
    open_stage(&s, true, anything, &middle, 1);
    assert_true(s.contributions->lost[0] == s.coverage->covered_area);
    assert_true(s.contributions->alone[0] == s.coverage->covered_area);
    close_stage(&s);
}

/* The one shadow there is. */
static void expect_shadow(sp_criterion criterion, bool plate, double area, sp_lack lack)
{
    stage s;
    sp_error error = {0};
    sp_shadow *shadows = NULL;
    size_t count = 0;
    open_stage(&s, plate, criterion, &middle, 1);
    assert_true(sp_shadows(s.evaluator, s.coverage, NULL, &shadows, &count, &error));
    assert_int_equal(count, 1);
    near(shadows[0].area, area, 0.03 * area);
    assert_int_equal(shadows[0].lack, lack);
    free(shadows);
    close_stage(&s);
}

static void shadows_show_what_they_lack(void **state)
{
    (void)state;
    expect_shadow(anything, true, 0.32, SP_LACK_REACH);
    expect_shadow((sp_criterion){.incidence = M_PI / 6}, false, 4 - M_PI / 3, SP_LACK_ANGLE);
    expect_shadow((sp_criterion){.incidence = M_PI / 2, .impact_speed = 100}, false, 4, SP_LACK_SPEED);
    double cosine = 1 / sqrt(1 + 0.81);
    expect_shadow((sp_criterion){.flux = FLOW / M_PI * pow(cosine, 3), .incidence = M_PI / 2}, false, 4 - M_PI * 0.81,
                  SP_LACK_FLUX);
}

/* Too little beyond 0.95 m, nothing behind the plate: two shadows, of which one nozzle brings something to one. */
static void open_two_shadows(stage *s)
{
    double cosine = 1 / sqrt(1 + 0.95 * 0.95);
    open_stage(s, true, (sp_criterion){.flux = FLOW / M_PI * pow(cosine, 3), .incidence = M_PI / 2}, &middle, 1);
}

static void figures_show_parts_and_who_is_nearest(void **state)
{
    (void)state;
    stage s;
    sp_error error = {0};
    open_two_shadows(&s);
    sp_result result = {.command = "simulate", .scene = "floor.yaml", .design_count = 1, .designs = &s.design};
    sp_figures *figures = sp_result_figures(&result, &error);
    assert_int_equal(figures->part_count, 1);
    near(figures->parts[0].area, 4, 1e-6);
    near(figures->parts[0].covered, s.coverage->covered_area, 1e-9);
    assert_int_equal(figures->shadow_count, 2);
    assert_int_equal(figures->shadows[0].lack, SP_LACK_FLUX);
    assert_string_equal(figures->shadows[0].nozzle, "N1");
    assert_int_equal(figures->shadows[1].lack, SP_LACK_REACH);
    assert_string_equal(figures->shadows[1].nozzle, "");
    sp_shadow *shadows = NULL;
    size_t count, patches = s.coverage->deposits.count;
    uint32_t *numbers = malloc(patches * sizeof *numbers);
    double areas[3] = {0};
    assert_true(sp_shadows(s.evaluator, s.coverage, NULL, &shadows, &count, &error));
    assert_true(sp_shadow_numbers(s.evaluator, s.coverage, shadows, 1, numbers, &error)); /* the larger alone */
    for (size_t i = 0; i < patches; i++)
        areas[numbers[i]] += sp_evaluator_patches(s.evaluator)->area[i];
    near(areas[1], shadows[0].area, 1e-9);
    near(areas[0], 4 - shadows[0].area, 1e-6);
    free(shadows);
    free(numbers);
    sp_figures_destroy(figures, 1);
    close_stage(&s);
}

/* The deepest of what is behind the plate first; none near another; then what is nearly enough. */
static void swabs_are_the_worst_places(void **state)
{
    (void)state;
    stage s;
    sp_error error = {0};
    sp_swab swabs[SP_SWABS];
    size_t count;
    open_two_shadows(&s);
    assert_true(sp_find_swabs(&s.design, swabs, &count, &error));
    assert_int_equal(count, SP_SWABS);
    near(swabs[0].place.x, 0.6, 0.05);
    near(swabs[0].place.y, 0, 0.25);
    assert_int_equal(swabs[0].lack, SP_LACK_REACH);
    assert_true(swabs[0].received == 0 && isnan(swabs[0].speed));
    double apart = 0.05 * sqrt(8 + 0.25);
    for (size_t i = 1; i < count; i++) {
        assert_true(swabs[i].received >= swabs[i - 1].received);
        for (size_t k = 0; k < i; k++)
            assert_true(sp_distance(swabs[i].place, swabs[k].place) >= apart);
    }
    char *csv = sp_swabs_csv(&s.design, &error), *line = csv;
    static const char first[] = "number,part,x_m,y_m,z_m,received_percent,flux_l_min_m2,speed_m_s,incidence_deg,lack\n"
                                "1,'=floor,";
    assert_memory_equal(csv, first, sizeof first - 1);
    assert_non_null(strstr(csv, ",0,0,,,no_nozzle_in_reach\n2,'=floor,"));
    for (count = 0; (line = strchr(line, '\n')); line++)
        count++;
    assert_int_equal(count, SP_SWABS + 1);
    free(csv);
    close_stage(&s);
}

/* Where all is covered they are the places of least to spare: the corners, where cos³t is 3^-1.5. */
static void swabs_of_a_clean_floor_have_least_to_spare(void **state)
{
    (void)state;
    stage s;
    sp_error error = {0};
    sp_swab swabs[SP_SWABS];
    size_t count;
    open_stage(&s, false, (sp_criterion){.flux = 0.1 * FLOW / M_PI, .incidence = M_PI / 2}, &middle, 1);
    assert_true(sp_find_swabs(&s.design, swabs, &count, &error));
    assert_int_equal(swabs[0].lack, SP_LACK_NOTHING);
    near(swabs[0].received, 10 / sqrt(27), 0.1);
    near(fabs(swabs[0].place.x), 1, 2 * TEXEL);
    near(fabs(swabs[0].place.y), 1, 2 * TEXEL);
    close_stage(&s);
}

/* Nothing reaches the floor: its ten samples are spread over the deep half of it, though all of it is as bad. */
static void swabs_of_a_dry_floor_are_spread(void **state)
{
    (void)state;
    stage s;
    sp_error error = {0};
    sp_swab swabs[SP_SWABS];
    size_t count, far = 0;
    open_stage(&s, false, (sp_criterion){.flux = 100 * FLOW / M_PI, .incidence = M_PI / 2}, &middle, 1);
    for (size_t p = 0; p < s.coverage->deposits.count; p++)
        s.coverage->deposits.counted[p] = 0;
    assert_true(sp_find_swabs(&s.design, swabs, &count, &error));
    assert_int_equal(count, SP_SWABS);
    for (size_t i = 1; i < count; i++)
        for (size_t k = 0; k < i; k++)
            far += sp_distance(swabs[i].place, swabs[k].place) >= 4 * 0.05 * sqrt(8);
    assert_int_equal(far, SP_SWABS * (SP_SWABS - 1) / 2);
    close_stage(&s);
}

/* FIPS 180-4's own example. */
static void a_digest_is_sha_256(void **state)
{
    (void)state;
    static const char path[] = BINARY_DIR "/abc.txt";
    sp_error error = {0};
    char digest[SP_SHA256];
    FILE *file = fopen(path, "wb");
    fputs("abc", file);
    fclose(file);
    assert_true(sp_file_sha256(path, digest, &error));
    assert_string_equal(digest, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    remove(path);
    assert_false(sp_file_sha256(path, digest, &error));
    assert_int_equal(error.kind, SP_ERROR_FILE);
    assert_string_equal(error.file, path);
}

/* "The 1 largest uncovered regions" of one would be none of a page's words. */
static void the_only_shadow_is_reported_as_one(void **state)
{
    (void)state;
    stage s;
    sp_error error = {0};
    open_stage(&s, true, anything, &middle, 1);
    sp_result result = {.command = "simulate", .scene = "floor.yaml", .design_count = 1, .designs = &s.design};
    result.picture_share = -1;
    char *html = sp_report_html(&result, &error);
    assert_non_null(html);
    assert_non_null(strstr(html, ": the largest uncovered region</caption>"));
    free(html);
    close_stage(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sprays_apart_are_worth_what_they_cover),
        cmocka_unit_test(twins_are_worth_nothing_or_all),
        cmocka_unit_test(without_the_only_one_all_is_lost),
        cmocka_unit_test(shadows_show_what_they_lack),
        cmocka_unit_test(figures_show_parts_and_who_is_nearest),
        cmocka_unit_test(swabs_are_the_worst_places),
        cmocka_unit_test(swabs_of_a_clean_floor_have_least_to_spare),
        cmocka_unit_test(swabs_of_a_dry_floor_are_spread),
        cmocka_unit_test(a_digest_is_sha_256),
        cmocka_unit_test(the_only_shadow_is_reported_as_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
