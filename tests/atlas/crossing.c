/* Chains of segments: whether they cross is decided exactly, in time about linear in their number. */
#include "shapes.h"

#include "atlas/charts/crossing.h"
#include "mesh/predicate.h"

/* A closed chain through `points`. */
static sp_segment *chain(double (*points)[2], size_t count)
{
    sp_segment *segments = malloc(count * sizeof *segments);
    for (size_t i = 0; i < count; i++) {
        size_t next = (i + 1) % count;
        segments[i] = (sp_segment){(uint32_t)i, (uint32_t)next, points[i], points[next]};
    }
    return segments;
}

static sp_crossing test_chain(double (*points)[2], size_t count)
{
    sp_segment *segments = chain(points, count);
    sp_crossing found = sp_segments_cross(segments, count);
    assert_true(found.memory);
    free(segments);
    return found;
}

static void orientation_is_exact(void **state)
{
    (void)state;
    /* Points on the line y = x, moved by the last bit: round-off alone would call most of them collinear. */
    for (int i = 0; i < 64; i++) {
        double a[2] = {0.5, 0.5}, b[2] = {12, 12}, c[2] = {24 + i * 0x1p-48, 24 + i * 0x1p-48};
        assert_true(sp_orientation(a, b, c) == 0);
        c[1] = nextafter(c[1], 100);
        assert_true(sp_orientation(a, b, c) > 0 && sp_orientation(b, a, c) < 0 && sp_orientation(c, a, b) > 0);
        a[0] = nextafter(0.5, 0);
        c[1] = c[0];
        assert_true(sp_orientation(a, b, c) < 0 || sp_orientation(a, b, c) > 0);
    }
}

static void stars_combs_and_bows(void **state)
{
    (void)state;
    double square[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, bow[4][2] = {{0, 0}, {1, 1}, {1, 0}, {0, 1}};
    assert_false(test_chain(square, 4).crossing);
    assert_true(test_chain(bow, 4).crossing);
    double touching[5][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 0}, {0, 1}}; /* a corner on an edge */
    assert_true(test_chain(touching, 5).crossing);
    touching[3][1] = 1e-6;
    assert_false(test_chain(touching, 5).crossing);
    double spike[5][2] = {{0, 0}, {1, 0}, {2, 0}, {1, 0}, {0, 1}}; /* there and back */
    assert_true(test_chain(spike, 5).crossing);
}

/* As many needles as there are, side by side or all around: pairs are tested in proportion to them, not to their
 * square.
 */
static void needles_are_not_quadratic(void **state)
{
    (void)state;
    for (int shape = 0; shape < 2; shape++) {
        double per_segment[2];
        for (int k = 0; k < 2; k++) {
            size_t count = k ? 40000 : 10000;
            double(*points)[2] = malloc(count * sizeof *points);
            for (size_t i = 0; i < count; i++) {
                double pitch = 2 * M_PI / (double)count, radius = shape == 1 && i % 2 ? 1 - 6 * pitch : 1;
                points[i][0] = radius * cos((double)i * pitch);
                points[i][1] = radius * sin((double)i * pitch);
            }
            sp_crossing found = test_chain(points, count);
            assert_false(found.crossing);
            per_segment[k] = (double)found.tests / (double)count;
            free(points);
        }
        print_message("shape %d: %.1f and %.1f tests a segment\n", shape, per_segment[0], per_segment[1]);
        assert_true(per_segment[1] < 2 * per_segment[0] && per_segment[1] < 100);
    }
}

/* Random chains against every pair. */
static void agrees_with_every_pair(void **state)
{
    (void)state;
    uint64_t seed = 5;
    int crossed = 0;
    for (int round = 0; round < 300; round++) {
        enum { MOST = 60 };
        double points[MOST][2];
        size_t count = 20 + (size_t)(40 * random_number(&seed));
        for (size_t i = 0; i < count; i++) { /* a wavy circle that crosses itself now and then */
            double turn = 2 * M_PI * (double)i / (double)count, radius = 1 + 0.5 * random_number(&seed);
            points[i][0] = radius * cos(turn + 0.3 * random_number(&seed));
            points[i][1] = radius * sin(turn + 0.3 * random_number(&seed));
        }
        bool expected = false;
        for (size_t i = 0; i < count; i++)
            for (size_t j = i + 2; j < count; j++) {
                const double *a = points[i], *b = points[i + 1], *c = points[j], *d = points[(j + 1) % count];
                expected = expected ||
                           (i != (j + 1) % count && (sp_orientation(a, b, c) > 0) != (sp_orientation(a, b, d) > 0) &&
                            (sp_orientation(c, d, a) > 0) != (sp_orientation(c, d, b) > 0));
            }
        assert_int_equal(test_chain(points, count).crossing, expected);
        crossed += expected;
    }
    print_message("%d of 300 cross\n", crossed);
    assert_true(crossed > 30 && crossed < 270);
}

/* A corner that lies on an edge still does where the chart is drawn far from the origin, which rounds; one that is
 * clearly beside it does not. */
static void moving_changes_no_answer(void **state)
{
    (void)state;
    uint64_t seed = 7;
    for (int round = 0; round < 1000; round++) {
        double turn = 2 * M_PI * random_number(&seed), far = 1e4 * random_number(&seed), on = random_number(&seed);
        double points[5][2] = {{0, 0}, {2, 0}, {2, 1}, {0.1 + 1.8 * on, 0}, {0, 1}};
        for (int beside = 0; beside < 2; beside++) {
            double moved[5][2];
            points[3][1] = 1e-8 * beside;
            for (int i = 0; i < 5; i++) {
                moved[i][0] = far + cos(turn) * points[i][0] - sin(turn) * points[i][1];
                moved[i][1] = far + sin(turn) * points[i][0] + cos(turn) * points[i][1];
            }
            assert_int_equal(test_chain(moved, 5).crossing, !beside);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(orientation_is_exact),      cmocka_unit_test(stars_combs_and_bows),
        cmocka_unit_test(needles_are_not_quadratic), cmocka_unit_test(agrees_with_every_pair),
        cmocka_unit_test(moving_changes_no_answer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
