/* What rotates, in the mean: against the jet in many positions, and against two-axis heads at many moments. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <sprayplan/nozzle.h>

#include <stdlib.h>

/* Angles in degrees; thickness 0: a cone. */
typedef struct {
    double angle, hollow, thickness, tilt, roll;
    unsigned jets; /* on a hub */
} turning;

static const turning turnings[] = {
    {60, 0, 4, 30, 0, 0},     {60, 0, 4, 30, 90, 0},    {60, 0, 4, 30, 37, 0},     {120, 0, 10, 0, 0, 0},
    {120, 0, 10, 0, 77, 0},   {90, 0, 8, 90, 90, 0},    {90, 0, 8, 90, 0, 0},      {200, 0, 30, 140, 65, 0},
    {360, 0, 20, 50, 110, 0}, {360, 0, 180, 20, 10, 0}, {0.2, 0, 0.02, 60, 45, 0}, {80, 0, 179, 45, 20, 0},
    {60, 0, 0, 30, 0, 0},     {60, 0, 0, 20, 0, 0},     {60, 0.7, 0, 40, 0, 0},    {60, 0.7, 0, 10, 0, 0},
    {1, 0, 0, 45, 0, 0},      {1e-3, 0, 0, 45, 0, 0},   {360, 0, 0, 77, 0, 0},     {300, 0.5, 0, 100, 0, 0},
    {90, 0, 0, 0, 0, 0},      {90, 0.5, 0, 180, 0, 0},  {30, 0.9, 0, 1e-6, 0, 0},  {1, 0, 0, 0, 0, 4},
    {1e-3, 0, 0, 0, 0, 1},    {90, 0, 0, 0, 0, 2},      {90, 0.8, 0, 0, 0, 2},     {12, 0.3, 0, 0, 0, 3},
};
#define TURNINGS (sizeof turnings / sizeof *turnings)

static double deg(double degrees)
{
    return degrees * M_PI / 180;
}

static sp_spray spray_of(const turning *own)
{
    sp_nozzle_type type = {.pattern = SP_PATTERN_ROTATING,
                           .hollow = own->hollow,
                           .thickness = deg(own->thickness),
                           .rotation = {.jet = own->thickness > 0 ? SP_PATTERN_FLAT_FAN
                                               : own->hollow > 0  ? SP_PATTERN_HOLLOW_CONE
                                                                  : SP_PATTERN_FULL_CONE,
                                        .tilt = deg(own->tilt),
                                        .roll = deg(own->roll),
                                        .jets = own->jets,
                                        .gears = {43, 47}}};
    return sp_spray_create(&type, deg(own->angle));
}

static sp_vec3 at_polar(double polar, double azimuth)
{
    return sp_v(sin(polar) * cos(azimuth), sin(polar) * sin(azimuth), cos(polar));
}

/* A direction of the body's frame in the jet's, when the body has turned by so much: the jet's frame, as sp_rotation
 * says it. */
static sp_vec3 in_jet(const turning *own, double turn, sp_vec3 d)
{
    double tilt = deg(own->tilt), roll = deg(own->roll);
    sp_vec3 z = sp_v(sin(tilt) * cos(turn), sin(tilt) * sin(turn), cos(tilt));
    sp_vec3 across = sp_v(-sin(turn), cos(turn), 0), along = sp_cross(across, z);
    sp_vec3 x = sp_along(sp_scale(along, cos(roll)), sin(roll), across);
    return sp_v(sp_dot(d, x), sp_dot(d, sp_cross(z, x)), sp_dot(d, z));
}

/* All of it, to 1e-9, up to where the region ends; and never less than nothing. */
static void no_liquid_is_lost(void **state)
{
    (void)state;
    for (size_t t = 0; t < TURNINGS; t++) {
        sp_spray spray = spray_of(&turnings[t]);
        double width = spray.high - spray.low, before = 0;
        assert_true(sp_spray_within(&spray, spray.low) == 0 && sp_spray_within(&spray, M_PI) == 1);
        double first = sp_spray_within(&spray, nextafter(spray.low, 4)),
               last = sp_spray_within(&spray, nextafter(spray.high, 0));
        if (!(first < 1e-9 && last > 1 - 1e-9))
            fail_msg("turning %zu begins at %g and lacks %g at the end", t, first, 1 - last);
        for (int i = 1; i <= 200; i++) {
            double within = sp_spray_within(&spray, spray.low + width * i / 200);
            if (within < before - 1e-9)
                fail_msg("turning %zu takes liquid back: %g after %g", t, within, before);
            before = within;
        }
    }
}

/* Whatever the breadth over which it is averaged, also where the jet is much thinner: within 6 %, since about the axis
 * what is broad is a cap, and not told finer. */
static void averages_hold_all_liquid(void **state)
{
    (void)state;
    enum { STEPS = 3000 };
    static const double breadths[] = {0.02, 0.1};
    sp_frame frame = sp_nozzle_frame(sp_v(0.3, -0.2, 0.9), 0.4, sp_v(0, 0, 1));
    for (size_t t = 0; t < TURNINGS; t++) {
        sp_spray spray = spray_of(&turnings[t]);
        for (size_t b = 0; b < sizeof breadths / sizeof *breadths; b++) {
            double sum = 0, share = 0, width = M_PI / STEPS;
            for (int i = 0; i < STEPS; i++) {
                double polar = width * (i + 0.5);
                sp_vec3 d = at_polar(polar, 1);
                sp_vec3 world = sp_along(sp_along(sp_scale(frame.x, d.x), d.y, frame.y), d.z, frame.z);
                double density = sp_spray_density(&spray, &frame, world, breadths[b]);
                share = sp_spray_share(&spray, &frame, world, breadths[b]);
                assert_true(share >= 0 && share <= 1 && density >= 0 && (share > 0 || density == 0));
                sum += density * 2 * M_PI * sin(polar) * width;
            }
            if (fabs(sum - 1) > 0.06)
                fail_msg("turning %zu over %g rad: %.5f of the liquid", t, breadths[b], sum);
        }
    }
}

/* The mean over 20,000 positions of the jet, at directions all over the region. */
static void intensity_is_the_mean_over_a_turn(void **state)
{
    (void)state;
    enum { POSITIONS = 20000, PLACES = 7 };
    for (size_t t = 0; t < TURNINGS; t++) {
        const turning *own = &turnings[t];
        sp_spray spray = spray_of(own), jet = spray;
        jet.kind = spray.jet;
        for (int i = 0; i < PLACES && !own->jets; i++) {
            double polar = spray.low + (spray.high - spray.low) * (i + 0.5) / PLACES, mean = 0;
            sp_vec3 d = at_polar(polar, 0.7);
            for (int k = 0; k < POSITIONS; k++)
                mean += sp_spray_intensity(&jet, in_jet(own, 2 * M_PI * (k + 0.3) / POSITIONS, d)) / POSITIONS;
            double found = sp_spray_intensity(&spray, d);
            /* four ends of arcs, each within a position, of a jet as dense as that */
            if (fabs(found - mean) > 4 / (POSITIONS * spray.solid_angle))
                fail_msg("turning %zu at %g rad: %.8g, by positions %.8g", t, polar, found, mean);
        }
    }
}

/* What leaves within a polar angle follows from what leaves at one. */
static void intensity_adds_up(void **state)
{
    (void)state;
    enum { STEPS = 20000 };
    for (size_t t = 0; t < TURNINGS; t++) {
        sp_spray spray = spray_of(&turnings[t]);
        double width = spray.high - spray.low, sum = 0;
        for (int i = 0; i < STEPS; i++) {
            double x = M_PI * (i + 0.5) / STEPS, polar = spray.low + width * 0.5 * (1 - cos(x));
            sum += sp_spray_intensity(&spray, at_polar(polar, 2)) * 2 * M_PI * sin(polar) * 0.5 * width * sin(x) *
                   M_PI / STEPS;
        }
        if (fabs(sum - 1) > 2e-3)
            fail_msg("turning %zu: intensity adds up to %g", t, sum);
    }
}

/* Bounds hold at every angle between, and tell something where they are said to. */
static void densities_are_bounds(void **state)
{
    (void)state;
    for (size_t t = 0; t < TURNINGS; t++) {
        sp_spray spray = spray_of(&turnings[t]);
        bool told = turnings[t].thickness == 0 && turnings[t].hollow == 0 && turnings[t].angle < 179;
        for (double from = 0; from < 3.1; from += 0.07)
            for (double width = 0.001; width < 1; width *= 3) {
                double to = fmin(M_PI, from + width), least, most, lowest = INFINITY, highest = 0;
                sp_spray_densities(&spray, from, to, &least, &most);
                for (int i = 0; i <= 20; i++) {
                    double density = sp_spray_intensity(&spray, at_polar(from + (to - from) * i / 20, 1));
                    lowest = fmin(lowest, density);
                    highest = fmax(highest, density);
                }
                if (!(least <= lowest * (1 + 1e-9) && most >= highest * (1 - 1e-9)))
                    fail_msg("turning %zu, %g to %g: bounds %g to %g, found %g to %g", t, from, to, least, most, lowest,
                             highest);
                assert_true(!told || least >= 0.99 * lowest);
            }
    }
}

/* Jets are spread over the polar angle as the liquid is. */
static void jets_follow_the_liquid(void **state)
{
    (void)state;
    enum { JETS = 300 };
    for (size_t t = 0; t < TURNINGS; t++) {
        sp_spray spray = spray_of(&turnings[t]);
        double start = 0;
        for (uint64_t i = 0; i < JETS; i++) {
            sp_vec3 d = sp_spray_direction(&spray, i, JETS, 3);
            double within = JETS * sp_spray_within(&spray, atan2(hypot(d.x, d.y), d.z)) - (double)i;
            start = i ? start : within;
            assert_true(fabs(sp_length(d) - 1) < 1e-12);
            if (fabs(within - start) > 1e-4)
                fail_msg("turning %zu: jet %d has %g of the liquid before it, expected %g", t, (int)i, within, start);
        }
    }
}

/* The polar angle of every part of a jet at many moments of its hub's turn: that of the body does not matter. */
static void two_axes_are_the_mean_over_time(void **state)
{
    (void)state;
    enum { MOMENTS = 720, PARTS = 400, BINS = 18 };
    const turning heads[] = {{1, 0, 0, 0, 0, 4}, {40, 0.5, 0, 0, 0, 1}};
    for (size_t h = 0; h < 2; h++) {
        sp_spray spray = spray_of(&heads[h]), jet = spray;
        jet.kind = spray.jet;
        double bins[BINS] = {0};
        for (uint64_t k = 0; k < (uint64_t)MOMENTS * PARTS; k++) {
            double hub = 2 * M_PI * ((double)(k / PARTS) + 0.3) / MOMENTS;
            sp_vec3 d = sp_spray_direction(&jet, k % PARTS, PARTS, 1);
            double polar = acos(fmax(-1, fmin(1, cos(hub) * d.z - sin(hub) * d.x)));
            bins[(int)fmin(BINS - 1, BINS * polar / M_PI)] += 1.0 / (MOMENTS * PARTS);
        }
        for (int i = 0; i < BINS; i++) {
            double low = M_PI * i / BINS, high = M_PI * (i + 1) / BINS;
            double expected = sp_spray_within(&spray, high) - sp_spray_within(&spray, low);
            if (fabs(bins[i] - expected) > 2e-4)
                fail_msg("head %zu, %g deg: %g, sampled %g", h, low * 180 / M_PI, expected, bins[i]);
        }
    }
    sp_spray thin = spray_of(&heads[0]);
    for (double polar = 0.1; polar < 3; polar += 0.3) {
        double density = sp_spray_intensity(&thin, at_polar(polar, 0));
        assert_true(fabs(density * 2 * M_PI * M_PI * sin(polar) - 1) < 3e-3);
    }
}

/* What is as it was when it has turned, turns in vain. */
static void turning_about_its_own_axis_changes_nothing(void **state)
{
    (void)state;
    sp_frame frame = sp_nozzle_frame(sp_v(0, 0, 1), 0, sp_v(0, 0, 1));
    sp_spray turned = spray_of(&(turning){90, 0.5, 0, 0, 0, 0}), still = turned;
    still.kind = turned.jet;
    assert_true(fabs(turned.low - still.inner) < 1e-15 && fabs(turned.high - still.outer) < 1e-15);
    assert_true(fabs(sp_spray_reach(&turned) - still.outer) < 1e-15);
    for (double polar = 0.005; polar < 3; polar += 0.011) {
        sp_vec3 d = at_polar(polar, 1);
        assert_true(fabs(sp_spray_intensity(&turned, d) - sp_spray_intensity(&still, d)) < 1e-12);
        assert_true(fabs(sp_spray_margin(&turned, d) - sp_spray_margin(&still, d)) < 1e-12);
        double share = sp_spray_share(&turned, &frame, d, 1e-4);
        assert_true(fabs(share - (sp_spray_intensity(&still, d) > 0)) < 1e-9);
        assert_true(sp_spray_density(&still, &frame, d, 0.01) ==
                    sp_spray_share(&still, &frame, d, 0.01) / still.solid_angle);
    }
}

/* What people are told of it: the cone that holds all, not the jet that turns in it. */
static void its_cone_holds_all_that_it_sprays(void **state)
{
    (void)state;
    sp_nozzle_type fan = {.pattern = SP_PATTERN_ROTATING,
                          .angle = deg(120),
                          .thickness = deg(6),
                          .rotation = {.jet = SP_PATTERN_FLAT_FAN, .tilt = deg(60)}},
                   stream = {.pattern = SP_PATTERN_ROTATING,
                             .angle = deg(1),
                             .rotation = {.jet = SP_PATTERN_SOLID_STREAM, .tilt = deg(20)}},
                   head = stream, still = {.pattern = SP_PATTERN_FULL_CONE, .angle = deg(90)};
    head.rotation = (sp_rotation){.jet = SP_PATTERN_SOLID_STREAM, .jets = 4, .gears = {43, 47}};
    assert_true(fabs(sp_nozzle_cone(&(sp_nozzle){.type = &fan}) - deg(240)) < 1e-12);
    assert_true(fabs(sp_nozzle_cone(&(sp_nozzle){.type = &stream}) - deg(41)) < 1e-12);
    assert_true(sp_nozzle_cone(&(sp_nozzle){.type = &head}) == 2 * M_PI);
    assert_true(sp_nozzle_cone(&(sp_nozzle){.type = &still}) == deg(90));
    assert_true(sp_nozzle_cone(&(sp_nozzle){.type = &still, .angle = deg(75)}) == deg(75));
    assert_true(sp_nozzle_angle(&(sp_nozzle){.type = &head}) == deg(1));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_liquid_is_lost),
        cmocka_unit_test(averages_hold_all_liquid),
        cmocka_unit_test(intensity_is_the_mean_over_a_turn),
        cmocka_unit_test(intensity_adds_up),
        cmocka_unit_test(densities_are_bounds),
        cmocka_unit_test(jets_follow_the_liquid),
        cmocka_unit_test(two_axes_are_the_mean_over_time),
        cmocka_unit_test(turning_about_its_own_axis_changes_nothing),
        cmocka_unit_test(its_cone_holds_all_that_it_sprays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
