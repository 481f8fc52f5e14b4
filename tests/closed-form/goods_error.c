/* The measured error of goods that move: against the closed form of a plate that passes under a cone, over the orders
 * in which the faces of a block may come, and as auto chooses texels by it. */
#include "measure.h"

#include <sprayplan/points.h>

#include <string.h>

#define SPEED 0.1 /* m/s */

#ifdef SPRAYPLAN_SANITIZE
#define OFFSETS 2          /* of a nozzle, on each texel */
#define TRUTH_POINTS 60000 /* a doubt of .2 points */
#define ORDERS 1           /* of a block's faces */
#else
#define OFFSETS 8
#define TRUTH_POINTS 200000
#define ORDERS 6
#endif

/* All of a mesh goes so far along x; a dose is asked for (m³/m²). Its texels are as long under sanitizers. */
static void open_pass(scene *s, sp_mesh *mesh, double way, double texel, double dose)
{
    scene_open(s, mesh, SP_TRAJECTORY_LINE, texel / COARSER);
    for (size_t i = 0; i < mesh->part_count; i++)
        s->surfaces[i].moves = true;
    s->setup.fidelity.method = SP_METHOD_INVERSE;
    s->setup.sweep = (sp_sweep){.from = {-0.5 * way, 0, 0}, .to = {0.5 * way, 0, 0}, .speed = SPEED};
    s->setup.criterion.flux = dose / sp_sweep_duration(&s->setup.sweep);
}

/* Measures of many evaluations. */
typedef struct {
    size_t within, all;
    double off, estimate; /* sums of true errors and of measured ones */
} record;

/* `share` is the true coverage; returns the one found. */
static double measure(const sp_evaluator *evaluator, const sp_layout *layout, double share, uint64_t seed, record *r)
{
    sp_error error = {0};
    sp_coverage *coverage = sp_evaluate(evaluator, layout, &error);
    assert_no_error(&error);
    sp_measured_error *measured = &coverage->measured;
    assert_true(sp_measure_error(evaluator, layout, coverage, SP_TRAJECTORY_AUTO, seed, measured, &error));
    assert_true(measured->known);
    double found = coverage->fraction, off = fabs(found - share);
    print_message("%4.1f mm: %.2f %% covered, %.2f in truth; measured error %.2f points, %.2f %% misjudged\n",
                  1e3 * sp_evaluator_fidelity(evaluator)->texel, 100 * found, 100 * share, 100 * measured->estimate,
                  100 * measured->misjudged);
    r->within += off <= measured->estimate;
    r->all++;
    r->off += off;
    r->estimate += measured->estimate;
    sp_coverage_destroy(coverage);
    return found;
}

/* Points are taken until the doubt is a quarter of the accuracy, of 1 % here, or of the error. */
static void assert_told(const char *what, const record *r)
{
    print_message("%s: %zu of %zu within, error %.2f points in the mean, measured %.2f\n", what, r->within, r->all,
                  100 * r->off / (double)r->all, 100 * r->estimate / (double)r->all);
    assert_true((double)r->within >= 0.95 * (double)r->all);
    assert_true(r->estimate <= 1.3 * r->off + 0.003 * (double)r->all);
}

/* The dose of a cone on a plate is that of a chord, which is the longer the nearer it is to the middle: rows of texels
 * that the width ends in are covered whole, or not. */
static void a_plate_under_a_cone(void **state)
{
    (void)state;
    const double height = 0.3, flow = 2e-4, near = 0.16, rim = height * tan(deg(40));
    const double texels[] = {0.02, 0.035, 0.05, 0.06}, solid = 2 * M_PI * (1 - cos(deg(40)));
    const double dose = 2 * flow * height * sqrt(rim * rim - near * near) /
                        (solid * SPEED * (height * height + near * near) * sqrt(height * height + rim * rim));
    sp_nozzle_type cone = spray_type(SP_PATTERN_FULL_CONE, 80);
    record r = {0};
    sp_error error = {0};
    for (size_t k = 0; k < sizeof texels / sizeof *texels; k++) {
        const rectangle plate = level_rectangle(0.4, 1, -height);
        scene s;
        open_pass(&s, mesh_of_rectangles(&plate, 1), 1.2, texels[k], dose);
        sp_evaluator *evaluator = scene_evaluator(&s);
        for (int i = 0; i < OFFSETS; i++) {
            sp_nozzle nozzle = nozzle_at(&cone, sp_v(0.01, 0.021 * i - 0.08, 0), sp_v(0, 0, -1), 0);
            sp_layout *layout = sp_layout_create(&nozzle, 1, &error);
            measure(evaluator, layout, 2 * near, (uint64_t)i, &r);
            sp_layout_destroy(layout);
        }
        sp_evaluator_destroy(evaluator);
        scene_close(&s);
    }
    assert_told("plate under a cone", &r);
}

static double share_of_points(const sp_evaluator *evaluator, const sp_layout *layout)
{
    sp_error error = {0};
    sp_points *surface = sp_points_create(evaluator, &error);
    sp_point *points = malloc(TRUTH_POINTS * sizeof *points);
    bool *covered = malloc(TRUTH_POINTS * sizeof *covered);
    assert_true(points && covered);
    size_t wet = 0;
    for (size_t i = 0; i < TRUTH_POINTS; i++)
        points[i] = sp_points_draw(surface, i, TRUTH_POINTS, 4711);
    assert_true(sp_points_judge(evaluator, layout, SP_TRAJECTORY_LINE, points, TRUTH_POINTS, covered, &error));
    for (size_t i = 0; i < TRUTH_POINTS; i++)
        wet += covered[i];
    free(points);
    free(covered);
    sp_points_destroy(surface);
    return (double)wet / TRUTH_POINTS;
}

/* Which faces are laid side by side, and where rows of texels end, hangs on their order: by as much as coverage differs
 * the error has to allow for. */
static void a_block_in_any_order(void **state)
{
    (void)state;
    sp_nozzle_type cone = spray_type(SP_PATTERN_FULL_CONE, 70);
    const sp_nozzle nozzles[] = {nozzle_at(&cone, sp_v(0.03, -0.1, 0.4), sp_v(0, 0.1, -1), 0),
                                 nozzle_at(&cone, sp_v(0, -0.55, 0.3), sp_v(0.1, 1, -0.5), 0)};
    sp_error error = {0};
    sp_layout *layout = sp_layout_create(nozzles, 2, &error);
    double truth = 0, least = 1, most = 0;
    record r = {0};
    for (int first = 0; first < ORDERS; first++) {
        rectangle faces[6], turned[6];
        box_rectangles(sp_v(-0.15, -0.2, -0.1), sp_v(0.3, 0.4, 0.2), faces);
        for (int i = 0; i < 6; i++)
            turned[i] = faces[(i + first) % 6];
        for (int k = 0; k < 2; k++) {
            scene s;
            open_pass(&s, mesh_of_rectangles(turned, 6), 1.4, k ? 0.06 : 0.05, 0.8e-3);
            sp_evaluator *evaluator = scene_evaluator(&s);
            truth = truth > 0 ? truth : share_of_points(evaluator, layout);
            double found = measure(evaluator, layout, truth, (uint64_t)first, &r);
            least = k ? least : fmin(least, found);
            most = k ? most : fmax(most, found);
            sp_evaluator_destroy(evaluator);
            scene_close(&s);
        }
    }
    print_message("block: its faces in another order differ by up to %.2f points\n", 100 * (most - least));
    assert_true(ORDERS == 1 || most - least > 0.002); /* else nothing is asked */
    assert_told("block", &r);
    sp_layout_destroy(layout);
}

/* Auto begins with few texels, and takes them where they keep half the accuracy. */
static void auto_takes_few_texels_that_do(void **state)
{
    (void)state;
    const rectangle plate = level_rectangle(0.1, 1, -0.3);
    sp_nozzle_type fan = spray_type(SP_PATTERN_FLAT_FAN, 80);
    fan.thickness = deg(3);
    sp_nozzle nozzle = nozzle_at(&fan, sp_v(0.013, 0, 0), sp_v(0, 0, -1), 0);
    nozzle.roll = M_PI / 2;
    scene s;
    sp_error error = {0};
    open_pass(&s, mesh_of_rectangles(&plate, 1), 0.4, 0, 1e-3);
    s.setup.fidelity.trajectory = SP_TRAJECTORY_AUTO;
    sp_layout *layout = sp_layout_create(&nozzle, 1, &error);
    sp_evaluator *evaluator = sp_evaluator_create_for(&s.setup, layout, &error);
    assert_no_error(&error);
    const sp_choice *choice = sp_evaluator_choice(evaluator);
    size_t texels = sp_evaluator_patches(evaluator)->count;
    print_message("%zu texels: %s; %s\n", texels, choice->texel, choice->trajectory);
    assert_true(texels > 25000 && texels < 40000);
    assert_non_null(strstr(choice->texel, "error within"));
    assert_false(choice->missed);
    assert_int_equal(sp_evaluator_fidelity(evaluator)->trajectory, SP_TRAJECTORY_PARABOLA);
    sp_evaluator *again;
    assert_true(sp_evaluator_again(evaluator, true, &again, &error));
    assert_non_null(again);
    size_t most = sp_evaluator_patches(again)->count;
    assert_true(most > 90000 && most < 110000); /* half the length would be 120,000 */
    sp_evaluator_destroy(again);
    sp_evaluator_destroy(evaluator);
    sp_layout_destroy(layout);
    scene_close(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_plate_under_a_cone),
        cmocka_unit_test(a_block_in_any_order),
        cmocka_unit_test(auto_takes_few_texels_that_do),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
