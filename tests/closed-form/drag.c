/* Flights of drops that air holds back, against measured terminal speeds and a reference in fine steps. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "spray/drag/chain.h"

static const sp_vec3 down = {0, 0, -9.81};
static const sp_fluid water = {1000, 1e-3, 0.072}, air = {1.2, 18e-6, 0};

typedef struct {
    sp_vec3 place, velocity;
} drop;

/* Written down once more, from the coefficient itself. */
static sp_vec3 pull_on(double diameter, sp_vec3 v, sp_vec3 gravity)
{
    double speed = sp_length(v), reynolds = air.density * diameter * speed / air.viscosity;
    if (speed == 0)
        return gravity;
    double drag = 24 / reynolds * (1 + 0.1806 * pow(reynolds, 0.6459)) + 0.4251 / (1 + 6880.95 / reynolds);
    return sp_along(gravity, -0.75 * air.density * drag / (water.density * diameter) * speed, v);
}

/* Runge and Kutta's classical steps, all alike. */
static drop fly(double diameter, drop at, sp_vec3 gravity, double time, int steps)
{
    double h = time / steps;
    for (int i = 0; i < steps; i++) {
        sp_vec3 v1 = at.velocity, a1 = pull_on(diameter, v1, gravity);
        sp_vec3 v2 = sp_along(at.velocity, h / 2, a1), a2 = pull_on(diameter, v2, gravity);
        sp_vec3 v3 = sp_along(at.velocity, h / 2, a2), a3 = pull_on(diameter, v3, gravity);
        sp_vec3 v4 = sp_along(at.velocity, h, a3), a4 = pull_on(diameter, v4, gravity);
        at.place = sp_along(at.place, h / 6, sp_add(sp_add(v1, v4), sp_scale(sp_add(v2, v3), 2)));
        at.velocity = sp_along(at.velocity, h / 6, sp_add(sp_add(a1, a4), sp_scale(sp_add(a2, a3), 2)));
    }
    return at;
}

static sp_wavefronts *fronts_of(double diameter, double speed, sp_vec3 gravity, double far)
{
    sp_error error = {0};
    sp_drag drag = sp_drag_of_drops(diameter, &water, &air);
    sp_wavefronts *fronts = sp_wavefronts_create(&drag, speed, gravity, far, &error);
    assert_string_equal(error.message, "");
    return fronts;
}

/* Gunn and Kinzer, "The terminal velocity of fall for water droplets in stagnant air", Journal of Meteorology 6, 1949.
 */
static void terminal_speeds_are_as_measured(void **state)
{
    (void)state;
    static const double measured[][3] = {
        {1e-4, 0.27, 0.11}, {5e-4, 2.06, 0.06}, {1e-3, 4.03, 0.06}, {2e-3, 6.49, 0.06}};
    for (size_t i = 0; i < sizeof measured / sizeof *measured; i++) {
        sp_drag drag = sp_drag_of_drops(measured[i][0], &water, &air);
        sp_march march = sp_march_from(&drag, down, sp_v(0, 0, 0), sp_v(0, 0, 0));
        while (isfinite(sp_march_on(&march, 1e-9).time))
            continue;
        double speed = -march.now.velocity.z;
        print_message("drops of %g mm: %.3f m/s, %+.1f %%\n", 1e3 * measured[i][0], speed,
                      100 * (speed / measured[i][1] - 1));
        assert_true(fabs(speed / measured[i][1] - 1) <= measured[i][2]);
    }
}

/* What deviates most of a flight's pieces, and of its end, from the reference; shares of way and speed. */
static void compare(double diameter, double speed, const sp_wavefronts *fronts, sp_vec3 from, const sp_flight *flight,
                    double *place, double *velocity)
{
    sp_chain chain = sp_chain_of(fronts, from, flight);
    drop at = {from, sp_scale(flight->direction, speed)};
    sp_arc_piece piece;
    double now = 0, end = 0;
    while (sp_chain_next(&chain, &piece)) {
        assert_true(fabs(piece.start - end) <= 1e-9 * flight->time);
        end = piece.last ? flight->time : piece.start + piece.ray.t_max / (1 + 1e-9);
        for (int k = 1; k <= 4; k++) {
            double t = k / 4. * (end - piece.start);
            at = fly(diameter, at, down, piece.start + t - now, 40);
            now = piece.start + t;
            double way = fmax(sp_distance(at.place, from), flight->lever * now / flight->time);
            *place = fmax(*place, sp_distance(sp_ray_point(&piece.ray, piece.acceleration, t), at.place) / way);
        }
    }
    assert_true(fabs(end - flight->time) <= 1e-12 * flight->time);
    *velocity = fmax(*velocity, sp_distance(at.velocity, flight->velocity) / sp_length(at.velocity));
}

/* Inverse flights land on their targets, by fine steps; chains keep to them all the way. */
static void flights_land(void **state)
{
    (void)state;
    static const double drops[] = {1e-4, 3e-4, 1.2e-3, 1e-2}, speeds[] = {3, 19};
    const double far = 2.5;
    double low = 0, high = 0, place = 0, velocity = 0;
    sp_vec3 from = sp_v(0.3, -0.2, 1.1);
    int counts[3] = {0}, close = 0;
    for (int i = 0; i < 480; i++) {
        double diameter = drops[i % 4], speed = speeds[i / 4 % 2], a = 0.7 * i,
               c = i % 9 ? cos(1.3 * i) : 1 - i % 2 * 2;
        double r = far * pow(10, -i % 5 * 0.5), s = sqrt(1 - c * c);
        sp_vec3 to = sp_along(from, r, sp_v(s * cos(a), s * sin(a), c));
        static sp_wavefronts *fronts[4][2];
        sp_wavefronts **own = &fronts[i % 4][i / 4 % 2];
        *own = *own ? *own : fronts_of(diameter, speed, down, far);
        sp_flight flights[2];
        int count = sp_wavefronts_flights(*own, from, to, flights);
        counts[count]++;
        for (int k = 0; k < count; k++) {
            drop at = fly(diameter, (drop){from, sp_scale(flights[k].direction, speed)}, down, flights[k].time, 4000);
            double missed = sp_distance(at.place, to) / fmax(r, flights[k].lever);
            *(k ? &high : &low) = fmax(k ? high : low, missed);
            close += k == 0 && missed < 1e-9;
            assert_true(k == 0 || flights[1].time > flights[0].time);
            compare(diameter, speed, *own, from, &flights[k], &place, &velocity);
        }
        if (i >= 472)
            sp_wavefronts_destroy(*own);
    }
    print_message("%d ends out of reach, %d with both arcs; missed by %.2g on low arcs (%d of them by less than 1e-9), "
                  "%.2g on high ones; chains off by %.2g, speeds by %.2g\n",
                  counts[0], counts[2], low, close, high, place, velocity);
    assert_true(counts[0] > 20 && counts[2] > 200 && counts[1] == 0);
    assert_true(low < 2e-7 && 10 * close > 8 * counts[2] && high < 1e-6 && place < 1e-4 && velocity < 1e-4);
}

/* Legs flown forwards against the same reference. */
static void marches_keep_to_the_reference(void **state)
{
    (void)state;
    static const double drops[] = {1e-5, 1e-4, 1e-3, 1e-2};
    double place = 0, velocity = 0;
    for (int i = 0; i < 40; i++) {
        double diameter = drops[i % 4], angle = 0.5 * i;
        sp_drag drag = sp_drag_of_drops(diameter, &water, &air);
        sp_vec3 start = sp_v(20 * cos(angle), 0, 20 * sin(angle));
        sp_march march = sp_march_from(&drag, down, sp_v(0, 0, 0), start);
        drop at = {{0, 0, 0}, start};
        for (int k = 0; k < 60; k++) {
            sp_leg leg = sp_march_on(&march, 1e-7);
            if (isinf(leg.time))
                break;
            sp_drag_state half = sp_leg_at(&leg, leg.time / 2);
            at = fly(diameter, at, down, leg.time / 2, 20);
            place = fmax(place, sp_distance(half.point, at.place) / sp_length(at.place));
            velocity = fmax(velocity, sp_distance(half.velocity, at.velocity) / sp_length(at.velocity));
            at = fly(diameter, at, down, leg.time / 2, 20);
        }
    }
    print_message("legs off by %.2g, speeds by %.2g\n", place, velocity);
    assert_true(place < 1e-5 && velocity < 1e-5);
}

/* From a micrometre to a centimetre, from a microsecond to a quarter of an hour. */
static void speed_tends_to_the_terminal_from_either_side(void **state)
{
    (void)state;
    for (double diameter = 1e-6; diameter < 1.1e-2; diameter *= 10) {
        sp_drag drag = sp_drag_of_drops(diameter, &water, &air);
        double ends[2];
        for (int fast = 0; fast < 2; fast++) {
            sp_march march = sp_march_from(&drag, down, sp_v(0, 0, 0), sp_v(0, 0, fast ? -60 : 0));
            double before = fast ? 60 : 0, start = 0;
            sp_leg leg = {0};
            for (double t = 1e-6; t < 1.1e3; t *= 1.3) {
                while (start + leg.time < t) {
                    start += leg.time;
                    leg = sp_march_on(&march, 1e-7);
                }
                double speed = -sp_leg_at(&leg, t - start).velocity.z;
                assert_true(isfinite(speed) && isfinite(sp_leg_at(&leg, t - start).point.z));
                assert_true(fast ? speed <= before * (1 + 1e-6) : speed >= before * (1 - 1e-6));
                before = speed;
            }
            ends[fast] = before;
        }
        assert_true(fabs(ends[0] / ends[1] - 1) < 1e-6);
    }
}

static void assert_alike(const sp_flight *one, const sp_flight *other, double within)
{
    assert_true(sp_distance(one->direction, other->direction) <= within);
    assert_true(sp_distance(one->velocity, other->velocity) <= within * sp_length(other->velocity));
    assert_true(fabs(one->time / other->time - 1) <= within && fabs(one->spread / other->spread - 1) <= within);
    assert_true(fabs(one->lever / other->lever - 1) <= within);
}

/* Without air, and as drops grow, flights are the closed-form ones. */
static void parabolas_and_lines_are_the_limits(void **state)
{
    (void)state;
    const sp_fluid thin = {0, 18e-6, 0};
    const sp_vec3 from = sp_v(0.1, 0.2, 0.3), gravities[2] = {down, {0, 0, 0}};
    const sp_drag drags[2] = {sp_drag_of_drops(1e-3, &water, &thin), sp_drag_of_drops(1e12, &water, &air)};
    for (int k = 0; k < 4; k++) {
        sp_error error = {0};
        sp_wavefronts *fronts = sp_wavefronts_create(&drags[k / 2], 8, gravities[k % 2], 4, &error);
        assert_non_null(fronts);
        for (int i = 0; i < 200; i++) {
            double a = 2.1 * i, c = i % 10 ? cos(0.9 * i) : 1, s = sqrt(1 - c * c), r = 4 * pow(10, -i % 7);
            sp_vec3 to = sp_along(from, r, sp_v(s * cos(a), s * sin(a), c));
            sp_flight found[2], expected[2];
            int count = sp_flights(from, to, 8, gravities[k % 2], expected);
            assert_int_equal(sp_wavefronts_flights(fronts, from, to, found), count);
            for (int j = 0; j < count; j++)
                assert_alike(&found[j], &expected[j], 1e-8);
        }
        sp_wavefronts_destroy(fronts);
    }
}

/* The area across the flight per solid angle, from neighbouring flights, and what sp_flight says of it. */
static void transfer_is_the_jacobian(void **state)
{
    (void)state;
    const double diameter = 5e-4, speed = 12, h = 1e-4;
    sp_wavefronts *fronts = fronts_of(diameter, speed, down, 3);
    int compared = 0;
    for (int i = 0; i < 60; i++) {
        double a = 2.1 * i, r = 0.3 + 0.02 * i;
        sp_vec3 to = sp_v(r * cos(a), r * sin(a), 0.6 * sin(5. * i));
        sp_flight flights[2], beside[2][2];
        int count = sp_wavefronts_flights(fronts, sp_v(0, 0, 0), to, flights);
        for (int k = 0; k < count; k++) {
            sp_vec3 n = sp_unit(flights[k].velocity), x = sp_unit(sp_cross(n, sp_v(0.3, 0.5, -0.8)));
            sp_vec3 across[2] = {x, sp_cross(n, x)}, turn[2];
            for (int j = 0; j < 2; j++) {
                for (int m = 0; m < 2; m++)
                    assert_int_equal(sp_wavefronts_flights(fronts, sp_v(0, 0, 0),
                                                           sp_along(to, (m ? -h : h) * r, across[j]), beside[m]),
                                     count);
                turn[j] = sp_scale(sp_sub(beside[0][k].direction, beside[1][k].direction), 0.5 / (h * r));
            }
            double transfer = sp_length(flights[k].velocity) / flights[k].spread;
            double found = sp_length(sp_cross(turn[0], turn[1]));
            if (fabs(found / transfer - 1) > 2e-3)
                fail_msg("end %d, arc %d: %.6g 1/m², by differences %.6g", i, k, transfer, found);
            compared++;
        }
    }
    assert_true(compared > 60);
    sp_wavefronts_destroy(fronts);
}

/* What a flight changes by, against neighbouring flights, and these found from it. */
static void neighbours_follow_from_a_flight(void **state)
{
    (void)state;
    const double diameters[3] = {1e-4, 5e-4, 3e-3}, step = 1e-6;
    int compared = 0, found = 0;
    for (int d = 0; d < 3; d++) {
        sp_wavefronts *fronts = fronts_of(diameters[d], 12, down, 3);
        for (int i = 0; i < 100; i++) {
            double a = 2.1 * i, b = 1.3 * i, r = d ? 0.2 + 0.02 * i : 0.1 + 0.003 * i;
            sp_vec3 to = sp_v(r * cos(a), r * sin(a), 0.6 * r * sin(5. * i));
            sp_vec3 move = sp_v(r * cos(b), r * sin(b), r * cos(0.7 * i));
            sp_flight flights[2], beside[2][2], moved[2], near;
            int count = sp_wavefronts_flights(fronts, sp_v(0, 0, 0), to, flights);
            int there = sp_wavefronts_flights(fronts, sp_v(0, 0, 0), sp_along(to, 0.01, move), moved);
            for (int m = 0; m < 2; m++)
                assert_int_equal(
                    sp_wavefronts_flights(fronts, sp_v(0, 0, 0), sp_along(to, m ? -step : step, move), beside[m]),
                    count);
            for (int k = 0; k < count; k++) {
                const sp_flight *ahead = &beside[0][k], *behind = &beside[1][k];
                sp_flight_change change = sp_wavefronts_change(fronts, &flights[k], move);
                double by = 0.5 / step;
                sp_vec3 turn = sp_scale(sp_sub(ahead->direction, behind->direction), by);
                sp_vec3 velocity = sp_scale(sp_sub(ahead->velocity, behind->velocity), by);
                double spread = by * log(ahead->spread / behind->spread);
                double size = fmax(1, fabs(spread));
                if (sp_distance(turn, change.direction) > 1e-4 * size ||
                    sp_distance(velocity, change.velocity) > 1e-3 * size ||
                    fabs(spread - change.spread) > 1e-3 * size * size)
                    fail_msg("drops of %g m, end %d, arc %d: turns off by %g, velocity by %g, spread by %g of %g",
                             diameters[d], i, k, sp_distance(turn, change.direction),
                             sp_distance(velocity, change.velocity), spread - change.spread, spread);
                compared++;
                if (k >= there ||
                    !sp_wavefronts_flight_near(fronts, sp_v(0, 0, 0), sp_along(to, 0.01, move), &flights[k], &near))
                    continue;
                assert_alike(&near, &moved[k], 1e-6);
                found++;
            }
        }
        sp_wavefronts_destroy(fronts);
    }
    assert_true(compared > 300 && found > 0.8 * compared);
}

/* A stream of 5 L/min at 19.4 m/s is 2.34 mm thick and breaks up .4 m away; until then it falls freely. */
static void streams_fly_free_at_first(void **state)
{
    (void)state;
    const sp_nozzle_type stream = {.pattern = SP_PATTERN_SOLID_STREAM, .drop = 3e-3, .cv = 0.95};
    const sp_nozzle nozzle = {.type = &stream, .flow = 5 / 6e4, .speed = 19.4};
    sp_drag drag = sp_drag_of(&nozzle, &water, &air);
    double diameter = sqrt(4 * nozzle.flow / (M_PI * nozzle.speed)), way = drag.delay * nozzle.speed;
    double weber = water.density * 19.4 * 19.4 * diameter / water.surface_tension;
    assert_true(fabs(way / (5 * pow(weber, 0.378) * diameter) - 1) < 1e-12);
    assert_true(way > 0.39 && way < 0.42);
    sp_error error = {0};
    sp_wavefronts *fronts = sp_wavefronts_create(&drag, 19.4, down, 3, &error);
    sp_vec3 from = sp_v(0, 0, 0);
    for (int i = 1; i < 30; i++) {
        sp_vec3 to = sp_v(0.1 * i * 0.8, 0, 0.1 * i * 0.6);
        sp_flight flights[2], free[2];
        assert_int_equal(sp_wavefronts_flights(fronts, from, to, flights), 2);
        assert_int_equal(sp_flights(from, to, 19.4, down, free), 2);
        if (flights[0].time < drag.delay)
            assert_alike(&flights[0], &free[0], 1e-8);
        else
            assert_true(sp_length(flights[0].velocity) < sp_length(free[0].velocity));
    }
    sp_wavefronts_destroy(fronts);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(terminal_speeds_are_as_measured),
        cmocka_unit_test(flights_land),
        cmocka_unit_test(marches_keep_to_the_reference),
        cmocka_unit_test(speed_tends_to_the_terminal_from_either_side),
        cmocka_unit_test(parabolas_and_lines_are_the_limits),
        cmocka_unit_test(transfer_is_the_jacobian),
        cmocka_unit_test(neighbours_follow_from_a_flight),
        cmocka_unit_test(streams_fly_free_at_first),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
