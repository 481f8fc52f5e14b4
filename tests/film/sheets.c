/* Sheets, wet on both sides: what stands behind their edges runs over to the other side. */
#include "rooms.h"

#ifdef SPRAYPLAN_SANITIZE
#define TEXEL_STEP 0.0125
#define ROOMS 2
#else
#define TEXEL_STEP 0.005
#define ROOMS 6
#endif

/* An open tray of sheet metal, .8 × .8 m, turned about y by `tilt`. */
static shape tray_in_room(double depth, double tilt)
{
    shape s = room_with_hole(0.1);
    sp_vec3 x = sp_v(0.8 * cos(tilt), 0, -0.8 * sin(tilt)), y = sp_v(0, 0.8, 0);
    sp_vec3 up = sp_v(depth * sin(tilt), 0, depth * cos(tilt)), corner = sp_v(-0.4, -0.4, -0.1);
    shape_part(&s, "tray");
    shape_sheet(&s, corner, x, y, 1);
    shape_sheet(&s, corner, x, up, 1);
    shape_sheet(&s, corner, y, up, 1);
    shape_sheet(&s, sp_add(corner, x), y, up, 1);
    shape_sheet(&s, sp_add(corner, y), x, up, 1);
    return s;
}

/* Liquid fills it and runs over the edges of the sheet: a level tray's on all sides alike, a tilted one's on the lowest
 * alone, and down the outside. */
static void a_tray_runs_over_its_edges(void **state)
{
    (void)state;
    static const sp_vec3 sides[4] = {{1, 0, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 1, 0}};
    for (double texel = 0.02; texel < 0.046; texel += TEXEL_STEP)
        for (int tilted = 0; tilted < 2; tilted++) {
            shape s = tray_in_room(0.08, 0.03 * tilted);
            walls w;
            walls_open(&w, shape_mesh(&s), SP_CAVITY_POINT, sp_v(0.1, 0.2, 0.8), texel);
            walls_rain(&w, (region){{-0.2, -0.2, -0.2}, {0.2, 0.2, 0}, {0, 0, 1}}, LAID);
            assert_ends(&w, 1, 0, 0, 1e-12);
            for (int i = 0; i < 4; i++) {
                region outside = {{-0.42, -0.42, -0.13}, {0.42, 0.42, -0.04}, sides[i]};
                /* without the inside of the wall across */
                outside.low = sp_v(sides[i].x > 0 ? 0.3 : -0.42, sides[i].y > 0 ? 0.3 : -0.42, -0.13);
                outside.high = sp_v(sides[i].x < 0 ? -0.3 : 0.42, sides[i].y < 0 ? -0.3 : 0.42, -0.04);
                if (!tilted)
                    assert_near("outside", mean_film(&w, outside), w.all / 3.2, 0.02);
                else if (i == 0)
                    assert_near("at the lowest edge", mean_film(&w, outside), w.all / 0.8, 0.1);
                else /* but for the cells of the lowest corners */
                    assert_true(mean_film(&w, outside) <= (i == 1 ? 0 : 0.06 * w.all / 0.8));
            }
            walls_close(&w);
        }
}

/* One that is deeper than a twentieth of all is a vessel without its drain. */
static void a_deep_tray_holds(void **state)
{
    (void)state;
    shape s = tray_in_room(0.15, 0);
    walls w;
    walls_open(&w, shape_mesh(&s), SP_CAVITY_POINT, sp_v(0.1, 0.2, 0.8), 0.03);
    walls_rain(&w, (region){{-0.2, -0.2, -0.2}, {0.2, 0.2, 0}, {0, 0, 1}}, LAID);
    assert_ends(&w, 0, 0, 1, 1e-12);
    walls_close(&w);
}

/* Two sheets that lean against each other, level along their valley: liquid leaves by both ends, to where it runs down
 * their undersides. Not alike, as at each end cells of one sheet or of both hold what stands in the valley. */
static void a_gutter_runs_out_at_its_ends(void **state)
{
    (void)state;
    for (double texel = 0.02; texel < 0.046; texel += TEXEL_STEP) {
        shape s = room_with_hole(0.1);
        shape_part(&s, "gutter");
        shape_sheet(&s, sp_v(0, -0.5, 0), sp_v(0.1, 0, 0.1), sp_v(0, 1, 0), 1);
        shape_sheet(&s, sp_v(0, -0.5, 0), sp_v(-0.1, 0, 0.1), sp_v(0, 1, 0), 1);
        walls w;
        walls_open(&w, shape_mesh(&s), SP_CAVITY_POINT, sp_v(0.1, 0.2, 0.8), texel);
        walls_rain(&w, (region){{-0.05, -0.1, 0}, {0.05, 0.1, 0.1}, {0, 0, 1}}, LAID);
        assert_ends(&w, 1, 0, 0, 1e-12);
        assert_true(mean_film(&w, (region){{-0.1, -0.4, 0.06}, {0.1, 0.4, 0.1}, {0, 0, -1}}) == 0);
        double ends[2];
        for (int k = 0; k < 2; k++)
            ends[k] = mean_film(&w, (region){{-0.1, k ? 0.45 : -0.5, 0}, {0.1, k ? 0.5 : -0.45, 0.05}, {0, 0, -1}});
        assert_true(fmin(ends[0], ends[1]) > 0.2 * (ends[0] + ends[1]));
        walls_close(&w);
    }
}

static sp_vec3 random_vector(uint64_t *state, double reach)
{
    double x = random_share(state), y = random_share(state), z = random_share(state);
    return sp_v(reach * (2 * x - 1), reach * (2 * y - 1), reach * (2 * z - 1));
}

/* However sheets hang in a room and cut through each other, all that arrives ends somewhere. */
static void sheets_at_random_lose_nothing(void **state)
{
    (void)state;
    uint64_t seed = 5;
    for (int room = 0; room < ROOMS; room++) {
        shape s = room_with_hole(0.1);
        shape_part(&s, "sheets");
        for (int i = 0; i < 20; i++) {
            sp_vec3 corner = random_vector(&seed, 0.7), x = random_vector(&seed, 0.4), y = random_vector(&seed, 0.4);
            if (i % 4 == 0) /* upright, with level edges */
                x.z = y.x = y.y = 0;
            shape_sheet(&s, corner, x, y, 1 + i % 3);
            if (i % 3 == 0) /* folded */
                shape_sheet(&s, corner, x, random_vector(&seed, 0.3), 1 + i % 3);
        }
        walls w;
        walls_open(&w, shape_mesh(&s), SP_CAVITY_POINT, sp_v(0, 0.9, 0.9), 0.04);
        walls_rain(&w, everywhere, LAID);
        walls_rain(&w, (region){{-0.9, -0.9, -0.9}, {0.9, 0.9, 0.9}, {0, 0, 1}}, LAID);
        walls_close(&w);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tray_runs_over_its_edges),
        cmocka_unit_test(a_deep_tray_holds),
        cmocka_unit_test(a_gutter_runs_out_at_its_ends),
        cmocka_unit_test(sheets_at_random_lose_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
