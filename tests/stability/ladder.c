/* No trajectory is dearer than the one above it: what lines cost is at most half as much again as what parabolas do,
 * counted in flights of which the way is asked for. Of these a line has one to a patch or cell, a parabola up to two.
 */
#include "stage.h"

#define DEARER 1.5

static const double half_angles[] = {0.5, 5, 30, 60, 180}; /* deg */
static const sp_vec3 places[] = {{-0.61, 0.17, 1.23}, {0.13, -0.47, 1.11}, {0.2, 0.3, 1e-3}, {-0.999, 0.1, 0.7}};
static const double speeds[] = {8, 12, 100};

static size_t count_flights(const sp_evaluator *evaluator, sp_vec3 place, double speed, double half_angle)
{
    sp_error error = {0};
    sp_reach *reach = sp_evaluator_reach(evaluator, place, (sp_launch){.speed = speed}, sp_unit(sp_v(0.1, 0.4, -0.5)),
                                         deg(half_angle), &error);
    assert_no_error(&error);
    size_t count = reach->count;
    sp_reach_destroy(reach);
    return count;
}

/* In a room without obstacles, so that none is left out because something lies in its way. They are fast enough
 * to come to every wall as parabolas too. */
static void lines_are_no_dearer_than_parabolas(void **state)
{
    (void)state;
    rectangle faces[6];
    box_rectangles(sp_v(-1, -0.8, 0), sp_v(2, 1.6, 1.5), faces);
    sp_evaluator *rungs[2];
    scene scenes[2];
    for (int k = 0; k < 2; k++) {
        scene_open(&scenes[k], mesh_of_rectangles(faces, 6), k ? SP_TRAJECTORY_PARABOLA : SP_TRAJECTORY_LINE,
                   STAGE_TEXEL);
        scenes[k].setup.cavity = SP_CAVITY_POINT;
        scenes[k].setup.cavity_point = sp_v(0.6, -0.4, 1.2);
        rungs[k] = scene_evaluator(&scenes[k]);
    }
    double worst = 0;
    size_t compared = 0;
    for (int i = 0; i < 4; i++)
        for (int v = 0; v < 3; v++)
            for (int a = 0; a < 5; a++) {
                size_t line = count_flights(rungs[0], places[i], speeds[v], half_angles[a]);
                size_t parabola = count_flights(rungs[1], places[i], speeds[v], half_angles[a]);
                if (line < 50 || parabola < 50) /* a stream within a few texels */
                    continue;
                compared++;
                worst = fmax(worst, (double)line / (double)parabola);
                if ((double)line > DEARER * (double)parabola)
                    fail_msg("place %d, %g m/s, %g deg: %zu flights as lines, %zu as parabolas", i, speeds[v],
                             half_angles[a], line, parabola);
            }
    print_message("lines take %.2f times the flights of parabolas at most, of %zu sprays\n", worst, compared);
    assert_true(compared > 20);
    for (int k = 0; k < 2; k++) {
        sp_evaluator_destroy(rungs[k]);
        scene_close(&scenes[k]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(lines_are_no_dearer_than_parabolas)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
