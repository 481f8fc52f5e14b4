/* Where film goes at the end of a wall: over edges, on to other bodies, and down through the air. */
#include "rooms.h"

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
        assert_true(mean_film(&w, beneath) == 0); /* a flat floor is one pool, and what stands on it is not counted */
        assert_ends(&w, 0, 0, 1, 1e-12);
        walls_close(&w);
    }
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ceiling_drips_straight_down),
        cmocka_unit_test(ceilings_hold_above_ten_degrees),
        cmocka_unit_test(plate_drips_over_its_edges),
        cmocka_unit_test(drips_beside_what_is_beneath),
        cmocka_unit_test(sheets_run_on_either_side),
        cmocka_unit_test(funnel_leads_through_its_spout),
        cmocka_unit_test(film_goes_on_to_a_touching_body),
        cmocka_unit_test(film_goes_from_a_shelf_to_the_wall),
        cmocka_unit_test(level_shelf_leaves_where_nothing_stands),
        cmocka_unit_test(ring_round_a_shaft),
        cmocka_unit_test(keels_drip),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
