/* Goods moved past nozzles: as many of them that stand, in the place of one that moves; jets; and the closed forms of
 * the dose on a plate under a fan and under a cone. */
#include "measure.h"

#include <sprayplan/points.h>

#include <string.h>

#define POINTS 0.001 /* of coverage */
#define SPEED 0.1    /* m/s */

/* The first `moving` parts of a mesh go from `from` to `to`; a dose is asked for (m³/m², 0: none). */
static void open_pass(scene *s, sp_mesh *mesh, size_t moving, double way, double texel, double dose)
{
    scene_open(s, mesh, SP_TRAJECTORY_LINE, texel);
    for (size_t i = 0; i < moving; i++)
        s->surfaces[i].moves = true;
    s->setup.sweep = (sp_sweep){.from = {-0.5 * way, 0, 0}, .to = {0.5 * way, 0, 0}, .speed = SPEED};
    s->setup.criterion.flux = dose / sp_sweep_duration(&s->setup.sweep);
}

static sp_nozzle_type fan(double degrees, double thickness)
{
    sp_nozzle_type type = spray_type(SP_PATTERN_FLAT_FAN, degrees);
    type.thickness = deg(thickness);
    return type;
}

/* Wide along y, across the way. */
static sp_nozzle across(const sp_nozzle_type *type, sp_vec3 position, sp_vec3 axis)
{
    sp_nozzle nozzle = nozzle_at(type, position, axis, 0);
    sp_vec3 x = sp_nozzle_frame(nozzle.axis, 0, sp_v(0, 0, 1)).x;
    nozzle.roll = fabs(x.y) > 0.5 ? 0 : M_PI / 2;
    return nozzle;
}

/* Positions of the goods, as as many nozzles at goods that stand: nothing else is there. */
static void assert_equals_standing(const char *what, const sp_nozzle *nozzle, sp_trajectory trajectory, double length,
                                   double texel)
{
    enum { fixed = 1000 };
    rectangle faces[6];
    box_rectangles(sp_v(-0.5 * length, -0.2, -0.1), sp_v(length, 0.4, 0.2), faces);
    scene moving, standing;
    open_pass(&moving, mesh_of_rectangles(faces, 6), 6, 1.6, texel, 0.5e-3);
    moving.setup.fidelity.trajectory = trajectory;
    standing = moving;
    standing.setup.surfaces = standing.surfaces;
    standing.setup.sweep = (sp_sweep){.speed = 0};
    for (size_t i = 0; i < 6; i++)
        standing.surfaces[i].moves = false;
    sp_evaluator *passes = scene_evaluator(&moving), *stands = scene_evaluator(&standing);
    sp_nozzle *many = calloc(fixed, sizeof *many);
    assert_non_null(many);
    for (int k = 0; k < fixed; k++) {
        many[k] = *nozzle;
        many[k].position.x -= moving.setup.sweep.from.x + (k + 0.5) / fixed * 1.6;
        many[k].flow = sp_nozzle_flow(nozzle, &moving.setup.liquid) / fixed;
    }
    sp_coverage *mean = scene_cover(passes, nozzle, 1, true), *sum = scene_cover(stands, many, fixed, true);
    double flux = mean->flux_mean / sum->flux_mean - 1;
    print_message("%-24s %.2f %% covered, by %d that stand %.2f %%; flux %+.3f %%\n", what, 100 * mean->fraction, fixed,
                  100 * sum->fraction, 100 * flux);
    if (!(fabs(mean->fraction - sum->fraction) <= POINTS * COARSER * COARSER) || !(fabs(flux) < 0.005 * COARSER))
        fail_msg("%s: not as %d that stand", what, fixed);
    free(many);
    sp_coverage_destroy(mean);
    sp_coverage_destroy(sum);
    sp_evaluator_destroy(passes);
    sp_evaluator_destroy(stands);
    scene_close(&moving);
}

static void passing_is_as_many_that_stand(void **state)
{
    (void)state;
    sp_nozzle_type thin = fan(75, 6), cone = spray_type(SP_PATTERN_FULL_CONE, 60);
    sp_nozzle above = across(&thin, sp_v(0.03, 0.05, 0.4), sp_v(0.1, 0.1, -1)),
              beside = nozzle_at(&cone, sp_v(0.02, -0.6, 0.2), sp_v(0.1, 1, -0.3), 0);
    assert_equals_standing("fan above, falling", &above, SP_TRAJECTORY_PARABOLA, 0.3, 0.014);
    assert_equals_standing("cone beside", &beside, SP_TRAJECTORY_LINE, 0.3, 0.014);
}

/* Drops whose flights are looked for one by one: shorter goods, on longer texels. */
static void drops_that_goods_pass_are_as_many_that_stand(void **state)
{
    (void)state;
    sp_nozzle_type cone = spray_type(SP_PATTERN_FULL_CONE, 60);
    cone.drop = 0.4e-3;
    sp_nozzle beside = nozzle_at(&cone, sp_v(0.02, -0.6, 0.2), sp_v(0.1, 1, -0.3), 0);
    assert_equals_standing("cone beside, with drag", &beside, SP_TRAJECTORY_DRAG, 0.1, 0.05);
}

/* A table that is carried under a beam: a plate with a side, and what stands in the way. */
static sp_mesh *table_under_beam(double moved)
{
    const rectangle parts[] = {{sp_v(-0.2 + moved, -0.2, 0), sp_v(0.4, 0, 0), sp_v(0, 0.4, 0)},
                               {sp_v(-0.1 + moved, -0.2, 0.02), sp_v(0, 0.4, 0), sp_v(0, 0, 0.15)},
                               {sp_v(-0.05, -0.1, 0.25), sp_v(0.1, 0, 0), sp_v(0, 0.12, 0)}};
    return mesh_of_rectangles(parts, 3);
}

static void open_table(scene *s, double moved, double texel)
{
    scene_open(s, table_under_beam(moved), SP_TRAJECTORY_LINE, texel);
    s->surfaces[2].clean = false;
}

/* The goods themselves, put where they pass. */
static void passing_is_as_many_positions_under_a_beam(void **state)
{
    (void)state;
    enum { positions = (int)(1000 / (COARSER * COARSER)) };
    const double way = 1.4, texel = 0.02, dose = 1.2e-3;
    sp_nozzle_type cone = spray_type(SP_PATTERN_FULL_CONE, 70);
    sp_nozzle nozzle = nozzle_at(&cone, sp_v(0.02, 0.03, 0.5), sp_v(0.1, 0, -1), 0);
    scene s;
    open_table(&s, 0, texel);
    s.surfaces[0].moves = s.surfaces[1].moves = true;
    s.setup.sweep = (sp_sweep){.from = {-0.5 * way, 0, 0}, .to = {0.5 * way, 0, 0}, .speed = SPEED};
    s.setup.criterion.flux = dose / sp_sweep_duration(&s.setup.sweep);
    sp_evaluator *passes = scene_evaluator(&s);
    const sp_patches *patches = sp_evaluator_patches(passes);
    sp_coverage *mean = scene_cover(passes, &nozzle, 1, true);
    double *sum = calloc(patches->count, sizeof *sum), covered = 0;
    assert_non_null(sum);
    for (int k = 0; k < positions; k++) {
        scene put;
        open_table(&put, ((k + 0.5) / positions - 0.5) * way, texel);
        put.setup.run.threads = 1; /* so little work that starting them would take longer */
        sp_evaluator *stands = scene_evaluator(&put);
        sp_coverage *one = scene_cover(stands, &nozzle, 1, true);
        assert_int_equal(one->deposits.count, patches->count);
        for (size_t i = 0; i < patches->count; i++)
            sum[i] += one->deposits.counted[i] / positions;
        sp_coverage_destroy(one);
        sp_evaluator_destroy(stands);
        scene_close(&put);
    }
    for (size_t i = 0; i < patches->count; i++)
        covered += sum[i] >= s.setup.criterion.flux ? patches->area[i] : 0;
    print_message("table under a beam: %.2f %% covered, in %d positions %.2f %%\n", 100 * mean->fraction, positions,
                  100 * covered / mean->area);
    assert_true(mean->fraction > 0.1 && mean->fraction < 0.9);
    assert_true(fabs(mean->fraction - covered / mean->area) <= POINTS * COARSER * COARSER);
    free(sum);
    sp_coverage_destroy(mean);
    sp_evaluator_destroy(passes);
    scene_close(&s);
}

/* Jets, spread over the pass, and the closed form; one thread and two. */
static void assert_jets_agree(const char *what, sp_trajectory trajectory, uint64_t jets, double points)
{
    sp_nozzle_type type = fan(75, 8);
    sp_nozzle nozzle = across(&type, sp_v(0.02, 0.03, 0.5), sp_v(0.15, 0.1, -1));
    sp_coverage *found[2][2];
    size_t count = 0;
    for (int threads = 1; threads <= 2; threads++) {
        scene s;
        open_table(&s, 0, 0.02);
        s.surfaces[0].moves = s.surfaces[1].moves = true;
        s.setup.sweep = (sp_sweep){.from = {-0.7, 0, 0}, .to = {0.7, 0, 0}, .speed = SPEED};
        s.setup.criterion.flux = 1.5e-3 / sp_sweep_duration(&s.setup.sweep);
        s.setup.fidelity.trajectory = trajectory;
        s.setup.fidelity.jets = jets;
        s.setup.run.threads = threads;
        sp_evaluator *evaluator = scene_evaluator(&s);
        count = sp_evaluator_patches(evaluator)->count;
        found[threads - 1][0] = scene_cover(evaluator, &nozzle, 1, true);
        found[threads - 1][1] = scene_cover(evaluator, &nozzle, 1, false);
        sp_evaluator_destroy(evaluator);
        scene_close(&s);
    }
    for (int k = 0; k < 2; k++)
        assert_memory_equal(found[0][k]->deposits.flux, found[1][k]->deposits.flux, count * sizeof(double));
    const sp_coverage *inverse = found[0][0], *forward = found[0][1];
    print_message("fan on a table, %s: %.2f %% covered, by jets %.2f %%\n", what, 100 * inverse->fraction,
                  100 * forward->fraction);
    compare_with("liquid on a table", "forward", forward->flux_mean, inverse->flux_mean, 0.02 * COARSER);
    assert_true(inverse->fraction > 0.1 && fabs(forward->fraction - inverse->fraction) <= points * COARSER);
    for (int i = 0; i < 4; i++)
        sp_coverage_destroy(found[i / 2][i % 2]);
}

static void jets_agree_whatever_the_threads(void **state)
{
    (void)state;
    assert_jets_agree("lines", SP_TRAJECTORY_LINE, 200000, 0.015);
    assert_jets_agree("drag", SP_TRAJECTORY_DRAG, 50000, 0.02);
}

/* The goods themselves stay where they are told not to be in the way. */
static void nozzles_stay_out_of_the_way(void **state)
{
    (void)state;
    scene s;
    open_table(&s, 0, 0.05);
    s.surfaces[0].moves = s.surfaces[1].moves = true;
    s.setup.sweep = (sp_sweep){.from = {-0.7, 0, 0}, .to = {0.7, 0, 0}, .speed = SPEED};
    sp_evaluator *evaluator = scene_evaluator(&s);
    sp_nozzle_type type = fan(75, 8);
    sp_nozzle over = nozzle_at(&type, sp_v(0.6, 0, 0.3), sp_v(0, 0, -1), 0), through = over, beam = over;
    sp_error error = {0};
    through.position.z = 0.1; /* the side passes there, 0.7 m from where the mesh has it */
    beam.position = sp_v(0, 0, 0.25);
    assert_true(sp_evaluator_admits(evaluator, &over, &error));
    assert_false(sp_evaluator_admits(evaluator, &through, &error));
    assert_non_null(strstr(error.message, "nozzles: n at [0.6 m, 0 m, 0.1 m] is in the way of the goods of the sweep"));
    error = (sp_error){0};
    assert_false(sp_evaluator_admits(evaluator, &beam, &error));
    assert_non_null(strstr(error.message, "is in a wall, part"));
    assert_true(sp_evaluator_is_clear(evaluator, sp_v(0.5, 0, 0.2), 0.029, SP_NONE));
    assert_false(sp_evaluator_is_clear(evaluator, sp_v(0.5, 0, 0.2), 0.031, SP_NONE));
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

/* m from a plate's middle, where a row of texels ends and the next begins, on texels of 10 mm and of 40 mm: rows count
 * whole. */
#define EDGE_OF_ROWS 0.14

/* A plate that passes wholly, 1 m wide, 0.4 m long, level, its front up, `height` under nozzles at the origin. */
static void open_plate(scene *s, double height, double texel, double dose)
{
    const rectangle plate = level_rectangle(0.4, 1, -height);
    open_pass(s, mesh_of_rectangles(&plate, 1), 1, 1.6, texel, dose);
}

/* Of the liquid of a fan all that leaves within the plate's width is laid out along the way: Q h/(A v (h² + y²)) m³/m²
 * at a distance y from the middle, A being the fan's angle. */
static void dose_of_a_fan(void **state)
{
    (void)state;
    const double height = 0.3, angle = deg(80), flow = 2e-4, wide = EDGE_OF_ROWS + 0.08;
    const double dose = flow * height / (angle * SPEED * (height * height + wide * wide));
    scene s;
    open_plate(&s, height, 0.01, dose);
    sp_nozzle_type type = fan(80, 4);
    sp_nozzle nozzle = across(&type, sp_v(0.013, 0, 0), sp_v(0, 0, -1));
    assert_true(wide < height * tan(angle / 2));
    assert_covers("plate under a fan", &s, &nozzle, 1, 0.4 * 2 * wide, BY_BOTH);

    sp_evaluator *evaluator = scene_evaluator(&s);
    sp_coverage *coverage = scene_cover(evaluator, &nozzle, 1, true);
    const sp_patches *patches = sp_evaluator_patches(evaluator);
    double duration = sp_sweep_duration(&s.setup.sweep), worst = 0;
    for (size_t i = 0; i < patches->count; i++) {
        double y = patches->point[i].y, expected = flow * height / (angle * SPEED * (height * height + y * y));
        if (fabs(y) < 0.2)
            worst = fmax(worst, fabs(coverage->deposits.flux[i] * duration / expected - 1));
    }
    print_message("dose of a fan: within %.3f %% on all patches\n", 100 * worst);
    assert_true(worst < 0.02 * COARSER);
    /* all of the fan's liquid falls on the plate while that is under it, which it is 0.4 m of the 1.6 m */
    compare_with("liquid of a fan", "inverse", coverage->flux_mean * patches->total_area, flow * 0.4 / 1.6,
                 INVERSE_BOUND);
    sp_coverage_destroy(coverage);
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

/* Points that pass take what the closed forms say: none may be told otherwise but within a millimetre of where the dose
 * is what is asked for. */
static void assert_points_take(const char *what, const sp_nozzle *nozzle, double height, double dose, double wide)
{
    enum { POINTS_DRAWN = 2000 };
    const double edge = 1e-3;
    scene s;
    open_plate(&s, height, 0.02 / COARSER, dose);
    s.setup.run.threads = 1;
    sp_evaluator *single = scene_evaluator(&s);
    s.setup.run.threads = 2;
    sp_evaluator *evaluator = scene_evaluator(&s);
    sp_error error = {0};
    sp_layout *layout = sp_layout_create(nozzle, 1, &error);
    sp_points *surface = sp_points_create(evaluator, &error);
    sp_point points[POINTS_DRAWN];
    bool covered[POINTS_DRAWN], again[POINTS_DRAWN];
    size_t held = 0;
    for (size_t i = 0; i < POINTS_DRAWN; i++)
        points[i] = sp_points_draw(surface, i, POINTS_DRAWN, 1);
    assert_true(sp_points_judge(evaluator, layout, SP_TRAJECTORY_LINE, points, POINTS_DRAWN, covered, &error));
    assert_true(sp_points_judge(single, layout, SP_TRAJECTORY_LINE, points, POINTS_DRAWN, again, &error));
    assert_memory_equal(covered, again, sizeof covered);
    for (size_t i = 0; i < POINTS_DRAWN; i++) {
        double y = fabs(points[i].position.y);
        held += covered[i];
        if (covered[i] != (y < wide) && fabs(y - wide) > edge)
            fail_msg("%s: a point %g m from the middle is %s", what, y, covered[i] ? "covered" : "dry");
    }
    assert_true(held > POINTS_DRAWN / 10 && held < 9 * POINTS_DRAWN / 10);
    sp_points_destroy(surface);
    sp_layout_destroy(layout);
    sp_evaluator_destroy(single);
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

static void points_take_the_dose(void **state)
{
    (void)state;
    const double height = 0.3, flow = 2e-4, wide = 0.22;
    sp_nozzle_type thin = fan(80, 3), cone = spray_type(SP_PATTERN_FULL_CONE, 80);
    sp_nozzle nozzle = across(&thin, sp_v(0.013, 0, 0), sp_v(0, 0, -1));
    assert_points_take("thin fan", &nozzle, height, flow * height / (deg(80) * SPEED * (height * height + wide * wide)),
                       wide);
    const double rim = height * tan(deg(40)), solid = 2 * M_PI * (1 - cos(deg(40))), near = 0.16;
    nozzle = nozzle_at(&cone, sp_v(0.01, 0, 0), sp_v(0, 0, -1), 0);
    assert_points_take("cone", &nozzle, height,
                       2 * flow * height * sqrt(rim * rim - near * near) /
                           (solid * SPEED * (height * height + near * near) * sqrt(height * height + rim * rim)),
                       near);
}

/* Under a cone, over the chord of its disc: 2Q h √(ρ² - y²)/(Ω v (h² + y²) √(h² + ρ²)). */
static void dose_of_a_cone(void **state)
{
    (void)state;
    const double height = 0.4, half = deg(30), flow = 2e-4, rim = 0.4 * tan(half), y = EDGE_OF_ROWS;
    const double solid = 2 * M_PI * (1 - cos(half));
    double dose = 2 * flow * height * sqrt(rim * rim - y * y) /
                  (solid * SPEED * (height * height + y * y) * sqrt(height * height + rim * rim));
    scene s;
    open_plate(&s, height, 0.01, dose);
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 60);
    sp_nozzle nozzle = nozzle_at(&type, sp_v(0.01, 0, 0), sp_v(0, 0, -1), 0);
    assert_covers("plate under a cone", &s, &nozzle, 1, 0.4 * 2 * y, BY_INVERSE);
    scene_close(&s);
}

/* What stands is shaded while goods are over it: a plate over a floor takes its length's share of the way. */
static void assert_floor_is_shaded(const char *what, sp_trajectory trajectory, double texel)
{
    rectangle faces[2] = {level_rectangle(0.4, 1, -0.2), level_rectangle(0.3, 0.3, -0.5)};
    scene s;
    open_pass(&s, mesh_of_rectangles(faces, 2), 1, 1.6, texel, 0);
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 40);
    sp_nozzle nozzle = nozzle_at(&type, sp_v(0, 0, 0), sp_v(0, 0, -1), 0);
    s.setup.fidelity.trajectory = trajectory;
    sp_evaluator *passed = scene_evaluator(&s);
    s.surfaces[0].moves = false;
    s.surfaces[0].clean = false;
    s.setup.sweep = (sp_sweep){.speed = 0};
    sp_coverage *mean = scene_cover(passed, &nozzle, 1, true);
    double on_floor = 0, all = 0;
    const sp_patches *patches = sp_evaluator_patches(passed);
    for (size_t i = 0; i < patches->count; i++)
        on_floor += patches->triangle[i] >= 2 * CELLS * CELLS ? mean->deposits.flux[i] * patches->area[i] : 0;
    s.mesh = mesh_of_rectangles(&faces[1], 1);
    sp_setup bare = s.setup;
    bare.mesh = s.mesh;
    s.setup = bare;
    s.surfaces[0].clean = true;
    sp_evaluator *open = scene_evaluator(&s);
    sp_coverage *free = scene_cover(open, &nozzle, 1, true);
    all = free->flux_mean * sp_evaluator_patches(open)->total_area;
    compare_with("floor that goods shade", what, on_floor / all, 1 - 0.4 / 1.6, 0.02 * COARSER);
    sp_mesh *both = (sp_mesh *)sp_evaluator_setup(passed)->mesh;
    sp_coverage_destroy(mean);
    sp_coverage_destroy(free);
    sp_evaluator_destroy(passed);
    sp_evaluator_destroy(open);
    sp_mesh_destroy(both);
    scene_close(&s);
}

static void floor_under_goods(void **state)
{
    (void)state;
    assert_floor_is_shaded("lines", SP_TRAJECTORY_LINE, 0.02);
    assert_floor_is_shaded("drag", SP_TRAJECTORY_DRAG, 0.04);
}

/* A block under a fan, its faces listed from the one of that number on. */
static sp_coverage *cover_block(int first, double texel)
{
    rectangle faces[6], turned[6];
    box_rectangles(sp_v(-0.15, -0.2, -0.1), sp_v(0.3, 0.4, 0.2), faces);
    for (int i = 0; i < 6; i++)
        turned[i] = faces[(i + first) % 6];
    sp_nozzle_type thin = fan(60, 6);
    sp_nozzle above = across(&thin, sp_v(0.03, 0.05, 0.4), sp_v(0, 0, -1));
    scene s;
    /* under sanitizers of the same texels, which it is about */
    open_pass(&s, mesh_of_rectangles(turned, 6), 6, 1.6, texel / COARSER, 0.5e-3);
    sp_evaluator *evaluator = scene_evaluator(&s);
    sp_coverage *coverage = scene_cover(evaluator, &above, 1, true);
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
    return coverage;
}

/* Which faces are laid side by side, and where the edges between them pass through texels, hangs on their order. */
static void faces_may_come_in_any_order(void **state)
{
    (void)state;
    sp_coverage *fine = cover_block(0, 0.008);
    for (int first = 0; first < 6; first++)
        for (int k = 0; k < 3; k++) {
            double texel = 0.035 + 0.0125 * k;
            sp_coverage *found = cover_block(first, texel);
            double flux = found->flux_mean / fine->flux_mean - 1, points = found->fraction - fine->fraction;
            print_message("face %d first, texels of %g mm: flux %+.3f %%, %+.2f points\n", first, 1e3 * texel,
                          100 * flux, 100 * points);
            assert_true(fabs(flux) < 0.01);
            sp_coverage_destroy(found);
        }
    sp_coverage_destroy(fine);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(passing_is_as_many_that_stand),
        cmocka_unit_test(drops_that_goods_pass_are_as_many_that_stand),
        cmocka_unit_test(passing_is_as_many_positions_under_a_beam),
        cmocka_unit_test(jets_agree_whatever_the_threads),
        cmocka_unit_test(nozzles_stay_out_of_the_way),
        cmocka_unit_test(dose_of_a_fan),
        cmocka_unit_test(dose_of_a_cone),
        cmocka_unit_test(points_take_the_dose),
        cmocka_unit_test(floor_under_goods),
        cmocka_unit_test(faces_may_come_in_any_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
