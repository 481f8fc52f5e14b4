/* Where liquid on the walls runs, pools, drips and ends. */
#include "walls.h"

#include "spray/rundown.h"

#define LAID 1e-4 /* m/s */

static const sp_vec3 X = {1, 0, 0}, Y = {0, 1, 0}, Z = {0, 0, 1};
static const region everywhere = {{-9, -9, -9}, {9, 9, 9}, {0, 0, 0}};

static sp_vec3 minus(sp_vec3 v)
{
    return sp_scale(v, -1);
}

/* A room of 2 × 2 × 2 m about the origin without a floor, its front inside. */
static shape room_without_floor(void)
{
    shape s = shape_create();
    shape_part(&s, "room");
    shape_sheet(&s, sp_v(-1, -1, 1), sp_v(0, 2, 0), sp_v(2, 0, 0), 1);
    shape_sheet(&s, sp_v(-1, -1, -1), sp_v(0, 2, 0), sp_v(0, 0, 2), 1);
    shape_sheet(&s, sp_v(-1, -1, -1), sp_v(0, 0, 2), sp_v(2, 0, 0), 1);
    shape_sheet(&s, sp_v(1, -1, -1), sp_v(0, 0, 2), sp_v(0, 2, 0), 1);
    shape_sheet(&s, sp_v(-1, 1, -1), sp_v(2, 0, 0), sp_v(0, 0, 2), 1);
    return s;
}

/* The room with a floor that falls by `slope` from all sides towards a hole of 0.4 × 0.4 m. */
static shape room_with_hole(double slope)
{
    shape s = room_without_floor();
    const double out[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (int i = 0; i < 4; i++) {
        const double *a = out[i], *b = out[(i + 1) % 4];
        double drop = -1 - 0.8 * slope;
        sp_vec3 p = sp_v(a[0], a[1], -1), q = sp_v(b[0], b[1], -1);
        sp_vec3 r = sp_v(0.2 * b[0], 0.2 * b[1], drop), t = sp_v(0.2 * a[0], 0.2 * a[1], drop);
        shape_triangle(&s, p, q, r);
        shape_triangle(&s, p, r, t);
    }
    return s;
}

/* A box turned about its own x axis by `roll` and then about y by `tilt`, front outwards, or only its top. */
static void turned_box(shape *s, sp_vec3 middle, sp_vec3 size, double roll, double tilt)
{
    sp_vec3 x = sp_v(cos(tilt), 0, -sin(tilt)), up = sp_v(sin(tilt), 0, cos(tilt));
    sp_vec3 y = sp_along(sp_scale(Y, cos(roll)), sin(roll), up), z = sp_along(sp_scale(up, cos(roll)), -sin(roll), Y);
    x = sp_scale(x, size.x);
    y = sp_scale(y, size.y);
    z = sp_scale(z, size.z);
    sp_vec3 low = sp_along(sp_along(sp_along(middle, -0.5, x), -0.5, y), -0.5, z);
    sp_vec3 high = sp_add(sp_add(sp_add(low, x), y), z);
    shape_sheet(s, low, y, x, 2);
    shape_sheet(s, low, z, y, 2);
    shape_sheet(s, low, x, z, 2);
    shape_sheet(s, high, minus(x), minus(y), 2);
    shape_sheet(s, high, minus(y), minus(z), 2);
    shape_sheet(s, high, minus(z), minus(x), 2);
}

/* A room with something of everything in it. */
static sp_mesh *crowded_room(void)
{
    shape s = room_with_hole(0.1);
    shape_part(&s, "things");
    turned_box(&s, sp_v(-0.5, -0.5, 0.3), sp_v(0.4, 0.3, 0.2), 0.5, 0.3);
    turned_box(&s, sp_v(0.5, -0.5, 0), sp_v(0.5, 0.5, 0.1), 0, 0);
    shape_sheet(&s, sp_v(-0.8, 0.2, 0.1), sp_v(0.6, 0, 0.2), sp_v(0, 0.5, -0.1), 3);
    const double pan[7][2] = {{0, 0.5}, {0.3, 0.5}, {0.3, 0.6}, {0.28, 0.6}, {0.28, 0.52}, {0, 0.52}, {0, 0.5}};
    shape_turned(&s, pan, 6, 16);
    const double ring[5][2] = {{0.2, -0.3}, {0.3, -0.4}, {0.2, -0.5}, {0.12, -0.4}, {0.2, -0.3}};
    shape_turned(&s, ring, 5, 16);
    return shape_mesh(&s);
}

static double random_share(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

static void everything_ends_somewhere(void **state)
{
    (void)state;
    walls w;
    walls_open(&w, crowded_room(), SP_CAVITY_POINT, sp_v(0, 0.9, 0.9), 0.06);
    walls_rain(&w, everywhere, LAID);
    walls_rain(&w, (region){sp_v(-9, -9, 0), sp_v(0, 9, 9), {0, 0, 0}}, LAID);
    for (size_t i = 0; i < w.cells->count; i += 97) {
        sp_error error = {0};
        memset(w.arriving, 0, w.cells->count * sizeof(double));
        w.arriving[i] = 1;
        assert_true(sp_film_run(w.film, w.arriving, w.per_width, &w.ends, &error));
        assert_true(fabs(w.ends.left + w.ends.astray + w.ends.held - 1) < 1e-12);
        assert_true(w.per_width[i] > 0);
    }
    walls_close(&w);
}

static void adjoint_is_the_transpose(void **state)
{
    (void)state;
    walls w;
    walls_open(&w, crowded_room(), SP_CAVITY_POINT, sp_v(0, 0.9, 0.9), 0.06);
    double *weight = malloc(w.cells->count * sizeof *weight), *worth = malloc(w.cells->count * sizeof *worth);
    uint64_t seed = 5;
    for (int turn = 0; turn < 5; turn++) {
        sp_error error = {0};
        double there = 0, back = 0;
        for (size_t i = 0; i < w.cells->count; i++) {
            w.arriving[i] = turn && random_share(&seed) < 0.9 ? 0 : random_share(&seed);
            weight[i] = turn && random_share(&seed) < 0.9 ? 0 : random_share(&seed);
        }
        assert_true(sp_film_run(w.film, w.arriving, w.per_width, NULL, &error));
        assert_true(sp_film_adjoint(w.film, weight, worth, &error));
        for (size_t i = 0; i < w.cells->count; i++) {
            there += weight[i] * w.per_width[i];
            back += worth[i] * w.arriving[i];
            assert_true(worth[i] >= 0);
        }
        assert_true(there > 0);
        if (!(fabs(there - back) <= 1e-12 * there))
            fail_msg("%.17g there, %.17g back", there, back);
    }
    free(weight);
    free(worth);
    walls_close(&w);
}

static void film_is_linear(void **state)
{
    (void)state;
    walls w;
    walls_open(&w, crowded_room(), SP_CAVITY_POINT, sp_v(0, 0.9, 0.9), 0.05);
    double *sum = calloc(w.cells->count, sizeof *sum);
    const region upper = {{-9, -9, 0.2}, {9, 9, 9}, {0, 0, 0}}, lower = {{-9, -9, -9}, {9, 9, 0.1}, {0, 0, 0}};
    for (int turn = 0; turn < 3; turn++) {
        sp_error error = {0};
        for (size_t i = 0; i < w.cells->count; i++)
            w.arriving[i] = (turn != 1 && region_holds(&upper, &w, i) ? 1.0 : 0.0) +
                            (turn != 0 && region_holds(&lower, &w, i) ? 3.0 : 0.0);
        assert_true(sp_film_run(w.film, w.arriving, w.per_width, NULL, &error));
        for (size_t i = 0; turn < 2 && i < w.cells->count; i++)
            sum[i] += w.per_width[i];
    }
    for (size_t i = 0; i < w.cells->count; i++)
        assert_true(fabs(sum[i] - w.per_width[i]) <= 1e-12 * sum[i]);
    free(sum);
    walls_close(&w);
}

static void same_for_any_threads(void **state)
{
    (void)state;
    double *first = NULL;
    for (int threads = 1; threads <= 3; threads += 2) {
        walls w;
        sp_setup setup = walls_setup(&w, crowded_room(), SP_CAVITY_POINT, sp_v(0, 0.9, 0.9), 0.07);
        setup.run.threads = threads;
        walls_start(&w, &setup);
        walls_rain(&w, everywhere, LAID);
        if (first) {
            assert_memory_equal(first, w.per_width, w.cells->count * sizeof *first);
        } else {
            first = w.per_width;
            w.per_width = NULL;
        }
        walls_close(&w);
    }
    free(first);
}

static void closed_box_holds_all(void **state)
{
    (void)state;
    for (int tilted = 0; tilted < 2; tilted++) {
        shape s = shape_create();
        shape_part(&s, "box");
        if (tilted)
            shape_sphere(&s, 1, true, 32);
        else
            shape_box(&s, sp_v(-1, -1, -1), sp_v(1, 1, 1), true);
        walls w;
        walls_open(&w, shape_mesh(&s), SP_CAVITY_POINT, sp_v(0.1, 0.2, 0.3), 0.1);
        walls_rain(&w, everywhere, LAID);
        assert_ends(&w, 0, 0, 1, 1e-12);
        walls_rain(&w, (region){sp_v(-9, -9, 0.5), sp_v(9, 9, 9), {0, 0, 0}}, LAID);
        assert_ends(&w, 0, 0, 1, 1e-12);
        walls_close(&w);
    }
}

static void hole_in_the_floor_drains_all(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        double slope = (const double[]){0, 0.02, 0.3}[i];
        shape s = room_with_hole(slope);
        walls w;
        walls_open(&w, shape_mesh(&s), SP_CAVITY_POINT, sp_v(0.1, 0.2, 0.3), 0.08);
        walls_rain(&w, (region){{-0.99, -0.99, -2}, {0.99, 0.99, 0.99}, {0, 0, 1}}, LAID);
        assert_ends(&w, 1, 0, 0, 1e-12);
        walls_rain(&w, (region){{-2, -2, -0.9}, {2, 2, 0.99}, {0, 0, 0}}, LAID);
        assert_ends(&w, 1, 0, 0, 1e-12);
        walls_close(&w);
    }
}

/* What drips off a ceiling over the hole falls through it. */
static void ceiling_drips_straight_down(void **state)
{
    (void)state;
    shape s = room_with_hole(0.1);
    walls w;
    walls_open(&w, shape_mesh(&s), SP_CAVITY_POINT, sp_v(0.1, 0.2, 0.3), 0.05);
    walls_rain(&w, (region){{-0.1, -0.1, 0.99}, {0.1, 0.1, 1.1}, {0, 0, -1}}, LAID);
    assert_ends(&w, 1, 0, 0, 1e-12);
    double walls_wet = wet_share(&w, (region){{-2, -2, -0.9}, {2, 2, 0.9}, {0, 0, 0}});
    double floor_wet = wet_share(&w, (region){{-2, -2, -2}, {2, 2, -0.9}, {0, 0, 1}});
    assert_true(walls_wet == 0 && floor_wet == 0);
    walls_rain(&w, (region){{0.5, 0.5, 0.99}, {0.6, 0.6, 1.1}, {0, 0, -1}}, LAID);
    assert_true(wet_share(&w, (region){{-2, -2, -0.95}, {2, 2, 0.9}, {0, 0, 0}}) == 0);
    assert_true(wet_share(&w, (region){{0.5, 0.5, -1.1}, {0.6, 0.6, -0.9}, {0, 0, 1}}) == 1);
    walls_close(&w);
}

/* A roof over the room: under one of 8° all drips where it arrives, under one of 12° it runs down to the wall. */
static void ceilings_hold_above_ten_degrees(void **state)
{
    (void)state;
    for (int steep = 0; steep < 2; steep++) {
        double fall = 2 * tan((steep ? 12 : 8) * M_PI / 180);
        shape s = shape_create();
        shape_part(&s, "roofed");
        shape_sheet(&s, sp_v(-1, -1, -1), sp_v(2, 0, 0), sp_v(0, 2, 0), 1);
        shape_sheet(&s, sp_v(-1, -1, 1), sp_v(0, 2, 0), sp_v(2, 0, -fall), 1);
        shape_sheet(&s, sp_v(-1, -1, -1), sp_v(0, 2, 0), sp_v(0, 0, 2), 1);
        shape_sheet(&s, sp_v(1, -1, -1), sp_v(0, 0, 2 - fall), sp_v(0, 2, 0), 1);
        for (int side = -1; side <= 1; side += 2) {
            sp_vec3 p = sp_v(-1, side, -1), q = sp_v(1, side, -1), r = sp_v(1, side, 1 - fall), t = sp_v(-1, side, 1);
            shape_triangle(&s, p, side < 0 ? r : q, side < 0 ? q : r);
            shape_triangle(&s, p, side < 0 ? t : r, side < 0 ? r : t);
        }
        walls w;
        walls_open(&w, shape_mesh(&s), SP_CAVITY_POINT, sp_v(0.1, 0.2, 0.1), 0.05);
        walls_rain(&w, (region){{-0.2, -0.2, 0.5}, {0.2, 0.2, 1}, {0, 0, -1}}, LAID);
        region low_wall = {{0.99, -0.3, -0.8}, {1.1, 0.3, 0.4}, {-1, 0, 0}};
        region beneath = {{-0.1, -0.1, -1.1}, {0.1, 0.1, -0.9}, {0, 0, 1}};
        assert_true((wet_share(&w, low_wall) > 0.3) == steep);
        assert_true((mean_film(&w, low_wall) > 0) == steep);
        assert_true(wet_share(&w, beneath) == 1); /* a flat floor is one pool */
        assert_ends(&w, 0, 0, 1, 1e-12);
        walls_close(&w);
    }
}

/* A pan hung in a room with a hole in its floor. */
static void pan_runs_over_its_rim(void **state)
{
    (void)state;
    shape s = room_with_hole(0.1);
    shape_part(&s, "pan");
    const double pan[7][2] = {{0, 0}, {0.3, 0}, {0.3, 0.07}, {0.26, 0.07}, {0.26, 0.02}, {0, 0.02}};
    shape_turned(&s, pan, 6, 48);
    walls w;
    walls_open(&w, shape_mesh(&s), SP_CAVITY_POINT, sp_v(0.1, 0.2, 0.8), 0.02);
    walls_rain(&w, (region){{-0.2, -0.2, 0}, {0.2, 0.2, 0.03}, {0, 0, 1}}, LAID);
    assert_ends(&w, 1, 0, 0, 1e-12);
    double around = w.all / (2 * M_PI * 0.3);
    assert_near("outside of the pan", mean_film(&w, (region){{-1, -1, 0.01}, {1, 1, 0.06}, {0, 0, 0}}) > 0, 1, 0);
    /* the pool's rim lies at 0.26 to 0.3 m */
    double inside = mean_film(&w, (region){{-0.2, -0.2, 0.01}, {0.2, 0.2, 0.03}, {0, 0, 1}});
    if (!(inside > 0.8 * around && inside < 1.3 * around))
        fail_msg("%g in the pan, %g over its rim", inside, around);
    size_t count;
    const sp_film_pool *pools = sp_film_pools(w.film, &count);
    bool found = false;
    for (size_t i = 0; i < count; i++)
        found = found || (pools[i].drains && pools[i].area > M_PI * 0.26 * 0.26 && pools[i].area < 0.4);
    assert_true(found);
    walls_close(&w);
}

/* A tank open at its top, deeper than a twentieth of all: it stands there till somebody opens its drain. */
static void deep_tank_holds(void **state)
{
    (void)state;
    shape s = room_with_hole(0.1);
    shape_part(&s, "tank");
    const double tank[7][2] = {{0, -0.4}, {0.3, -0.4}, {0.3, 0.1}, {0.28, 0.1}, {0.28, -0.38}, {0, -0.38}};
    shape_turned(&s, tank, 6, 32);
    walls w;
    walls_open(&w, shape_mesh(&s), SP_CAVITY_POINT, sp_v(0.1, 0.2, 0.8), 0.04);
    walls_rain(&w, (region){{-0.15, -0.15, -0.39}, {0.15, 0.15, -0.3}, {0, 0, 1}}, LAID);
    assert_ends(&w, 0, 0, 1, 1e-12);
    assert_true(wet_share(&w, (region){{-1, -1, -0.35}, {1, 1, 0.2}, {0, 0, 0}}) == 0);
    walls_rain(&w, (region){{-0.15, -0.15, 0.9}, {0.15, 0.15, 1.1}, {0, 0, -1}}, LAID);
    assert_ends(&w, 0, 0, 1, 1e-12);
    walls_rain(&w, (region){{-0.9, -0.9, 0.9}, {-0.5, 0.9, 1.1}, {0, 0, -1}}, LAID);
    assert_ends(&w, 1, 0, 0, 1e-12);
    walls_close(&w);
}

/* A level plate: what lies on it runs over its four edges, and of a solid one down its sides. */
static void plate_drips_over_its_edges(void **state)
{
    (void)state;
    for (int sheet = 0; sheet < 2; sheet++) {
        shape s = shape_create();
        shape_part(&s, "plate");
        if (sheet)
            shape_sheet(&s, sp_v(-0.4, -0.3, 0), sp_v(0.8, 0, 0), sp_v(0, 0.6, 0), 1);
        else
            shape_box(&s, sp_v(-0.4, -0.3, -0.1), sp_v(0.4, 0.3, 0), false);
        walls w;
        walls_open(&w, shape_mesh(&s), SP_CAVITY_OUTSIDE, sp_v(0, 0, 0), 0.05);
        walls_rain(&w, (region){{-0.2, -0.2, -0.01}, {0.1, 0.2, 0.01}, {0, 0, 1}}, LAID);
        region top = {{-0.4, -0.3, -0.01}, {0.4, 0.3, 0.01}, {0, 0, 1}};
        assert_near("on the plate", mean_film(&w, top), w.all / 2.8, 1e-9);
        if (sheet)
            assert_true(wet_share(&w, (region){{-0.4, -0.3, -0.01}, {0.4, 0.3, 0.01}, {0, 0, -1}}) == 0);
        else
            for (int i = 0; i < 4; i++) {
                sp_vec3 n = (const sp_vec3[]){{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}}[i];
                assert_near("on a side", mean_film(&w, (region){{-0.5, -0.5, -0.09}, {0.5, 0.5, -0.01}, n}),
                            w.all / 2.8, 0.02);
            }
        assert_ends(&w, 1, 0, 0, 1e-12);
        walls_close(&w);
    }
}

/* Where the floor has a hole right under the plate, what runs over the plate's edges misses it. */
static void drips_beside_what_is_beneath(void **state)
{
    (void)state;
    shape s = room_with_hole(-0.1); /* away from the hole: to the walls */
    shape_part(&s, "plate");
    shape_sheet(&s, sp_v(-0.4, -0.4, 0), sp_v(0.8, 0, 0), sp_v(0, 0.8, 0), 1);
    walls w;
    walls_open(&w, shape_mesh(&s), SP_CAVITY_POINT, sp_v(0.1, 0.2, 0.5), 0.05);
    walls_rain(&w, (region){{-0.2, -0.2, -0.01}, {0.1, 0.2, 0.01}, {0, 0, 1}}, LAID);
    assert_true(wet_share(&w, (region){{-0.3, -0.3, -2}, {0.3, 0.3, -0.1}, {0, 0, 1}}) == 0);
    assert_true(wet_share(&w, (region){{-0.9, -0.9, -2}, {0.9, 0.9, -0.1}, {0, 0, 1}}) > 0.3);
    walls_close(&w);
}

/* Either side of a vertical sheet has its own film. */
static void sheets_run_on_either_side(void **state)
{
    (void)state;
    shape s = shape_create();
    shape_part(&s, "sheet");
    shape_sheet(&s, sp_v(-0.5, 0, -0.5), X, Z, 2);
    walls w;
    walls_open(&w, shape_mesh(&s), SP_CAVITY_OUTSIDE, sp_v(0, 0, 0), 0.05);
    region front = {{-0.5, -0.01, -0.5}, {0.5, 0.01, 0.5}, minus(Y)}, back = front, lower = front;
    back.normal = Y;
    lower.high.z = -0.05;
    region upper = front;
    upper.low.z = 0.25;
    walls_rain(&w, upper, LAID);
    assert_true(wet_share(&w, front) > 0.99 && wet_share(&w, back) == 0);
    assert_near("below", mean_film(&w, lower), LAID * 0.25, 0.06);
    upper.normal = Y;
    walls_rain(&w, upper, LAID);
    assert_true(wet_share(&w, front) == 0 && wet_share(&w, back) > 0.99);
    walls_close(&w);
}

/* A funnel hung in a room with a hole beneath it: all runs down its inside, round the edge or through, and leaves. */
static void funnel_leads_through_its_spout(void **state)
{
    (void)state;
    shape s = room_with_hole(-0.1);
    shape_part(&s, "funnel");
    const double funnel[3][2] = {{0.05, -0.2}, {0.05, 0}, {0.6, 0.4}};
    shape_turned(&s, funnel, 3, 48);
    walls w;
    walls_open(&w, shape_mesh(&s), SP_CAVITY_POINT, sp_v(0.1, 0.2, 0.8), 0.03);
    walls_rain(&w, (region){{-0.4, -0.4, 0.9}, {0.4, 0.3, 1.1}, {0, 0, -1}}, LAID);
    region spout = {{-0.06, -0.06, -0.15}, {0.06, 0.06, -0.05}, {0, 0, 0}};
    assert_near("in the spout", mean_film(&w, spout), 0.5 * w.all / (2 * M_PI * 0.05), 0.05); /* dry outside */
    assert_ends(&w, 1, 0, 0, 1e-12);
    walls_close(&w);
}

/* A box that stands on a sloping floor, or through which that goes, and shares no edges with it. */
static void film_goes_on_to_a_touching_body(void **state)
{
    (void)state;
    for (int pierced = 0; pierced < 2; pierced++) {
        shape s = room_with_hole(0.3);
        shape_part(&s, "box");
        double bottom = pierced ? -1.5 : -1.12; /* the floor is at -1.12 and lower under it */
        shape_box(&s, sp_v(0.6, -0.1, bottom), sp_v(0.8, 0.1, -0.6), false);
        walls w;
        walls_open(&w, shape_mesh(&s), SP_CAVITY_POINT, sp_v(0.1, 0.2, 0.8), 0.045);
        walls_rain(&w, (region){{0.6, -0.1, -0.61}, {0.8, 0.1, -0.59}, Z}, LAID);
        assert_true(wet_share(&w, (region){{0.25, -0.1, -2}, {0.55, 0.1, -1}, Z}) > 0.8);
        assert_ends(&w, 1, 0, 0, 1e-12);
        walls_rain(&w, (region){{0.85, -0.05, -1.1}, {0.98, 0.05, -1}, Z}, LAID); /* above the box */
        assert_ends(&w, 1, 0, 0, 1e-12);
        walls_close(&w);
    }
}

/* A sloping shelf that ends at a wall without sharing an edge with it. */
static void film_goes_from_a_shelf_to_the_wall(void **state)
{
    (void)state;
    shape s = room_with_hole(0.1);
    shape_part(&s, "shelf");
    shape_sheet(&s, sp_v(0.5, -0.3, 0.2), sp_v(0.5, 0, -0.2), sp_v(0, 0.6, 0), 2);
    walls w;
    walls_open(&w, shape_mesh(&s), SP_CAVITY_POINT, sp_v(0.1, 0.2, 0.8), 0.04);
    walls_rain(&w, (region){{0.5, -0.2, 0}, {0.8, 0.2, 0.3}, Z}, LAID);
    region beneath = {{0.99, -1, -0.9}, {1.1, 1, -0.1}, minus(X)};
    assert_near("on the wall", 2 * mean_film(&w, beneath), w.all, 0.1);
    assert_ends(&w, 1, 0, 0, 1e-12);
    walls_close(&w);
}

/* A level shelf between walls that it touches, sharing no edges: liquid leaves over its one free edge alone. With a gap
 * behind it, also there. */
static void level_shelf_leaves_where_nothing_stands(void **state)
{
    (void)state;
    for (int gap = 0; gap < 2; gap++) {
        shape s = room_with_hole(0.1);
        shape_part(&s, "shelf");
        shape_sheet(&s, sp_v(0.5, -1, 0.2), sp_v(gap ? 0.44 : 0.5, 0, 0), sp_v(0, 2, 0), 3);
        walls w;
        walls_open(&w, shape_mesh(&s), SP_CAVITY_POINT, sp_v(0.1, 0.2, 0.8), 0.04);
        region shelf = {{0.5, -1, 0.19}, {1, 1, 0.21}, Z};
        walls_rain(&w, shelf, LAID);
        /* the cells in the corners may count as standing before the wall */
        assert_near("on the shelf", mean_film(&w, shelf), w.all / (gap ? 4 : 2), 0.05);
        double behind = wet_share(&w, (region){{0.9, -0.9, -1.2}, {1, 0.9, -0.9}, Z});
        assert_true(gap ? behind > 0.3 : behind == 0);
        assert_ends(&w, 1, 0, 0, 1e-12);
        walls_close(&w);
    }
}

/* A shaft with a ring on it that shares no edges with it: the film of the shaft goes on to the ring, over its edge and
 * down. */
static void ring_round_a_shaft(void **state)
{
    (void)state;
    for (int sloping = 0; sloping < 2; sloping++) {
        shape s = shape_create();
        shape_part(&s, "shaft");
        const double shaft[4][2] = {{0, -0.8}, {0.1, -0.8}, {0.1, 0.8}, {0, 0.8}};
        shape_turned(&s, shaft, 4, 24);
        shape_part(&s, "ring");
        double inner = sloping ? 0.1 : 0;
        const double ring[5][2] = {{0.08, -0.1}, {0.3, -0.1}, {0.3, 0}, {0.08, inner}, {0.08, -0.1}};
        shape_turned(&s, ring, 5, 24);
        walls w;
        walls_open(&w, shape_mesh(&s), SP_CAVITY_OUTSIDE, sp_v(0, 0, 0), 0.03);
        walls_rain(&w, (region){{-0.2, -0.2, 0.3}, {0.2, 0.2, 0.7}, {0, 0, 0}}, LAID);
        region rim = {{-0.31, -0.31, -0.08}, {0.31, 0.31, -0.02}, {0, 0, 0}};
        assert_near("on the ring's rim", mean_film(&w, rim), w.all / (2 * M_PI * 0.3), 0.1);
        assert_true(wet_share(&w, (region){{-0.11, -0.11, -0.7}, {0.11, 0.11, -0.15}, {0, 0, 0}}) == 0);
        assert_ends(&w, 1, 0, 0, 1e-12);
        walls_close(&w);
    }
}

/* What hangs in the air and ends in an edge or a corner below: liquid drips off there, it does not stay. */
static void keels_drip(void **state)
{
    (void)state;
    for (int kind = 0; kind < 6; kind++) {
        shape s = shape_create();
        shape_part(&s, "keel");
        const double pipe[5][2] = {{0, -0.5}, {0.2, 0}, {0, 0.2}};
        if (kind == 0) /* on an edge */
            turned_box(&s, sp_v(0, 0, 0), sp_v(0.6, 0.3, 0.3), M_PI / 4, 0);
        else if (kind == 1) /* on an edge that slopes a little */
            turned_box(&s, sp_v(0, 0, 0), sp_v(0.6, 0.3, 0.3), M_PI / 4, 0.02);
        else if (kind == 2) /* on a corner */
            turned_box(&s, sp_v(0, 0, 0), sp_v(0.4, 0.4, 0.4), M_PI / 4, 0.6);
        else if (kind == 3) /* on a tip */
            shape_turned(&s, pipe, 3, 7);
        else if (kind == 4) /* so thin that texels go round its lower edge */
            shape_box(&s, sp_v(-0.3, -0.003, -0.2), sp_v(0.3, 0.003, 0.1), false);
        else /* a level strip narrower than a texel */
            shape_sheet(&s, sp_v(-0.3, -0.01, 0), sp_v(0.6, 0, 0), sp_v(0, 0.02, 0), 1);
        walls w;
        walls_open(&w, shape_mesh(&s), SP_CAVITY_OUTSIDE, sp_v(0, 0, 0), 0.06);
        walls_rain(&w, (region){{-0.4, -0.4, -0.7}, {0.4, 0.4, 0.7}, {0, 0, 0}}, LAID);
        assert_ends(&w, 1, 0, 0, 1e-12);
        walls_close(&w);
    }
}

/* A ball of which some triangles, or all, face inwards: whichever way each of them faces, film runs on its outside from
 * one to the next. */
static void triangles_may_face_either_way(void **state)
{
    (void)state;
    for (int turned = 0; turned < 3; turned++) { /* none, about half, all */
        uint64_t seed = 3;
        shape s = shape_create();
        shape_part(&s, "ball");
        shape_sphere(&s, 0.5, false, 24);
        for (size_t i = 0; i < s.triangle_count; i++)
            if (turned == 2 || (turned == 1 && random_share(&seed) < 0.5)) {
                uint32_t second = s.triangles[i][1];
                s.triangles[i][1] = s.triangles[i][2];
                s.triangles[i][2] = second;
            }
        walls w;
        walls_open(&w, shape_mesh(&s), SP_CAVITY_OUTSIDE, sp_v(0, 0, 0), 0.03);
        walls_rain(&w, (region){{-1, -1, 0}, {1, 1, 1}, {0, 0, 0}}, LAID);
        double around = w.all / (2 * M_PI * 0.5);
        assert_near("below the middle", mean_film(&w, (region){{-1, -1, -0.15}, {1, 1, -0.03}, {0, 0, 0}}), around,
                    0.05);
        assert_ends(&w, 1, 0, 0, 1e-12);
        walls_close(&w);
    }
}

/* Liquid that is thrown on a shelf that need not be clean runs on to the wall, which is to be, and counts there. */
static void film_crosses_what_is_not_cleaned(void **state)
{
    (void)state;
    sp_error error = {0};
    shape s = room_with_hole(0.1);
    shape_part(&s, "shelf");
    shape_sheet(&s, sp_v(0.5, -0.3, 0.2), sp_v(0.5, 0, -0.2), sp_v(0, 0.6, 0), 2);
    walls w;
    sp_setup setup = walls_setup(&w, shape_mesh(&s), SP_CAVITY_POINT, sp_v(0.1, 0.2, 0.8), 0.08);
    w.surfaces[1].clean = false;
    setup.criterion = (sp_criterion){.flux = 1e9, .incidence = M_PI / 2, .film = 1e-5};
    w.evaluator = sp_evaluator_create(&setup, &error);
    assert_string_equal(error.message, "");
    w.cells = &w.evaluator->patches;
    const sp_rundown *rundown = w.evaluator->rundown;
    assert_true(rundown->walls->patches.count > w.cells->count);
    const sp_nozzle_type cone = {
        .pattern = SP_PATTERN_FULL_CONE, .angle = 0.5, .flow = 1e-4, .at = 2e5, .exponent = 0.5, .cv = 0.95};
    sp_nozzle nozzle = {.type = &cone, .position = sp_v(0.75, 0, 0.5), .axis = sp_v(0, 0, -1), .pressure = 2e5};
    sp_layout *layout = sp_layout_create(&nozzle, 1, &error);
    sp_coverage *coverage = sp_evaluate_inverse(w.evaluator, layout, &error);
    assert_string_equal(error.message, "");
    assert_near("arriving", coverage->film.arriving, 1e-4, 0.1);
    assert_near("leaving", coverage->film.left, coverage->film.arriving, 1e-12);
    assert_true(coverage->film.area > 0);
    assert_near("covered", coverage->covered_area, coverage->film.area, 1e-12);
    double wall = 0, area = 0;
    for (size_t i = 0; i < w.cells->count; i++) {
        const region beneath = {{0.99, -1, -0.9}, {1.1, 1, -0.1}, minus(X)};
        wall += region_holds(&beneath, &w, i) ? coverage->deposits.film[i] * w.cells->area[i] : 0;
        area += region_holds(&beneath, &w, i) ? w.cells->area[i] : 0;
        assert_int_equal(coverage->deposits.covered[i], coverage->deposits.film[i] >= 1e-5);
    }
    assert_near("on the wall", 2 * wall / area, coverage->film.arriving, 0.15);
    sp_coverage_destroy(coverage);
    sp_layout_destroy(layout);
    walls_close(&w);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everything_ends_somewhere),
        cmocka_unit_test(adjoint_is_the_transpose),
        cmocka_unit_test(film_is_linear),
        cmocka_unit_test(same_for_any_threads),
        cmocka_unit_test(closed_box_holds_all),
        cmocka_unit_test(hole_in_the_floor_drains_all),
        cmocka_unit_test(ceiling_drips_straight_down),
        cmocka_unit_test(ceilings_hold_above_ten_degrees),
        cmocka_unit_test(pan_runs_over_its_rim),
        cmocka_unit_test(deep_tank_holds),
        cmocka_unit_test(plate_drips_over_its_edges),
        cmocka_unit_test(drips_beside_what_is_beneath),
        cmocka_unit_test(sheets_run_on_either_side),
        cmocka_unit_test(funnel_leads_through_its_spout),
        cmocka_unit_test(film_goes_on_to_a_touching_body),
        cmocka_unit_test(film_goes_from_a_shelf_to_the_wall),
        cmocka_unit_test(level_shelf_leaves_where_nothing_stands),
        cmocka_unit_test(ring_round_a_shaft),
        cmocka_unit_test(keels_drip),
        cmocka_unit_test(triangles_may_face_either_way),
        cmocka_unit_test(film_crosses_what_is_not_cleaned),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
