/* What arrives ends somewhere, whatever the room: as a linear map and its transpose, in pools, and through an
 * evaluator. */
#include "rooms.h"

#include "spray/falling_film.h"

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

static int crowd(void **state)
{
    walls *w = malloc(sizeof *w);
    assert_non_null(w);
    walls_open(w, crowded_room(), SP_CAVITY_POINT, sp_v(0, 0.9, 0.9), 0.05);
    *state = w;
    return 0;
}

static int leave(void **state)
{
    walls_close(*state);
    free(*state);
    return 0;
}

static void everything_ends_somewhere(void **state)
{
    walls *w = *state;
    walls_rain(w, everywhere, LAID);
    walls_rain(w, (region){sp_v(-9, -9, 0), sp_v(0, 9, 9), {0, 0, 0}}, LAID);
    for (size_t i = 0; i < w->cells->count; i += 97) {
        sp_error error = {0};
        memset(w->arriving, 0, w->cells->count * sizeof(double));
        w->arriving[i] = 1;
        assert_true(sp_film_run(w->film, w->arriving, w->per_width, &w->ends, &error));
        assert_true(fabs(w->ends.left + w->ends.astray + w->ends.held - 1) < 1e-12);
        assert_true(w->per_width[i] > 0);
    }
}

static void adjoint_is_the_transpose(void **state)
{
    walls *w = *state;
    double *weight = malloc(w->cells->count * sizeof *weight), *worth = malloc(w->cells->count * sizeof *worth);
    uint64_t seed = 5;
    for (int turn = 0; turn < 5; turn++) {
        sp_error error = {0};
        double there = 0, back = 0;
        for (size_t i = 0; i < w->cells->count; i++) {
            w->arriving[i] = turn && random_share(&seed) < 0.9 ? 0 : random_share(&seed);
            weight[i] = turn && random_share(&seed) < 0.9 ? 0 : random_share(&seed);
        }
        assert_true(sp_film_run(w->film, w->arriving, w->per_width, NULL, &error));
        assert_true(sp_film_adjoint(w->film, weight, worth, &error));
        for (size_t i = 0; i < w->cells->count; i++) {
            there += weight[i] * w->per_width[i];
            back += worth[i] * w->arriving[i];
            assert_true(worth[i] >= 0);
        }
        assert_true(there > 0);
        if (!(fabs(there - back) <= 1e-12 * there))
            fail_msg("%.17g there, %.17g back", there, back);
    }
    free(weight);
    free(worth);
}

static void film_is_linear(void **state)
{
    walls *w = *state;
    double *sum = calloc(w->cells->count, sizeof *sum);
    const region upper = {{-9, -9, 0.2}, {9, 9, 9}, {0, 0, 0}}, lower = {{-9, -9, -9}, {9, 9, 0.1}, {0, 0, 0}};
    for (int turn = 0; turn < 3; turn++) {
        sp_error error = {0};
        for (size_t i = 0; i < w->cells->count; i++)
            w->arriving[i] = (turn != 1 && region_holds(&upper, w, i) ? 1.0 : 0.0) +
                             (turn != 0 && region_holds(&lower, w, i) ? 3.0 : 0.0);
        assert_true(sp_film_run(w->film, w->arriving, w->per_width, NULL, &error));
        for (size_t i = 0; turn < 2 && i < w->cells->count; i++)
            sum[i] += w->per_width[i];
    }
    for (size_t i = 0; i < w->cells->count; i++)
        assert_true(fabs(sum[i] - w->per_width[i]) <= 1e-12 * sum[i]);
    free(sum);
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
    for (int i = 0; i < 2; i++) {
        double slope = (const double[]){0, 0.02}[i];
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

static double most_film(const walls *w, region within)
{
    double most = 0;
    for (size_t i = 0; i < w->cells->count; i++)
        if (region_holds(&within, w, i))
            most = fmax(most, w->per_width[i]);
    return most;
}

/* A cube hung in the room, its top level, on which liquid falls in the middle: by all four sides runs a quarter of it,
 * evenly down to the level underside, however texels lie about the edges. */
static void a_level_top_runs_over_on_all_sides(void **state)
{
    (void)state;
    static const sp_vec3 sides[4] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}};
    for (double texel = 0.02; texel < 0.046; texel += 0.005) {
        shape s = room_with_hole(0.1);
        shape_part(&s, "cube");
        /* low + (high - low) is high: its sides share their vertices */
        shape_box(&s, sp_v(-0.4, -0.4, -0.1), sp_v(0.4, 0.4, -0.1 + 0.4), false);
        walls w;
        walls_open(&w, shape_mesh(&s), SP_CAVITY_POINT, sp_v(0.1, 0.2, 0.8), texel);
        walls_rain(&w, (region){{-0.2, -0.2, 0.25}, {0.2, 0.2, 0.35}, {0, 0, 1}}, LAID);
        assert_ends(&w, 1, 0, 0, 1e-12);
        for (int i = 0; i < 4; i++) {
            double aside = 0.32, even = w.all / 3.2;
            region side = {{-0.41, -0.41, 0}, {0.41, 0.41, 0.2}, sides[i]}, low = side;
            assert_near("a side", mean_film(&w, side), even, 0.08);
            /* to its lower edge, away from the others */
            low.low = sp_v(fabs(sides[i].x) > 0 ? -0.41 : -aside, fabs(sides[i].y) > 0 ? -0.41 : -aside, -0.11);
            low.high = sp_v(fabs(sides[i].x) > 0 ? 0.41 : aside, fabs(sides[i].y) > 0 ? 0.41 : aside, 0);
            assert_true(most_film(&w, low) < 1.2 * even);
        }
        walls_close(&w);
    }
}

/* A box, corner by corner: bit 0 of a corner's number is x, bit 1 y, bit 2 z. */
static void corner_box(shape *s, sp_vec3 low, sp_vec3 high, const uint8_t (*triangles)[3])
{
    sp_vec3 corner[8];
    for (int i = 0; i < 8; i++)
        corner[i] = sp_v(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    for (int i = 0; i < 12; i++)
        shape_triangle(s, corner[triangles[i][0]], corner[triangles[i][1]], corner[triangles[i][2]]);
}

/* About the edges of a level underside some cells go round the edge: where these are level with each other but for
 * round-off, none of them sends its liquid along to the next. */
static void film_drips_off_a_level_underside_where_it_comes(void **state)
{
    (void)state;
    static const uint8_t inwards[12][3] = {{3, 2, 0}, {1, 3, 0}, {7, 5, 4}, {6, 7, 4}, {5, 1, 0}, {4, 5, 0},
                                           {7, 6, 2}, {3, 7, 2}, {6, 4, 0}, {2, 6, 0}, {7, 3, 1}, {5, 7, 1}};
    static const uint8_t outwards[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                            {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    shape s = shape_create();
    shape_part(&s, "room");
    corner_box(&s, sp_v(0, 0, 0), sp_v(1, 1, 1), inwards);
    shape_part(&s, "ledge");
    corner_box(&s, sp_v(0.7, 0.3, 0.3), sp_v(1.2, 0.7, 0.5), outwards);
    walls w;
    sp_error error = {0};
    sp_setup setup = walls_setup(&w, shape_mesh(&s), SP_CAVITY_POINT, sp_v(0.2, 0.5, 0.5), 0.01);
    setup.criterion.film = 3e-3 / 60;
    sp_evaluator *evaluator = sp_evaluator_create(&setup, &error);
    assert_string_equal(error.message, "");
    const sp_nozzle_type cone = {.pattern = SP_PATTERN_FULL_CONE,
                                 .angle = M_PI / 3,
                                 .flow = 4.757e-3 / 60,
                                 .at = 5e4,
                                 .exponent = 0.46,
                                 .cv = 1};
    sp_layout layout = {.count = 1,
                        .nozzles = (sp_nozzle[]){
                            {.type = &cone, .position = sp_v(0.3, 0.5, 0.8), .axis = sp_v(1, 0, 0), .pressure = 5e4}}};
    sp_coverage *coverage = sp_evaluate_inverse(evaluator, &layout, &error);
    assert_non_null(coverage);
    const sp_patches *patches = sp_evaluator_patches(evaluator);
    double above = 0, lowest = 0;
    for (size_t i = 0; i < patches->count; i++) {
        sp_vec3 p = patches->point[i];
        if (patches->normal[i].x > -0.9 || p.x < 0.69 || p.x > 0.71 || p.y < 0.33 || p.y > 0.67 || p.z > 0.4)
            continue;
        double *most = p.z < 0.31 ? &lowest : &above;
        *most = fmax(*most, coverage->deposits.film[i]);
    }
    assert_true(above > 0);
    if (!(lowest < 1.2 * above))
        fail_msg("%g m2/s in the lowest row, %g above", lowest, above);
    sp_coverage_destroy(coverage);
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(w.mesh);
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
    const sp_falling_film *falling_film = w.evaluator->falling_film;
    assert_true(falling_film->walls->patches.count > w.cells->count);
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
        cmocka_unit_test(pan_runs_over_its_rim),
        cmocka_unit_test(a_level_top_runs_over_on_all_sides),
        cmocka_unit_test(film_drips_off_a_level_underside_where_it_comes),
        cmocka_unit_test(deep_tank_holds),
        cmocka_unit_test(triangles_may_face_either_way),
        cmocka_unit_test(film_crosses_what_is_not_cleaned),
    };
    return cmocka_run_group_tests(tests, crowd, leave);
}
