/* Nozzles, types, setups and options that a program made in memory: what the public headers rule out is
 * SP_ERROR_ARGUMENT and names the field, and what they allow is taken. */
#include "../optimizer/room.h"

#include <sprayplan/sprayplan.h>

/* A room and all that a case may spoil. */
typedef struct {
    room room;
    sp_nozzle_type type;
    sp_nozzle nozzle;
    sp_layout layout;
    sp_setup setup;
    sp_surface surfaces[2];
    sp_cap cap;
    sp_mount mount;
    const sp_nozzle_type *types[1];
    double pressure;
    sp_place_options options;
} givens;

static void make(givens *g)
{
    g->type = room_cone("cone", 90 * DEGREE, 12);
    g->nozzle =
        (sp_nozzle){.name = "N1", .type = &g->type, .position = {0.5, 0.5, 0.9}, .axis = {0, 0, -1}, .pressure = 2e5};
    g->layout = (sp_layout){1, &g->nozzle};
    g->setup = g->room.setup;
    g->surfaces[0] = g->surfaces[1] = (sp_surface){.clean = true};
    g->setup.surfaces = g->surfaces;
    g->cap = (sp_cap){.point = {0.5, 0.5, 1}, .normal = {0, 0, 1}, .radius = 0.1};
    g->setup.caps = &g->cap;
    g->setup.cap_count = 1;
    g->mount = (sp_mount){.kind = SP_MOUNT_BOX,
                          .axis = {0, 0, -1},
                          .tilt = 1,
                          .spacing = 0.6,
                          .from = {0.2, 0.2, 0.8},
                          .to = {0.8, 0.8, 0.8}};
    g->types[0] = &g->type;
    g->pressure = 2e5;
    g->options = room_options();
    g->options.types = g->types;
    g->options.type_count = 1;
    g->options.pressures = &g->pressure;
    g->options.pressure_count = 1;
    g->options.mounts = &g->mount;
    g->options.mount_count = 1;
    g->options.max_nozzles = 1;
}

static void refused(const char *what, const char *field, const void *made, const sp_error *error)
{
    if (made || error->kind != SP_ERROR_ARGUMENT || !strstr(error->message, field))
        fail_msg("%s: %s, error %d: %s", what, made ? "taken" : "refused", (int)error->kind, error->message);
}

/* By all that take a layout. */
static void layout_is_refused(const givens *g, const char *what, const char *field)
{
    const sp_evaluator *evaluator = g->room.evaluator;
    sp_error errors[6] = {{0}};
    sp_track_gaps gaps;
    refused(what, field, sp_evaluate(evaluator, &g->layout, &errors[0]), &errors[0]);
    refused(what, field, sp_evaluate_forward(evaluator, &g->layout, 0, 100, &errors[1]), &errors[1]);
    refused(what, field, sp_evaluator_create_for(&g->setup, &g->layout, &errors[2]), &errors[2]);
    refused(what, field, sp_fitting_sheet_create(&g->layout, &g->setup, NULL, 0, &errors[3]), &errors[3]);
    if (!g->layout.nozzles)
        return;
    refused(what, field, sp_evaluator_admits(evaluator, &g->nozzle, &errors[4]) ? g : NULL, &errors[4]);
    refused(what, field, sp_find_track_gaps(evaluator, &g->nozzle, &gaps, &errors[5]) ? g : NULL, &errors[5]);
}

static void setup_is_refused(const givens *g, const char *what, const char *field)
{
    sp_error error = {0};
    refused(what, field, sp_evaluator_create(&g->setup, &error), &error);
}

static void options_are_refused(const givens *g, const char *what, const char *field)
{
    sp_error error = {0};
    refused(what, field, sp_place(g->room.evaluator, &g->options, &error), &error);
}

/* The statement spoils what make() made. */
#define NOZZLE(field, statement) (make(g), statement, layout_is_refused(g, #statement, field))
#define SETUP(field, statement) (make(g), statement, setup_is_refused(g, #statement, field))
#define PLACE(field, statement) (make(g), statement, options_are_refused(g, #statement, field))

static void nozzles_are_refused(void **state)
{
    givens *g = *state;
    NOZZLE("N1: pressure", g->nozzle.pressure = NAN);
    NOZZLE("N1: pressure", g->nozzle.pressure = -1);
    NOZZLE("N1: pressure", g->nozzle.pressure = INFINITY);
    NOZZLE("N1: axis", g->nozzle.axis = sp_v(0, 0, 0));
    NOZZLE("N1: axis", g->nozzle.axis = sp_v(NAN, 0, 1));
    NOZZLE("N1: position", g->nozzle.position = sp_v(NAN, 0, 0));
    NOZZLE("N1: no type", g->nozzle.type = NULL);
    NOZZLE("N1: angle", g->nozzle.angle = NAN);
    NOZZLE("N1: angle", g->nozzle.angle = -1);
    NOZZLE("N1: angle", g->nozzle.angle = 7);
    NOZZLE("N1: flow", g->nozzle.flow = NAN);
    NOZZLE("N1: flow", g->nozzle.flow = -1);
    NOZZLE("N1: flow", g->nozzle.flow = INFINITY);
    NOZZLE("N1: speed", g->nozzle.speed = NAN);
    NOZZLE("N1: speed", g->nozzle.speed = -3);
    NOZZLE("N1: roll", g->nozzle.roll = NAN);
    NOZZLE("expected a name that ends", memset(g->nozzle.name, 'x', SP_NAME));
    NOZZLE("layout: nozzles", g->layout.nozzles = NULL);
}

static void types_are_refused(void **state)
{
    givens *g = *state;
    NOZZLE("type cone: angle", g->type.angle = NAN);
    NOZZLE("type cone: angle", g->type.angle = 0);
    NOZZLE("type cone: angle", g->type.angle = -1);
    NOZZLE("type cone: angle", g->type.angle = 10);
    NOZZLE("type cone: expected one of the patterns", g->type.pattern = 99);
    NOZZLE("type cone: flow", g->type.flow = NAN);
    NOZZLE("type cone: flow", g->type.flow = INFINITY);
    NOZZLE("type cone: flow", g->type.flow = -1);
    NOZZLE("type cone: at", g->type.at = 0);
    NOZZLE("type cone: at", g->type.at = NAN);
    NOZZLE("type cone: exponent", g->type.exponent = NAN);
    NOZZLE("type cone: exponent", g->type.exponent = -5);
    NOZZLE("type cone: cv", g->type.cv = NAN);
    NOZZLE("type cone: cv", g->type.cv = -1);
    NOZZLE("type cone: trajectory", g->type.trajectory = 77);
    NOZZLE("type cone: hollow", (g->type.pattern = SP_PATTERN_HOLLOW_CONE, g->type.hollow = NAN));
    NOZZLE("type cone: hollow", (g->type.pattern = SP_PATTERN_HOLLOW_CONE, g->type.hollow = 1));
    NOZZLE("type cone: thickness", g->type.pattern = SP_PATTERN_FLAT_FAN);
    NOZZLE("type cone: thickness", (g->type.pattern = SP_PATTERN_FLAT_FAN, g->type.thickness = NAN));
    NOZZLE("expected a name that ends", memset(g->type.name, 'x', SP_NAME));
}

static void turn(givens *g, sp_rotation rotation)
{
    g->type.pattern = SP_PATTERN_ROTATING;
    g->type.rotation = rotation;
}

static void assemble(givens *g, sp_member *member)
{
    member->type = room_cone("hole", 60 * DEGREE, 1);
    member->axis = sp_v(0, 0, 1);
    member->share = 1;
    g->type.pattern = SP_PATTERN_CLUSTER;
    g->type.members = member;
    g->type.member_count = 1;
}

static void heads_and_balls_are_refused(void **state)
{
    givens *g = *state;
    const sp_rotation head = {.jet = SP_PATTERN_SOLID_STREAM, .jets = 4, .gears = {43, 41}};
    sp_rotation stuck = head, fans = head;
    stuck.gears[1] = 0;
    fans.jet = SP_PATTERN_FLAT_FAN;
    sp_member member = {.roll = 0};
    NOZZLE("gears with teeth", turn(g, stuck));
    NOZZLE("cones or streams as jets", turn(g, fans));
    NOZZLE("type cone: angle", (turn(g, head), g->type.angle = 100 * DEGREE));
    NOZZLE("rotation's tilt", turn(g, (sp_rotation){.jet = SP_PATTERN_FULL_CONE, .tilt = 4}));
    NOZZLE("rotation's roll", turn(g, (sp_rotation){.jet = SP_PATTERN_FULL_CONE, .roll = NAN}));
    NOZZLE("rotation's speed", turn(g, (sp_rotation){.jet = SP_PATTERN_FULL_CONE, .speed = -1}));
    NOZZLE("1 to 1000 members", g->type.pattern = SP_PATTERN_CLUSTER);
    NOZZLE("type hole: angle", (assemble(g, &member), member.type.angle = 10));
    NOZZLE("member's axis", (assemble(g, &member), member.axis = sp_v(0, 0, 0)));
    NOZZLE("member's offset", (assemble(g, &member), member.offset.x = NAN));
    member.offset.x = 0;
    NOZZLE("member's roll", (assemble(g, &member), member.roll = NAN));
}

static void setups_are_refused(void **state)
{
    givens *g = *state;
    SETUP("up as", g->setup.up = sp_v(0, 0, 0));
    SETUP("up as", g->setup.up = sp_v(1, 0, 0));
    SETUP("up as", g->setup.up = sp_v(0, 0, NAN));
    SETUP("an accuracy", g->setup.fidelity.accuracy = NAN);
    SETUP("an accuracy", g->setup.fidelity.accuracy = -1);
    SETUP("trajectory", g->setup.fidelity.trajectory = 50);
    SETUP("method", g->setup.fidelity.method = 50);
    SETUP("splat", g->setup.fidelity.splat = 50);
    SETUP("cavity", g->setup.cavity = 50);
    SETUP("combine", g->setup.criterion.combine = 9);
    SETUP("origin", g->setup.origin.x = NAN);
    SETUP("caps", g->setup.caps = NULL);
    SETUP("unfolded", g->setup.unfolded_count = 3);
    SETUP("threads", g->setup.run.threads = SP_THREADS + 1);
    SETUP("threads", g->setup.run.threads = 1000000);
    SETUP("threads", g->setup.run.threads = -1);
    SETUP("time limit", g->setup.run.time_limit = NAN);
}

static void options_are_reported(void **state)
{
    givens *g = *state;
    PLACE("types", g->options.types = NULL);
    PLACE("type: none", g->types[0] = NULL);
    PLACE("pressures", g->options.pressures = NULL);
    PLACE("mounts", g->options.mounts = NULL);
    PLACE("others", g->options.other_count = 2);
    PLACE("max_water", g->options.max_water = NAN);
    PLACE("max_water", g->options.max_water = -1);
    PLACE("memory", g->options.memory = NAN);
    PLACE("clearance", g->options.clearance = NAN);
    PLACE("clearance", g->options.clearance = -1);
    PLACE("objective", g->options.objective = 9);
    PLACE("place: pressure", g->pressure = NAN);
    PLACE("place: pressure", g->pressure = -1);
    PLACE("refine.position", g->options.refine.position = NAN);
    PLACE("refine.axis", g->options.refine.axis = -1);
    PLACE("refine.angle", g->options.refine.angle = NAN);
    PLACE("refine.flow", g->options.refine.flow = NAN);
    PLACE("threads", g->options.run.threads = 1000000);
    PLACE("time limit", g->options.run.time_limit = -1);
    PLACE("angle_max", g->type.angle_max = 1);
    PLACE("flow_min", g->type.flow_min = NAN);
    PLACE("flow_step", g->type.flow_step = ((sp_step){NAN, 1}));
    PLACE("body", g->type.body = NAN);
    PLACE("type cone: flow", g->type.flow = NAN);
    PLACE("N1: pressure", (g->nozzle.pressure = NAN, g->options.kept = &g->layout));
}

static void mounts_are_refused(void **state)
{
    givens *g = *state;
    PLACE("kind", g->mount.kind = 9);
    PLACE("cost", g->mount.cost = NAN);
    PLACE("cost", g->mount.cost = -1);
    PLACE("cost", g->mount.cost = INFINITY);
    PLACE("tilt", g->mount.tilt = NAN);
    PLACE("tilt", g->mount.tilt = 10);
    PLACE("spacing", g->mount.spacing = NAN);
    PLACE("axis", g->mount.axis = sp_v(0, 0, 0));
    PLACE("axis", g->mount.axis = sp_v(NAN, 0, 0));
    PLACE("from", g->mount.from = sp_v(NAN, 0, 0));
    PLACE("the smaller first", g->mount.from = sp_v(1, 1, 1));
    PLACE("standoff", (g->mount.kind = SP_MOUNT_SURFACE, g->mount.standoff = NAN));
    PLACE("depth_spacing", (g->mount.kind = SP_MOUNT_PORT, g->mount.depth_spacing = NAN));
    PLACE("depth_to", (g->mount.kind = SP_MOUNT_PORT, g->mount.depth_from = 0.5));
    PLACE("types", (g->mount.kind = SP_MOUNT_PORT, g->mount.type_count = 2));
    PLACE("bore", g->mount.bore = NAN);
    PLACE("tilt_step", g->mount.tilt_step = ((sp_step){NAN, 1}));
    PLACE("tilt_step", g->mount.tilt_step = ((sp_step){-1, 0.1}));
    size_t all[1], usable[1];
    sp_error error = {0};
    make(g);
    g->mount.tilt = NAN;
    refused("counted", "tilt", sp_place_count_points(g->room.evaluator, &g->options, all, usable, &error) ? all : NULL,
            &error);
}

static void trees_and_lists_are_refused(void **state)
{
    givens *g = *state;
    sp_error errors[5] = {{0}};
    const sp_vec3 corners[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const uint32_t triangle[1][3] = {{0, 1, 2}};
    make(g);
    refused("tracer", "threads", sp_tracer_create(g->room.mesh, SP_ACCELERATOR_BVH, 1000000, &errors[0]), &errors[0]);
    refused("mesh", "vertices", sp_mesh_create(NULL, 3, triangle, 1, NULL, NULL, 0, &errors[1]), &errors[1]);
    refused("mesh", "triangles", sp_mesh_create(corners, 3, NULL, 1, NULL, NULL, 0, &errors[2]), &errors[2]);
    refused("sheet", "mounts", sp_fitting_sheet_create(&g->layout, &g->setup, NULL, 1, &errors[3]), &errors[3]);
    refused("bore", "mounts", sp_mounts_admit(&g->setup, NULL, 1, &g->nozzle, &errors[4]) ? g : NULL, &errors[4]);
}

/* What stands for none, for all and for the ends themselves. */
static void what_is_allowed_is_taken(void **state)
{
    givens *g = *state;
    sp_error error = {0};
    make(g);
    g->nozzle.type = &(sp_nozzle_type){.name = "open", .pattern = SP_PATTERN_FULL_CONE, .angle = 360 * DEGREE};
    g->nozzle.flow = 1e-4; /* which the type need not tell then, nor the speed */
    g->nozzle.speed = 10;
    g->nozzle.pressure = 0;
    sp_coverage *coverage = sp_evaluate(g->room.evaluator, &g->layout, &error);
    assert_string_equal(error.message, "");
    assert_true(coverage && coverage->fraction > 0.9);
    sp_coverage_destroy(coverage);
    make(g);
    g->setup.run.threads = 2;
    g->setup.fidelity.accuracy = 1;
    sp_evaluator *evaluator = sp_evaluator_create(&g->setup, &error);
    assert_string_equal(error.message, "");
    sp_evaluator_destroy(evaluator);
    make(g);
    g->options.refine = sp_place_options_default().refine;
    g->options.refine.roll = false;
    g->options.refine.axis = g->options.refine.position = 0;
    g->options.memory = INFINITY;
    g->mount.tilt = 180 * DEGREE;
    g->options.run.time_limit = 5;
    sp_proposal *proposal = sp_place(g->room.evaluator, &g->options, &error);
    assert_string_equal(error.message, "");
    assert_non_null(proposal);
    sp_proposal_destroy(proposal);
}

static int open_room(void **state)
{
    static givens g;
    room_builder builder = {0};
    room_box(&builder, sp_v(0, 0, 0), sp_v(1, 1, 1), "walls", "lid");
    g.room.setup = sp_setup_default();
    g.room.setup.cavity = SP_CAVITY_POINT;
    g.room.setup.cavity_point = sp_v(0.5, 0.5, 0.5);
    g.room.setup.fidelity.accuracy = ROOM_ACCURACY;
    room_open(&g.room, &builder, 0.2);
    *state = &g;
    return 0;
}

static int close_room(void **state)
{
    room_close(&((givens *)*state)->room);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nozzles_are_refused),         cmocka_unit_test(types_are_refused),
        cmocka_unit_test(heads_and_balls_are_refused), cmocka_unit_test(setups_are_refused),
        cmocka_unit_test(options_are_reported),        cmocka_unit_test(mounts_are_refused),
        cmocka_unit_test(trees_and_lists_are_refused), cmocka_unit_test(what_is_allowed_is_taken),
    };
    return cmocka_run_group_tests(tests, open_room, close_room);
}
