/* Rotating nozzles in a room: as many fixed ones in the place of one, jets, and the closed form of two-axis heads. */
#include "room_of_nozzles.h"

#define POINTS 0.001 /* of coverage */

static sp_nozzle_type turned(sp_nozzle_type jet, double tilt, double roll)
{
    jet.rotation = (sp_rotation){.jet = jet.pattern, .tilt = deg(tilt), .roll = deg(roll)};
    jet.pattern = SP_PATTERN_ROTATING;
    return jet;
}

/* Position k of the jet, as a nozzle that stands still; the frame is sp_rotation's. */
static sp_nozzle standing(const sp_nozzle *turning, const sp_nozzle_type *jet, int k, int fixed)
{
    const sp_rotation *rotation = &turning->type->rotation;
    const sp_vec3 up = sp_v(0, 0, 1);
    sp_frame own = sp_nozzle_frame(turning->axis, turning->roll + 2 * M_PI * k / fixed, up);
    double c = cos(rotation->tilt), s = sin(rotation->tilt);
    sp_vec3 axis = sp_along(sp_scale(own.x, s), c, own.z), along = sp_along(sp_scale(own.x, c), -s, own.z);
    sp_vec3 x = sp_along(sp_scale(along, cos(rotation->roll)), sin(rotation->roll), own.y);
    sp_frame plain = sp_nozzle_frame(axis, 0, up);
    sp_nozzle nozzle = *turning;
    nozzle.type = jet;
    nozzle.axis = axis;
    nozzle.roll = atan2(sp_dot(x, plain.y), sp_dot(x, plain.x));
    nozzle.flow = turning->type->flow / fixed;
    return nozzle;
}

static double flux_apart(const sp_evaluator *evaluator, const sp_coverage *one, const sp_coverage *other)
{
    const sp_patches *patches = sp_evaluator_patches(evaluator);
    double apart = 0, all = 0;
    for (size_t i = 0; i < patches->count; i++) {
        apart += fabs(one->deposits.flux[i] - other->deposits.flux[i]) * patches->area[i];
        all += other->deposits.flux[i] * patches->area[i];
    }
    return apart / all;
}

/* On a floor: what one turns in the place of so many. Where each of many brings too little alone, a patch counts whole
 * or not at all, which the one's edge is finer than: it takes texels short enough. */
static void assert_equals_fixed(const char *what, sp_nozzle_type jet, double tilt, double roll)
{
    enum { fixed = 720 };
    const rectangle floor_only = level_rectangle(2, 2, -0.5);
    scene s;
    scene_open(&s, mesh_of_rectangles(&floor_only, 1), SP_TRAJECTORY_LINE, 0.02);
    s.setup.criterion.flux = 4.0 / 60 / 1000;
    sp_evaluator *evaluator = scene_evaluator(&s);
    sp_nozzle_type type = turned(jet, tilt, roll);
    sp_nozzle one = nozzle_at(&type, place, body, 0), *many = calloc(fixed, sizeof *many);
    assert_non_null(many);
    for (int k = 0; k < fixed; k++)
        many[k] = standing(&one, &jet, k, fixed);
    sp_coverage *mean = scene_cover(evaluator, &one, 1, true), *sum = scene_cover(evaluator, many, fixed, true);
    double apart = flux_apart(evaluator, mean, sum);
    print_message("%-28s %.2f %% covered, by %d fixed ones %.2f %%; flux %.2f %% apart\n", what, 100 * mean->fraction,
                  fixed, 100 * sum->fraction, 100 * apart);
    if (!(fabs(mean->fraction - sum->fraction) <= POINTS * COARSER * COARSER) || !(apart < 0.02 * COARSER))
        fail_msg("%s: not as %d fixed ones", what, fixed);
    free(many);
    sp_coverage_destroy(mean);
    sp_coverage_destroy(sum);
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

static sp_nozzle_type strong(sp_pattern pattern, double degrees, double thickness)
{
    sp_nozzle_type type = spray_type(pattern, degrees);
    type.thickness = deg(thickness);
    type.flow = 40e-3 / 60;
    return type;
}

static void one_is_as_many_fixed_ones(void **state)
{
    (void)state;
    assert_equals_fixed("fan, leaning", strong(SP_PATTERN_FLAT_FAN, 60, 4), 30, 20);
    assert_equals_fixed("hollow cone, leaning", strong(SP_PATTERN_HOLLOW_CONE, 80, 0), 25, 0);
}

/* About the vertical, on a level floor: rings, be they wider than texels or not. */
static void streams_cover_rings(void **state)
{
    (void)state;
    const rectangle floor_only = level_rectangle(2, 2, -0.5);
    const double widths[] = {1, 8};
    scene s;
    scene_open(&s, mesh_of_rectangles(&floor_only, 1), SP_TRAJECTORY_LINE, 0.02);
    for (size_t i = 0; i < sizeof widths / sizeof *widths; i++) {
        sp_nozzle_type type = turned(strong(SP_PATTERN_SOLID_STREAM, widths[i], 0), 35, 0);
        sp_nozzle nozzle = nozzle_at(&type, sp_v(0.11, 0.07, 0.3), sp_v(0, 0, -1), 0);
        double outer = 0.8 * tan(deg(35 + widths[i] / 2)), inner = 0.8 * tan(deg(35 - widths[i] / 2));
        assert_covers("stream's ring", &s, &nozzle, 1, M_PI * (outer * outer - inner * inner), BY_INVERSE);
    }
    scene_close(&s);
}

/* Jets and the closed form agree, and no liquid is lost by either. */
static void jets_and_closed_form_agree(void **state)
{
    (void)state;
    scene s;
    open_room(&s, 0.05);
    s.setup.fidelity.jets = JETS / 20;
    sp_evaluator *evaluator = scene_evaluator(&s);
    sp_nozzle_type types[] = {turned(strong(SP_PATTERN_FLAT_FAN, 60, 4), 30, 20),
                              turned(strong(SP_PATTERN_SOLID_STREAM, 1, 0), 50, 0),
                              strong(SP_PATTERN_SOLID_STREAM, 1, 0)};
    types[2].pattern = SP_PATTERN_ROTATING;
    types[2].rotation = (sp_rotation){.jet = SP_PATTERN_SOLID_STREAM, .jets = 4, .gears = {43, 47}};
    for (size_t t = 0; t < sizeof types / sizeof *types; t++) {
        sp_nozzle nozzle = nozzle_at(&types[t], place, body, 0);
        sp_coverage *closed = scene_cover(evaluator, &nozzle, 1, true),
                    *jets = scene_cover(evaluator, &nozzle, 1, false);
        const sp_patches *patches = sp_evaluator_patches(evaluator);
        double liquid = 0;
        for (size_t i = 0; i < patches->count; i++)
            liquid += closed->deposits.flux[i] * patches->area[i];
        print_message("type %zu: %.2f %% covered, by jets %.2f %%; %.2f %% of the liquid arrives\n", t,
                      100 * closed->fraction, 100 * jets->fraction, 100 * liquid / types[t].flow);
        assert_true(fabs(closed->fraction - jets->fraction) < 0.01 * COARSER * COARSER);
        assert_true(fabs(liquid / types[t].flow - 1) < 0.01 * COARSER * COARSER);
        assert_true(fabs(jets->balance.clean / types[t].flow - 1) < 1e-6);
        sp_coverage_destroy(closed);
        sp_coverage_destroy(jets);
    }
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

/* On the wall that a two-axis head looks at squarely, along lines: Q cos i / (2π² sin ϑ d²). */
static void two_axis_flux_is_the_closed_form(void **state)
{
    (void)state;
    scene s;
    scene_open(&s, mesh_of_room(), SP_TRAJECTORY_LINE, 0.04);
    sp_evaluator *evaluator = scene_evaluator(&s);
    sp_nozzle_type type = strong(SP_PATTERN_SOLID_STREAM, 1, 0);
    type.pattern = SP_PATTERN_ROTATING;
    type.rotation = (sp_rotation){.jet = SP_PATTERN_SOLID_STREAM, .jets = 2, .gears = {1, 300}};
    sp_nozzle nozzle = nozzle_at(&type, sp_v(0, 0, 0), sp_v(0, 0, -1), 0);
    sp_coverage *coverage = scene_cover(evaluator, &nozzle, 1, true);
    const sp_patches *patches = sp_evaluator_patches(evaluator);
    for (size_t i = 0; i < patches->count; i++) {
        sp_vec3 p = patches->point[i];
        double distance = sp_length(p), sine = hypot(p.x, p.y) / distance;
        double expected =
            -sp_dot(p, patches->normal[i]) / distance * type.flow / (2 * M_PI * M_PI * sine * distance * distance);
        if (sine > 0.3 && fabs(coverage->deposits.flux[i] / expected - 1) > 0.01 * COARSER * COARSER)
            fail_msg("flux at %g %g %g is %g, expected %g", p.x, p.y, p.z, coverage->deposits.flux[i], expected);
    }
    sp_coverage_destroy(coverage);
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

/* Where it is proved that lines and parabolas say the same, they do; and of a two-axis head that is most of the room.
 */
static void bound_on_lines_holds(void **state)
{
    (void)state;
    sp_nozzle_type types[] = {turned(strong(SP_PATTERN_FLAT_FAN, 60, 4), 30, 20),
                              turned(strong(SP_PATTERN_SOLID_STREAM, 6, 0), 50, 0),
                              strong(SP_PATTERN_SOLID_STREAM, 1, 0)};
    types[2].pattern = SP_PATTERN_ROTATING;
    types[2].rotation = (sp_rotation){.jet = SP_PATTERN_SOLID_STREAM, .jets = 4, .gears = {43, 47}};
    for (size_t t = 0; t < sizeof types / sizeof *types; t++) {
        sp_nozzle nozzle = nozzle_at(&types[t], place, body, 0);
        double bound = assert_bound_on_lines("type", t, &nozzle, 1.0 / 60 / 1000);
        assert_true(t < 2 || bound < 0.3 * COARSER);
    }
}

static void threads_change_nothing(void **state)
{
    (void)state;
    sp_nozzle_type types[] = {turned(strong(SP_PATTERN_FLAT_FAN, 60, 4), 30, 20),
                              strong(SP_PATTERN_SOLID_STREAM, 2, 0)};
    types[1].pattern = SP_PATTERN_ROTATING;
    types[1].rotation = (sp_rotation){.jet = SP_PATTERN_SOLID_STREAM, .jets = 3, .gears = {7, 11}};
    sp_nozzle nozzles[] = {nozzle_at(&types[0], place, body, 0), nozzle_at(&types[1], place, body, 0)};
    assert_threads_change_nothing(nozzles, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_is_as_many_fixed_ones),  cmocka_unit_test(streams_cover_rings),
        cmocka_unit_test(jets_and_closed_form_agree), cmocka_unit_test(two_axis_flux_is_the_closed_form),
        cmocka_unit_test(bound_on_lines_holds),       cmocka_unit_test(threads_change_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
