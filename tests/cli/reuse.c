/* simulate: {atlas: reuse}: the texture coordinates that the scene's own files have. */
#include "results.h"

#include <sprayplan/sprayplan.h>

#include <math.h>

/* The room on pages of its own, and a plate in it of which a page is a fifth as wide. */
static const char plate_obj[] = "v 0.6 0.6 0.3\nv 0.8 0.6 0.3\nv 0.8 0.8 0.3\nv 0.6 0.8 0.3\n"
                                "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\ng plate\nf 1/1 2/2 3/3 4/4\n";

static void write_flat_room(const char *name, const char *files)
{
    outcome result = run_program("atlas room.obj -o flat.obj --texel 20mm --quiet");
    assert_int_equal(result.status, 0);
    forget(&result);
    write_room_with(name, "  - file: room.obj\n", files);
}

static void coverage_is_that_of_an_own_atlas(void **state)
{
    (void)state;
    write_flat_room("flat.yaml", "  - file: flat.obj\n");
    json_t *own = expect_json("simulate room.yaml --set simulate.texel=20mm --json", 0);
    json_t *reused = expect_json(
        "simulate flat.yaml --set simulate.texel=auto --set simulate.atlas=reuse --threads 1 --json -o one", 0);
    json_t *again = expect_again(
        reused, "simulate flat.yaml --set simulate.texel=auto --set simulate.atlas=reuse --threads 2 --json -o two", 0);
    json_t *fidelity = json_object_get(reused, "fidelity");
    assert_true(fabs(number(fidelity, "texel_m") - 0.02) < 1e-12); /* as the file notes */
    assert_true(fabs(number(json_object_get(reused, "geometry"), "clean_area_m2") - 6) < 1e-9);
    double error = number(fidelity, "error_estimate") + number(json_object_get(own, "fidelity"), "error_estimate");
    double coverage = number(layout_named(reused, "manual"), "coverage");
    assert_true(fabs(coverage - number(layout_named(own, "manual"), "coverage")) <= error);
    assert_true(error < 0.02 && coverage > 0.1);
    assert_true(json_equal(json_object_get(reused, "layouts"), json_object_get(again, "layouts")));
    json_decref(again);
    again = expect_json("simulate one/layout.yaml --json", 0);
    assert_true(number(layout_named(again, "manual"), "coverage") == coverage);
    json_decref(again);
    json_decref(reused);
    json_decref(own);
}

/* Charts that lie on one another on texels so long lie apart on shorter ones. */
static void a_texel_too_long_for_the_pages_is_gone_below(void **state)
{
    (void)state;
    write_flat_room("flat.yaml", "  - file: flat.obj\n");
    json_t *kept = expect_json("simulate flat.yaml --set simulate.texel=20mm --set simulate.atlas=reuse --json", 0);
    json_t *below = expect_json("simulate flat.yaml --set simulate.texel=90mm --set simulate.atlas=reuse --json", 0);
    json_t *fidelity = json_object_get(below, "fidelity");
    assert_true(number(fidelity, "texel_m") <= 0.045 && number(fidelity, "texel_m") >= 0.02 - 1e-12);
    assert_non_null(strstr(json_string_value(json_object_get(json_object_get(fidelity, "auto"), "texel_m")),
                           "not the 90 mm asked for"));
    assert_true(fabs(number(json_object_get(below, "geometry"), "clean_area_m2") - 6) < 1e-9);
    assert_null(json_object_get(json_object_get(json_object_get(kept, "fidelity"), "auto"), "texel_m"));
    json_decref(below);
    json_decref(kept);
}

/* The charts are the file's own: its pages are the pictures' pages, and 1 and 2 threads give the same bytes. */
static void pages_are_those_of_the_file(void **state)
{
    (void)state;
    write_flat_room("flat.yaml", "  - file: flat.obj\n");
    ensure("one", "simulate flat.yaml --set simulate.texel=auto --set simulate.atlas=reuse --threads 1");
    ensure("two", "simulate flat.yaml --set simulate.texel=auto --set simulate.atlas=reuse --threads 2");
    size_t size, other;
    char *exr = read_file("one/deposits.exr", &size), *same = read_file("two/deposits.exr", &other);
    char *obj = read_file("flat.obj", NULL), *png = read_file("one/coverage.png", NULL);
    assert_true(exr && same && size == other && memcmp(exr, same, size) == 0);
    unsigned edge = 0;
    assert_int_equal(sscanf(obj, "# sprayplan atlas: texels along a page's edge, and metres of a texel: %u", &edge), 1);
    assert_int_equal((unsigned char)png[18] << 8 | (unsigned char)png[19], edge); /* the PNG header's width */
    free(exr);
    free(same);
    free(obj);
    free(png);
    char *layout = read_file("one/layout.yaml", NULL);
    assert_non_null(strstr(layout, "atlas: reuse"));
    free(layout);
}

static void files_have_pages_of_their_own(void **state)
{
    (void)state;
    write_file("plate.obj", plate_obj);
    write_flat_room("both.yaml", "  - file: flat.obj\n  - file: plate.obj\n");
    json_t *both = expect_json("simulate both.yaml --set simulate.texel=20mm --set simulate.atlas=reuse --json", 0);
    json_t *own = expect_json("simulate both.yaml --set simulate.texel=20mm --json", 0);
    assert_true(fabs(number(json_object_get(both, "geometry"), "clean_area_m2") - 6.08) < 1e-9);
    double error = number(json_object_get(both, "fidelity"), "error_estimate") +
                   number(json_object_get(own, "fidelity"), "error_estimate");
    assert_true(fabs(number(layout_named(both, "manual"), "coverage") -
                     number(layout_named(own, "manual"), "coverage")) <= error);
    json_decref(both);
    json_decref(own);
}

/* The search's own texels are longer than the file's, where its charts would not keep a pixel apart. */
static void place_reuses_too(void **state)
{
    (void)state;
    outcome result = run_program("atlas room.obj -o coarse.obj --texel 100mm --quiet");
    assert_int_equal(result.status, 0);
    forget(&result);
    write_room_with("coarse.yaml", "  - file: room.obj\n", "  - file: coarse.obj\n");
    json_t *object = expect_json("place coarse.yaml --set simulate.texel=auto --set simulate.atlas=reuse --set "
                                 "place.refine=none --json -o placed",
                                 0);
    assert_true(number(layout_named(object, "proposed"), "coverage") >= 0.9);
    json_decref(object);
    char *layout = read_file("placed/layout.yaml", NULL);
    assert_non_null(strstr(layout, "atlas: reuse"));
    free(layout);
}

/* A little longer than the file's, as `study` tries them, charts need not keep apart: they are packed anew. */
static void other_texels_pack_the_charts_anew(void **state)
{
    (void)state;
    write_flat_room("flat.yaml", "  - file: flat.obj\n");
    char path[1024];
    snprintf(path, sizeof path, "%s/flat.yaml", workplace);
    sp_error error = {0};
    const char *const settings[] = {"simulate.atlas=reuse", "simulate.texel=auto"};
    sp_scene *scene = sp_scene_load_with(path, settings, 2, NULL, &error);
    assert_non_null(scene);
    sp_setup setup = *sp_scene_setup(scene);
    sp_evaluator *own = sp_evaluator_create(&setup, &error);
    setup.fidelity.texel *= 1.03;
    sp_evaluator *longer = sp_evaluator_create(&setup, &error);
    if (!own || !longer)
        fail_msg("%s", error.message);
    assert_int_equal(sp_evaluator_atlas(longer)->chart_count, sp_evaluator_atlas(own)->chart_count);
    assert_true(sp_evaluator_patches(longer)->count < sp_evaluator_patches(own)->count);
    assert_true(fabs(sp_evaluator_patches(longer)->total_area - 6) < 1e-9);
    sp_evaluator_destroy(longer);
    sp_evaluator_destroy(own);
    sp_scene_destroy(scene);
}

static void what_is_unsound_is_reported_where(void **state)
{
    (void)state;
    expect("simulate room.yaml --set simulate.atlas=reuse", 3, "",
           "room.obj:10: found a corner without texture coordinates; expected texture coordinates as atlas writes "
           "them\n");
    expect("simulate room.yaml --set simulate.atlas=again", 3, "",
           "simulate.atlas=again: atlas: found 'again', expected unfold or reuse\n");
    char *turned = strdup(plate_obj);
    memcpy(strstr(turned, "1/1 2/2"), "1/2 2/1", 7);
    write_file("turned.obj", turned);
    free(turned);
    write_flat_room("turned.yaml", "  - file: flat.obj\n  - file: turned.obj\n");
    expect("simulate turned.yaml --set simulate.atlas=reuse", 3, "",
           "turned.obj:10: found a triangle that is turned over on the page; expected texture coordinates as atlas "
           "writes them\n");
    write_file("dull.stl", "solid dull\nfacet normal 0 0 1\nouter loop\nvertex 0.6 0.6 0.3\nvertex 0.8 0.6 0.3\n"
                           "vertex 0.8 0.8 0.3\nendloop\nendfacet\nendsolid dull\n");
    write_flat_room("dull.yaml", "  - file: flat.obj\n  - file: dull.stl\n");
    expect("simulate dull.yaml --set simulate.atlas=reuse", 3, "",
           "dull.yaml:3:11: file: found 'dull.stl', expected an OBJ file, as simulate has atlas: reuse\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coverage_is_that_of_an_own_atlas),
        cmocka_unit_test(a_texel_too_long_for_the_pages_is_gone_below),
        cmocka_unit_test(pages_are_those_of_the_file),
        cmocka_unit_test(files_have_pages_of_their_own),
        cmocka_unit_test(place_reuses_too),
        cmocka_unit_test(other_texels_pack_the_charts_anew),
        cmocka_unit_test(what_is_unsound_is_reported_where),
    };
    return cmocka_run_group_tests(tests, open_workplace, close_workplace);
}
