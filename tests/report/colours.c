/* What the colours of pictures say: scales of every quantity, the bar, charts. */
#include "report/layers.h"
#include "report/page.h"

#include "tank.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

typedef struct {
    sp_mesh *mesh;
    sp_evaluator *evaluator;
    sp_layout *layout;
    sp_coverage *coverage;
    sp_design design;
} fixture;

static int set_up(void **state)
{
    static fixture f;
    sp_error error = {0};
    f.mesh = tank_mesh(24, &error);
    sp_setup setup = tank_setup(f.mesh, 0.05);
    setup.criterion = (sp_criterion){.flux = 1 / 6e4, .impact_speed = 8, .incidence = M_PI / 3};
    f.evaluator = sp_evaluator_create(&setup, &error);
    f.layout = sp_layout_create(tank_manual, 3, &error);
    f.coverage = sp_evaluate(f.evaluator, f.layout, &error);
    f.design = (sp_design){.name = "manual", .evaluator = f.evaluator, .layout = f.layout, .coverage = f.coverage};
    *state = &f;
    return f.coverage ? 0 : 1;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    sp_coverage_destroy(f->coverage);
    sp_layout_destroy(f->layout);
    sp_evaluator_destroy(f->evaluator);
    sp_mesh_destroy(f->mesh);
    return 0;
}

static sp_colour_scale scale_of(const fixture *f, sp_quantity quantity, sp_shades shades)
{
    return sp_colour_scale_of(&f->design, 1, (sp_picture_style){.quantity = quantity, .shades = shades});
}

/* All of what arrives but a hundredth of the area lies on the scale, which grows with the value. */
static void scales_hold_what_arrives(void **state)
{
    const fixture *f = *state;
    const sp_deposits *deposits = &f->coverage->deposits;
    const double *area = sp_evaluator_patches(f->evaluator)->area;
    for (int q = SP_QUANTITY_SPEED; q < SP_QUANTITY_CHARTS; q++)
        for (int shades = SP_SHADES_LINEAR; shades <= SP_SHADES_LOG; shades++) {
            sp_colour_scale scale = scale_of(f, (sp_quantity)q, (sp_shades)shades);
            double above = 0, all = 0;
            assert_true(scale.low < scale.high && (scale.low > 0) == (shades == SP_SHADES_LOG));
            for (size_t i = 0; i < deposits->count; i++) {
                double value = sp_quantity_value(deposits, (sp_quantity)q, i);
                all += value > 0 ? area[i] : 0;
                above += value > scale.high * (1 + 1e-12) ? area[i] : 0;
            }
            assert_true(all > 1 && above <= 0.012 * all);
            assert_true(sp_colour_scale_place(&scale, scale.low) == 0);
            assert_true(sp_colour_scale_place(&scale, scale.high) == 1);
            double middle = shades == SP_SHADES_LOG ? sqrt(scale.low * scale.high) : 0.5 * scale.high;
            assert_true(fabs(sp_colour_scale_place(&scale, middle) - 0.5) < 1e-9);
        }
}

static void steps_part_where_the_criterion_does(void **state)
{
    const fixture *f = *state;
    const struct {
        sp_quantity quantity;
        double threshold;
    } asked[] = {{SP_QUANTITY_FLUX, 1 / 6e4},
                 {SP_QUANTITY_SPEED, 8},
                 {SP_QUANTITY_SPEED_MAX, 8},
                 {SP_QUANTITY_INCIDENCE, M_PI / 3},
                 {SP_QUANTITY_COVERED, 0.5}};
    for (size_t i = 0; i < sizeof asked / sizeof *asked; i++) {
        sp_colour_scale scale = scale_of(f, asked[i].quantity, SP_SHADES_STEPPED);
        assert_true(scale.threshold_count == 1 && scale.thresholds[0] == asked[i].threshold &&
                    scale.style.shades == SP_SHADES_STEPPED);
        double at = sp_colour_scale_place(&scale, asked[i].threshold);
        assert_true(at > sp_colour_scale_place(&scale, asked[i].threshold * (1 - 1e-12)));
        assert_true(at == sp_colour_scale_place(&scale, 10 * asked[i].threshold));
    }
    assert_int_equal(scale_of(f, SP_QUANTITY_JETS, SP_SHADES_STEPPED).style.shades, SP_SHADES_LOG);
}

static void as_colour(const fixture *f, const sp_colour_scale *scale, double value, uint8_t rgb[3])
{
    (void)f;
    sp_colour_of(scale->style.colours, sp_colour_scale_place(scale, value), rgb);
}

/* Flux only where it covers; others wherever liquid arrives, striped where it does not cover. */
static void what_is_not_covered_is_striped(void **state)
{
    const fixture *f = *state;
    const sp_deposits *deposits = &f->coverage->deposits;
    sp_colour_scale flux = scale_of(f, SP_QUANTITY_FLUX, SP_SHADES_AUTO);
    sp_colour_scale speed = scale_of(f, SP_QUANTITY_SPEED, SP_SHADES_AUTO);
    size_t seen[3] = {0};
    for (uint32_t i = 0; i < deposits->count; i++) {
        uint8_t rgb[3], expected[3];
        int kind = deposits->covered[i] ? 0 : deposits->flux[i] > 0 ? 1 : 2;
        seen[kind]++;
        for (int stripe = 0; stripe < 2; stripe++) {
            sp_false_colour(&flux, deposits, i, stripe, rgb);
            as_colour(f, &flux, deposits->flux[i], expected);
            assert_memory_equal(rgb, kind == 0 ? expected : sp_colour_hatch[stripe], 3);
            sp_false_colour(&speed, deposits, i, stripe, rgb);
            as_colour(f, &speed, deposits->speed[i], expected);
            assert_memory_equal(rgb, kind == 0 || (kind == 1 && !stripe) ? expected : sp_colour_hatch[stripe], 3);
        }
    }
    assert_true(seen[0] && seen[1] && seen[2]);
}

static void charts_are_told_from_their_neighbours(void **state)
{
    const fixture *f = *state;
    const sp_atlas *atlas = sp_evaluator_atlas(f->evaluator);
    sp_error error = {0};
    uint8_t *colour = sp_chart_colours(atlas, &error);
    size_t meetings = 0;
    assert_non_null(colour);
    for (size_t i = 0; i < atlas->seam_count; i++) {
        uint32_t one = atlas->chart[atlas->seams[i].edge / 3], other = atlas->chart[atlas->seams[i].across / 3];
        assert_true(one == other || colour[one] != colour[other]);
        meetings += one != other;
    }
    for (size_t c = 0; c < atlas->chart_count; c++)
        assert_true(colour[c] < SP_CHART_COLOURS);
    assert_true(meetings > 0);
    free(colour);
}

static sp_text bar_of(const fixture *f, sp_picture_style style, bool film)
{
    sp_figures figures = {.film.known = film};
    sp_result result = {
        .command = "simulate", .scene = "t.yaml", .design_count = 1, .designs = &f->design, .style = style};
    sp_page page = {.result = &result, .figures = &figures, .scale = sp_colour_scale_of(&f->design, 1, style)};
    sp_text bar = {0};
    sp_page_colour_bar(&page, &bar);
    return bar;
}

static void expect_bar(const fixture *f, sp_picture_style style, const char *const *texts)
{
    sp_text bar = bar_of(f, style, false);
    for (; *texts; texts++) {
        if (!strstr(bar.text, *texts))
            fail_msg("no %s in the colour bar", *texts);
    }
    free(bar.text);
}

static void the_bar_shows_unit_ticks_and_criterion(void **state)
{
    const fixture *f = *state;
    expect_bar(f, (sp_picture_style){0},
               (const char *const[]){"Liquid flux, L/min per m\xc2\xb2", "not covered", ">1</text>",
                                     "asked for: at least 1 L/min per m\xc2\xb2", NULL});
    expect_bar(f, (sp_picture_style){.quantity = SP_QUANTITY_INCIDENCE},
               (const char *const[]){"Incidence, mean, deg", ">0</text>", ">20</text>", ">80</text>",
                                     "asked for: at most 60 deg", NULL});
    expect_bar(f, (sp_picture_style){.quantity = SP_QUANTITY_SPEED, .shades = SP_SHADES_STEPPED},
               (const char *const[]){"Impact speed, mean, m/s", "below 8 m/s", "8 m/s or more", NULL});
    expect_bar(f, (sp_picture_style){.quantity = SP_QUANTITY_CHARTS, .wireframe = true},
               (const char *const[]){"Charts of the atlas: each a colour unlike its neighbours'", NULL});
    sp_text bar = bar_of(f, (sp_picture_style){.quantity = SP_QUANTITY_COVERED}, false);
    assert_non_null(strstr(bar.text, "Covered share"));
    assert_null(strstr(bar.text, "asked for"));
    free(bar.text);
    expect_bar(f, (sp_picture_style){.colours = SP_COLOURS_CIVIDIS}, (const char *const[]){"#00224e", NULL});
}

/* Letters of 13 px are no wider than 7.2 on average. */
static void what_the_bar_says_is_within_it(void **state)
{
    for (int film = 0; film < 2; film++) {
        sp_text bar = bar_of(*state, (sp_picture_style){0}, film);
        double width, height, x, y;
        int shown = 0;
        assert_int_equal(sscanf(strstr(bar.text, "viewBox"), "viewBox=\"0 0 %lf %lf\"", &width, &height), 2);
        for (const char *at = bar.text; (at = strstr(at, "<text ")); at++, shown++) {
            const char *words = strchr(at, '>') + 1;
            assert_int_equal(sscanf(at, "<text x=\"%lf\" y=\"%lf\"", &x, &y), 2);
            assert_true(x + 7.2 * (double)strcspn(words, "<") <= width);
            assert_true(y < height);
        }
        assert_true(shown >= 5 + film);
        free(bar.text);
    }
}

/* The tank's layout once more, held against a criterion of so much flux. */
static sp_design asking_for(const fixture *f, double flux, const char *name)
{
    sp_error error = {0};
    sp_setup setup = *sp_evaluator_setup(f->evaluator);
    setup.criterion.flux = flux;
    setup.criterion.impact_speed = 0;
    sp_design design = {.name = name, .evaluator = sp_evaluator_create(&setup, &error), .layout = f->layout};
    assert_non_null(design.evaluator);
    design.coverage = sp_evaluate(design.evaluator, f->layout, &error);
    assert_non_null(design.coverage);
    return design;
}

static void forget(sp_design design)
{
    sp_coverage_destroy((sp_coverage *)design.coverage);
    sp_evaluator_destroy((sp_evaluator *)design.evaluator);
}

/* The colours of who asks for little are not all at the dark end, and everybody's criterion has its mark. */
static void one_scale_serves_several_criteria(void **state)
{
    const fixture *f = *state;
    sp_design designs[] = {asking_for(f, 5 / 6e4, "much.yaml"), asking_for(f, 0.5 / 6e4, "little.yaml"),
                           asking_for(f, 5 / 6e4, "same.yaml")};
    sp_figures figures[3] = {0};
    sp_result result = {.command = "compare", .scene = "t.yaml", .design_count = 3, .designs = designs};
    sp_page page = {.result = &result, .figures = figures, .main = SP_UNKNOWN};
    for (size_t i = 0; i < 3; i++)
        figures[i].name = (char *)designs[i].name;
    page.manual = page.greedy = SP_UNKNOWN;
    page.scale = sp_colour_scale_of(designs, 3, (sp_picture_style){0});
    assert_true(fabs(6e4 * page.scale.low - 0.5) < 1e-9);
    assert_int_equal(page.scale.threshold_count, 2);
    sp_text bar = {0};
    sp_page_colour_bar(&page, &bar);
    assert_non_null(strstr(bar.text, "asked for by little.yaml: at least 0.5 L/min"));
    assert_non_null(strstr(bar.text, "asked for by much.yaml, same.yaml: at least 5 L/min"));
    free(bar.text);
    bar = (sp_text){0};
    page.scale = sp_colour_scale_of(designs, 3, (sp_picture_style){.shades = SP_SHADES_STEPPED});
    double below = sp_colour_scale_place(&page.scale, 0.4 / 6e4), between = sp_colour_scale_place(&page.scale, 1 / 6e4),
           above = sp_colour_scale_place(&page.scale, 6 / 6e4);
    assert_true(below < between && between < above);
    sp_page_colour_bar(&page, &bar);
    assert_non_null(strstr(bar.text, ">below 0.5</text>"));
    assert_non_null(strstr(bar.text, ">0.5 to 5</text>"));
    assert_non_null(strstr(bar.text, ">5 or more</text>"));
    free(bar.text);
    for (size_t i = 0; i < 3; i++)
        forget(designs[i]);
}

/* Where values lie beyond an end, its figure and a point say so. */
static void ends_that_are_exceeded_are_signed(void **state)
{
    const fixture *f = *state;
    sp_figures figures = {0};
    sp_result result = {.command = "simulate", .scene = "t.yaml", .design_count = 1, .designs = &f->design};
    sp_page page = {.result = &result, .figures = &figures, .scale = scale_of(f, SP_QUANTITY_FLUX, SP_SHADES_AUTO)};
    double most = 0;
    for (size_t i = 0; i < f->coverage->deposits.count; i++)
        most = fmax(most, f->coverage->deposits.covered[i] ? f->coverage->deposits.flux[i] : 0);
    assert_int_equal(page.scale.above, most > page.scale.high * (1 + 1e-9));
    for (int above = 0; above < 2; above++) {
        sp_text bar = {0};
        page.scale.above = above;
        sp_page_colour_bar(&page, &bar);
        assert_int_equal(strstr(bar.text, "\xe2\x89\xa5 ") != NULL, above);
        assert_int_equal(strstr(bar.text, "class=\"beyond\"") != NULL, above || page.scale.below);
        free(bar.text);
    }
}

/* Half of a figure's letters stand to the left of its tick. */
static void the_first_figure_is_whole(void **state)
{
    const fixture *f = *state;
    sp_figures figures = {0};
    sp_result result = {.command = "simulate", .scene = "t.yaml", .design_count = 1, .designs = &f->design};
    sp_page page = {.result = &result, .figures = &figures, .scale = scale_of(f, SP_QUANTITY_FLUX, SP_SHADES_AUTO)};
    page.scale.low = 0.001 / 6e4;
    page.scale.below = true;
    sp_text bar = {0};
    sp_page_colour_bar(&page, &bar);
    const char *figure = strstr(bar.text, ">\xe2\x89\xa4 0.001<"), *tick = figure;
    assert_non_null(figure);
    while (strncmp(tick, "<text ", 6) != 0)
        tick--;
    double x;
    assert_int_equal(sscanf(tick, "<text x=\"%lf\"", &x), 1);
    assert_true(x - 7.2 * 7 / 2 >= 0);
    free(bar.text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_the_bar_says_is_within_it),
        cmocka_unit_test(one_scale_serves_several_criteria),
        cmocka_unit_test(ends_that_are_exceeded_are_signed),
        cmocka_unit_test(the_first_figure_is_whole),
        cmocka_unit_test(scales_hold_what_arrives),
        cmocka_unit_test(steps_part_where_the_criterion_does),
        cmocka_unit_test(what_is_not_covered_is_striped),
        cmocka_unit_test(charts_are_told_from_their_neighbours),
        cmocka_unit_test(the_bar_shows_unit_ticks_and_criterion),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
