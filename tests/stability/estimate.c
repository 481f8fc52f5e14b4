/* The measured error holds what it says: over scenes of known coverage, texels, trajectories and seeds the true error
 * lies within the estimate, and the estimate is not much larger. */
#include "stage.h"

#include <sprayplan/points.h>

#ifdef SPRAYPLAN_SANITIZE
#define SEEDS 3
#define TRUTH_POINTS 100000
#define ACCURACY 0.015 /* coarser texels want more points */
#else
#define SEEDS 20 /* for each of up to nine ways to evaluate a scene */
#define TRUTH_POINTS 2000000
#define ACCURACY 0.02 /* fewer points a seed than by default, and so more seeds */
#endif

/* Measures of one scene, over all ways to evaluate it and all seeds. */
typedef struct {
    size_t within, all;
} record;

/* One way: `share` is the true coverage when liquid flies as `reference` says. */
static void measure(const char *what, const sp_evaluator *evaluator, const sp_layout *layout, sp_trajectory reference,
                    double share, record *r)
{
    sp_error error = {0};
    sp_coverage *coverage = sp_evaluate(evaluator, layout, &error);
    assert_no_error(&error);
    double true_error = fabs(coverage->fraction - share), mean = 0, misjudged = 0;
    size_t within = 0;
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        sp_measured_error *measured = &coverage->measured;
        assert_true(sp_measure_error(evaluator, layout, coverage, reference, seed, measured, &error));
        assert_true(measured->known);
        within += true_error <= measured->estimate;
        mean += measured->estimate / SEEDS;
        misjudged += measured->misjudged / SEEDS;
    }
    print_message("%-24s %s as %s, %5.1f mm: error %.3f points, estimate %.3f, misjudged %.3f, %zu of %d within\n",
                  what, sp_evaluator_fidelity(evaluator)->trajectory == SP_TRAJECTORY_LINE ? "lines" : "parabolas",
                  reference == SP_TRAJECTORY_LINE ? "lines" : "parabolas",
                  1e3 * sp_evaluator_fidelity(evaluator)->texel, 100 * true_error, 100 * mean, 100 * misjudged, within,
                  SEEDS);
    assert_true(mean <= fmax(3 * true_error, 0.002));
    assert_true(misjudged + 0.002 >= true_error);
    r->within += within;
    r->all += SEEDS;
    sp_coverage_destroy(coverage);
}

static void assert_mostly_within(const char *what, const record *r)
{
    print_message("%s: %zu of %zu within\n", what, r->within, r->all);
    assert_true((double)r->within >= 0.95 * (double)r->all);
}

static const double texels[] = {0.5, 1, 2}; /* times a scene's own */

/* A flat surface under one nozzle, of which `area` (m²) is covered by lines and by parabolas; 0: not known. */
typedef struct {
    const char *name;
    rectangle shapes[2];
    size_t shape_count; /* the second is an obstacle */
    sp_nozzle_type type;
    sp_nozzle nozzle;
    sp_criterion criterion;
    double area[2];
    double texel; /* m */
} plate;

static void assert_on_plate(plate *p)
{
    record r = {0};
    sp_error error = {0};
    p->nozzle.type = &p->type;
    sp_layout *layout = sp_layout_create(&p->nozzle, 1, &error);
    double whole = sp_length(sp_cross(p->shapes[0].u, p->shapes[0].v));
    for (int k = 0; k < 2; k++)
        for (size_t i = 0; p->area[k] > 0 && i < sizeof texels / sizeof *texels; i++) {
            scene s;
            sp_trajectory trajectory = k ? SP_TRAJECTORY_PARABOLA : SP_TRAJECTORY_LINE;
            scene_open(&s, mesh_of_rectangles(p->shapes, p->shape_count), trajectory, texels[i] * p->texel);
            s.setup.fidelity.method = SP_METHOD_INVERSE;
            s.setup.criterion = p->criterion;
            s.setup.fidelity.accuracy = ACCURACY;
            s.surfaces[1].clean = false;
            sp_evaluator *evaluator = scene_evaluator(&s);
            measure(p->name, evaluator, layout, trajectory, p->area[k] / whole, &r);
            sp_evaluator_destroy(evaluator);
            scene_close(&s);
        }
    assert_mostly_within(p->name, &r);
    sp_layout_destroy(layout);
}

static const sp_criterion any_liquid = {0, 0, M_PI / 2, SP_COMBINE_SUM, 0};

static plate floor_plate(const char *name, sp_pattern pattern, double degrees, double height, double speed)
{
    plate p = {.name = name,
               .shapes = {level_rectangle(2.4, 2.4, 0)},
               .shape_count = 1,
               .type = spray_type(pattern, degrees),
               .criterion = any_liquid,
               .texel = 0.02};
    p.nozzle = nozzle_at(NULL, sp_v(0.013, -0.007, height), sp_v(0, 0, -1), speed);
    return p;
}

/* Where a jet at the polar angle `a` about straight down lands, as far out: of a line, and of a parabola. */
static double landing(double a, double h, double v, bool parabola)
{
    double down = v * cos(a), time = (sqrt(down * down + 2 * 9.81 * h) - down) / 9.81;
    return parabola ? v * sin(a) * time : h * tan(a);
}

static void cone_on_a_plate(void **state)
{
    (void)state;
    plate p = floor_plate("cone", SP_PATTERN_FULL_CONE, 80, 1.2, 5);
    for (int k = 0; k < 2; k++)
        p.area[k] = M_PI * pow(landing(deg(40), 1.2, 5, k), 2);
    assert_on_plate(&p);
}

static void ring_on_a_plate(void **state)
{
    (void)state;
    plate p = floor_plate("hollow cone", SP_PATTERN_HOLLOW_CONE, 80, 1.1, 6);
    for (int k = 0; k < 2; k++)
        p.area[k] = M_PI * (pow(landing(deg(40), 1.1, 6, k), 2) - pow(landing(deg(28), 1.1, 6, k), 2));
    assert_on_plate(&p);
}

/* As tests/closed-form/fan.c. */
static void thin_fan_on_a_plate(void **state)
{
    (void)state;
    const double h = 0.8, x = h * tan(deg(45));
    plate p = floor_plate("fan of 2 degrees", SP_PATTERN_FLAT_FAN, 90, h, 0);
    p.type.thickness = deg(2);
    p.area[0] = 2 * tan(deg(1)) * (x * sqrt(x * x + h * h) + h * h * asinh(x / h));
    assert_on_plate(&p);
}

/* As tests/closed-form/shadow.c. */
static void shadow_on_a_plate(void **state)
{
    (void)state;
    plate p = floor_plate("shadow", SP_PATTERN_FULL_CONE, 80, 1.2, 0);
    p.shapes[1] = level_rectangle(0.25, 0.25, 0.5);
    p.shapes[1].corner = sp_add(p.shapes[1].corner, sp_v(0.11, -0.06, 0));
    p.shape_count = 2;
    p.area[0] = M_PI * pow(landing(deg(40), 1.2, 1, false), 2) - pow(0.25 * 1.2 / 0.7, 2);
    assert_on_plate(&p);
}

/* As tests/closed-form/threshold.c: the flux Q h / (Ω r³), and on a wall the height at which speed is left. */
static void thresholds_on_plates(void **state)
{
    (void)state;
    const double h = 0.5, v = 6, level = 0.1234;
    plate p = floor_plate("flux", SP_PATTERN_FULL_CONE, 130, h, 0);
    double solid_angle = 2 * M_PI * (1 - cos(deg(65))), r = h * cbrt(2);
    p.criterion.flux = 0.5 * p.type.flow / (solid_angle * h * h);
    p.area[0] = M_PI * (r * r - h * h);
    assert_on_plate(&p);

    plate wall = floor_plate("impact speed", SP_PATTERN_FULL_CONE, 170, 0, v);
    wall.nozzle = nozzle_at(NULL, sp_v(0, 0, 0), sp_v(1, 0, 0), v);
    wall.shapes[0] = (rectangle){sp_v(0.5, -0.5, -0.4), sp_v(0, 0, 0.8), sp_v(0, 1, 0)};
    wall.criterion.impact_speed = sqrt(v * v - 2 * 9.81 * level);
    wall.area[1] = 0.4 + level;
    wall.texel = 0.015;
    assert_on_plate(&wall);
}

static double dense_share(const sp_evaluator *evaluator, const sp_layout *layout, sp_trajectory reference)
{
    enum { BLOCK = 50000 };
    static sp_point drawn[BLOCK];
    static bool covered[BLOCK];
    sp_error error = {0};
    sp_points *points = sp_points_create(evaluator, &error);
    size_t wet = 0;
    for (size_t first = 0; first < TRUTH_POINTS; first += BLOCK) {
        for (size_t i = 0; i < BLOCK; i++)
            drawn[i] = sp_points_draw(points, first + i, TRUTH_POINTS, 4711);
        assert_true(sp_points_judge(evaluator, layout, reference, drawn, BLOCK, covered, &error));
        for (size_t i = 0; i < BLOCK; i++)
            wet += covered[i];
    }
    sp_points_destroy(points);
    return (double)wet / TRUTH_POINTS;
}

/* The furnished room, by lines and parabolas, each as itself, and lines where parabolas are the truth. Of that there is
 * no closed form: the truth is that of very many points. */
static void furnished_rooms(void **state)
{
    (void)state;
    sp_transform home = sp_transform_default();
    sp_error error = {0};
    record r = {0};
    double truth[3] = {0};
    for (int own = SP_TRAJECTORY_LINE; own <= SP_TRAJECTORY_PARABOLA; own++)
        for (size_t i = 0; i < sizeof texels / sizeof *texels; i++) {
            stage st;
            stage_open(&st, (sp_trajectory)own, &home, sp_v(0, 0, 1));
            st.s.setup.fidelity.texel = texels[i] * STAGE_TEXEL * 1.5;
            st.s.setup.fidelity.accuracy = ACCURACY;
            st.s.setup.fidelity.method = own == SP_TRAJECTORY_LINE && i == 0 ? SP_METHOD_FORWARD : SP_METHOD_INVERSE;
            sp_evaluator *evaluator = scene_evaluator(&st.s);
            sp_layout *layout = sp_layout_create(st.nozzles, 2, &error);
            for (int reference = own; reference <= SP_TRAJECTORY_PARABOLA; reference++) {
                if (truth[reference] == 0)
                    truth[reference] = dense_share(evaluator, layout, (sp_trajectory)reference);
                measure("furnished room", evaluator, layout, (sp_trajectory)reference, truth[reference], &r);
            }
            sp_layout_destroy(layout);
            sp_evaluator_destroy(evaluator);
            stage_close(&st);
        }
    assert_mostly_within("furnished room", &r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cone_on_a_plate),      cmocka_unit_test(ring_on_a_plate),
        cmocka_unit_test(thin_fan_on_a_plate),  cmocka_unit_test(shadow_on_a_plate),
        cmocka_unit_test(thresholds_on_plates), cmocka_unit_test(furnished_rooms),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
