/* However little of its speed a wall gives back, no liquid leaves a closed vessel: what is thrown back arrives again,
 * and where it ended adds up. Hops soon are lower than what coordinates are rounded to; then it stays on the wall. */
#include "stage.h"

#ifdef SPRAYPLAN_SANITIZE
#define BOUNCE_JETS 500
#else
#define BOUNCE_JETS 2000
#endif

static const double restitutions[] = {1, 0.6, 0.1, 0.05, 0.01};
static const int reflections[] = {5, 20, 100};

static sp_mesh *turned(sp_mesh *mesh)
{
    sp_transform pose = sp_transform_default();
    sp_transform_rotation(&pose, sp_v(0.3, 0.5, -0.8), 1.3);
    sp_mesh *posed = sp_mesh_join((const sp_mesh *const *)&mesh, &pose, 1, NULL);
    sp_mesh_destroy(mesh);
    return posed;
}

static sp_mesh *box(void)
{
    rectangle faces[6];
    box_rectangles(sp_v(-0.9, -0.8, -0.7), sp_v(1.9, 1.7, 1.5), faces);
    return mesh_of_rectangles(faces, 6);
}

/* 2 m long and 1 m wide; its bottom an edge of 53 degrees, or one of 6. */
static sp_mesh *trough(double depth)
{
    const sp_vec3 corner[6] = {{-1, -0.5, 0.5}, {-1, 0.5, 0.5}, {-1, 0.02, 0.5 - depth},
                               {1, -0.5, 0.5},  {1, 0.5, 0.5},  {1, -0.02, 0.5 - depth}};
    static const uint32_t triangle[8][3] = {{0, 1, 2}, {3, 5, 4}, {0, 3, 4}, {0, 4, 1},
                                            {0, 2, 5}, {0, 5, 3}, {1, 4, 5}, {1, 5, 2}};
    return sp_mesh_create(corner, 6, triangle, 8, NULL, NULL, 0, NULL);
}

/* What has not come to rest yet has arrived as often as it may, and none leaves. Off mirrors none comes to rest. */
static void assert_none_is_lost(const char *vessel, sp_mesh *mesh)
{
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 120);
    sp_nozzle nozzle = nozzle_at(&type, sp_v(0.1, 0.04, 0.3), sp_v(0.3, 0.2, -0.5), 6);
    double worst = 0;
    scene s;
    scene_open(&s, mesh, SP_TRAJECTORY_LINE, 0.1);
    s.setup.fidelity.jets = BOUNCE_JETS;
    s.setup.cavity = SP_CAVITY_POINT;
    s.setup.cavity_point = nozzle.position;
    for (int way = 0; way < 2 * 5 * 3; way++) {
        double restitution = restitutions[way / 2 % 5];
        bool rests = restitution < 1;
        s.setup.fidelity.trajectory = way % 2 ? SP_TRAJECTORY_PARABOLA : SP_TRAJECTORY_LINE;
        s.setup.fidelity.reflections = reflections[way / 10];
        for (size_t p = 0; p < PARTS; p++)
            s.surfaces[p] = (sp_surface){.clean = true, .restitution = restitution, .rebound = 1};
        sp_evaluator *evaluator = scene_evaluator(&s);
        sp_coverage *coverage = sound_cover(evaluator, &nozzle, 1, false);
        const sp_balance *ended = &coverage->balance;
        double flow = coverage->flow, all = s.setup.fidelity.reflections + 1;
        double impacts = share_landed(coverage), off = fabs((ended->clean + ended->unfollowed) / flow - 1);
        double least = ended->clean / flow + all * ended->unfollowed / flow;
        bool arrives = rests ? impacts > least - 1e-9 && impacts < all + 1e-9 : fabs(impacts / all - 1) < 1e-9;
        if (!(arrives && off < 1e-9 && ended->left == 0 && ended->other == 0))
            fail_msg("%s, restitution %g, %.0f impacts at most, trajectory %d: %g impacts, %g of the liquid left it",
                     vessel, restitution, all, s.setup.fidelity.trajectory, impacts, ended->left / flow);
        worst = fmax(worst, fmax(off, rests ? 0 : fabs(impacts / all - 1)));
        sp_coverage_destroy(coverage);
        sp_evaluator_destroy(evaluator);
    }
    print_message("%s: liquid off by %.2g at most\n", vessel, worst);
    scene_close(&s);
}

static void in_a_box(void **state)
{
    (void)state;
    assert_none_is_lost("box", box());
    assert_none_is_lost("box, turned", turned(box()));
}

static void in_a_sphere(void **state)
{
    (void)state;
    assert_none_is_lost("sphere", mesh_of_sphere(1, 3));
}

static void in_troughs(void **state)
{
    (void)state;
    assert_none_is_lost("trough of 53 degrees", trough(1));
    assert_none_is_lost("trough of 6 degrees", trough(10));
}

/* A stream straight down arrives once more for every hop, the last of which is the first lower than 2^-30 of the box.
 */
static void as_often_as_it_comes_off(void **state)
{
    (void)state;
    const double speed = 6, height = 1, g = 9.81, extent = 1.0;
    sp_nozzle_type type = spray_type(SP_PATTERN_SOLID_STREAM, 0.01);
    sp_nozzle nozzle = nozzle_at(&type, sp_v(0.1, 0.04, 0.3), sp_v(0, 0, -1), speed);
    scene s;
    scene_open(&s, box(), SP_TRAJECTORY_PARABOLA, 0.1);
    s.setup.fidelity.jets = 100;
    s.setup.fidelity.reflections = 1000;
    for (int i = 1; i < 5; i++) {
        for (size_t p = 0; p < PARTS; p++)
            s.surfaces[p].restitution = restitutions[i];
        double across = sqrt(speed * speed + 2 * g * height) * restitutions[i];
        int impacts = 2;
        for (; across * across / (2 * g) >= 0x1p-30 * extent; impacts++)
            across *= restitutions[i];
        sp_evaluator *evaluator = scene_evaluator(&s);
        sp_coverage *coverage = sound_cover(evaluator, &nozzle, 1, false);
        print_message("restitution %g: %.9f impacts, %d expected\n", restitutions[i], share_landed(coverage), impacts);
        assert_true(fabs(share_landed(coverage) - impacts) < 1e-9);
        assert_true(fabs(coverage->balance.clean / coverage->flow - 1) < 1e-9);
        sp_coverage_destroy(coverage);
        sp_evaluator_destroy(evaluator);
    }
    scene_close(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(in_a_box),
        cmocka_unit_test(in_a_sphere),
        cmocka_unit_test(in_troughs),
        cmocka_unit_test(as_often_as_it_comes_off),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
