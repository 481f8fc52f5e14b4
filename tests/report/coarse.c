/* A surface drawn of fewer triangles: few enough, near what it stands for, and of the right texels. */
#include "report/coarse.h"
#include "report/page.h"
#include "report/viewer/shown.h"

#include "exported.h"

#include <math.h>

typedef struct {
    exported e;
    sp_layers layers;
    sp_drawn_surface surface;
    size_t whole;
    double cell;
} fixture;

/* Of a design that stands. */
static void coarsen(fixture *f, size_t most)
{
    sp_error error = {0};
    sp_drawn_surface_free(&f->surface);
    assert_true(sp_drawn_surface_create(&f->surface, &f->layers, &error));
    f->whole = f->surface.triangle_count;
    assert_true(sp_drawn_surface_coarsen(&f->surface, f->e.evaluator, most, &f->cell, &error));
}

static void set_up(fixture *f, bool cavity)
{
    sp_error error = {0};
    *f = (fixture){0};
    export_set_up_around(&f->e, 96, cavity, sp_v(0, 0, 0), sp_transform_default());
    assert_true(sp_layers_create(&f->layers, f->e.evaluator, &error));
}

static void tear_down(fixture *f)
{
    sp_drawn_surface_free(&f->surface);
    sp_layers_free(&f->layers);
    export_tear_down(&f->e);
}

static void what_fits_stays(void **state)
{
    (void)state;
    fixture f;
    set_up(&f, true);
    coarsen(&f, SIZE_MAX);
    assert_int_equal(f.surface.triangle_count, f.whole);
    assert_true(f.cell == 0);
    tear_down(&f);
}

/* Ranges follow one after the other, each within the vertices of its part. */
static void check_ranges(const sp_drawn_surface *s)
{
    size_t next = 0;
    for (size_t r = 0; r < s->range_count; r++) {
        const sp_drawn_range *range = &s->ranges[r];
        assert_int_equal(range->first, next);
        assert_true(range->count > 0);
        next += range->count;
        for (size_t i = range->first; i < next; i++)
            for (int k = 0; k < 3; k++)
                assert_in_range(s->corners[i][k], range->vertex_first, range->vertex_end - 1);
        if (r > 0 && range->part != range[-1].part)
            assert_int_equal(range->vertex_first, range[-1].vertex_end);
    }
    assert_int_equal(next, s->triangle_count);
}

/* Each corner is a vertex of the mesh near the one that it was. */
static void check_places(const fixture *f)
{
    const sp_drawn_surface *s = &f->surface;
    const sp_mesh *mesh = f->e.mesh;
    for (size_t r = 0; r < s->range_count; r++)
        for (size_t i = s->ranges[r].first; i < s->ranges[r].first + s->ranges[r].count; i++)
            for (int k = 0; k < 3; k++) {
                uint32_t was = mesh->triangles[s->triangles[i]][s->ranges[r].layer ? 2 - k : k];
                uint32_t at = s->vertices[s->corners[i][k]].at;
                assert_true(sp_distance(mesh->vertices[was], mesh->vertices[at]) <= f->cell);
            }
}

/* The patch that a drawn triangle shows at its middle, SP_NONE for none. */
static uint32_t patch_at(const fixture *f, const sp_drawn_range *range, size_t triangle, sp_vec3 *place)
{
    const sp_atlas *atlas = sp_evaluator_atlas(f->e.evaluator);
    double uv[2] = {0, 0};
    *place = sp_v(0, 0, 0);
    for (int k = 0; k < 3; k++) {
        const sp_drawn_vertex *vertex = &f->surface.vertices[f->surface.corners[triangle][k]];
        *place = sp_along(*place, 1.0 / 3, f->e.mesh->vertices[vertex->at]);
        for (int axis = 0; axis < 2; axis++)
            uv[axis] += (double)vertex->uv[axis] * atlas->page_edge / 3;
    }
    uint32_t pixel = sp_atlas_pixel(atlas, range->page, (uint32_t)uv[0], (uint32_t)uv[1]);
    return pixel == SP_NONE ? SP_NONE : f->layers.patch[range->layer][pixel];
}

/* Of 50 no more than one, at rims of charts, shows nothing or what is elsewhere. */
static void check_texels(const fixture *f)
{
    const sp_drawn_surface *s = &f->surface;
    const sp_patches *patches = sp_evaluator_patches(f->e.evaluator);
    size_t shown = 0, right = 0;
    for (size_t r = 0; r < s->range_count; r++)
        for (size_t i = s->ranges[r].first; i < s->ranges[r].first + s->ranges[r].count; i++) {
            if (s->ranges[r].page == SP_NONE)
                continue;
            sp_vec3 place;
            uint32_t patch = patch_at(f, &s->ranges[r], i, &place);
            shown++;
            right += patch != SP_NONE && sp_distance(place, patches->point[patch]) <= f->cell + patches->length[patch];
        }
    assert_true(shown > 100);
    if (right < shown - shown / 50)
        fail_msg("%zu of %zu triangles show the texels that are there", right, shown);
}

static void few_enough_are_left_where_they_were(void **state)
{
    (void)state;
    for (int cavity = 0; cavity < 2; cavity++) {
        fixture f;
        set_up(&f, cavity);
        for (size_t most = 500; most <= 2000; most *= 2) {
            coarsen(&f, most);
            assert_true(f.whole > 2 * most);
            assert_in_range(f.surface.triangle_count, most / 2, most);
            assert_true(f.cell > 0);
            check_ranges(&f.surface);
            check_places(&f);
            check_texels(&f);
        }
        tear_down(&f);
    }
}

static void nothing_may_be_left(void **state)
{
    (void)state;
    fixture f;
    set_up(&f, true);
    coarsen(&f, 0);
    assert_int_equal(f.surface.triangle_count, 0);
    assert_int_equal(f.surface.range_count, 0);
    tear_down(&f);
}

/* In words; nothing where all is drawn. */
static void the_page_shows(void **state)
{
    (void)state;
    sp_error error = {0};
    fixture f;
    set_up(&f, true);
    coarsen(&f, 2000);
    sp_result result = {.command = "simulate", .scene = "tank.yaml", .design_count = 1, .designs = &f.e.design};
    sp_figures *figures = sp_result_figures(&result, &error);
    sp_page page = {.result = &result, .figures = figures, .manual = SP_UNKNOWN, .greedy = SP_UNKNOWN};
    char told[128];
    snprintf(told, sizeof told, "below are %zu triangles of the %zu that face the liquid", f.surface.triangle_count,
             f.whole);
    size_t lengths[2];
    for (int whole = 0; whole < 2; whole++) {
        sp_text text = {0};
        page.most_drawn = whole ? f.whole : 2000;
        assert_true(sp_page_viewer(&page, &text, &error));
        assert_false(text.failed);
        assert_int_equal(strstr(text.text, told) == NULL, whole);
        assert_int_equal(strstr(text.text, "too large to be drawn") == NULL, whole);
        lengths[whole] = text.length;
        free(text.text);
    }
    assert_true(lengths[0] < lengths[1]);
    sp_figures_destroy(figures, 1);
    tear_down(&f);
}

/* Two runs on one geometry have one model, and each its own where the geometries differ. */
static void designs_of_one_surface_share_it(void **state)
{
    (void)state;
    for (int other = 0; other < 2; other++) {
        exported one, two;
        export_set_up(&one, true, sp_v(0, 0, 0), sp_transform_default());
        export_set_up_around(&two, other ? 32 : 24, true, sp_v(0, 0, 0), sp_transform_default());
        sp_design designs[3] = {{.name = "read"}, one.design, two.design};
        sp_result result = {.command = "compare", .design_count = 3, .designs = designs};
        sp_page page = {.result = &result, .main = SP_UNKNOWN};
        assert_null(sp_viewer_evaluator(&page, 0));
        assert_ptr_equal(sp_viewer_evaluator(&page, 1), one.evaluator);
        assert_ptr_equal(sp_viewer_evaluator(&page, 2), other ? two.evaluator : one.evaluator);
        export_tear_down(&one);
        export_tear_down(&two);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_fits_stays),
        cmocka_unit_test(few_enough_are_left_where_they_were),
        cmocka_unit_test(nothing_may_be_left),
        cmocka_unit_test(the_page_shows),
        cmocka_unit_test(designs_of_one_surface_share_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
