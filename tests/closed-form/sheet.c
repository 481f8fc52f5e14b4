/* A sheet of two large triangles, against which both evaluators are run: a parabola may come through the very triangle
 * that it is aimed at, from beneath, which fine triangles hide. */
#include "measure.h"

#include <stdio.h>

#ifdef SPRAYPLAN_SANITIZE
#define MANY 200000
#define POINTS 0.01 /* of coverage */
#define SHARE 0.02  /* and of what is covered */
#define ATTITUDES 3
#else
#define MANY 2000000
#define POINTS 0.002
#define SHARE 0.005
#define ATTITUDES 8
#endif
#define EDGE 2.0 /* m */

/* A square about a point, its front along the normal. */
static sp_mesh *sheet_mesh(sp_vec3 middle, sp_vec3 normal, double turn)
{
    sp_vec3 x = sp_unit(sp_cross(fabs(normal.x) < 0.5 ? sp_v(1, 0, 0) : sp_v(0, 1, 0), normal));
    sp_vec3 y = sp_cross(normal, x), vertices[4];
    for (int k = 0; k < 4; k++) {
        double angle = turn + (k + 0.5) * M_PI / 2, radius = EDGE / sqrt(2);
        vertices[k] = sp_along(sp_along(middle, radius * cos(angle), x), radius * sin(angle), y);
    }
    const uint32_t triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
    return sp_mesh_create(vertices, 4, triangles, 2, NULL, NULL, 0, NULL);
}

/* Shares of the sheet by both evaluators, which have to agree. */
static double covered_share(const char *what, sp_mesh *mesh, sp_trajectory trajectory, const sp_nozzle *nozzle)
{
    sp_error error = {0};
    scene s;
    scene_open(&s, mesh, trajectory, 0.02);
    sp_evaluator *evaluator = scene_evaluator(&s);
    sp_layout *layout = sp_layout_create(nozzle, 1, &error);
    sp_coverage *inverse = sp_evaluate_inverse(evaluator, layout, &error);
    sp_coverage *forward = sp_evaluate_forward(evaluator, layout, 0, MANY, &error);
    assert_no_error(&error);
    assert_non_null(inverse);
    assert_non_null(forward);
    double share = inverse->fraction;
    print_message("%-40s inverse %8.4f %%, forward %8.4f %%\n", what, 100 * share, 100 * forward->fraction);
    if (!(fabs(share - forward->fraction) <= POINTS + SHARE * share))
        fail_msg("%s: %.4f %% by the inverse evaluator, %.4f %% by the forward one", what, 100 * share,
                 100 * forward->fraction);
    sp_coverage_destroy(inverse);
    sp_coverage_destroy(forward);
    sp_layout_destroy(layout);
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
    return share;
}

/* The edge of a cone that is sprayed upwards, where it comes to a height: from v cos a t - g t²/2 = h. */
static double radius_at(double speed, double half_angle, double height)
{
    const double g = 9.81;
    double rise = speed * cos(half_angle), time = (rise - sqrt(rise * rise - 2 * g * height)) / g;
    return speed * sin(half_angle) * time;
}

static void washed_from_beneath(void **state)
{
    (void)state;
    const sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 60);
    const double speed = 0.95 * sqrt(2 * 2e5 / 1000), whole = EDGE * EDGE, height = 0.5;
    sp_nozzle nozzle = nozzle_at(&type, sp_v(0, 0, 1 - height), sp_v(0, 0, 1), 0);
    double radius[2] = {radius_at(speed, deg(30), height), height * tan(deg(30))};
    for (int line = 0; line < 2; line++) {
        double expected = M_PI * radius[line] * radius[line] / whole;
        sp_mesh *mesh = sheet_mesh(sp_v(0, 0, 1), sp_v(0, 0, 1), 0);
        double share = covered_share(line ? "from beneath, line" : "from beneath, parabola", mesh,
                                     line ? SP_TRAJECTORY_LINE : SP_TRAJECTORY_AUTO, &nozzle);
        assert_float_equal(share, expected, POINTS / 2);
        assert_float_equal(share, 0.065, 0.002);
    }
}

/* Sheets turned every way, washed from either side, near and slowly enough for what goes past an edge to fall back. */
static void turned_every_way(void **state)
{
    (void)state;
    const sp_nozzle_type types[3] = {spray_type(SP_PATTERN_FULL_CONE, 100), spray_type(SP_PATTERN_HOLLOW_CONE, 70),
                                     spray_type(SP_PATTERN_FLAT_FAN, 120)};
    for (int i = 0; i < ATTITUDES; i++) {
        double height = 1 - (2 * i + 1.0) / ATTITUDES, around = 2.4 * i, level = sqrt(1 - height * height);
        sp_vec3 normal = sp_v(level * cos(around), level * sin(around), height), middle = sp_v(0.3, -0.2, 1);
        sp_vec3 aside = sp_unit(sp_cross(normal, sp_v(0.6, -0.48, 0.64)));
        sp_vec3 position = sp_along(sp_along(middle, i % 2 ? 0.4 : -0.6, normal), 0.3, aside);
        sp_vec3 axis = sp_along(sp_sub(middle, position), 0.2, aside);
        sp_nozzle nozzle = nozzle_at(&types[i % 3], position, axis, i % 4 < 2 ? 5 : 12);
        for (int line = 0; line < 2; line++) {
            char what[64];
            snprintf(what, sizeof what, "attitude %d, %s", i, line ? "line" : "parabola");
            covered_share(what, sheet_mesh(middle, normal, 0.7 * i), line ? SP_TRAJECTORY_LINE : SP_TRAJECTORY_AUTO,
                          &nozzle);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(washed_from_beneath),
        cmocka_unit_test(turned_every_way),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
