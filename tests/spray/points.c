/* Points: they lie evenly on what is counted, and each is judged as the closed form says. */
#include "../closed-form/measure.h"

#include <sprayplan/points.h>

#include <stdlib.h>
#include <string.h>

#define POINTS 20000

static sp_points *points_of(const sp_evaluator *evaluator)
{
    sp_error error = {0};
    sp_points *points = sp_points_create(evaluator, &error);
    assert_no_error(&error);
    assert_non_null(points);
    return points;
}

static sp_point *draw(const sp_evaluator *evaluator, size_t n, uint64_t seed)
{
    sp_points *points = points_of(evaluator);
    sp_point *drawn = malloc(n * sizeof *drawn);
    assert_non_null(drawn);
    for (size_t i = 0; i < n; i++)
        drawn[i] = sp_points_draw(points, i, n, seed);
    sp_points_destroy(points);
    return drawn;
}

static bool *judge(const sp_evaluator *evaluator, const sp_nozzle *nozzles, size_t nozzle_count,
                   sp_trajectory trajectory, const sp_point *points, size_t count)
{
    sp_error error = {0};
    sp_layout *layout = sp_layout_create(nozzles, nozzle_count, &error);
    bool *covered = malloc(count * sizeof *covered);
    assert_true(sp_points_judge(evaluator, layout, trajectory, points, count, covered, &error));
    sp_layout_destroy(layout);
    return covered;
}

/* A room of sheets, some wet on their front and some on their back, with a box that stands half in a wall: its
 * triangles, and the wall's, are wet in parts. The box's outer end is out of the liquid; the ceiling is an obstacle. */
static sp_evaluator *open_room(scene *s, int threads)
{
    rectangle faces[12];
    box_rectangles(sp_v(0, 0, 0), sp_v(1, 0.8, 0.6), faces);
    box_rectangles(sp_v(-0.2, 0.3, 0.17), sp_v(0.4, 0.2, 0.2), faces + 6);
    for (int i = 0; i < 3; i++) {
        sp_vec3 u = faces[i].u;
        faces[i].u = faces[i].v;
        faces[i].v = u;
    }
    scene_open(s, mesh_of_rectangles(faces, 12), SP_TRAJECTORY_PARABOLA, 0.02 / COARSER);
    s->surfaces[3].clean = false;
    s->setup.fidelity.method = SP_METHOD_INVERSE;
    s->setup.cavity = SP_CAVITY_POINT;
    s->setup.cavity_point = sp_v(0.6, 0.5, 0.3);
    s->setup.run.threads = threads;
    return scene_evaluator(s);
}

static void points_lie_on_what_is_counted(void **state)
{
    (void)state;
    scene s;
    sp_evaluator *evaluator = open_room(&s, 2);
    const sp_patches *patches = sp_evaluator_patches(evaluator);
    assert_float_equal(patches->total_area, 3.92 - 0.8, 1e-6);
    sp_points *points = points_of(evaluator);
    assert_float_equal(sp_points_area(points), patches->total_area, 1e-9);
    sp_points_destroy(points);
    sp_point *drawn = draw(evaluator, POINTS, 7);
    size_t lost = 0;
    for (size_t i = 0; i < POINTS; i++) {
        const sp_point *p = &drawn[i];
        assert_true(p->u >= 0 && p->v >= 0 && p->u + p->v <= 1);
        assert_float_equal(sp_distance(p->position, sp_triangle_point(s.mesh, p->triangle, p->u, p->v)), 0, 1e-15);
        assert_int_equal(sp_evaluator_wet_at(evaluator, p->triangle, p->u, p->v) >> (p->side == SP_SIDE_BACK) & 1, 1);
        assert_true(s.surfaces[s.mesh->part[p->triangle]].clean);
        lost += p->patch == SP_NONE;
        if (p->patch != SP_NONE)
            assert_true(patches->side[p->patch] == p->side &&
                        sp_distance(patches->point[p->patch], p->position) < 2 * patches->length[p->patch] &&
                        sp_distance(patches->normal[p->patch], p->normal) < 1e-9);
    }
    assert_true(lost <= 1);
    free(drawn);
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

/* The triangles of a part follow each other: at either end of them a point may be on one or the other. */
static void each_part_has_its_share(void **state)
{
    (void)state;
    scene s;
    sp_evaluator *evaluator = open_room(&s, 2);
    const sp_patches *patches = sp_evaluator_patches(evaluator);
    sp_point *drawn = draw(evaluator, POINTS, 3);
    double expected[PARTS] = {0}, found[PARTS] = {0};
    for (size_t i = 0; i < patches->count; i++)
        expected[s.mesh->part[patches->triangle[i]]] += patches->area[i] / patches->total_area * POINTS;
    for (size_t i = 0; i < POINTS; i++)
        found[s.mesh->part[drawn[i].triangle]]++;
    for (size_t i = 0; i < PARTS; i++)
        assert_true(fabs(found[i] - expected[i]) <= 2);
    free(drawn);
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

static sp_evaluator *open_floor(scene *s, sp_trajectory trajectory)
{
    rectangle floor = level_rectangle(2.4, 2.4, 0);
    scene_open(s, mesh_of_rectangles(&floor, 1), trajectory, 0.05 / COARSER);
    return scene_evaluator(s);
}

/* How many of n points fall on a disc, over many seeds: independent ones would scatter by √(n p (1 - p)). */
static void points_are_even(void **state)
{
    (void)state;
    enum { SEEDS = 50, N = 4096 };
    scene s;
    sp_evaluator *evaluator = open_floor(&s, SP_TRAJECTORY_LINE);
    double share = M_PI * 0.7 * 0.7 / (2.4 * 2.4), mean = 0, square = 0;
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        sp_point *drawn = draw(evaluator, N, seed);
        double inside = 0;
        for (size_t i = 0; i < N; i++)
            inside += hypot(drawn[i].position.x - 0.2, drawn[i].position.y + 0.1) < 0.7;
        mean += (inside - N * share) / SEEDS;
        square += (inside - N * share) * (inside - N * share) / SEEDS;
        free(drawn);
    }
    double random = sqrt(N * share * (1 - share));
    print_message("on a disc: off by %.2f on average, scatter %.2f, of random points %.2f\n", mean, sqrt(square),
                  random);
    assert_true(sqrt(square) < 0.3 * random);
    assert_true(fabs(mean) < 4 * sqrt(square / SEEDS));
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

static sp_nozzle cone_in_the_room(const sp_nozzle_type *type)
{
    return nozzle_at(type, sp_v(0.7, 0.3, 0.55), sp_v(-0.5, 0.1, -1), 5);
}

/* Same points, verdicts and figures whatever the number of threads. */
static void threads_do_not_matter(void **state)
{
    (void)state;
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 100);
    sp_nozzle nozzle = cone_in_the_room(&type);
    sp_point *drawn[2];
    bool *covered[2];
    sp_measured_error measured[2];
    for (int i = 0; i < 2; i++) {
        scene s;
        sp_error error = {0};
        sp_evaluator *evaluator = open_room(&s, i ? 3 : 1);
        sp_coverage *coverage = scene_cover(evaluator, &nozzle, 1, true);
        sp_layout *layout = sp_layout_create(&nozzle, 1, &error);
        drawn[i] = draw(evaluator, POINTS, 5);
        covered[i] = judge(evaluator, &nozzle, 1, SP_TRAJECTORY_AUTO, drawn[i], POINTS);
        assert_true(sp_measure_error(evaluator, layout, coverage, SP_TRAJECTORY_AUTO, 1, &measured[i], &error));
        sp_layout_destroy(layout);
        sp_coverage_destroy(coverage);
        sp_evaluator_destroy(evaluator);
        scene_close(&s);
    }
    for (size_t i = 0; i < POINTS; i++)
        assert_true(sp_distance(drawn[0][i].position, drawn[1][i].position) == 0 &&
                    drawn[0][i].patch == drawn[1][i].patch && covered[0][i] == covered[1][i]);
    assert_true(measured[0].known && measured[0].estimate == measured[1].estimate &&
                measured[0].misjudged == measured[1].misjudged && measured[0].points == measured[1].points);
    for (int i = 0; i < 2; i++) {
        free(drawn[i]);
        free(covered[i]);
    }
}

/* How far (m) a point of the floor lies within the edge of what is covered, negative outside; its place is as seen from
 * the nozzle. */
typedef double closed_form(sp_vec3 place);

static void assert_verdicts(const sp_evaluator *evaluator, const sp_nozzle *nozzles, size_t count,
                            sp_trajectory trajectory, closed_form *inside)
{
    sp_point *drawn = draw(evaluator, POINTS, 11);
    bool *covered = judge(evaluator, nozzles, count, trajectory, drawn, POINTS);
    size_t some = 0;
    for (size_t i = 0; i < POINTS; i++) {
        double margin = drawn[i].position.z == 0 ? inside(sp_sub(drawn[i].position, nozzles[0].position)) : 0;
        if (fabs(margin) > 1e-9 && covered[i] != (margin > 0))
            fail_msg("point %zu, %g m within the edge, is %s", i, margin, covered[i] ? "covered" : "dry");
        some += margin > 0;
    }
    assert_true(some > POINTS / 200 && some < POINTS);
    free(drawn);
    free(covered);
}

#define HEIGHT 1.1
#define FEEBLE 2.0 /* m/s */

static double in_cone(sp_vec3 p)
{
    return HEIGHT * tan(deg(40)) - hypot(p.x, p.y);
}

/* As tests/closed-form/cone.c. */
static double in_cone_of_parabolas(sp_vec3 p)
{
    double along = FEEBLE * cos(deg(40)), time = (sqrt(along * along + 2 * 9.81 * HEIGHT) - along) / 9.81;
    return FEEBLE * sin(deg(40)) * time - hypot(p.x, p.y);
}

static double in_envelope(sp_vec3 p)
{
    return FEEBLE / 9.81 * sqrt(FEEBLE * FEEBLE + 2 * 9.81 * HEIGHT) - hypot(p.x, p.y);
}

/* Of a nozzle that looks down x is against the world's and y along it, before its roll. */
static double in_fan(sp_vec3 p)
{
    double c = cos(0.3), s = sin(0.3), x = s * p.y - c * p.x, y = s * p.x + c * p.y;
    return fmin(HEIGHT * tan(deg(45)) - fabs(x), hypot(x, HEIGHT) * tan(deg(0.5)) - fabs(y));
}

static sp_nozzle over_the_floor(const sp_nozzle_type *type)
{
    return nozzle_at(type, sp_v(0.013, -0.007, HEIGHT), sp_v(0, 0, -1), FEEBLE);
}

/* Lines or parabolas, whatever the evaluator itself flies. */
static void verdicts_on_a_floor(void **state)
{
    (void)state;
    sp_nozzle_type cone = spray_type(SP_PATTERN_FULL_CONE, 80), ball = spray_type(SP_PATTERN_FULL_CONE, 360),
                   fan = spray_type(SP_PATTERN_FLAT_FAN, 90);
    fan.thickness = deg(1);
    sp_nozzle nozzles[3] = {over_the_floor(&cone), over_the_floor(&ball), over_the_floor(&fan)};
    for (int own = SP_TRAJECTORY_LINE; own <= SP_TRAJECTORY_PARABOLA; own++) {
        scene s;
        sp_evaluator *evaluator = open_floor(&s, (sp_trajectory)own);
        assert_verdicts(evaluator, &nozzles[0], 1, SP_TRAJECTORY_LINE, in_cone);
        assert_verdicts(evaluator, &nozzles[0], 1, SP_TRAJECTORY_PARABOLA, in_cone_of_parabolas);
        assert_verdicts(evaluator, &nozzles[1], 1, SP_TRAJECTORY_AUTO, in_envelope);
        assert_verdicts(evaluator, &nozzles[2], 1, SP_TRAJECTORY_LINE, in_fan);
        sp_evaluator_destroy(evaluator);
        scene_close(&s);
    }
}

#define PLATE 0.3
#define OVER 0.5

static double out_of_the_shadow(sp_vec3 p)
{
    double half = 0.5 * PLATE * HEIGHT / (HEIGHT - OVER);
    double in_shadow = fmin(half - fabs(p.x), half - fabs(p.y)); /* the plate is straight below the nozzle */
    return fmin(in_cone(p), -in_shadow);
}

static void verdicts_in_a_shadow(void **state)
{
    (void)state;
    rectangle shapes[2] = {level_rectangle(2.4, 2.4, 0), level_rectangle(PLATE, PLATE, OVER)};
    sp_nozzle_type cone = spray_type(SP_PATTERN_FULL_CONE, 80);
    sp_nozzle nozzle = over_the_floor(&cone);
    shapes[1].corner = sp_add(shapes[1].corner, sp_v(nozzle.position.x, nozzle.position.y, 0));
    scene s;
    scene_open(&s, mesh_of_rectangles(shapes, 2), SP_TRAJECTORY_LINE, 0.05 / COARSER);
    s.surfaces[1].clean = false;
    sp_evaluator *evaluator = scene_evaluator(&s);
    assert_verdicts(evaluator, &nozzle, 1, SP_TRAJECTORY_LINE, out_of_the_shadow);
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

/* Below a nozzle the flux is Q h / (Ω r³). */
static double flux_radius(double flow)
{
    double solid_angle = 2 * M_PI * (1 - cos(deg(70))), threshold = 0.6 * 2e-4 / (solid_angle * HEIGHT * HEIGHT);
    double r = cbrt(flow * HEIGHT / (solid_angle * threshold));
    return sqrt(fmax(0, r * r - HEIGHT * HEIGHT));
}
static double with_one(sp_vec3 p)
{
    return flux_radius(2e-4) - hypot(p.x, p.y);
}
static double with_both(sp_vec3 p)
{
    return flux_radius(4e-4) - hypot(p.x, p.y);
}

static void fluxes_add_up_or_not(void **state)
{
    (void)state;
    sp_nozzle_type cone = spray_type(SP_PATTERN_FULL_CONE, 140);
    sp_nozzle pair[2] = {over_the_floor(&cone), over_the_floor(&cone)};
    double solid_angle = 2 * M_PI * (1 - cos(deg(70)));
    for (int combine = SP_COMBINE_SUM; combine <= SP_COMBINE_SINGLE; combine++) {
        rectangle floor = level_rectangle(2.4, 2.4, 0);
        scene s;
        scene_open(&s, mesh_of_rectangles(&floor, 1), SP_TRAJECTORY_LINE, 0.05 / COARSER);
        s.setup.criterion.flux = 0.6 * cone.flow / (solid_angle * HEIGHT * HEIGHT);
        s.setup.criterion.combine = (sp_combine)combine;
        sp_evaluator *evaluator = scene_evaluator(&s);
        assert_verdicts(evaluator, pair, 2, SP_TRAJECTORY_LINE, combine == SP_COMBINE_SUM ? with_both : with_one);
        sp_evaluator_destroy(evaluator);
        scene_close(&s);
    }
}

/* What walls throw back is not known at points: nothing is measured, and that is no error. */
static void nothing_is_measured_of_reflections(void **state)
{
    (void)state;
    rectangle floor = level_rectangle(2.4, 2.4, 0);
    sp_nozzle_type cone = spray_type(SP_PATTERN_FULL_CONE, 80);
    sp_nozzle nozzle = over_the_floor(&cone);
    scene s;
    scene_open(&s, mesh_of_rectangles(&floor, 1), SP_TRAJECTORY_LINE, 0.05 / COARSER);
    s.setup.fidelity.jets = 1000;
    s.setup.fidelity.reflections = 1;
    sp_evaluator *evaluator = scene_evaluator(&s);
    sp_coverage *coverage = scene_cover(evaluator, &nozzle, 1, false);
    sp_error error = {0};
    sp_layout *layout = sp_layout_create(&nozzle, 1, &error);
    assert_true(sp_measure_error(evaluator, layout, coverage, SP_TRAJECTORY_AUTO, 1, &coverage->measured, &error));
    assert_false(coverage->measured.known);
    assert_false(sp_measure_error(evaluator, layout, NULL, SP_TRAJECTORY_AUTO, 1, &coverage->measured, &error));
    assert_null(sp_points_create(NULL, &error));
    sp_points_destroy(NULL);
    sp_layout_destroy(layout);
    sp_coverage_destroy(coverage);
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_lie_on_what_is_counted),
        cmocka_unit_test(each_part_has_its_share),
        cmocka_unit_test(points_are_even),
        cmocka_unit_test(threads_do_not_matter),
        cmocka_unit_test(verdicts_on_a_floor),
        cmocka_unit_test(verdicts_in_a_shadow),
        cmocka_unit_test(fluxes_add_up_or_not),
        cmocka_unit_test(nothing_is_measured_of_reflections),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
