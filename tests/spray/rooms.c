/* Rooms with bodies that touch, overlap, nest in and pierce each other: the wet area is known exactly. */
#include "shapes.h"

#include <stdio.h>

static const sp_surface surfaces[SHAPE_PARTS] = {{true, 0, 1, false}, {true, 0, 1, false}, {true, 0, 1, false},
                                                 {true, 0, 1, false}, {true, 0, 1, false}, {true, 0, 1, false},
                                                 {true, 0, 1, false}, {true, 0, 1, false}};

/* Turned about an axis that is parallel to nothing, and moved. */
static sp_transform attitude(double angle)
{
    sp_transform turn = sp_transform_default();
    sp_transform_rotation(&turn, sp_v(0.3, -0.7, 0.55), angle);
    turn.translate = sp_v(0.37 * angle, -2.1 * angle, 0.9 * angle);
    return turn;
}

static sp_evaluator *evaluator_of(shape *s, sp_cavity_kind cavity, sp_vec3 point, double angle, double texel,
                                  sp_mesh **mesh, sp_error *error)
{
    sp_transform turn = attitude(angle);
    for (size_t i = 0; i < s->point_count; i++)
        s->points[i] = sp_transform_point(&turn, s->points[i]);
    *mesh = shape_mesh(s);
    sp_setup setup = sp_setup_default();
    setup.mesh = *mesh;
    setup.surfaces = surfaces;
    setup.cavity = cavity;
    setup.cavity_point = sp_transform_point(&turn, point);
    setup.fidelity.texel = texel;
    setup.run.threads = 1;
    return sp_evaluator_create(&setup, error);
}

static const double angles[] = {0, 0.4, 2.9};

/* How a room lies and how fine its texels are changes no line that runs. */
#ifdef SPRAYPLAN_SANITIZE
#define FIRST_WET 1
#define LAST_WET 1
#define FINE_TEXEL 0.01
#else
#define FIRST_WET 0
#define LAST_WET 2
#define FINE_TEXEL 0.005
#endif

/* The scene that `make` draws is wet on `area`, however it lies. */
static void expect_wet(const char *what, shape (*make)(void), sp_vec3 point, double area)
{
    for (size_t i = FIRST_WET; i <= LAST_WET; i++) {
        sp_mesh *mesh;
        sp_error error = {0};
        shape s = make();
        sp_evaluator *evaluator = evaluator_of(&s, SP_CAVITY_POINT, point, angles[i], 0.06, &mesh, &error);
        assert_string_equal(error.message, "");
        double found = sp_evaluator_patches(evaluator)->total_area;
        if (!(fabs(found / area - 1) < 2e-5))
            fail_msg("%s, turned by %g: %.6f m2 found, expected %.6f", what, angles[i], found, area);
        sp_evaluator_destroy(evaluator);
        sp_mesh_destroy(mesh);
    }
}

/* 1 m wide, walls 0.1 m thick. */
static shape room(void)
{
    shape s = shape_create();
    shape_part(&s, "inner");
    shape_box(&s, sp_v(0, 0, 0), sp_v(1, 1, 1), true);
    shape_part(&s, "outer");
    shape_box(&s, sp_v(-0.1, -0.1, -0.1), sp_v(1.1, 1.1, 1.1), false);
    return s;
}

/* The same as a sheet turned inwards. */
static shape sheet_room(void)
{
    shape s = shape_create();
    shape_part(&s, "inner");
    shape_box(&s, sp_v(0, 0, 0), sp_v(1, 1, 1), true);
    return s;
}

/* A box of 0.3 x 0.1 x 0.5 m that stands `in` deep in the wall x = 0. */
static void add_box(shape *s, double in)
{
    shape_part(s, "box");
    shape_box(s, sp_v(-in, 0.2, 0.3), sp_v(0.3 - in, 0.3, 0.8), false);
}

static shape clear_box(void)
{
    shape s = room();
    add_box(&s, -0.005);
    return s;
}
static shape touching_box(void)
{
    shape s = room();
    add_box(&s, 0);
    return s;
}
static shape sunk_box(void)
{
    shape s = room();
    add_box(&s, 0.001);
    return s;
}
static shape piercing_box(void)
{
    shape s = room();
    add_box(&s, 0.15);
    return s;
}
static shape sheet_touching_box(void)
{
    shape s = sheet_room();
    add_box(&s, 0);
    return s;
}
static shape sheet_piercing_box(void)
{
    shape s = sheet_room();
    add_box(&s, 0.15);
    return s;
}
/* Nearer than the contact, and a little beyond it into the wall. */
static shape nearly_touching_box(void)
{
    shape s = room();
    add_box(&s, -5e-7);
    return s;
}

static const double box_clear = 6 + 2 * (0.3 * 0.1 + 0.3 * 0.5 + 0.1 * 0.5);

static void boxes_and_walls(void **state)
{
    (void)state;
    sp_vec3 point = sp_v(0.7, 0.6, 0.5);
    expect_wet("clear", clear_box, point, box_clear);
    expect_wet("touching", touching_box, point, box_clear - 2 * 0.05);
    expect_wet("nearly touching", nearly_touching_box, point, box_clear - 2 * 0.05);
    expect_wet("1 mm in the wall", sunk_box, point, box_clear - 2 * 0.05 - 1.2 * 0.001);
    expect_wet("through the wall", piercing_box, point, box_clear - 2 * 0.05 - 1.2 * 0.15);
    expect_wet("touching a sheet", sheet_touching_box, point, box_clear - 2 * 0.05);
    expect_wet("through a sheet", sheet_piercing_box, point, box_clear - 2 * 0.05 - 1.2 * 0.15);
}

enum { SEGMENTS = 24 };
static const double radius = 0.05;
static double ring(void)
{
    return 2 * SEGMENTS * radius * sin(M_PI / SEGMENTS);
}
static double disc(void)
{
    return 0.5 * SEGMENTS * radius * radius * sin(2 * M_PI / SEGMENTS);
}

/* A shaft about (0.5, 0.5) from z = low to high. */
static void add_shaft(shape *s, double low, double high)
{
    const double profile[][2] = {{0, high}, {radius, high}, {radius, low}, {0, low}};
    size_t first = s->point_count;
    shape_part(s, "shaft");
    /* the profile is drawn with its front outwards where it runs downwards on the outside */
    shape_turned(s, profile, 4, SEGMENTS);
    for (size_t i = first; i < s->point_count; i++)
        s->points[i] = sp_add(s->points[i], sp_v(0.5, 0.5, 0));
}

/* A blade through the shaft, 0.4 x 0.02 x 0.1 m. */
static void add_blade(shape *s)
{
    shape_part(s, "blade");
    shape_box(s, sp_v(0.3, 0.49, 0.3), sp_v(0.7, 0.51, 0.4), false);
}

static shape hanging_shaft(void)
{
    shape s = room();
    add_shaft(&s, 0.25, 1);
    return s;
}
static shape shaft_in_the_lid(void)
{
    shape s = room();
    add_shaft(&s, 0.25, 1.05);
    add_blade(&s);
    return s;
}
static shape shaft_through_the_lid(void)
{
    shape s = room();
    add_shaft(&s, 0.25, 1.5);
    add_blade(&s);
    return s;
}
static shape shaft_through_a_sheet(void)
{
    shape s = sheet_room();
    add_shaft(&s, 0.25, 1.5);
    add_blade(&s);
    return s;
}

/* Of the blade, what the shaft leaves: its faces at y = ±0.01 and its top and bottom. */
static double blade_area(void)
{
    double half = 0.01, chord = 0, covered = 0;
    /* the shaft's section between y = -half and half, as strips between its corners */
    enum { STRIPS = 20000 };
    for (int i = 0; i <= STRIPS; i++) {
        double y = half * (2.0 * i / STRIPS - 1), right = 0;
        for (int k = 0; k < SEGMENTS; k++) {
            double a = 2 * M_PI * k / SEGMENTS, b = 2 * M_PI * (k + 1) / SEGMENTS;
            double ya = radius * sin(a), yb = radius * sin(b), xa = radius * cos(a), xb = radius * cos(b);
            if ((ya <= y) != (yb <= y))
                right = fmax(right, xa + (y - ya) / (yb - ya) * (xb - xa));
        }
        covered += 2 * right * (i == 0 || i == STRIPS ? 0.5 : 1) * 2 * half / STRIPS;
        chord = i == STRIPS ? 2 * right : chord;
    }
    return 2 * 0.1 * (0.4 - chord) + 2 * (0.4 * 0.02 - covered) + 2 * 0.02 * 0.1;
}

/* Of the shaft's side, what the blade covers: strips of 0.1 m height. */
static double blade_on_shaft(void)
{
    double half = 0.01, covered = 0;
    for (int k = 0; k < SEGMENTS; k++) {
        double a = 2 * M_PI * k / SEGMENTS, b = 2 * M_PI * (k + 1) / SEGMENTS;
        double ya = radius * sin(a), yb = radius * sin(b), length = 2 * radius * sin(M_PI / SEGMENTS);
        double low = fmax(fmin(ya, yb), -half), high = fmin(fmax(ya, yb), half);
        if (high > low)
            covered += length * (high - low) / fabs(yb - ya);
    }
    return 0.1 * covered;
}

static void shafts_and_blades(void **state)
{
    (void)state;
    sp_vec3 point = sp_v(0.2, 0.2, 0.7);
    double shaft = 6 - disc() + 0.75 * ring() + disc();
    expect_wet("shaft that ends on the lid", hanging_shaft, point, shaft);
    double with_blade = shaft - blade_on_shaft() + blade_area();
    expect_wet("shaft in the lid", shaft_in_the_lid, point, with_blade);
    expect_wet("shaft through the lid", shaft_through_the_lid, point, with_blade);
    expect_wet("shaft through a sheet", shaft_through_a_sheet, point, with_blade);
}

/* Boxes that lie on each other, flush, and in each other. */
static shape stacked_boxes(void)
{
    shape s = room();
    shape_part(&s, "low");
    shape_box(&s, sp_v(0.3, 0.3, 0), sp_v(0.7, 0.7, 0.2), false);
    shape_part(&s, "high");
    shape_box(&s, sp_v(0.3, 0.4, 0.2), sp_v(0.5, 0.6, 0.5), false); /* flush at x = 0.3 */
    return s;
}
static shape overlapping_boxes(void)
{
    shape s = room();
    shape_part(&s, "one");
    shape_box(&s, sp_v(0.2, 0.2, 0.2), sp_v(0.6, 0.6, 0.4), false);
    shape_part(&s, "two");
    shape_box(&s, sp_v(0.4, 0.4, 0.2), sp_v(0.8, 0.8, 0.4), false); /* tops and bottoms in one plane */
    return s;
}
static shape nested_boxes(void)
{
    shape s = room();
    shape_part(&s, "one");
    shape_box(&s, sp_v(0.2, 0.2, 0.2), sp_v(0.6, 0.6, 0.6), false);
    shape_part(&s, "in it");
    shape_box(&s, sp_v(0.3, 0.3, 0.3), sp_v(0.5, 0.5, 0.5), false);
    shape_part(&s, "hollow");
    shape_box(&s, sp_v(0.52, 0.52, 0.52), sp_v(0.58, 0.58, 0.58), true);
    return s;
}
static shape same_box_twice(void)
{
    shape s = room();
    for (int i = 0; i < 2; i++) {
        shape_part(&s, i ? "again" : "box");
        shape_box(&s, sp_v(0.2, 0.2, 0.2), sp_v(0.6, 0.6, 0.6), false);
    }
    return s;
}
static shape inside_out_box(void)
{
    shape s = room();
    shape_part(&s, "box");
    shape_box(&s, sp_v(0.2, 0.2, 0.2), sp_v(0.6, 0.6, 0.6), true);
    return s;
}
static shape inside_out_in_a_sheet(void)
{
    shape s = sheet_room();
    shape_part(&s, "box");
    shape_box(&s, sp_v(0.2, 0.2, 0), sp_v(0.6, 0.6, 0.6), true);
    return s;
}
static shape room_turned_outwards(void)
{
    shape s = shape_create();
    shape_part(&s, "tank");
    shape_box(&s, sp_v(0, 0, 0), sp_v(1, 1, 1), false);
    shape_part(&s, "box");
    shape_box(&s, sp_v(0.2, 0.2, 0), sp_v(0.6, 0.6, 0.6), false);
    return s;
}

static void bodies_on_and_in_bodies(void **state)
{
    (void)state;
    sp_vec3 point = sp_v(0.9, 0.1, 0.8);
    expect_wet("stacked", stacked_boxes, point, 6 + 4 * 0.4 * 0.2 + 2 * (0.2 + 0.2) * 0.3);
    expect_wet("overlapping", overlapping_boxes, point, 6 + 2 * (0.16 + 0.16 - 0.04) + 0.2 * 8 * 0.4 - 0.2 * 4 * 0.2);
    expect_wet("nested", nested_boxes, point, 6 + 6 * 0.16);
    expect_wet("twice", same_box_twice, point, 6 + 6 * 0.16);
    expect_wet("inside out", inside_out_box, point, 6 + 6 * 0.16);
    expect_wet("inside out on a sheet", inside_out_in_a_sheet, point, 6 + 4 * 0.4 * 0.6);
    expect_wet("room turned outwards", room_turned_outwards, point, 6 + 4 * 0.4 * 0.6);
}

/* Sheets: through a wall, on a wall, across each other. */
static shape sheet_through_the_wall(void)
{
    shape s = room();
    shape_part(&s, "baffle");
    shape_sheet(&s, sp_v(-0.3, 0.4, 0.2), sp_v(0.6, 0, 0), sp_v(0, 0, 0.5), 1);
    return s;
}
static shape crossed_sheets(void)
{
    shape s = room();
    shape_part(&s, "one");
    shape_sheet(&s, sp_v(0.2, 0.5, 0.2), sp_v(0.6, 0, 0), sp_v(0, 0, 0.5), 1);
    shape_part(&s, "two");
    shape_sheet(&s, sp_v(0.5, 0.2, 0.2), sp_v(0, 0.6, 0), sp_v(0, 0, 0.5), 1);
    return s;
}
/* A bulkhead of two triangles shuts off the half x > 0.5, and a shaft stands in it. */
static shape bulkhead(void)
{
    shape s = room();
    shape_part(&s, "bulkhead");
    shape_sheet(&s, sp_v(0.5, -0.05, -0.05), sp_v(0, 1.1, 0), sp_v(0, 0, 1.1), 1);
    shape_part(&s, "bar");
    shape_box(&s, sp_v(0.3, 0.3, 0.3), sp_v(0.8, 0.5, 0.5), false);
    return s;
}
/* The sheet lid of a sheet pot reaches far beyond the pot, and a plate lies over all of it. */
static shape overhanging_lid(void)
{
    shape s = shape_create();
    shape_part(&s, "pot");
    shape_sheet(&s, sp_v(0, 0, 0), sp_v(1, 0, 0), sp_v(0, 1, 0), 1);
    shape_sheet(&s, sp_v(0, 0, 0), sp_v(0, 0, 1), sp_v(1, 0, 0), 1);
    shape_sheet(&s, sp_v(0, 0, 0), sp_v(0, 1, 0), sp_v(0, 0, 1), 1);
    shape_sheet(&s, sp_v(1, 0, 0), sp_v(0, 0, 1), sp_v(0, 1, 0), 1);
    shape_sheet(&s, sp_v(0, 1, 0), sp_v(1, 0, 0), sp_v(0, 0, 1), 1);
    shape_part(&s, "lid");
    shape_sheet(&s, sp_v(-0.3, -0.3, 1), sp_v(1.6, 0, 0), sp_v(0, 1.6, 0), 1);
    shape_part(&s, "floor");
    shape_sheet(&s, sp_v(-2, -2, -0.5), sp_v(5, 0, 0), sp_v(0, 5, 0), 1);
    return s;
}
/* A solid lid that lies on a thick pot and overhangs it by 100 mm. */
static shape solid_lid(void)
{
    shape s = shape_create();
    const double pot[][2] = {{0, 0.02}, {0.5, 0.02}, {0.5, 1}, {0.52, 1}, {0.52, 0}, {0, 0}};
    shape_part(&s, "pot");
    shape_turned(&s, pot, 6, SEGMENTS);
    shape_part(&s, "lid");
    const double lid[][2] = {{0, 1.02}, {0.62, 1.02}, {0.62, 1}, {0, 1}};
    shape_turned(&s, lid, 4, SEGMENTS);
    return s;
}

static void sheets_and_lids(void **state)
{
    (void)state;
    sp_vec3 point = sp_v(0.2, 0.2, 0.7);
    expect_wet("sheet through the wall", sheet_through_the_wall, point, 6 + 2 * 0.3 * 0.5);
    expect_wet("crossed sheets", crossed_sheets, point, 6 + 4 * 0.6 * 0.5);
    expect_wet("bulkhead", bulkhead, point, 1 + 1 + 4 * 0.5 - 0.04 + 0.04 + 4 * 0.2 * 0.2);
    expect_wet("overhanging lid", overhanging_lid, point, 6);
    double c = cos(M_PI / SEGMENTS), d = sin(M_PI / SEGMENTS);
    expect_wet("solid lid", solid_lid, point, 2 * SEGMENTS * 0.5 * 0.5 * c * d + 2 * SEGMENTS * 0.5 * d * 0.98);
}

/* A block stands in the hollow of a tank, or that hollow is not shut; another is, so that the tank is no room. */
static shape walled_tank(bool shut)
{
    shape s = shape_create();
    shape_part(&s, "tank");
    shape_box(&s, sp_v(0, 0, 0), sp_v(1, 1, 1), false);
    shape_box(&s, sp_v(0.05, 0.05, 0.05), sp_v(0.1, 0.1, 0.1), true);
    if (!shut) {
        shape_sheet(&s, sp_v(0.2, 0.2, 0.2), sp_v(0.6, 0, 0), sp_v(0, 0.6, 0), 1);
        return s;
    }
    shape_box(&s, sp_v(0.2, 0.2, 0.2), sp_v(0.8, 0.8, 0.8), true);
    shape_part(&s, "block");
    shape_box(&s, sp_v(0.4, 0.4, 0.4), sp_v(0.6, 0.6, 0.6), false);
    return s;
}

static void expect_refused(shape s, sp_vec3 point, const char *why)
{
    sp_mesh *mesh;
    sp_error error = {0};
    assert_null(evaluator_of(&s, SP_CAVITY_POINT, point, 0.4, 0.03, &mesh, &error));
    assert_int_equal(error.kind, SP_ERROR_INPUT);
    assert_non_null(strstr(error.message, "lies in the material of part"));
    assert_non_null(strstr(error.message, why));
    sp_mesh_destroy(mesh);
}

static void a_point_in_steel_is_refused(void **state)
{
    (void)state;
    expect_refused(room(), sp_v(-0.05, 0.5, 0.5), "");
    expect_refused(piercing_box(), sp_v(0.1, 0.25, 0.5), "");
    expect_refused(sheet_piercing_box(), sp_v(0.1, 0.25, 0.5), "");
    expect_refused(solid_lid(), sp_v(0.1, 0.1, 1.01), "");
    expect_refused(walled_tank(true), sp_v(0.5, 0.5, 0.5), "\"block\"; expected");
    expect_refused(walled_tank(true), sp_v(0.15, 0.5, 0.5), "\"tank\"; expected");
    expect_refused(walled_tank(false), sp_v(0.5, 0.5, 0.5),
                   "\"tank\", or in a hollow of it that cannot be told, since it has open edges; expected");
}

/* At 5 mm, and for any number of threads the same bytes. */
/* A shaft 2 m long and 0.05 m wide, and half way up a sheet with a square hole. */
static const double shaft_width = 0.05;
static shape barred_shaft(double x, double y, double wide)
{
    shape s = shape_create();
    const double b = shaft_width, left = x - wide / 2, right = x + wide / 2, low = y - wide / 2, high = y + wide / 2;
    shape_part(&s, "walls");
    shape_box(&s, sp_v(0, 0, 0), sp_v(b, b, 2), true);
    shape_part(&s, "sheet");
    shape_sheet(&s, sp_v(0, 0, 1), sp_v(left, 0, 0), sp_v(0, b, 0), 1);
    shape_sheet(&s, sp_v(right, 0, 1), sp_v(b - right, 0, 0), sp_v(0, b, 0), 1);
    shape_sheet(&s, sp_v(left, 0, 1), sp_v(wide, 0, 0), sp_v(0, low, 0), 1);
    shape_sheet(&s, sp_v(left, high, 1), sp_v(wide, 0, 0), sp_v(0, b - high, 0), 1);
    return s;
}

/* In how many of 24 such shafts the liquid is found beyond the hole; the cavity's point looks along the sheet. */
static int holes_found(double wide)
{
    int found = 0;
    for (int i = 0; i < 8; i++)
        for (size_t k = 0; k < sizeof angles / sizeof *angles; k++) {
            sp_mesh *mesh;
            sp_error error = {0};
            const double b = shaft_width;
            shape s = barred_shaft(b * (0.3 + 0.05 * i), b * (0.35 + 0.04 * (i * 3 % 8)), wide);
            sp_vec3 point = sp_v(0.95 * b, 0.05 * b, 1 - 0.02 * b);
            sp_evaluator *evaluator = evaluator_of(&s, SP_CAVITY_POINT, point, angles[k], 0.05, &mesh, &error);
            assert_string_equal(error.message, "");
            double area = sp_evaluator_patches(evaluator)->total_area, half = 4 * b + 2 * b * b - wide * wide;
            bool both = area > 1.5 * half;
            assert_true(fabs(area / (both ? 2 * half : half) - 1) < 2e-5);
            found += both;
            sp_evaluator_destroy(evaluator);
            sp_mesh_destroy(mesh);
        }
    return found;
}

/* So small a hole that chance decides: with an eighth of the lines from large faces 11 are found. */
static void liquid_finds_holes(void **state)
{
    (void)state;
    int found = holes_found(0.004);
    print_message("%d of 24 holes\n", found);
    assert_true(found >= 17);
}

static void fine_texels_and_threads(void **state)
{
    (void)state;
    sp_mesh *mesh;
    sp_error error = {0};
    shape s = sunk_box();
    sp_evaluator *one = evaluator_of(&s, SP_CAVITY_POINT, sp_v(0.7, 0.6, 0.5), 0.4, FINE_TEXEL, &mesh, &error);
    assert_non_null(one);
    const sp_patches *a = sp_evaluator_patches(one);
    assert_true(fabs(a->total_area / (box_clear - 0.1 - 0.0012) - 1) < 1e-5);
    sp_setup setup = *sp_evaluator_setup(one);
    setup.run.threads = 5;
    sp_evaluator *other = sp_evaluator_create(&setup, &error);
    assert_non_null(other);
    const sp_patches *b = sp_evaluator_patches(other);
    assert_int_equal(a->count, b->count);
    assert_memory_equal(a->area, b->area, a->count * sizeof *a->area);
    assert_memory_equal(a->point, b->point, a->count * sizeof *a->point);
    for (size_t i = 0; i < a->count; i++) /* a patch's point is wet, or the patch would not be judged where it counts */
        assert_true(sp_evaluator_inside(one, sp_along(a->point[i], 1e-4, a->normal[i])));
    sp_evaluator_destroy(other);
    sp_evaluator_destroy(one);
    sp_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boxes_and_walls),
        cmocka_unit_test(shafts_and_blades),
        cmocka_unit_test(bodies_on_and_in_bodies),
        cmocka_unit_test(sheets_and_lids),
        cmocka_unit_test(a_point_in_steel_is_refused),
        cmocka_unit_test(liquid_finds_holes),
        cmocka_unit_test(fine_texels_and_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
