/* Gaps between the tracks of two-axis jet heads, against tracks that are sampled densely. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <sprayplan/tracks.h>

#include <stdlib.h>

static sp_vec3 random_direction(uint64_t i, uint64_t n)
{
    sp_spray all = {.kind = SP_PATTERN_FULL_CONE, .outer = M_PI};
    sp_spray_settle(&all);
    return sp_spray_direction(&all, i, n, 5);
}

/* Squares of chords from the directions to a track, of three samples in turn; between these they follow a parabola. */
typedef struct {
    double before, here, least;
} approach;

static void look(approach *own, double square)
{
    double down = own->before - own->here, up = square - own->here, bend = down + up;
    double deepest = bend > 0 ? own->here - (up - down) * (up - down) / (8 * bend) : own->here;
    if (own->here >= 0 && down >= 0 && up >= 0)
        own->least = fmin(own->least, fmax(0, deepest));
    own->least = fmin(own->least, square);
    own->before = own->here;
    own->here = square;
}

/* The angles from the directions to the nearest of all jets' tracks, of which so many points a radian are sampled. */
static void sample_tracks(const sp_rotation *rotation, unsigned turns, double points, const sp_vec3 *directions,
                          size_t count, double *angles)
{
    double ratio = (double)rotation->gears[0] / rotation->gears[1];
    size_t steps = (size_t)(points * 2 * M_PI * turns * fmax(ratio, 1));
    approach *own = malloc(count * sizeof *own);
    assert_non_null(own);
    for (size_t i = 0; i < count; i++)
        angles[i] = INFINITY; /* squares until the end */
    for (unsigned j = 0; j < rotation->jets; j++) {
        for (size_t i = 0; i < count; i++)
            own[i] = (approach){-1, -1, angles[i]};
        for (size_t k = 0; k <= steps; k++) {
            double body = 2 * M_PI * turns * (double)k / (double)steps;
            double hub = ratio * body + 2 * M_PI * j / rotation->jets, level = sin(hub);
            sp_vec3 jet = sp_v(level * cos(body), level * sin(body), cos(hub));
            for (size_t i = 0; i < count; i++) {
                sp_vec3 apart = sp_sub(jet, directions[i]);
                look(&own[i], sp_dot(apart, apart));
            }
        }
        for (size_t i = 0; i < count; i++)
            angles[i] = own[i].least;
    }
    for (size_t i = 0; i < count; i++)
        angles[i] = 2 * asin(0.5 * sqrt(angles[i]));
    free(own);
}

static void assert_gaps(unsigned jets, unsigned gear, unsigned other, unsigned turns, double points)
{
    enum { COUNT = 120 };
    sp_rotation rotation = {.jet = SP_PATTERN_SOLID_STREAM, .jets = jets, .gears = {gear, other}};
    sp_vec3 directions[COUNT];
    double sampled[COUNT], mean = 0, error = 0, worst = 0;
    for (size_t i = 0; i < COUNT; i++)
        directions[i] = random_direction(i, COUNT);
    sample_tracks(&rotation, turns, points, directions, COUNT, sampled);
    for (size_t i = 0; i < COUNT; i++) {
        double off = fabs(sp_track_angle(&rotation, turns, directions[i]) - sampled[i]);
        mean += sampled[i] / COUNT;
        error += off / COUNT;
        worst = fmax(worst, off);
    }
    print_message("%u jets, %u:%u, %u turns: mean gap %.4f rad, off by %.2f %% of it, %.1f %% at worst\n", jets, gear,
                  other, turns, mean, 100 * error / mean, 100 * worst / mean);
    if (!(error <= 0.04 * mean))
        fail_msg("gaps are off by more than 4 %% of their mean");
}

static void gaps_are_those_of_dense_tracks(void **state)
{
    (void)state;
    assert_gaps(4, 43, 47, 20, 40);
    assert_gaps(4, 43, 47, 47, 80);
    assert_gaps(2, 43, 47, 11, 40);
    assert_gaps(1, 29, 30, 30, 40);
    assert_gaps(3, 61, 17, 9, 60);
}

/* Hubs that turn slowly: tracks nearly along parallels, few and far apart. */
static void small_fractions_are_reported(void **state)
{
    (void)state;
    assert_gaps(1, 1, 24, 24, 40);
    assert_gaps(2, 1, 40, 40, 40);
    assert_gaps(4, 3, 100, 100, 20);
    assert_gaps(1, 1, 200, 200, 60);
}

/* After that many turns nothing new is drawn, and the closed form of a whole mesh is the sum over its crossings. */
static void tracks_repeat(void **state)
{
    (void)state;
    sp_rotation rotation = {.jet = SP_PATTERN_SOLID_STREAM, .jets = 3, .gears = {12, 20}};
    assert_int_equal(sp_track_turns(&rotation), 5);
    rotation.gears[0] = 43;
    rotation.gears[1] = 47;
    assert_int_equal(sp_track_turns(&rotation), 47);
    for (uint64_t i = 0; i < 200; i++) {
        sp_vec3 d = random_direction(i, 200);
        double whole = sp_track_angle(&rotation, 0, d), fewer = sp_track_angle(&rotation, 40, d);
        assert_true(sp_track_angle(&rotation, 1000, d) == whole);
        assert_true(whole <= fewer + 1e-12);
    }
    assert_true(sp_track_angle(&rotation, 1, sp_v(0, 0, 1)) == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gaps_are_those_of_dense_tracks),
        cmocka_unit_test(small_fractions_are_reported),
        cmocka_unit_test(tracks_repeat),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
