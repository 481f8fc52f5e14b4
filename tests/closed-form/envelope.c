/* The ballistic envelope: what a nozzle that sprays everywhere can reach. The parabola of safety over the nozzle is
 * z = v²/2g - g ρ²/2v². */
#include "measure.h"

static const double v = 5, g = 9.81;

static void envelope_on_a_floor(void **state)
{
    (void)state;
    const double h = 1;
    double radius = v / g * sqrt(v * v + 2 * g * h);
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 360);
    sp_nozzle nozzle = nozzle_at(&type, sp_v(0.013, -0.007, h), sp_v(0, 0, -1), v);
    rectangle floor = level_rectangle(2.2 * radius, 2.2 * radius, 0);
    scene s;
    scene_open(&s, mesh_of_rectangles(&floor, 1), SP_TRAJECTORY_PARABOLA, radius / 150);
    assert_covers("envelope on a floor", &s, &nozzle, 1, M_PI * radius * radius, BY_BOTH);
    scene_close(&s);
}

/* On a wall at distance d it is the segment of a parabola over the wall's foot. */
static void envelope_on_a_wall(void **state)
{
    (void)state;
    const double h = 0.5, d = 1;
    double top = v * v / (2 * g) - g * d * d / (2 * v * v) + h, half_width = v * sqrt(2 * top / g);
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 360);
    sp_nozzle nozzle = nozzle_at(&type, sp_v(0, 0, h), sp_v(0, 1, 0), v);
    rectangle wall = {sp_v(d, -1.1 * half_width, 0), sp_v(0, 0, 1.2 * top), sp_v(0, 2.2 * half_width, 0)};
    scene s;
    scene_open(&s, mesh_of_rectangles(&wall, 1), SP_TRAJECTORY_PARABOLA, top / 200);
    assert_covers("envelope on a wall", &s, &nozzle, 1, 4.0 / 3 * top * half_width, BY_BOTH);
    scene_close(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(envelope_on_a_floor),
        cmocka_unit_test(envelope_on_a_wall),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
