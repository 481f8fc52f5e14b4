/* Meshes with very much in one place: copies upon copies, corners that all but meet, very many triangles at a corner
 * or in a ring. */
#include "stage.h"

#ifdef SPRAYPLAN_SANITIZE
enum { COPIES = 60, AT_A_CORNER = 1000, IN_A_LOOP = 4000 };
#else
enum { COPIES = 1000, AT_A_CORNER = 10000, IN_A_LOOP = 100000 };
#endif

/* A box of 2 m × 1.6 m × 1.5 m of two triangles a wall, `copies` times; `bits`: each triangle has corners of its own,
 * every coordinate up or down by a last bit, or as it is. */
static sp_mesh *boxes(size_t copies, bool bits)
{
    static const sp_vec3 corner[8] = {{-1, -0.8, 0},   {1, -0.8, 0},   {1, 0.8, 0},   {-1, 0.8, 0},
                                      {-1, -0.8, 1.5}, {1, -0.8, 1.5}, {1, 0.8, 1.5}, {-1, 0.8, 1.5}};
    static const uint32_t inwards[12][3] = {{0, 1, 2}, {0, 2, 3}, {4, 6, 5}, {4, 7, 6}, {0, 5, 1}, {0, 4, 5},
                                            {1, 6, 2}, {1, 5, 6}, {2, 7, 3}, {2, 6, 7}, {3, 4, 0}, {3, 7, 4}};
    sp_vec3 *points = malloc(36 * copies * sizeof *points);
    uint32_t(*triangles)[3] = malloc(12 * copies * sizeof *triangles);
    uint64_t random = 1;
    for (size_t i = 0; i < 36 * copies; i++) {
        points[i] = corner[inwards[i / 3 % 12][i % 3]];
        double *of[3] = {&points[i].x, &points[i].y, &points[i].z};
        for (int k = 0; k < 3 && bits; k++) {
            random = random * 6364136223846793005u + 1442695040888963407u; /* Knuth, TAOCP 3.3.4 */
            *of[k] = random >> 62 == 0 ? nextafter(*of[k], 9) : random >> 62 == 1 ? nextafter(*of[k], -9) : *of[k];
        }
        triangles[i / 3][i % 3] = (uint32_t)i;
    }
    sp_mesh *mesh =
        sp_mesh_create(points, 36 * copies, (const uint32_t(*)[3])triangles, 12 * copies, NULL, NULL, 0, NULL);
    free(points);
    free(triangles);
    return mesh;
}

static summary cover_boxes(size_t copies, bool bits, sp_trajectory trajectory)
{
    scene s;
    scene_open(&s, boxes(copies, bits), trajectory, 1);
    s.setup.fidelity.texel = 0.08;
    s.setup.cavity = SP_CAVITY_POINT;
    s.setup.cavity_point = sp_v(0.1, 0.2, 0.8);
    s.setup.criterion = (sp_criterion){8.3e-6, 3, deg(80), SP_COMBINE_SUM, 0};
    sp_evaluator *evaluator = scene_evaluator(&s);
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 100);
    sp_nozzle nozzle = nozzle_at(&type, sp_v(0.31, 0.13, 0.71), sp_v(0.9, 0.3, -0.2), 9);
    summary sum = summarise(evaluator, &nozzle, 1, true);
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
    return sum;
}

/* Charts may be joined otherwise, so that texels lie elsewhere: what that changes is their own error. */
static void assert_alike(const char *what, summary found, summary plain)
{
    print_message("%s: area %+.1e, coverage %+.1e, liquid %+.1e\n", what, found.area / plain.area - 1,
                  found.fraction - plain.fraction, found.landed - plain.landed);
    assert_float_equal(found.area / plain.area, 1, 1e-9);
    assert_float_equal(found.fraction, plain.fraction, 2e-4);
    assert_float_equal(found.landed, plain.landed, 1e-3);
}

static void copies_upon_copies(void **state)
{
    (void)state;
    assert_alike("copies", cover_boxes(COPIES, false, SP_TRAJECTORY_PARABOLA),
                 cover_boxes(1, false, SP_TRAJECTORY_PARABOLA));
}

static void corners_a_bit_apart(void **state)
{
    (void)state;
    for (int t = SP_TRAJECTORY_LINE; t <= SP_TRAJECTORY_PARABOLA; t++)
        assert_alike("a bit apart", cover_boxes(1, true, (sp_trajectory)t), cover_boxes(1, false, (sp_trajectory)t));
}

/* How far a chart's lengths are from the mesh's, at worst: of edges, as shares of their own. */
static double worst_edge(const sp_mesh *mesh, const sp_charts *charts)
{
    double worst = 0;
    for (size_t t = 0; t < mesh->triangle_count; t++)
        for (int i = 0; i < 3; i++) {
            const double *p = charts->flat[t][i], *q = charts->flat[t][(i + 1) % 3];
            double length =
                sp_distance(mesh->vertices[mesh->triangles[t][i]], mesh->vertices[mesh->triangles[t][(i + 1) % 3]]);
            worst = fmax(worst, fabs(hypot(q[0] - p[0], q[1] - p[1]) / length - 1));
        }
    return worst;
}

/* The longest way across a chart. */
static double chart_across(const sp_charts *charts)
{
    const double *corners = &charts->flat[0][0][0];
    double most = 0, far[2] = {corners[0], corners[1]};
    for (int round = 0; round < 4; round++) { /* from the farthest to the farthest: enough for strips and fans */
        double from[2] = {far[0], far[1]};
        for (size_t i = 0; i < 3 * charts->triangle_count; i++) {
            double length = hypot(corners[2 * i] - from[0], corners[2 * i + 1] - from[1]);
            if (length > most) {
                most = length;
                far[0] = corners[2 * i];
                far[1] = corners[2 * i + 1];
            }
        }
    }
    return most;
}

/* A cone about z of `count` triangles, its tip up. */
static sp_mesh *cone_of(size_t count, double radius, double height)
{
    sp_vec3 *points = malloc((count + 1) * sizeof *points);
    uint32_t(*triangles)[3] = malloc(count * sizeof *triangles);
    points[count] = sp_v(0, 0, height);
    for (size_t i = 0; i < count; i++) {
        double turn = 2 * M_PI * (double)i / (double)count;
        points[i] = sp_v(radius * cos(turn), radius * sin(turn), 0);
        triangles[i][0] = (uint32_t)i;
        triangles[i][1] = (uint32_t)((i + 1) % count);
        triangles[i][2] = (uint32_t)count;
    }
    sp_mesh *mesh = sp_mesh_create(points, count + 1, (const uint32_t(*)[3])triangles, count, NULL, NULL, 0, NULL);
    free(points);
    free(triangles);
    return mesh;
}

/* A cone's side is a sector: one chart, its lengths kept, and all of it wet by what sprays down on it from above; from
 * the side no more than half. */
static void very_many_triangles_at_a_corner(void **state)
{
    (void)state;
    const double radius = 0.5, height = 0.4, side = sqrt(radius * radius + height * height), n = AT_A_CORNER;
    /* of the pyramid with so many sides */
    double edge = 2 * radius * sin(M_PI / n), area = 0.5 * n * edge * sqrt(side * side - 0.25 * edge * edge);
    double angle = 2 * n * asin(0.5 * edge / side); /* of the sector */
    double across = angle >= M_PI ? 2 * side : 2 * side * sin(0.5 * angle);
    scene s;
    scene_open(&s, cone_of(AT_A_CORNER, radius, height), SP_TRAJECTORY_LINE, 0.01 / COARSER);
    assert_int_equal(s.mesh->triangle_count, AT_A_CORNER);
    sp_charts *charts = sp_charts_create(s.mesh, INFINITY, NULL);
    assert_int_equal(charts->chart_count, 1);
    double strain = worst_edge(s.mesh, charts), drift = chart_across(charts) / across - 1;
    print_message("%d triangles at a corner: edges %.1e, across the chart %+.1e\n", AT_A_CORNER, strain, drift);
    assert_true(strain < 1e-9 && fabs(drift) < 1e-6);
    sp_charts_destroy(charts);
    sp_evaluator *evaluator = scene_evaluator(&s);
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 100);
    sp_nozzle nozzle = nozzle_at(&type, sp_v(0, 0, 1.2), sp_v(0, 0, -1), 9);
    sp_coverage *coverage = sound_cover(evaluator, &nozzle, 1, true);
    print_message("... area %+.1e, coverage from above %.9f\n", coverage->area / area - 1, coverage->fraction);
    assert_float_equal(coverage->area / area, 1, 1e-9);
    assert_float_equal(coverage->fraction, 1, 1e-9);
    sp_coverage_destroy(coverage);
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

/* A band closed in a ring, unfolded: as long as it is round, and no longer crooked than round-off makes it. */
static void a_loop_unfolded(void **state)
{
    (void)state;
    enum { ROUND = IN_A_LOOP / 2 };
    const double radius = 1, width = 0.05;
    sp_vec3 *points = malloc(2 * ROUND * sizeof *points);
    uint32_t(*triangles)[3] = malloc(2 * ROUND * sizeof *triangles);
    for (uint32_t i = 0; i < ROUND; i++) {
        double turn = 2 * M_PI * i / ROUND;
        points[i] = sp_v(radius * cos(turn), radius * sin(turn), 0);
        points[ROUND + i] = sp_add(points[i], sp_v(0, 0, width));
        uint32_t next = (i + 1) % ROUND;
        const uint32_t two[2][3] = {{i, next, ROUND + next}, {i, ROUND + next, ROUND + i}};
        for (int k = 0; k < 6; k++)
            triangles[2 * i + (uint32_t)k / 3][k % 3] = two[k / 3][k % 3];
    }
    sp_mesh *mesh = sp_mesh_create(points, 2 * ROUND, (const uint32_t(*)[3])triangles, 2 * ROUND, NULL, NULL, 0, NULL);
    sp_charts *charts = sp_charts_create(mesh, INFINITY, NULL);
    double round = ROUND * 2 * radius * sin(M_PI / ROUND);
    double drift = chart_across(charts) / hypot(round, width) - 1, strain = worst_edge(mesh, charts);
    print_message("a loop of %zu triangles: %zu charts, edges %.1e, from end to end %+.1e\n", mesh->triangle_count,
                  charts->chart_count, strain, drift);
    assert_int_equal(charts->chart_count, 1);
    assert_true(strain < 1e-9 && fabs(drift) < 1e-9);
    sp_charts_destroy(charts);
    sp_mesh_destroy(mesh);
    free(points);
    free(triangles);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(copies_upon_copies),
        cmocka_unit_test(corners_a_bit_apart),
        cmocka_unit_test(very_many_triangles_at_a_corner),
        cmocka_unit_test(a_loop_unfolded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
