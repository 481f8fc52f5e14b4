/* Which sides face the liquid. */
#include "shapes.h"

typedef struct {
    sp_mesh *mesh;
    sp_evaluator *evaluator;
} fixture;

/* As many as any mesh here has parts. */
static const sp_surface surfaces[] = {
    {true, 0, 1, false}, {true, 0, 1, false}, {true, 0, 1, false}, {true, 0, 1, false}};

static sp_setup setup_of(const fixture *f)
{
    sp_setup setup = sp_setup_default();
    setup.mesh = f->mesh;
    setup.surfaces = surfaces;
    setup.fidelity.texel = 0.05;
    setup.run.threads = 2;
    return setup;
}

static fixture build(shape *s, sp_cavity_kind cavity, sp_vec3 point)
{
    fixture f = {.mesh = shape_mesh(s)};
    sp_setup setup = setup_of(&f);
    setup.cavity = cavity;
    setup.cavity_point = point;
    sp_error error = {0};
    f.evaluator = sp_evaluator_create(&setup, &error);
    assert_string_equal(error.message, "");
    assert_non_null(f.evaluator);
    return f;
}

static void release(fixture *f)
{
    sp_evaluator_destroy(f->evaluator);
    sp_mesh_destroy(f->mesh);
}

/* Every triangle of the part named `name` is wet on exactly these sides. */
static void expect(const fixture *f, const char *name, unsigned sides)
{
    size_t seen = 0;
    for (uint32_t t = 0; t < f->mesh->triangle_count; t++) {
        if (strcmp(f->mesh->parts[f->mesh->part[t]].name, name))
            continue;
        seen++;
        if (sp_evaluator_wet(f->evaluator, t) != sides)
            fail_msg("%s: triangle %u is wet on %u, expected %u", name, t, sp_evaluator_wet(f->evaluator, t), sides);
    }
    assert_true(seen > 0);
}

enum { SEGMENTS = 48 };
static const double inner_profile[][2] = {{0, 0.02}, {0.5, 0.02}, {0.5, 1}, {0.1, 1}, {0.1, 1.2}};
static const double rim_profile[][2] = {{0.1, 1.2}, {0.12, 1.2}};
static const double outer_profile[][2] = {{0.12, 1.2}, {0.12, 1.02}, {0.52, 1.02}, {0.52, 0}, {0, 0}};

/* A vessel with a thick wall, an open neck and a sheet baffle. */
static shape thick_vessel(void)
{
    shape s = shape_create();
    shape_part(&s, "inner");
    shape_turned(&s, inner_profile, 5, SEGMENTS);
    shape_part(&s, "rim");
    shape_turned(&s, rim_profile, 2, SEGMENTS);
    shape_part(&s, "outer");
    shape_turned(&s, outer_profile, 5, SEGMENTS);
    shape_part(&s, "baffle");
    shape_sheet(&s, sp_v(0.35, 0, 0.1), sp_v(0.1, 0, 0), sp_v(0, 0, 0.8), 2);
    return s;
}

/* Area of a polygon of SEGMENTS corners turned along a profile: frustums of triangles. */
static double turned_area(const double (*profile)[2], int count)
{
    double area = 0, half = M_PI / SEGMENTS;
    for (int i = 0; i + 1 < count; i++) {
        double dr = (profile[i + 1][0] - profile[i][0]) * cos(half), dz = profile[i + 1][1] - profile[i][1];
        area += SEGMENTS * sin(half) * (profile[i][0] + profile[i + 1][0]) * sqrt(dr * dr + dz * dz);
    }
    return area;
}

static void thick_vessel_is_wet_inside_only(void **state)
{
    (void)state;
    shape s = thick_vessel();
    fixture f = build(&s, SP_CAVITY_POINT, sp_v(0.01, 0.2, 0.6));
    expect(&f, "inner", 1);
    expect(&f, "rim", 0);
    expect(&f, "outer", 0);
    expect(&f, "baffle", 3);

    const sp_patches *patches = sp_evaluator_patches(f.evaluator);
    double expected = turned_area(inner_profile, 5) + 2 * 0.1 * 0.8;
    assert_true(fabs(patches->total_area / expected - 1) < 1e-9);

    assert_true(sp_evaluator_inside(f.evaluator, sp_v(0.3, 0.2, 0.3)));
    assert_false(sp_evaluator_inside(f.evaluator, sp_v(0.51, 0, 0.5)));
    assert_false(sp_evaluator_inside(f.evaluator, sp_v(0.3, 0.2, 0.01)));
    assert_false(sp_evaluator_inside(f.evaluator, sp_v(0.9, 0, 0.5)));
    release(&f);
}

static void from_outside_the_opening_lets_the_flood_in(void **state)
{
    (void)state;
    shape s = thick_vessel();
    fixture f = build(&s, SP_CAVITY_OUTSIDE, sp_v(0, 0, 0));
    expect(&f, "inner", 1);
    expect(&f, "rim", 1);
    expect(&f, "outer", 1);
    expect(&f, "baffle", 3);
    assert_true(sp_evaluator_inside(f.evaluator, sp_v(0.9, 0, 0.5)));
    assert_true(sp_evaluator_inside(f.evaluator, sp_v(0.3, 0.2, 0.3)));
    assert_false(sp_evaluator_inside(f.evaluator, sp_v(0.51, 0, 0.5)));
    release(&f);
}

static shape shell(void)
{
    shape s = shape_create();
    shape_part(&s, "inner");
    shape_sphere(&s, 1, true, 32);
    shape_part(&s, "outer");
    shape_sphere(&s, 1.1, false, 32);
    return s;
}

static void shell_from_inside_and_outside(void **state)
{
    (void)state;
    shape s = shell();
    fixture f = build(&s, SP_CAVITY_POINT, sp_v(0, 0, 0));
    expect(&f, "inner", 1);
    expect(&f, "outer", 0);
    release(&f);
    s = shell();
    f = build(&s, SP_CAVITY_OUTSIDE, sp_v(0, 0, 0));
    expect(&f, "inner", 0);
    expect(&f, "outer", 1);
    assert_false(sp_evaluator_inside(f.evaluator, sp_v(0, 0, 0)));
    release(&f);
    s = shell();
    f = build(&s, SP_CAVITY_NONE, sp_v(0, 0, 0));
    expect(&f, "inner", 3);
    expect(&f, "outer", 3);
    assert_true(sp_evaluator_inside(f.evaluator, sp_v(5, 0, 0)));
    release(&f);
}

/* A solid that stands on the wall covers a piece of a large wall triangle: nothing may leak through the contact. */
static void solid_touching_the_wall_stays_dry_inside(void **state)
{
    (void)state;
    shape s = shape_create();
    shape_part(&s, "wall");
    shape_box(&s, sp_v(0, 0, 0), sp_v(1, 1, 1), true);
    shape_part(&s, "solid");
    shape_box(&s, sp_v(0, 0.3, 0.3), sp_v(0.4, 0.6, 0.7), false);
    shape_part(&s, "jacket");
    shape_box(&s, sp_v(-0.1, -0.1, -0.1), sp_v(1.1, 1.1, 1.1), false);
    fixture f = build(&s, SP_CAVITY_POINT, sp_v(0.8, 0.5, 0.5));
    expect(&f, "wall", 1);
    expect(&f, "jacket", 0);
    for (uint32_t t = 0; t < f.mesh->triangle_count; t++) {
        if (strcmp(f.mesh->parts[f.mesh->part[t]].name, "solid"))
            continue;
        bool contact = sp_triangle_normal(f.mesh, t).x < -0.5;
        assert_int_equal(sp_evaluator_wet(f.evaluator, t), contact ? 0 : 1);
    }
    release(&f);
}

/* Triangles that the file holds twice, or both ways round, count once and hide nothing. */
static void doubled_triangles_stay_wet(void **state)
{
    (void)state;
    shape s = shape_create();
    shape_part(&s, "wall");
    shape_box(&s, sp_v(0, 0, 0), sp_v(1, 1, 1), true);
    shape_sheet(&s, sp_v(0.3, 0.3, 0.6), sp_v(0.4, 0, 0), sp_v(0, 0.4, 0), 1);
    size_t count = s.triangle_count;
    shape_box(&s, sp_v(0, 0, 0), sp_v(1, 1, 1), false);
    shape_sheet(&s, sp_v(0.3, 0.3, 0.6), sp_v(0.4, 0, 0), sp_v(0, 0.4, 0), 1);
    fixture f = build(&s, SP_CAVITY_POINT, sp_v(0.52, 0.47, 0.3));
    for (uint32_t t = 0; t < count; t++)
        assert_int_equal(sp_evaluator_wet(f.evaluator, t), t < 12 ? 1 : 3);
    release(&f);
}

static void same_for_any_number_of_threads(void **state)
{
    (void)state;
    shape s = thick_vessel();
    fixture f = build(&s, SP_CAVITY_POINT, sp_v(0.01, 0.2, 0.6));
    sp_setup setup = *sp_evaluator_setup(f.evaluator);
    setup.run.threads = 3;
    sp_error error = {0};
    sp_evaluator *other = sp_evaluator_create(&setup, &error);
    assert_non_null(other);
    for (uint32_t t = 0; t < f.mesh->triangle_count; t++)
        assert_int_equal(sp_evaluator_wet(f.evaluator, t), sp_evaluator_wet(other, t));
    const sp_patches *a = sp_evaluator_patches(f.evaluator), *b = sp_evaluator_patches(other);
    assert_int_equal(a->count, b->count);
    assert_memory_equal(a->area, b->area, a->count * sizeof *a->area);
    assert_memory_equal(a->point, b->point, a->count * sizeof *a->point);
    sp_evaluator_destroy(other);
    release(&f);
}

static void point_that_sees_nothing_is_refused(void **state)
{
    (void)state;
    shape s = shape_create();
    shape_part(&s, "speck");
    shape_sheet(&s, sp_v(0, 0, 0), sp_v(1, 0, 0), sp_v(0, 1, 0), 1);
    fixture f = {.mesh = shape_mesh(&s)};
    sp_setup setup = setup_of(&f);
    setup.cavity = SP_CAVITY_POINT;
    setup.cavity_point = sp_v(1e5, 0, 1e5);
    sp_error error = {0};
    assert_null(sp_evaluator_create(&setup, &error));
    assert_int_equal(error.kind, SP_ERROR_INPUT);
    assert_non_null(strstr(error.message, "no surface is seen"));
    sp_mesh_destroy(f.mesh);
}

static void point_on_a_surface_is_refused(void **state)
{
    (void)state;
    /* inside a triangle of the wall, on an edge between two, in a corner, on the slanting sheet */
    const sp_vec3 points[] = {{0.7, 0.2, 0}, {0.5, 0.5, 0}, {0, 0, 0}, {0.5, 0.45, 0.45}};
    for (size_t i = 0; i < sizeof points / sizeof *points; i++) {
        shape s = shape_create();
        shape_part(&s, "wall");
        shape_box(&s, sp_v(0, 0, 0), sp_v(1, 1, 1), true);
        shape_sheet(&s, sp_v(0.3, 0.3, 0.3), sp_v(0.4, 0, 0), sp_v(0, 0.3, 0.3), 1);
        fixture f = {.mesh = shape_mesh(&s)};
        sp_setup setup = setup_of(&f);
        setup.cavity = SP_CAVITY_POINT;
        setup.cavity_point = points[i];
        sp_error error = {0};
        assert_null(sp_evaluator_create(&setup, &error));
        assert_int_equal(error.kind, SP_ERROR_INPUT);
        assert_non_null(strstr(error.message, "a surface goes through the point"));
        sp_mesh_destroy(f.mesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(thick_vessel_is_wet_inside_only),
        cmocka_unit_test(from_outside_the_opening_lets_the_flood_in),
        cmocka_unit_test(shell_from_inside_and_outside),
        cmocka_unit_test(solid_touching_the_wall_stays_dry_inside),
        cmocka_unit_test(doubled_triangles_stay_wet),
        cmocka_unit_test(same_for_any_number_of_threads),
        cmocka_unit_test(point_that_sees_nothing_is_refused),
        cmocka_unit_test(point_on_a_surface_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
