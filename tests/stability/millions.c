/* A room of very many triangles is simulated as one of few is. With a number as its argument the program takes a room
 * of about so many triangles and says what it costs. */
#include "stage.h"

#include <stdio.h>
#include <sys/resource.h>

#ifdef SPRAYPLAN_SANITIZE
enum { TRIANGLES = 3000 };
#else
enum { TRIANGLES = 100000 };
#endif

/* A box of 2 m × 1.6 m × 1.5 m, each wall of n × n squares, fronts outwards. */
static sp_mesh *fine_box(size_t n)
{
    rectangle faces[6];
    box_rectangles(sp_v(-1, -0.8, 0), sp_v(2, 1.6, 1.5), faces);
    size_t row = n + 1, points = 6 * row * row, count = 0;
    sp_vec3 *vertex = malloc(points * sizeof *vertex);
    uint32_t(*triangle)[3] = malloc(12 * n * n * sizeof *triangle);
    assert_true(vertex && triangle);
    for (size_t f = 0; f < 6; f++)
        for (size_t k = 0; k < row * row; k++) {
            const rectangle *r = &faces[f];
            /* what two walls share must be the same to the last bit: the box is the hull of its corners */
            vertex[f * row * row + k] =
                sp_along(sp_along(r->corner, (double)(k % row) / (double)n, r->u), (double)(k / row) / (double)n, r->v);
        }
    for (size_t f = 0; f < 6; f++)
        for (size_t k = 0; k < n * n; k++) {
            uint32_t a = (uint32_t)(f * row * row + k / n * row + k % n), d = a + (uint32_t)row;
            const uint32_t two[2][3] = {{a, a + 1, d + 1}, {a, d + 1, d}};
            for (int i = 0; i < 6; i++)
                triangle[count + (size_t)i / 3][i % 3] = two[i / 3][i % 3];
            count += 2;
        }
    sp_mesh *mesh = sp_mesh_create(vertex, points, (const uint32_t(*)[3])triangle, count, NULL, NULL, 0, NULL);
    free(vertex);
    free(triangle);
    return mesh;
}

static double peak_bytes(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * (double)usage.ru_maxrss;
}

static summary cover(size_t triangles)
{
    scene s;
    scene_open(&s, fine_box((size_t)ceil(sqrt((double)triangles / 12))), SP_TRAJECTORY_PARABOLA, 1);
    size_t count = s.mesh->triangle_count;
    s.setup.fidelity.texel = STAGE_TEXEL;
    s.setup.cavity = SP_CAVITY_POINT;
    s.setup.cavity_point = sp_v(0.1, 0.2, 0.8);
    s.setup.criterion = (sp_criterion){8.3e-6, 3, deg(80), SP_COMBINE_SUM, 0};
    sp_evaluator *evaluator = scene_evaluator(&s);
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 100);
    sp_nozzle nozzle = nozzle_at(&type, sp_v(0.31, 0.13, 0.71), sp_v(0.9, 0.3, -0.2), 9);
    summary sum = summarise(evaluator, &nozzle, 1, true);
    print_message("%zu triangles: area %.9f m2, coverage %.6f, landed %.6f; %.0f bytes a triangle at the most\n", count,
                  sum.area, sum.fraction, sum.landed, peak_bytes() / (double)count);
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
    return sum;
}

static void assert_as_a_plain_one(size_t triangles)
{
    summary plain = cover(12), found = cover(triangles);
    assert_float_equal(found.area / plain.area, 1, 1e-9);
    assert_float_equal(found.fraction, plain.fraction, 0.002);
    assert_float_equal(found.landed, plain.landed, 0.005);
}

static void as_a_plain_room(void **state)
{
    (void)state;
    assert_as_a_plain_one(TRIANGLES);
}

/* Triangles, corners and half edges have numbers of 32 bits. */
static void too_many_are_refused(void **state)
{
    (void)state;
    static const sp_vec3 points[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    static const uint32_t triangle[][3] = {{0, 1, 2}};
    sp_error error = {0};
    assert_null(sp_mesh_create(points, 3, triangle, UINT32_MAX / 3, NULL, NULL, 0, &error));
    assert_int_equal(error.kind, SP_ERROR_INPUT);
    error = (sp_error){0};
    assert_null(sp_mesh_create(points, UINT32_MAX, triangle, 1, NULL, NULL, 0, &error));
    assert_int_equal(error.kind, SP_ERROR_INPUT);
    /* and so have texels */
    scene s;
    scene_open(&s, fine_box(1), SP_TRAJECTORY_LINE, 1);
    s.setup.fidelity.texel = 1e-7;
    error = (sp_error){0};
    assert_null(sp_evaluator_create(&s.setup, &error));
    print_message("%s\n", error.message);
    assert_int_equal(error.kind, SP_ERROR_INPUT);
    scene_close(&s);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(as_a_plain_room),
        cmocka_unit_test(too_many_are_refused),
    };
    if (argc > 1) {
        assert_as_a_plain_one(strtoull(argv[1], NULL, 10));
        return 0;
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
