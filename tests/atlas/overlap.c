/* Overlaps are counted right, whatever lies on the page, and without holding every needle against every other. */
#include "shapes.h"

#include "atlas/overlap.h"
#include "atlas/plane.h"

#ifdef SPRAYPLAN_SANITIZE
enum { NEEDLES = 3000, ROUNDS = 15 };
#else
enum { NEEDLES = 30000, ROUNDS = 60 };
#endif

/* A surface with what is laid of it, one chart unless said otherwise. Vertices lie where they are laid. */
typedef struct {
    sp_mesh *mesh;
    sp_atlas atlas;
} laid;

static laid lay(double (*points)[2], size_t point_count, uint32_t (*triangles)[3], size_t count)
{
    sp_vec3 *vertices = malloc(point_count * sizeof *vertices);
    for (size_t i = 0; i < point_count; i++) /* never two in one place, where welding would make them one */
        vertices[i] = sp_v(points[i][0], points[i][1], 1e-3 * (double)i / (double)point_count);
    laid l = {.mesh = mesh_of(vertices, point_count, (const uint32_t(*)[3])triangles, count)};
    assert_int_equal(l.mesh->triangle_count, count);
    l.atlas = (sp_atlas){.texel = 1, .triangle_count = count, .chart_count = 1, .page_count = 1, .page_edge = 4096};
    l.atlas.chart = calloc(count, sizeof *l.atlas.chart);
    l.atlas.chart_page = calloc(count, sizeof *l.atlas.chart_page);
    l.atlas.uv = malloc(count * sizeof *l.atlas.uv);
    for (size_t t = 0; t < count; t++)
        for (int k = 0; k < 3; k++)
            memcpy(l.atlas.uv[t][k], points[triangles[t][k]], sizeof l.atlas.uv[t][k]);
    free(vertices);
    return l;
}

static void forget(laid *l)
{
    sp_mesh_destroy(l->mesh);
    free(l->atlas.chart);
    free(l->atlas.chart_page);
    free(l->atlas.uv);
}

static sp_overlaps overlaps_of(const laid *l, size_t most)
{
    sp_overlaps found;
    sp_error error = {0};
    if (!sp_find_overlaps(&l->atlas, l->mesh, most, &found, &error))
        fail_msg("%s", error.message);
    return found;
}

/* Needles around a point, over so many turns; a whole turn closes up. `inner` > 0 leaves a hole in the middle, and the
 * needles are then two and two the halves of thin quadrangles. */
static laid fan(size_t count, double turns, double inner)
{
    size_t rim = turns == 1 ? count : count + 1, used = 0;
    double(*points)[2] = malloc((2 * rim + 1) * sizeof *points);
    uint32_t(*triangles)[3] = malloc(2 * count * sizeof *triangles);
    for (size_t i = 0; i < rim; i++)
        for (int ring = 0; ring < 2; ring++) {
            double angle = 2 * M_PI * turns * (double)i / (double)count, radius = ring ? inner : 1000;
            points[i + (size_t)ring * rim][0] = 2000 + radius * cos(angle);
            points[i + (size_t)ring * rim][1] = 2000 + radius * sin(angle);
        }
    for (uint32_t i = 0; i < count; i++) {
        uint32_t a = i, b = (uint32_t)((i + 1) % rim), c = a + (uint32_t)rim, d = b + (uint32_t)rim;
        memcpy(triangles[used++], (uint32_t[]){inner > 0 ? c : (uint32_t)rim, a, b}, sizeof *triangles);
        if (inner > 0)
            memcpy(triangles[used++], (uint32_t[]){c, b, d}, sizeof *triangles);
    }
    laid l = lay(points, inner > 0 ? 2 * rim : rim + 1, triangles, used);
    free(points);
    free(triangles);
    return l;
}

static void fans_of_needles_do_not_overlap(void **state)
{
    (void)state;
    const double turns[] = {1, 1, 0.95, 0.95}, inner[] = {0, 100, 0, 100}; /* a hole is a second chain */
    for (int i = 0; i < 4; i++) {
        laid l = fan(NEEDLES, turns[i], inner[i]);
        sp_overlaps found = overlaps_of(&l, SIZE_MAX);
        print_message("%g turns, hole %g: %.1f tests a triangle\n", turns[i], inner[i],
                      (double)found.tests / (double)l.atlas.triangle_count);
        assert_int_equal(found.count, 0);
        assert_int_equal(found.triangle, SP_NONE);
        assert_true(found.tests < 100 * l.atlas.triangle_count);
        forget(&l);
    }
}

/* A fan of 1.1 turns: the last needles lie on the first ones. */
static void more_than_a_turn_does(void **state)
{
    (void)state;
    enum { TURN = 500, OVER = 50 };
    const double inner[] = {0, 100};
    for (int i = 0; i < 2; i++) {
        laid l = fan(TURN + OVER, 1 + (double)OVER / TURN, inner[i]);
        sp_overlaps found = overlaps_of(&l, SIZE_MAX);
        assert_int_equal(found.count, i ? 2 * OVER : OVER);
        assert_int_equal(found.triangle, i ? 2 * TURN : TURN);
        assert_int_equal(overlaps_of(&l, 1).count > 0, 1);
        forget(&l);
    }
}

/* A ring and a disc as one chart each, the disc in the ring's hole, on the ring, or far away: only what lies over what
 * is of its own chart counts. As one chart, all over each other counts. */
static void islands_count_by_chart(void **state)
{
    (void)state;
    enum { SIDES = 24 };
    const double shift[] = {0, 150, 400};
    for (int i = 0; i < 3; i++) {
        double points[3 * SIDES + 1][2] = {{0}};
        uint32_t triangles[3 * SIDES][3];
        for (uint32_t k = 0; k < SIDES; k++) {
            double c = cos(2 * M_PI * k / SIDES), s = sin(2 * M_PI * k / SIDES);
            uint32_t next = (k + 1) % SIDES;
            memcpy(points[k], (double[]){1000 + 100 * c, 1000 + 100 * s}, sizeof *points);
            memcpy(points[SIDES + k], (double[]){1000 + 200 * c, 1000 + 200 * s}, sizeof *points);
            memcpy(points[2 * SIDES + k], (double[]){1000 + shift[i] + 40 * c, 1000 + 40 * s}, sizeof *points);
            memcpy(triangles[k], (uint32_t[]){k, SIDES + k, SIDES + next}, sizeof *triangles);
            memcpy(triangles[SIDES + k], (uint32_t[]){k, SIDES + next, next}, sizeof *triangles);
            memcpy(triangles[2 * SIDES + k], (uint32_t[]){3 * SIDES, 2 * SIDES + k, 2 * SIDES + next},
                   sizeof *triangles);
        }
        memcpy(points[3 * SIDES], (double[]){1000 + shift[i], 1000}, sizeof *points);
        laid l = lay(points, 3 * SIDES + 1, triangles, 3 * SIDES);
        assert_int_equal(overlaps_of(&l, SIZE_MAX).count > 0, shift[i] == 150);
        for (int t = 2 * SIDES; t < 3 * SIDES; t++)
            l.atlas.chart[t] = 1;
        l.atlas.chart_count = 2;
        assert_int_equal(overlaps_of(&l, SIZE_MAX).count, 0);
        forget(&l);
    }
}

static size_t count_pairs(const sp_atlas *atlas)
{
    size_t count = 0;
    for (size_t a = 0; a < atlas->triangle_count; a++)
        for (size_t b = 0; b < a; b++)
            count += atlas->chart[a] == atlas->chart[b] &&
                     sp_triangles_overlap((const double(*)[2])atlas->uv[a], (const double(*)[2])atlas->uv[b]);
    return count;
}

/* Nets rolled up askew, some beyond a turn, some in two charts, against every pair. */
static void agrees_with_every_pair(void **state)
{
    (void)state;
    enum { COLUMNS = 30, ROWS = 3, POINTS = (COLUMNS + 1) * (ROWS + 1) };
    uint64_t seed = 9;
    int overlapping = 0;
    for (int round = 0; round < ROUNDS; round++) {
        double points[POINTS][2], turns = 0.7 + 0.6 * random_number(&seed);
        uint32_t triangles[2 * COLUMNS * ROWS][3];
        size_t count = 0;
        for (uint32_t c = 0; c <= COLUMNS; c++)
            for (uint32_t r = 0; r <= ROWS; r++) {
                double angle = -2 * M_PI * turns * (c + 0.3 * random_number(&seed)) / COLUMNS;
                double radius = 300 + 100 * (r + 0.3 * random_number(&seed));
                double *p = points[c * (ROWS + 1) + r];
                p[0] = 1000 + radius * cos(angle);
                p[1] = 1000 + radius * sin(angle);
            }
        for (uint32_t c = 0; c < COLUMNS; c++)
            for (uint32_t r = 0; r < ROWS; r++) {
                uint32_t a = c * (ROWS + 1) + r, b = a + ROWS + 1;
                memcpy(triangles[count++], (uint32_t[]){a, b, b + 1}, sizeof *triangles);
                memcpy(triangles[count++], (uint32_t[]){a, b + 1, a + 1}, sizeof *triangles);
            }
        laid l = lay(points, POINTS, triangles, count);
        if (round % 3 == 0) {
            l.atlas.chart_count = 2;
            for (size_t t = 0; t < count / 2; t++)
                l.atlas.chart[t] = 1;
        }
        size_t expected = count_pairs(&l.atlas);
        assert_int_equal(overlaps_of(&l, SIZE_MAX).count, expected);
        overlapping += expected > 0;
        forget(&l);
    }
    print_message("%d of %d overlap\n", overlapping, ROUNDS);
    assert_true(overlapping > ROUNDS / 8 && overlapping < ROUNDS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fans_of_needles_do_not_overlap),
        cmocka_unit_test(more_than_a_turn_does),
        cmocka_unit_test(islands_count_by_chart),
        cmocka_unit_test(agrees_with_every_pair),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
