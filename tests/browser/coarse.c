/* A page whose picture has fewer triangles than the geometry: what a click tells is still what is there. */
#include "../report/exported.h"
#include "browser.h"

#include "report/page.h"

#include <math.h>

#define MOST 2500
#define OFF 0.2 /* m: more than the cells of that are wide */

static exported e;
static json_t *found[2]; /* what the page's reader saw: as it is, and on textures of few pixels */

static void write_report(const char *page)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/report.html", workplace);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fputs(page, file);
    fclose(file);
}

static json_t *read_report(void)
{
    json_t *told =
        read_with("viewer.js", "report.html", "--window-size=1200,900 --virtual-time-budget=60000 --dump-dom");
    assert_opened(told);
    return told;
}

static int open_twice(void **state)
{
    if (open_workplace(state) != 0)
        return -1;
    if (!has_browser())
        return 0;
    sp_error error = {0};
    export_set_up_around(&e, 160, true, sp_v(0, 0, 0), sp_transform_default());
    sp_result result = {.command = "simulate", .scene = "tank.yaml", .design_count = 1, .designs = &e.design};
    char *page = sp_page_html(&result, MOST, &error), *tile = page ? strstr(page, "TILE = 4096") : NULL;
    assert_non_null(tile);
    write_report(page);
    found[0] = read_report();
    memcpy(tile, "TILE = 37  ", strlen("TILE = 37  "));
    write_report(page);
    found[1] = read_report();
    free(page);
    return 0;
}

static int close_both(void **state)
{
    for (int i = 0; i < 2; i++)
        json_decref(found[i]);
    if (has_browser())
        export_tear_down(&e);
    return close_workplace(state);
}

static void a_click_shows_what_is_there(void **state)
{
    (void)state;
    skip_without_browser();
    const sp_patches *patches = sp_evaluator_patches(e.evaluator);
    const json_t *picks = json_object_get(found[0], "picks"), *pick;
    size_t i, asked = 0;
    json_array_foreach(picks, i, pick)
    {
        sp_vec3 at;
        const char *text = json_string_value(json_object_get(pick, "text")), *where = strstr(text, " at ");
        size_t patch = (size_t)json_integer_value(json_object_get(pick, "patch"));
        if (!where || sscanf(where, " at %lf, %lf, %lf m", &at.x, &at.y, &at.z) != 3 || strstr(where, "no cleaning"))
            continue;
        asked++;
        assert_true(patch < patches->count);
        assert_true(sp_distance(at, patches->point[patch]) <= OFF);
        const json_t *row = json_array_get(json_object_get(pick, "rows"), 4);
        double share = strtod(json_string_value(json_array_get(row, 1)), NULL);
        assert_true(fabs(share - 100 * e.coverage->deposits.share[patch]) <= 1);
    }
    assert_true(asked >= 5);
}

static void a_page_of_several_textures_looks_the_same(void **state)
{
    (void)state;
    skip_without_browser();
    assert_true(sp_evaluator_atlas(e.evaluator)->page_edge > 37);
    assert_true(json_equal(json_object_get(found[0], "first"), json_object_get(found[1], "first")));
    assert_true(json_equal(json_object_get(found[0], "quantities"), json_object_get(found[1], "quantities")));
}

/* A page that evaluates nothing has them with it. */
static void boxes_come_and_go(void **state)
{
    (void)state;
    skip_without_browser();
    const json_t *boxes = json_object_get(json_object_get(found[0], "layers"), "Boxes");
    const json_t *on = json_object_get(boxes, "on"), *off = json_object_get(boxes, "off");
    assert_non_null(strstr(json_string_value(json_object_get(on, "said")), "Boxes: the leaves"));
    assert_false(json_equal(json_object_get(on, "seen"), json_object_get(off, "seen")));
    assert_true(json_equal(json_object_get(off, "seen"), json_object_get(found[0], "first")));
    assert_true(json_equal(json_object_get(json_object_get(boxes, "byKey"), "seen"), json_object_get(on, "seen")));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_click_shows_what_is_there),
        cmocka_unit_test(a_page_of_several_textures_looks_the_same),
        cmocka_unit_test(boxes_come_and_go),
    };
    return cmocka_run_group_tests(tests, open_twice, close_both);
}
