/* Full and hollow cones on planes and inside a sphere. */
#include "measure.h"

/* One level floor below a nozzle at height h. */
static void assert_on_floor(const char *what, const sp_nozzle *nozzle, double edge, sp_trajectory trajectory,
                            double texel, double area)
{
    scene s;
    rectangle floor = level_rectangle(edge, edge, 0);
    scene_open(&s, mesh_of_rectangles(&floor, 1), trajectory, texel);
    assert_covers(what, &s, nozzle, 1, area, BY_BOTH);
    scene_close(&s);
}

static void full_cone_on_a_plane(void **state)
{
    (void)state;
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 80);
    sp_nozzle nozzle = nozzle_at(&type, sp_v(0.013, -0.007, 1.2), sp_v(0, 0, -1), 0);
    double radius = 1.2 * tan(deg(40));
    assert_on_floor("full cone on a plane", &nozzle, 2.4, SP_TRAJECTORY_LINE, 0.005, M_PI * radius * radius);
}

/* A jet at the cone's edge falls h = v cos(a) t + g t²/2 while it flies v sin(a) t outwards. */
static void full_cone_of_parabolas_on_a_plane(void **state)
{
    (void)state;
    const double h = 1.2, v = 4, a = deg(40), g = 9.81;
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 80);
    sp_nozzle nozzle = nozzle_at(&type, sp_v(0.013, -0.007, h), sp_v(0, 0, -1), v);
    double time = (sqrt(v * v * cos(a) * cos(a) + 2 * g * h) - v * cos(a)) / g, radius = v * sin(a) * time;
    assert_on_floor("full cone of parabolas on a plane", &nozzle, 2, SP_TRAJECTORY_PARABOLA, 0.004,
                    M_PI * radius * radius);
}

/* The cone (p · axis)² = cos²(a) p² meets the plane at distance h in an ellipse. */
static void full_cone_on_a_tilted_plane(void **state)
{
    (void)state;
    const double h = 1, a = deg(25), b = deg(35);
    double near = h * tan(b - a), far = h * tan(b + a), middle = 0.5 * (near + far);
    double reach = (middle * sin(b) + h * cos(b)) / cos(a);
    double half_width = sqrt(reach * reach - middle * middle - h * h);
    double area = M_PI * 0.5 * (far - near) * half_width;
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 50);

    sp_nozzle leaning = nozzle_at(&type, sp_v(-0.9, 0.01, h), sp_v(sin(b), 0, -cos(b)), 0);
    assert_on_floor("leaning cone on a plane", &leaning, 3, SP_TRAJECTORY_LINE, 0.004, area);

    scene s; /* the same the other way about: the plane leans */
    sp_vec3 u = sp_v(cos(b), 0, sin(b)), v = sp_v(0, 1, 0), n = sp_v(-sin(b), 0, cos(b));
    rectangle plane = {sp_along(sp_along(sp_v(0, 0, 0), -1.6, u), -1.6, v), sp_scale(u, 3.2), sp_scale(v, 3.2)};
    scene_open(&s, mesh_of_rectangles(&plane, 1), SP_TRAJECTORY_LINE, 0.004);
    sp_nozzle upright = nozzle_at(&type, sp_along(sp_scale(n, h), 0.9, u), sp_v(0, 0, -1), 0);
    assert_covers("cone on a tilted plane", &s, &upright, 1, area, BY_BOTH);
    scene_close(&s);
}

/* From an apex at distance e from the centre, on the cone's axis, a jet at the polar angle a meets the sphere at the
 * angle a - asin(e sin(a) / R) from the axis, seen from the centre (law of sines). */
static void full_cone_in_a_sphere(void **state)
{
    (void)state;
    const double radius = 1, e = 0.4, a = deg(50);
    double cap = a - asin(e * sin(a) / radius);
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 100);
    sp_vec3 axis = sp_unit(sp_v(0.3, -0.5, -0.8));
    scene s;
    scene_open(&s, mesh_of_sphere(radius, COARSER > 1 ? 5 : 6), SP_TRAJECTORY_LINE, 0.005);
    sp_nozzle nozzle = nozzle_at(&type, sp_scale(axis, e), axis, 0);
    assert_covers("cone in a sphere, offset apex", &s, &nozzle, 1, 2 * M_PI * radius * radius * (1 - cos(cap)),
                  BY_BOTH);
    scene_close(&s);
}

static void hollow_cone_on_a_plane(void **state)
{
    (void)state;
    sp_nozzle_type type = spray_type(SP_PATTERN_HOLLOW_CONE, 90);
    type.hollow = 0.5;
    sp_nozzle nozzle = nozzle_at(&type, sp_v(0.013, -0.007, 1), sp_v(0, 0, -1), 0);
    double outer = tan(deg(45)), inner = tan(deg(22.5));
    assert_on_floor("hollow cone on a plane", &nozzle, 2.2, SP_TRAJECTORY_LINE, 0.003,
                    M_PI * (outer * outer - inner * inner));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(full_cone_on_a_plane),        cmocka_unit_test(full_cone_of_parabolas_on_a_plane),
        cmocka_unit_test(full_cone_on_a_tilted_plane), cmocka_unit_test(full_cone_in_a_sphere),
        cmocka_unit_test(hollow_cone_on_a_plane),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
