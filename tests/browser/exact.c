/* The surface that a page evaluates layouts on is the program's to the last bit, whatever its coordinates are made of.
 */
#include "../report/tank.h"
#include "browser.h"

#include <sprayplan/sprayplan.h>

#include <math.h>

/* As they were computed, of six digits, of single precision in mm, or unfolded elsewhere; triangles begin at any of
 * their corners in the first, so that nothing repeats itself. */
typedef enum { ANY, DIGITS, SINGLE, REUSED, KINDS } kind;

static const char scene_yaml[] = "geometry:\n"
                                 "  - {file: %s, unit: %s}\n"
                                 "cavity: [-0.3 m, 0 m, 0.7 m]\n"
                                 "criterion: {flux: 1 L/min/m2}\n"
                                 "catalogue: catalogue.yaml\n"
                                 "nozzles:\n"
                                 "  - {name: N1, type: cone, position: [0.3 m, -0.25 m, 1.2 m], axis: [0, 0, -1], "
                                 "pressure: 2 bar}\n"
                                 "simulate: {texel: 80 mm, atlas: %s}\n";

static void write_coordinate(FILE *file, double value, kind of)
{
    if (of == DIGITS)
        fprintf(file, " %.6g", value);
    else
        fprintf(file, " %.17g", of == SINGLE ? (double)(float)(1e3 * value) : value);
}

static void write_tank(kind of)
{
    sp_error error = {0};
    sp_mesh *mesh = tank_mesh(24, &error);
    assert_non_null(mesh);
    char path[1024], scene[2048];
    snprintf(path, sizeof path, "%s/tank.obj", workplace);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        fputs("v", file);
        for (int k = 0; k < 3; k++)
            write_coordinate(file, (&mesh->vertices[i].x)[k], of);
        fputs("\n", file);
    }
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        const uint32_t *v = mesh->triangles[t];
        int from = of == ANY ? tank_turn(t) : 0;
        fprintf(file, "f %u %u %u\n", v[from] + 1, v[(from + 1) % 3] + 1, v[(from + 2) % 3] + 1);
    }
    fclose(file);
    sp_mesh_destroy(mesh);
    if (of == REUSED) {
        outcome result = run_program("atlas tank.obj -o unfolded.obj --texel 0.08 --quiet");
        assert_int_equal(result.status, 0);
        forget(&result);
    }
    snprintf(scene, sizeof scene, scene_yaml, of == REUSED ? "unfolded.obj" : "tank.obj", of == SINGLE ? "mm" : "m",
             of == REUSED ? "reuse" : "unfold");
    write_file("tank.yaml", scene);
}

static json_t *read_page(void)
{
    outcome result = run_program("simulate tank.yaml -o simulated --quiet");
    assert_int_equal(result.status, 0);
    forget(&result);
    json_t *found = read_with("exact.js", "simulated/report.html", "--virtual-time-budget=60000 --dump-dom");
    assert_opened(found);
    return found;
}

static double number(const json_t *found, const char *list, size_t i)
{
    return json_number_value(json_array_get(json_object_get(found, list), i));
}

/* A triangle by the places of its corners, and by where these lie on the atlas. */
typedef struct {
    double place[9], uv[6];
    bool wet;
} triangle;

static int by_place(const void *a, const void *b)
{
    const triangle *one = a, *two = b;
    for (int k = 0; k < 9; k++)
        if (one->place[k] != two->place[k])
            return one->place[k] < two->place[k] ? -1 : 1;
    return 0;
}

static void read_triangle(const json_t *found, size_t t, triangle *read)
{
    for (size_t k = 0; k < 9; k++)
        read->place[k] = number(found, "places", 3 * (size_t)number(found, "triangles", 3 * t + k / 3) + k % 3);
    for (size_t k = 0; k < 6; k++)
        read->uv[k] = number(found, "uv", 6 * t + k);
}

/* The page has them in an order of its own. Corners of charts on which nothing is cleaned may be rounded. */
static void expect_surface(const json_t *found, const sp_evaluator *evaluator)
{
    const sp_mesh *mesh = sp_evaluator_setup(evaluator)->mesh;
    const sp_atlas *atlas = sp_evaluator_atlas(evaluator);
    size_t count = mesh->triangle_count, exact = 0;
    triangle *own = calloc(count, sizeof *own), *read = calloc(count, sizeof *read);
    assert_int_equal(json_array_size(json_object_get(found, "places")), 3 * mesh->vertex_count);
    assert_int_equal(json_array_size(json_object_get(found, "triangles")), 3 * count);
    for (uint32_t t = 0; t < count; t++) {
        for (size_t k = 0; k < 9; k++)
            own[t].place[k] = (&mesh->vertices[mesh->triangles[t][k / 3]].x)[k % 3];
        memcpy(own[t].uv, atlas->uv[t], sizeof own[t].uv);
        own[t].wet = sp_evaluator_wet(evaluator, t);
        read_triangle(found, t, &read[t]);
    }
    qsort(own, count, sizeof *own, by_place);
    qsort(read, count, sizeof *read, by_place);
    for (size_t t = 0; t < count; t++) {
        assert_int_equal(by_place(&own[t], &read[t]), 0);
        assert_true(t == 0 || by_place(&own[t - 1], &own[t]) != 0);
        for (size_t k = 0; k < 6 && own[t].wet; k++, exact++)
            assert_true(own[t].uv[k] == read[t].uv[k]);
    }
    assert_true(exact > 1000);
    free(own);
    free(read);
}

static void it_is_the_same_to_the_last_bit(void **state)
{
    (void)state;
    skip_without_browser();
    for (kind of = ANY; of < KINDS; of++) {
        write_tank(of);
        json_t *found = read_page();
        sp_error error = {0};
        char path[1024];
        snprintf(path, sizeof path, "%s/tank.yaml", workplace);
        sp_scene *scene = sp_scene_load(path, &error);
        sp_evaluator *evaluator = scene ? sp_evaluator_create(sp_scene_setup(scene), &error) : NULL;
        assert_non_null(evaluator);
        expect_surface(found, evaluator);
        sp_evaluator_destroy(evaluator);
        sp_scene_destroy(scene);
        json_decref(found);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(it_is_the_same_to_the_last_bit)};
    return cmocka_run_group_tests(tests, open_workplace, close_workplace);
}
