/* Smooth arrivals: their derivatives by every unknown, against differences, for cones and fans, lines, parabolas and
 * drops. */
#include "prepared.h"

#include "refine/smooth_arrivals.h"
#include "scoring/scoring.h"

#define PRESSURE 2e5

typedef struct {
    room room;
    sp_nozzle_type type;
    const sp_nozzle_type *types[1];
    double pressure;
    sp_mount mount;
    sp_place_options options;
    prepared ready;
    sp_sights sights;
    sp_partial partial;
} bench;

/* A floor with a wall behind it, and one nozzle of the pattern given aslant above them. */
static void bench_open(bench *b, sp_pattern pattern, sp_trajectory trajectory, double flux, sp_combine combine)
{
    sp_error error = {0};
    *b = (bench){.pressure = PRESSURE};
    room_builder builder = {0};
    room_part(&builder, "corner");
    room_sheet(&builder, sp_v(-1.5, -1.5, 0), sp_v(3, 0, 0), sp_v(0, 3, 0));
    room_sheet(&builder, sp_v(-1.5, 1.5, 0), sp_v(3, 0, 0), sp_v(0, 0, 2));
    b->room.setup = sp_setup_default();
    b->room.setup.fidelity.trajectory = trajectory;
    b->room.setup.criterion.flux = flux;
    b->room.setup.criterion.combine = combine;
    room_open(&b->room, &builder, 0.1);
    b->type = room_cone("set", 70 * DEGREE, 20);
    b->type.pattern = pattern;
    b->type.hollow = 0.6;
    b->type.thickness = 30 * DEGREE;
    b->type.angle_min = 40 * DEGREE;
    b->type.angle_max = 110 * DEGREE;
    b->type.flow_min *= 0.5;
    b->type.flow_max *= 2;
    b->types[0] = &b->type;
    b->mount = (sp_mount){.kind = SP_MOUNT_BOX,
                          .axis = sp_unit(sp_v(0.1, 0.3, -1)),
                          .tilt = 60 * DEGREE,
                          .spacing = 1,
                          .from = sp_v(-0.5, -0.5, 1),
                          .to = sp_v(0.5, 0.5, 2)};
    b->options = room_options();
    b->options.refine = (sp_refine){0.4, 30 * DEGREE, true, INFINITY, INFINITY};
    b->options.types = b->types;
    b->options.type_count = 1;
    b->options.pressures = &b->pressure;
    b->options.pressure_count = 1;
    b->options.mounts = &b->mount;
    b->options.mount_count = 1;
    prepare(&b->ready, b->room.evaluator, &b->options);
    assert_true(sp_sights_create(&b->ready.search, 4, false, &b->sights, &error));
    assert_true(sp_partial_create(&b->ready.search, &b->partial, &error));
    assert_true(sp_partial_add_pose(&b->ready.search, &b->partial, (sp_pose){1, 0, 2, 0}, &error));
}

static void bench_close(bench *b)
{
    sp_partial_free(&b->partial);
    sp_sights_free(&b->sights);
    prepared_free(&b->ready);
    room_close(&b->room);
}

/* Smooth arrivals, and what they bring: values and slopes by turns. */
#define COLUMNS 3
typedef struct {
    double *value[COLUMNS], *slope[COLUMNS];
} looks;

static looks looks_create(const sp_sight *sight)
{
    looks l;
    for (int i = 0; i < COLUMNS; i++) {
        l.value[i] = malloc((sight->count + 1) * sizeof(double));
        l.slope[i] = malloc((sight->count + 1) * SP_UNKNOWNS * sizeof(double));
        assert_true(l.value[i] && l.slope[i]);
    }
    return l;
}

static void looks_free(looks *l)
{
    for (int i = 0; i < COLUMNS; i++) {
        free(l->value[i]);
        free(l->slope[i]);
    }
}

static void look(const bench *b, const sp_pose_parameters *parameters, const sp_sight *sight, const double *values,
                 bool slopes, const looks *l)
{
    const sp_width width = {0.3, 0.1};
    const sp_smooth_arrivals arrivals = {l->value[0], slopes ? l->slope[0] : NULL, l->value[1],
                                         slopes ? l->slope[1] : NULL};
    const sp_brought brought = {l->value[2], slopes ? l->slope[2] : NULL};
    sp_smooth_arrivals_set(&b->ready.search, parameters, sight, width, values, 0, sight->count, &arrivals, &brought);
}

/* Largest difference between slopes and central differences over the largest slope, for one unknown. */
static double worst_error(const double *ahead, const double *behind, const double *slope, size_t count, double step)
{
    double worst = 0, largest = 0;
    size_t off = 0;
    for (size_t i = 0; i < count; i++)
        largest = fmax(largest, fabs(slope[i]));
    for (size_t i = 0; i < count; i++) {
        double miss = fabs((ahead[i] - behind[i]) / (2 * step) - slope[i]) / largest;
        off += miss > 1e-4;
        worst = fmax(worst, miss);
    }
    assert_true(largest > 0);
    /* where two edges of a pattern are equally near, or nothing is left of it, the slope has a corner */
    return off > count / 100 ? worst : 0;
}

static bool any(const double *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (numbers[i] != 0)
            return true;
    return false;
}

/* The same of all columns that anything is in, which for one unknown at least one must be. */
static double worst_of_unknown(const bench *b, const sp_pose_parameters *parameters, const sp_sight *sight,
                               const double *values, size_t k, const looks *here)
{
    double step = 1e-5 * (parameters->high[k] - parameters->low[k]), moved[SP_UNKNOWNS], worst = 0;
    looks at[2] = {looks_create(sight), looks_create(sight)};
    memcpy(moved, values, sizeof moved);
    for (int i = 0; i < 2; i++) {
        moved[k] = values[k] + (i ? -step : step);
        look(b, parameters, sight, moved, false, &at[i]);
    }
    int columns = 0;
    for (int i = 0; i < COLUMNS; i++) {
        const double *slope = here->slope[i] + k * sight->count;
        if (!any(slope, sight->count) && !memcmp(at[0].value[i], at[1].value[i], sight->count * sizeof(double)))
            continue;
        columns++;
        worst = fmax(worst, worst_error(at[0].value[i], at[1].value[i], slope, sight->count, step));
    }
    assert_true(columns > 0);
    looks_free(&at[0]);
    looks_free(&at[1]);
    return worst;
}

static void check_slopes(const bench *b, const sp_pose_parameters *parameters, const sp_sight *sight, int number)
{
    double values[SP_UNKNOWNS];
    assert_true(sight->count > 300);
    for (size_t k = 0; k < parameters->count; k++)
        values[k] = 0.4 * parameters->low[k] + 0.6 * parameters->high[k];
    looks here = looks_create(sight);
    look(b, parameters, sight, values, true, &here);
    for (size_t k = 0; k < parameters->count; k++) {
        double worst = worst_of_unknown(b, parameters, sight, values, k, &here);
        if (worst > 0)
            fail_msg("case %d, unknown %zu of kind %d: off by %g", number, k, (int)parameters->kind[k], worst);
    }
    looks_free(&here);
}

static void slopes_are_differences(void **state)
{
    (void)state;
    const sp_pattern patterns[] = {SP_PATTERN_FULL_CONE, SP_PATTERN_HOLLOW_CONE, SP_PATTERN_FLAT_FAN};
    const sp_trajectory trajectories[] = {SP_TRAJECTORY_LINE, SP_TRAJECTORY_PARABOLA, SP_TRAJECTORY_DRAG};
    for (int i = 0; i < 27; i++) {
        bench b;
        sp_error error = {0};
        double flux = i < 9 ? 0 : 2 * LITRES_PER_MINUTE;
        bench_open(&b, patterns[i % 3], trajectories[i / 3 % 3], flux, i < 18 ? SP_COMBINE_SUM : SP_COMBINE_SINGLE);
        const sp_sight *sight = sp_sights_look(&b.sights, &b.partial.items[0], &error);
        assert_non_null(sight);
        sp_pose_parameters parameters = sp_pose_parameters_create(&b.ready.search, &b.partial.items[0]);
        assert_int_equal(parameters.count, i % 3 == 2 ? 8 : 7);
        check_slopes(&b, &parameters, sight, i);
        bench_close(&b);
    }
}

/* Where only what a partial layout leaves dry is looked at, a nozzle adds the same to it. */
static void dry_patches_say_what_is_added(void **state)
{
    (void)state;
    bench b;
    sp_error error = {0};
    bench_open(&b, SP_PATTERN_FULL_CONE, SP_TRAJECTORY_PARABOLA, 2 * LITRES_PER_MINUTE, SP_COMBINE_SUM);
    size_t patches = b.ready.search.patch_count, left_out = 0;
    float *whole = malloc(patches * sizeof *whole), *part = malloc(patches * sizeof *part);
    sp_placed placed = b.partial.items[0];
    placed.nozzle.position.x += 0.05;
    assert_true(whole && part);
    assert_true(sp_sights_field(&b.sights, &placed, NULL, whole, &error));
    assert_true(sp_sights_field(&b.sights, &placed, &b.partial, part, &error));
    assert_true(sp_field_gain(&b.ready.search, &b.partial, whole) == sp_field_gain(&b.ready.search, &b.partial, part));
    for (size_t p = 0; p < patches; p++)
        left_out += whole[p] != 0 && part[p] == 0;
    assert_true(left_out > 0);
    free(whole);
    free(part);
    bench_close(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slopes_are_differences),
        cmocka_unit_test(dry_patches_say_what_is_added),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
