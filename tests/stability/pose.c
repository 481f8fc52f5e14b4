/* The same scene at another size, place or attitude covers the same. */
#include "stage.h"

#include <stdio.h>

/* Another pose rounds otherwise, so that charts are cut otherwise where two ways are equally good; what is left is the
 * error of the texels themselves: at the edges of sprays each is in or out. Of N ~ 1/texel such texels about √N fall
 * one way, each of texel², so that the error goes with texel^1.5. The factors were set from what texels of 23.7 mm
 * showed, up to 0.1 points (inverse) and 0.22 (forward), not derived. */
static const double coverage_bounds[] = {0.001, 0.0025}; /* in points, as a fraction: inverse, forward; at 23.7 mm */
static const double liquid_at_fine = 0.006, mean_at_fine = 0.002;

static double coarseness(void)
{
    return pow(STAGE_TEXEL / 0.0237, 1.5);
}

static const sp_vec3 z_up = {0, 0, 1}, y_up = {0, 1, 0};
static const char *const evaluators[] = {"inverse", "forward"};

/* By the inverse and by the forward evaluator. */
typedef struct {
    summary by[2];
} result;

static result run(sp_trajectory trajectory, const sp_transform *pose, sp_vec3 up)
{
    stage st;
    stage_open(&st, trajectory, pose, up);
    sp_evaluator *evaluator = scene_evaluator(&st.s);
    result r;
    for (int k = 0; k < 2; k++) {
        r.by[k] = summarise(evaluator, st.nozzles, 2, k == 0);
        r.by[k].area /= pose->scale * pose->scale;
        r.by[k].speed /= pose->scale;
    }
    sp_evaluator_destroy(evaluator);
    stage_close(&st);
    return r;
}

/* Worth comparing with: neither all nor nothing is covered, and all liquid lands in the room. */
static result at_home(sp_trajectory trajectory)
{
    sp_transform pose = sp_transform_default();
    result r = run(trajectory, &pose, z_up);
    for (int k = 0; k < 2; k++) {
        print_message("at home, %s: coverage %.5f, landed %.5f\n", evaluators[k], r.by[k].fraction, r.by[k].landed);
        assert_true(r.by[k].fraction > 0.2 && r.by[k].fraction < 0.8);
        assert_true(fabs(r.by[k].landed - 1) < (k ? 1e-9 : liquid_at_fine * coarseness()));
    }
    return r;
}

static void assert_like(const char *what, double number, sp_trajectory trajectory, result found, result home)
{
    for (int k = 0; k < 2; k++) {
        const summary *a = &found.by[k], *b = &home.by[k];
        char text[160];
        snprintf(text, sizeof text,
                 "%s %g, %s, %s: coverage %.5f %+.5f, liquid %+.5f, speed %+.5f %%, incidence %+.5f %%", what, number,
                 trajectory == SP_TRAJECTORY_LINE ? "lines" : "parabolas", evaluators[k], a->fraction,
                 a->fraction - b->fraction, a->landed - b->landed, 100 * (a->speed / b->speed - 1),
                 100 * (a->incidence / b->incidence - 1));
        print_message("%s\n", text);
        bool like = fabs(a->area / b->area - 1) < 1e-9 &&
                    fabs(a->fraction - b->fraction) <= coverage_bounds[k] * coarseness() &&
                    fabs(a->landed - b->landed) <= (k ? 1e-9 : liquid_at_fine * coarseness()) &&
                    fabs(a->speed / b->speed - 1) <= mean_at_fine * coarseness() &&
                    fabs(a->incidence / b->incidence - 1) <= mean_at_fine * coarseness();
        if (!like)
            fail_msg("%s", text);
    }
}

static void any_size(void **state)
{
    (void)state;
    static const double scales[] = {1e-6, 0.3, 1e6};
    for (int t = SP_TRAJECTORY_LINE; t <= SP_TRAJECTORY_PARABOLA; t++) {
        sp_trajectory trajectory = (sp_trajectory)t;
        result home = at_home(trajectory);
        for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
            sp_transform pose = sp_transform_default();
            pose.scale = scales[i];
            assert_like("size", scales[i], trajectory, run(trajectory, &pose, z_up), home);
        }
    }
}

/* A power of two rounds nothing: whatever differs then compares a length with a number. */
static void a_power_of_two_changes_no_bit(void **state)
{
    (void)state;
    for (int t = SP_TRAJECTORY_LINE; t <= SP_TRAJECTORY_PARABOLA; t++) {
        result home = at_home((sp_trajectory)t);
        for (int power = -20; power <= 20; power += 40) {
            sp_transform pose = sp_transform_default();
            pose.scale = ldexp(1, power);
            result found = run((sp_trajectory)t, &pose, z_up);
            for (int k = 0; k < 2; k++) {
                assert_true(found.by[k].area == home.by[k].area);
                assert_true(found.by[k].fraction == home.by[k].fraction);
                assert_true(found.by[k].landed == home.by[k].landed);
                assert_true(found.by[k].speed == home.by[k].speed);
                assert_true(found.by[k].incidence == home.by[k].incidence);
            }
        }
    }
}

static void any_place(void **state)
{
    (void)state;
    static const double distances[] = {1e3, 1e5};
    for (int t = SP_TRAJECTORY_LINE; t <= SP_TRAJECTORY_PARABOLA; t++) {
        sp_trajectory trajectory = (sp_trajectory)t;
        result home = at_home(trajectory);
        for (size_t i = 0; i < sizeof distances / sizeof *distances; i++) {
            sp_transform pose = sp_transform_default();
            pose.translate = sp_scale(sp_v(0.8, -0.7, 0.31), distances[i]);
            assert_like("moved", distances[i], trajectory, run(trajectory, &pose, z_up), home);
        }
    }
}

static void any_attitude(void **state)
{
    (void)state;
    result lines = at_home(SP_TRAJECTORY_LINE), parabolas = at_home(SP_TRAJECTORY_PARABOLA);
    for (int i = 1; i <= 2; i++) {
        sp_transform pose = sp_transform_default();
        sp_transform_rotation(&pose, sp_v(cos(3.0 * i), sin(5.0 * i), cos(7.0 * i)), 1.9 * i);
        assert_like("rotation", i, SP_TRAJECTORY_LINE, run(SP_TRAJECTORY_LINE, &pose, z_up), lines);
        sp_transform_rotation(&pose, z_up, 2.1 * i);
        assert_like("turn about z", i, SP_TRAJECTORY_PARABOLA, run(SP_TRAJECTORY_PARABOLA, &pose, z_up), parabolas);
    }
    sp_transform pose = sp_transform_default();
    sp_transform_rotation(&pose, sp_v(1, 0, 0), -M_PI / 2);
    assert_like("y up", 0, SP_TRAJECTORY_PARABOLA, run(SP_TRAJECTORY_PARABOLA, &pose, y_up), parabolas);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_size),
        cmocka_unit_test(a_power_of_two_changes_no_bit),
        cmocka_unit_test(any_place),
        cmocka_unit_test(any_attitude),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
