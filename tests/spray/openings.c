/* Openings through which the flood leaves: where they are said to be, what lies beyond them is not wet, and caps shut
 * them. */
#include "shapes.h"

static const sp_surface surfaces[SHAPE_PARTS] = {{true, 0, 1, false}, {true, 0, 1, false}, {true, 0, 1, false}};
enum { SEGMENTS = 24 };
static const double radius = 0.05, gap = 0.01;

typedef struct {
    double wet, outdoors; /* m² */
    sp_opening openings[SP_OPENINGS];
    size_t count, more;
    sp_cap_use use; /* of the cap */
    double beyond;  /* it, m² */
} flooded;

/* What is wet of a shape from a point, with a cap or without: NULL. */
static flooded flood(shape s, sp_vec3 point, const sp_cap *cap)
{
    sp_mesh *mesh = shape_mesh(&s);
    sp_setup setup = sp_setup_default();
    sp_error error = {0};
    setup.mesh = mesh;
    setup.surfaces = surfaces;
    setup.cavity = SP_CAVITY_POINT;
    setup.cavity_point = point;
    setup.caps = cap;
    setup.cap_count = cap != NULL;
    setup.fidelity.texel = 0.02;
    setup.run.threads = 1;
    sp_evaluator *evaluator = sp_evaluator_create(&setup, &error);
    assert_string_equal(error.message, "");
    flooded found = {.wet = sp_evaluator_patches(evaluator)->total_area, .outdoors = sp_evaluator_outdoors(evaluator)};
    const sp_opening *openings = sp_evaluator_openings(evaluator, &found.count);
    memcpy(found.openings, openings, found.count * sizeof *openings);
    found.more = sp_evaluator_more_openings(evaluator);
    if (cap)
        found.use = sp_evaluator_cap_use(evaluator, 0);
    assert_true(sp_evaluator_beyond_caps(evaluator, &found.beyond, &error));
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(mesh);
    return found;
}

static sp_cap cap_of(const sp_opening *opening)
{
    return (sp_cap){.point = opening->place, .normal = opening->normal, .radius = opening->radius};
}

/* A thick vessel with a hole in its lid for a shaft, 10 mm wider than that and 20 mm long. */
static shape gap_around_the_shaft(void)
{
    shape s = shape_create();
    const double wall[][2] = {{0, 0},       {0.5, 0},      {0.5, 1},  {radius + gap, 1}, {radius + gap, 1.02},
                              {0.52, 1.02}, {0.52, -0.02}, {0, -0.02}};
    shape_part(&s, "wall");
    shape_turned(&s, wall, 8, SEGMENTS);
    const double shaft[][2] = {{0, 1.4}, {radius, 1.4}, {radius, 0.3}, {0, 0.3}};
    shape_part(&s, "shaft");
    shape_turned(&s, shaft, 4, SEGMENTS);
    return s;
}

/* Nothing that lies outdoors is wet, the opening is named, and a cap shuts it exactly where it lies. */
static void gaps_and_caps(void **state)
{
    (void)state;
    sp_vec3 point = sp_v(0.3, 0, 0.5);
    double c = cos(M_PI / SEGMENTS), d = sin(M_PI / SEGMENTS), hole = radius + gap;
    double inside = SEGMENTS * c * d * (2 * 0.5 * 0.5 - hole * hole + radius * radius) + 2 * SEGMENTS * d * 0.5 +
                    2 * SEGMENTS * d * radius * 0.7;
    double in_hole = 2 * SEGMENTS * d * (hole + radius) * 0.02;
    flooded open = flood(gap_around_the_shaft(), point, NULL);
    sp_opening opening = open.openings[0];
    assert_true(open.wet > 0.998 * inside && open.wet < 1.002 * (inside + in_hole));
    assert_true(open.outdoors > 0 && open.count > 0);
    assert_true(fabs(opening.place.z - 1.01) < 0.03);
    assert_true(fabs(hypot(opening.place.x, opening.place.y) - radius - gap / 2) < 0.015);
    assert_true(opening.width > 0.5 * gap && opening.width < 3 * gap);
    for (size_t i = 0; i < open.count; i++) /* seen from beside it, a gap has no plane that its cap would lie in */
        assert_true(open.openings[i].radius == 0);
    const sp_cap cap = {{0, 0, 1.01}, {0, 0, 2}, 0.07};
    flooded shut = flood(gap_around_the_shaft(), point, &cap);
    assert_true(shut.outdoors == 0);
    assert_int_equal(shut.count, 0);
    assert_int_equal(shut.use, SP_CAP_SHUTS);
    /* the cap halves the shaft's side in the hole; the hole's wall is one face or two from end to end */
    assert_true(shut.wet > inside + 0.4 * in_hole && shut.wet < inside + 1.01 * in_hole);
}

static shape box_without_a_lid(int sheets)
{
    shape s = shape_create();
    const sp_vec3 x = sp_v(1, 0, 0), y = sp_v(0, 1, 0), z = sp_v(0, 0, 1), low = sp_v(0, 0, 0);
    shape_part(&s, "walls");
    shape_sheet(&s, low, x, y, 1);
    shape_sheet(&s, low, z, x, 1);
    shape_sheet(&s, low, y, z, 1);
    shape_sheet(&s, y, x, z, 1);
    shape_sheet(&s, x, z, y, 1);
    shape_part(&s, "sheets");
    for (int i = 0; i < sheets; i++)
        shape_sheet(&s, sp_v(0.3, 0.5, 0.5), sp_v(0.4, 0, 0), z, 1);
    return s;
}

/* A sheet sticks out through a cap, drawn once or twice: it is wet on both sides as far as the cap. */
static void caps_cut_what_is_drawn_twice(void **state)
{
    (void)state;
    const sp_cap cap = {{0.5, 0.5, 1}, {0, 0, 1}, 0.8};
    for (int sheets = 1; sheets <= 2; sheets++)
        assert_float_equal(flood(box_without_a_lid(sheets), sp_v(0.5, 0.3, 0.5), &cap).wet, 5.4, 1e-9);
}

/* One that lies in the liquid, by some inches or by far, one that is too small, and one that parts the room. */
static void caps_tell_what_they_are_good_for(void **state)
{
    (void)state;
    const sp_cap caps[] = {{{0.5, 0.5, 1.01}, {0, 0, 1}, 0.8}, {{0.5, 0.5, 0.95}, {0, 0, 1}, 0.45},
                           {{0.5, 0.5, 0.5}, {1, 2, 3}, 0.2},  {{0.5, 0.5, 1}, {0, 0, 1}, 0.3},
                           {{0.5, 0.5, 1000}, {0, 0, 1}, 0.8}, {{0.5, 0.5, -0.01}, {0, 0, 1}, 0.5},
                           {{0.5, 0.5, 0.4}, {0, 0, 1}, 0.8}};
    const sp_cap_use uses[] = {SP_CAP_SHUTS, SP_CAP_PASSED, SP_CAP_PASSED, SP_CAP_PASSED,
                               SP_CAP_DRY,   SP_CAP_DRY,    SP_CAP_SHUTS};
    for (size_t i = 0; i < sizeof caps / sizeof *caps; i++) {
        flooded capped = flood(box_without_a_lid(0), sp_v(0.5, 0.3, 0.2), &caps[i]);
        assert_int_equal(capped.use, uses[i]);
        assert_float_equal(capped.beyond, i == 6 ? 4 * 0.6 : 0, 1e-9);
    }
}

/* A pot with an outlet in its bottom, with and without a floor beneath it. */
static shape pot_with_outlet(bool floor)
{
    shape s = shape_create();
    const double pot[][2] = {{0.05, -0.05}, {0.05, 0},     {0.5, 0},      {0.5, 1},      {0, 1},       {0, 1.02},
                             {0.52, 1.02},  {0.52, -0.02}, {0.07, -0.02}, {0.07, -0.05}, {0.05, -0.05}};
    shape_part(&s, "pot");
    for (int i = 0; i + 1 < 11; i++)
        shape_turned(&s, pot + i, 2, SEGMENTS);
    if (floor) {
        shape_part(&s, "floor");
        shape_sheet(&s, sp_v(-2, -2, -0.6), sp_v(4, 0, 0), sp_v(0, 4, 0), 40);
    }
    return s;
}

static void what_lies_outside_changes_nothing(void **state)
{
    (void)state;
    sp_vec3 point = sp_v(0.02, 0.01, 0.5); /* it sees the floor */
    flooded alone = flood(pot_with_outlet(false), point, NULL);
    assert_true(alone.outdoors == 0);
    double c = cos(M_PI / SEGMENTS), d = sin(M_PI / SEGMENTS);
    double inside = SEGMENTS * c * d * (2 * 0.25 - 0.0025) + 2 * SEGMENTS * d * (0.5 + 0.05 * 0.05);
    assert_true(fabs(alone.wet / inside - 1) < 1e-5);
    flooded above_floor = flood(pot_with_outlet(true), point, NULL);
    assert_true(fabs(above_floor.wet / inside - 1) < 1e-5);
    assert_true(above_floor.outdoors > 1);
    assert_true(fabs(above_floor.openings[0].width - 0.1) < 0.05);
}

/* A room of 1 m of sheets, with a square hole of 0.1 m in its floor. */
static shape box_with_a_hole(void)
{
    static const double sheets[][4] = {{0, 0, 1, 0.2}, {0, 0.2, 0.7, 0.1}, {0.8, 0.2, 0.2, 0.1}, {0, 0.3, 1, 0.7}};
    shape s = shape_create();
    shape_part(&s, "box");
    for (size_t i = 0; i < 4; i++)
        shape_sheet(&s, sp_v(sheets[i][0], sheets[i][1], 0), sp_v(sheets[i][2], 0, 0), sp_v(0, sheets[i][3], 0), 1);
    shape_sheet(&s, sp_v(0, 0, 1), sp_v(1, 0, 0), sp_v(0, 1, 0), 1);
    shape_sheet(&s, sp_v(0, 0, 0), sp_v(1, 0, 0), sp_v(0, 0, 1), 1);
    shape_sheet(&s, sp_v(0, 1, 0), sp_v(1, 0, 0), sp_v(0, 0, 1), 1);
    shape_sheet(&s, sp_v(0, 0, 0), sp_v(0, 1, 0), sp_v(0, 0, 1), 1);
    shape_sheet(&s, sp_v(1, 0, 0), sp_v(0, 1, 0), sp_v(0, 0, 1), 1);
    return s;
}

/* A room of 1 m, its lid holed: width, height and orientation of the hole. */
static shape turned_box_with_a_hole(double width, double height, const sp_vec3 axes[3])
{
    const double low[] = {0.5 - width / 2, 0.5 - height / 2};
    const double lid[][4] = {{0, 0, 1, low[1]},
                             {0, low[1], low[0], height},
                             {low[0] + width, low[1], low[0], height},
                             {0, low[1] + height, 1, low[1]}};
    shape s = shape_create();
    shape_part(&s, "box");
    for (size_t i = 0; i < 4; i++)
        shape_sheet(&s, sp_along(sp_scale(axes[0], lid[i][0]), lid[i][1], axes[1]), sp_scale(axes[0], lid[i][2]),
                    sp_scale(axes[1], lid[i][3]), 1);
    for (int i = 0; i < 3; i++) {
        if (i < 2)
            shape_sheet(&s, sp_v(0, 0, 0), axes[i], axes[2], 1);
        shape_sheet(&s, axes[i], axes[(i + 1) % 3], axes[(i + 2) % 3], 1);
    }
    return s;
}

/* However long it is and whichever way it lies, and not much wider than that takes. */
static void a_cap_covers_every_corner_of_its_hole(void **state)
{
    (void)state;
    for (int i = 0; i < 12; i++) {
        double width = 0.3 - 0.02 * i, height = 0.05 + 0.17 * (i % 3), turn = 0.37 * i, lean = i % 4 ? 0.6 * i : 0;
        const sp_vec3 across = sp_v(cos(turn), sin(turn), 0), along = sp_v(-sin(turn), cos(turn), 0),
                      up = sp_v(0, 0, 1);
        const sp_vec3 axes[] = {across, sp_along(sp_scale(along, cos(lean)), sin(lean), up),
                                sp_along(sp_scale(up, cos(lean)), -sin(lean), along)};
        sp_vec3 middle = sp_scale(sp_add(axes[0], axes[1]), 0.5);
        flooded open = flood(turned_box_with_a_hole(width, height, axes),
                             sp_along(sp_along(middle, 0.5, axes[2]), 0.1, axes[0]), NULL);
        assert_int_equal(open.count, 1);
        double need = 0;
        for (int corner = 0; corner < 4; corner++) {
            sp_vec3 beside = sp_along(middle, corner & 1 ? 0.5 * width : -0.5 * width, axes[0]);
            beside = sp_along(beside, corner & 2 ? 0.5 * height : -0.5 * height, axes[1]);
            need = fmax(need, sp_distance(beside, open.openings[0].place));
        }
        assert_true(open.openings[0].radius >= need && open.openings[0].radius <= 1.1 * need);
    }
}

/* Its lines lean over from afar, and would step over what parts the holes. Of those that are not kept it is told how
 * many there are. */
static void caps_of_a_screen_cover_one_hole_each(void **state)
{
    (void)state;
    shape s = shape_create();
    shape_part(&s, "lid");
    for (int i = 0; i < 20; i++)
        for (int j = 0; j < 20; j++)
            if (i % 4 != 2 || j % 4 != 2)
                shape_sheet(&s, sp_v(0.05 * i, 0.05 * j, 1), sp_v(0.05, 0, 0), sp_v(0, 0.05, 0), 1);
    shape_part(&s, "room");
    const sp_vec3 low = sp_v(0, 0, 0), x = sp_v(1, 0, 0), y = sp_v(0, 1, 0), z = sp_v(0, 0, 1);
    shape_sheet(&s, low, x, y, 1);
    shape_sheet(&s, low, z, x, 1);
    shape_sheet(&s, low, y, z, 1);
    shape_sheet(&s, y, x, z, 1);
    shape_sheet(&s, x, z, y, 1);
    flooded open = flood(s, sp_v(0.3, 0.6, 0.5), NULL);
    assert_int_equal(open.count, SP_OPENINGS);
    assert_int_equal(open.more, 25 - SP_OPENINGS);
    double need = 0.025 * sqrt(2);
    for (size_t i = 0; i < open.count; i++)
        assert_true(open.openings[i].radius >= need && open.openings[i].radius <= 1.1 * need);
}

/* Most see it aslant. Ground under it changes nothing, and the cap that is offered shuts it. */
static void a_hole_is_one_opening_where_it_is(void **state)
{
    (void)state;
    const sp_vec3 point = sp_v(0.3, 0.6, 0.5);
    flooded open = flood(box_with_a_hole(), point, NULL);
    assert_int_equal(open.count, 1);
    assert_true(sp_distance(open.openings[0].place, sp_v(0.75, 0.25, 0)) < 0.02);
    assert_true(fabs(open.openings[0].place.z) < 1e-4);
    assert_true(fabs(open.openings[0].width - 0.1) < 0.01);
    assert_true(sp_distance(open.openings[0].normal, sp_v(0, 0, -1)) < 1e-12);
    assert_true(open.openings[0].radius > 0.06 && open.openings[0].radius < 0.08);
    const sp_cap cap = cap_of(&open.openings[0]);
    for (int capped = 0; capped <= 1; capped++) {
        shape s = box_with_a_hole();
        shape_part(&s, "ground");
        shape_sheet(&s, sp_v(-2, -2, -0.5), sp_v(5, 0, 0), sp_v(0, 5, 0), 40);
        flooded above_ground = flood(s, point, capped ? &cap : NULL);
        assert_float_equal(above_ground.wet, 5.99, 1e-9);
        assert_true(capped ? above_ground.outdoors == 0 : above_ground.outdoors > 0.1);
    }
}

/* A room of 2 m by 1 m with a slot of 0.1 m from end to end along its floor's edge and a small hole in the same floor,
 * a bar over half of the slot. */
static shape room_with_a_slot(void)
{
    shape s = shape_create();
    shape_part(&s, "room");
    static const double floor[][4] = {{0, 0.1, 2, 0.4}, {0, 0.5, 0.9, 0.1}, {1, 0.5, 1, 0.1}, {0, 0.6, 2, 0.4}};
    for (size_t i = 0; i < 4; i++)
        shape_sheet(&s, sp_v(floor[i][0], floor[i][1], 0), sp_v(floor[i][2], 0, 0), sp_v(0, floor[i][3], 0), 1);
    shape_sheet(&s, sp_v(0, 0, 1), sp_v(2, 0, 0), sp_v(0, 1, 0), 1);
    shape_sheet(&s, sp_v(0, 0, 0), sp_v(2, 0, 0), sp_v(0, 0, 1), 1);
    shape_sheet(&s, sp_v(0, 1, 0), sp_v(2, 0, 0), sp_v(0, 0, 1), 1);
    shape_sheet(&s, sp_v(0, 0, 0), sp_v(0, 1, 0), sp_v(0, 0, 1), 1);
    shape_sheet(&s, sp_v(2, 0, 0), sp_v(0, 1, 0), sp_v(0, 0, 1), 1);
    shape_part(&s, "bar");
    shape_sheet(&s, sp_v(0.2, 0, 0.5), sp_v(1, 0, 0), sp_v(0, 0.15, 0), 1);
    return s;
}

static void a_slot_is_one_opening_and_a_hole_beside_it_another(void **state)
{
    (void)state;
    flooded open = flood(room_with_a_slot(), sp_v(0.3, 0.6, 0.5), NULL);
    assert_int_equal(open.count, 2);
    const sp_opening *slot = &open.openings[0], *hole = &open.openings[1];
    assert_true(slot->place.y > 0 && slot->place.y < 0.1 && slot->radius > 1 && slot->radius < 2.1);
    assert_true(sp_distance(hole->place, sp_v(0.95, 0.55, 0)) < 0.02 && hole->radius < 0.08);
    for (size_t i = 0; i < open.count; i++) {
        assert_true(sp_distance(open.openings[i].normal, sp_v(0, 0, -1)) < 1e-12);
        assert_true(fabs(open.openings[i].width - 0.1) < 0.01);
    }
}

/* A slot's cap reaches as far as a pit in the floor beside it, and would part it from the room. */
static void no_cap_is_offered_that_parts_what_is_wet(void **state)
{
    (void)state;
    const sp_vec3 x = sp_v(2, 0, 0), z = sp_v(0, 0, 1), pit = sp_v(0, 0.5, -0.4);
    shape s = shape_create();
    shape_part(&s, "room");
    shape_sheet(&s, sp_v(0, 0.1, 0), x, sp_v(0, 0.4, 0), 1);
    shape_sheet(&s, sp_v(0, 0, 1), x, sp_v(0, 1, 0), 1);
    shape_sheet(&s, sp_v(0, 0, 0), x, z, 1);
    shape_sheet(&s, sp_v(0, 1, 0), x, z, 1);
    shape_sheet(&s, sp_v(0, 0, 0), sp_v(0, 1, 0), z, 1);
    shape_sheet(&s, sp_v(2, 0, 0), sp_v(0, 1, 0), z, 1);
    shape_part(&s, "pit");
    shape_sheet(&s, pit, x, sp_v(0, 0.5, 0), 1);
    shape_sheet(&s, pit, x, sp_v(0, 0, 0.4), 1);
    shape_sheet(&s, sp_v(0, 1, -0.4), x, sp_v(0, 0, 0.4), 1);
    shape_sheet(&s, pit, sp_v(0, 0.5, 0), sp_v(0, 0, 0.4), 1);
    shape_sheet(&s, sp_add(pit, x), sp_v(0, 0.5, 0), sp_v(0, 0, 0.4), 1);
    flooded open = flood(s, sp_v(0.3, 0.6, 0.5), NULL);
    assert_int_equal(open.count, 1);
    assert_true(open.openings[0].place.y < 0.1 && open.openings[0].radius == 0);
}

/* A shaft through a gland: what is seen of the gap has a plane that is not the gland's. */
static void no_cap_is_offered_that_would_not_shut(void **state)
{
    (void)state;
    const double wall[][2] = {{0, 0}, {0.5, 0}, {0.5, 1}, {0.0427, 1.1}, {0.0427, 1.18}};
    const double shaft[][2] = {{0, 1.26}, {0.03, 1.26}, {0.03, 0.1}, {0, 0.1}};
    shape s = shape_create();
    shape_part(&s, "wall");
    shape_turned(&s, wall, 5, 96);
    shape_part(&s, "shaft");
    shape_turned(&s, shaft, 4, 24);
    flooded open = flood(s, sp_v(0.3, 0, 0.5), NULL);
    assert_true(open.count > 0);
    for (size_t i = 0; i < open.count; i++)
        assert_true(open.openings[i].radius == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gaps_and_caps),
        cmocka_unit_test(caps_cut_what_is_drawn_twice),
        cmocka_unit_test(caps_tell_what_they_are_good_for),
        cmocka_unit_test(what_lies_outside_changes_nothing),
        cmocka_unit_test(a_hole_is_one_opening_where_it_is),
        cmocka_unit_test(a_cap_covers_every_corner_of_its_hole),
        cmocka_unit_test(caps_of_a_screen_cover_one_hole_each),
        cmocka_unit_test(a_slot_is_one_opening_and_a_hole_beside_it_another),
        cmocka_unit_test(no_cap_is_offered_that_parts_what_is_wet),
        cmocka_unit_test(no_cap_is_offered_that_would_not_shut),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
