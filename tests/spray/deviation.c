/* Lines in place of parabolas: the formula for how far they are apart, against the flights themselves, and the bound on
 * what that does to a coverage, against both coverages, by patches and by points. */
#include "../closed-form/measure.h"

#include <sprayplan/deviation.h>
#include <sprayplan/points.h>

#include <stdlib.h>
#include <string.h>

#ifdef SPRAYPLAN_SANITIZE
#define CASES 24
#else
#define CASES 240
#endif
#define FLIGHTS 200000
#define POINTS 4000

static double random_share(void)
{
    static uint64_t state = 88172645463325252u;
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return (double)(state >> 11) * 0x1p-53;
}

static double between(double low, double high)
{
    return low + (high - low) * random_share();
}

static bool one_in(int n)
{
    return random_share() * n < 1;
}

static sp_vec3 random_direction(void)
{
    double z = between(-1, 1), turn = between(0, 2 * M_PI), r = sqrt(1 - z * z);
    return sp_v(r * cos(turn), r * sin(turn), z);
}

/* Many of the flights are nearly upright, where the formula is reached. */
static void lines_deviate_as_the_formula_says(void **state)
{
    (void)state;
    double most = 0;
    for (int i = 0; i < FLIGHTS; i++) {
        double speed = pow(10, between(-1, 2)), g = pow(10, between(-1, 2));
        double eps = one_in(2) ? between(1e-9, 0.5) : pow(10, between(-9, -0.31));
        sp_vec3 gravity = sp_scale(random_direction(), g), way = random_direction();
        if (one_in(2))
            way = sp_unit(sp_along(sp_scale(gravity, -1 / g), pow(10, between(-6, 0)), way));
        sp_vec3 from = sp_scale(random_direction(), between(0, 0.01));
        sp_vec3 to = sp_along(from, eps * speed * speed / g, way);
        sp_flight flights[2];
        assert_int_equal(sp_flights(from, to, speed, gravity, flights), 2);
        sp_vec3 line = sp_unit(sp_sub(to, from));
        double angle = atan2(sp_length(sp_cross(line, flights[0].direction)), sp_dot(line, flights[0].direction));
        double said = sp_line_deviation(from, to, speed, gravity);
        if (!(angle <= said * (1 + 1e-9) + 1e-15))
            fail_msg("a flight of eps %.17g is off by %.17g, the formula says %.17g", eps, angle, said);
        most = said > 1e-9 ? fmax(most, angle / said) : most;
    }
    print_message("largest deviation over the formula's: 1 - %.3g\n", 1 - most);
    assert_true(most > 1 - 1e-6);
    assert_true(sp_line_deviation(sp_v(0, 0, 0), sp_v(0, 0, 1), 4, sp_v(0, 0, -9.81)) == INFINITY);
}

/* A room with sheets and balls in it; some lack a wall. */
static sp_mesh *random_room(void)
{
    rectangle faces[9];
    box_rectangles(sp_v(-1, -0.8, 0), sp_v(2, 1.6, 1.5), faces);
    size_t count = 6;
    if (one_in(3))
        faces[(int)between(0, 6)] = faces[--count];
    for (int sheets = (int)between(0, 4); sheets > 0; sheets--) {
        sp_vec3 u = sp_scale(random_direction(), between(0.05, 0.6)),
                v = sp_scale(random_direction(), between(0.05, 0.6));
        if (one_in(2))
            u.z = v.z = 0;
        sp_vec3 middle = sp_v(between(-0.6, 0.6), between(-0.5, 0.5), between(0.3, 1.2));
        faces[count++] = (rectangle){sp_along(sp_along(middle, -0.5, u), -0.5, v), u, v};
    }
    sp_mesh *pieces[3] = {mesh_of_rectangles(faces, count)};
    sp_transform places[3] = {sp_transform_default(), sp_transform_default(), sp_transform_default()};
    size_t balls = (size_t)between(0, 3);
    for (size_t i = 1; i <= balls; i++) {
        pieces[i] = mesh_of_sphere(between(0.03, 0.25), 2);
        places[i].translate = sp_v(between(-0.7, 0.7), between(-0.5, 0.5), between(0.3, 1.2));
    }
    sp_mesh *room = sp_mesh_join((const sp_mesh *const *)pieces, places, balls + 1, NULL);
    assert_non_null(room);
    for (size_t i = 0; i <= balls; i++)
        sp_mesh_destroy(pieces[i]);
    return room;
}

static sp_nozzle_type random_type(void)
{
    static const double angles[4][2] = {{20, 360}, {40, 150}, {30, 120}, {0.5, 10}};
    int pattern = (int)between(0, 4);
    sp_nozzle_type type = spray_type((sp_pattern)pattern, between(angles[pattern][0], angles[pattern][1]));
    type.hollow = between(0.1, 0.95);
    type.thickness = deg(one_in(2) ? between(0.5, 3) : between(5, 60));
    return type;
}

/* Lines and parabolas on the same patches. */
typedef struct {
    scene s;
    sp_evaluator *evaluators[2];
    sp_nozzle_type types[3];
    sp_nozzle nozzles[3];
    sp_layout *layout;
} trial;

static void trial_open(trial *t)
{
    sp_error error = {0};
    scene_open(&t->s, random_room(), SP_TRAJECTORY_LINE, between(0.06, 0.16) / COARSER);
    sp_setup *setup = &t->s.setup;
    setup->fidelity.method = SP_METHOD_INVERSE;
    setup->criterion =
        (sp_criterion){one_in(2) ? 0 : pow(10, between(-6, -3.5)), one_in(2) ? 0 : between(1, 8),
                       one_in(2) ? M_PI / 2 : deg(between(40, 89)), one_in(2) ? SP_COMBINE_SUM : SP_COMBINE_SINGLE, 0};
    setup->gravity = one_in(8) ? 1 : 9.81;
    for (int k = 0; k < 2; k++) {
        setup->fidelity.trajectory = k ? SP_TRAJECTORY_PARABOLA : SP_TRAJECTORY_LINE;
        t->evaluators[k] = scene_evaluator(&t->s);
    }
    size_t count = 1 + (size_t)between(0, 3);
    for (size_t i = 0; i < count; i++) {
        sp_vec3 place = sp_v(between(-0.95, 0.95), between(-0.75, 0.75), between(0.05, 1.45));
        t->types[i] = random_type();
        t->nozzles[i] = nozzle_at(&t->types[i], place, random_direction(), pow(10, between(0.3, 1.8)));
        t->nozzles[i].roll = between(0, 6);
    }
    t->layout = sp_layout_create(t->nozzles, count, &error);
    assert_no_error(&error);
}

static void trial_close(trial *t)
{
    sp_layout_destroy(t->layout);
    sp_evaluator_destroy(t->evaluators[0]);
    sp_evaluator_destroy(t->evaluators[1]);
    scene_close(&t->s);
}

static void assert_patches_agree(const trial *t, const bool *decided, double bound)
{
    sp_coverage *coverage[2];
    for (int k = 0; k < 2; k++)
        coverage[k] = scene_cover(t->evaluators[k], t->layout->nozzles, t->layout->count, true);
    assert_int_equal(coverage[0]->deposits.count, coverage[1]->deposits.count);
    for (size_t i = 0; i < coverage[0]->deposits.count; i++) {
        double line = coverage[0]->deposits.share[i], parabola = coverage[1]->deposits.share[i];
        if (decided[i] && !(line == parabola && (line == 0 || line == 1)))
            fail_msg("patch %zu is decided, but lines cover %g of it, parabolas %g", i, line, parabola);
    }
    assert_true(fabs(coverage[0]->fraction - coverage[1]->fraction) <= bound + 1e-12);
    sp_coverage_destroy(coverage[0]);
    sp_coverage_destroy(coverage[1]);
}

/* The share of points at which lines and parabolas differ. */
static double assert_points_agree(const trial *t, const bool *decided)
{
    static sp_point drawn[POINTS];
    static bool covered[2][POINTS];
    sp_error error = {0};
    sp_points *points = sp_points_create(t->evaluators[0], &error);
    for (size_t i = 0; i < POINTS; i++)
        drawn[i] = sp_points_draw(points, i, POINTS, 1);
    for (int k = 0; k < 2; k++)
        assert_true(sp_points_judge(t->evaluators[0], t->layout, k ? SP_TRAJECTORY_PARABOLA : SP_TRAJECTORY_LINE, drawn,
                                    POINTS, covered[k], &error));
    size_t differ = 0;
    for (size_t i = 0; i < POINTS; i++) {
        bool apart = covered[0][i] != covered[1][i];
        if (apart && drawn[i].patch != SP_NONE && decided[drawn[i].patch])
            fail_msg("a point of patch %u, which is decided, is covered by one of line and parabola", drawn[i].patch);
        differ += apart;
    }
    sp_points_destroy(points);
    return (double)differ / POINTS;
}

static void coverage_differs_within_the_bound(void **state)
{
    (void)state;
    size_t telling = 0;
    double differ = 0, bounds = 0;
    for (int i = 0; i < CASES; i++) {
        trial t;
        trial_open(&t);
        size_t patches = sp_evaluator_patches(t.evaluators[0])->count;
        bool *decided[2] = {calloc(patches, 1), calloc(patches, 1)};
        double bound[2];
        sp_error error = {0};
        for (int k = 0; k < 2; k++)
            assert_true(sp_bound_lines(t.evaluators[k], t.layout, &bound[k], decided[k], &error));
        assert_true(bound[0] == bound[1] && memcmp(decided[0], decided[1], patches) == 0);
        assert_patches_agree(&t, decided[0], bound[0]);
        differ += assert_points_agree(&t, decided[0]) / CASES;
        bounds += bound[0] / CASES;
        telling += bound[0] < 0.2;
        free(decided[0]);
        free(decided[1]);
        trial_close(&t);
    }
    print_message(
        "%d rooms: lines and parabolas differ at %.2f %% of the points, bound %.1f %% on average, below 20 %% "
        "in %zu\n",
        CASES, 100 * differ, 100 * bounds, telling);
    assert_true(differ > 0.002 && 5 * telling > CASES);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_deviate_as_the_formula_says),
        cmocka_unit_test(coverage_differs_within_the_bound),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
