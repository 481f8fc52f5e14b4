/* Cells of aims: no aim of a cell is worth more than the cell's bound, and small cells' bounds are little more than
 * what their aims are worth. */
#include "prepared.h"

#include "certificate/aim_pricing.h"
#include "scoring/scoring.h"

#define TYPES 6
#ifdef SPRAYPLAN_SANITIZE
#define TEXEL 0.12
#define CELLS 60
#define LOOSE_MOST 2.2 /* bounds of small cells: patches at an edge count whole, and are large */
#else
#define TEXEL 0.05
#define CELLS 400
#define LOOSE_MOST 1.4
#endif
#define AIMS 12 /* of each cell */

typedef struct {
    room room;
    sp_nozzle_type type[TYPES];
    const sp_nozzle_type *types[TYPES];
    double pressure;
    sp_mount mounts[2];
    sp_place_options options;
    prepared ready;
    sp_cover cover;
    uint32_t weight[1], tier[64];
    const uint32_t *tiers[2 * TYPES];
    size_t ports[2];
    float *need;
    sp_valid_inequalities inequalities;
    sp_multipliers multipliers;
    sp_aim_kinds kinds;
    sp_pose_pricing *poses;
    sp_aim_pricing *aims;
} stage;

static double next_random(uint64_t *state)
{
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    return (double)((*state * 0x2545f4914f6cdd1du) >> 11) * 0x1p-53;
}

static void set_types(stage *s)
{
    s->type[0] = room_cone("wide", 90 * DEGREE, 20);
    s->type[0].angle_min = 60 * DEGREE;
    s->type[0].angle_max = 130 * DEGREE;
    s->type[0].flow_min = 0.7 * s->type[0].flow;
    s->type[0].flow_max = 1.3 * s->type[0].flow;
    s->type[1] = room_cone("narrow", 30 * DEGREE, 9);
    s->type[2] = room_cone("hollow", 120 * DEGREE, 16);
    s->type[2].pattern = SP_PATTERN_HOLLOW_CONE;
    s->type[2].hollow = 0.7;
    s->type[3] = room_cone("fan", 80 * DEGREE, 10);
    s->type[3].pattern = SP_PATTERN_FLAT_FAN;
    s->type[3].thickness = 20 * DEGREE;
    s->type[4] = room_cone("sheet", 240 * DEGREE, 10);
    s->type[4].pattern = SP_PATTERN_FLAT_FAN;
    s->type[4].thickness = 40 * DEGREE;
    /* no edge: all that its bound may lie above is rounding */
    s->type[5] = room_cone("round", 360 * DEGREE, 30);
    for (int i = 0; i < TYPES; i++)
        s->types[i] = &s->type[i];
}

/* Multipliers at random, some texels' by an inequality; `sparse`: of few texels, so that each of them tells. */
static void set_multipliers(stage *s, bool sparse, uint64_t *random)
{
    sp_error error = {0};
    size_t patches = s->ready.search.patch_count;
    s->weight[0] = 1;
    for (size_t i = 0; i < 64; i++)
        s->tier[i] = 0;
    for (size_t i = 0; i < 2 * TYPES; i++)
        s->tiers[i] = s->tier;
    s->ports[0] = s->ports[1] = SP_NO_PORT;
    s->cover = (sp_cover){.texel_count = patches,
                          .area = s->ready.search.area,
                          .tier_count = 1,
                          .weight = s->weight,
                          .nozzles = 3,
                          .water = 3,
                          .repeats = true,
                          .threads = 1};
    s->need = malloc(patches * sizeof *s->need);
    sp_valid_inequalities_create(3, &s->inequalities);
    assert_true(s->need && sp_multipliers_create(&s->cover, &s->multipliers, &error));
    s->multipliers.inequalities = &s->inequalities;
    for (size_t t = 0; t < patches; t++) {
        double strengthened = fmax(0, next_random(random) - 0.5);
        s->need[t] = t % 17 ? 1 : 0.5f;
        double priced = sparse ? t % 37 == 0 : 1;
        s->multipliers.plain[t] = (float)(priced * next_random(random) * (1 - strengthened)) * s->ready.search.area[t];
        s->multipliers.strengthened[t] = (float)(priced * strengthened) * s->ready.search.area[t];
        s->multipliers.kind[t] = (uint8_t)(next_random(random) * (double)s->inequalities.kinds);
    }
}

static void stage_open(stage *s, sp_trajectory trajectory, bool sparse, uint64_t *random)
{
    sp_error error = {0};
    *s = (stage){.pressure = 2e5};
    room_builder b = {0};
    room_box(&b, sp_v(-1, -1, 0), sp_v(1, 1, 2), "walls", "lid");
    room_box(&b, sp_v(-0.3, -0.2, 0.6), sp_v(0.2, 0.2, 1.1), "block", "top");
    s->room.setup = sp_setup_default();
    s->room.setup.cavity = SP_CAVITY_POINT;
    s->room.setup.cavity_point = sp_v(0.6, 0.6, 0.5);
    s->room.setup.criterion =
        (sp_criterion){.flux = 8 * LITRES_PER_MINUTE, .impact_speed = 3, .incidence = 80 * DEGREE};
    s->room.setup.fidelity.trajectory = trajectory;
    room_open(&s->room, &b, TEXEL);
    set_types(s);
    s->mounts[0] = (sp_mount){.kind = SP_MOUNT_LINE,
                              .axis = sp_v(0, 0, -1),
                              .tilt = M_PI,
                              .spacing = 0.7,
                              .from = sp_v(-0.7, 0.4, 1.5),
                              .to = sp_v(0.7, 0.4, 1.5)};
    s->mounts[1] = (sp_mount){.kind = SP_MOUNT_BOX,
                              .axis = sp_unit(sp_v(0.3, 0.2, -1)),
                              .tilt = 4 * DEGREE,
                              .from = sp_v(0.6, -0.5, 1.8),
                              .to = sp_v(0.6, -0.5, 1.8)};
    s->options = room_options();
    s->options.refine = sp_place_options_default().refine;
    s->options.types = s->types;
    s->options.type_count = TYPES;
    s->options.pressures = &s->pressure;
    s->options.pressure_count = 1;
    s->options.mounts = s->mounts;
    s->options.mount_count = 2;
    s->options.run.threads = 1;
    prepare(&s->ready, s->room.evaluator, &s->options);
    set_multipliers(s, sparse, random);
    assert_true(sp_aim_kinds_create(&s->ready.search, &s->kinds, &error));
    assert_int_equal(s->kinds.count, TYPES);
    s->poses = sp_pose_pricing_create(&s->ready.search, &s->cover, s->tier, s->need, NULL, s->ports, &error);
    s->aims = sp_aim_pricing_create(&s->ready.search, &s->cover, &s->kinds, s->tiers, s->ports, s->poses, &error);
    assert_true(s->poses && s->aims);
}

static void stage_close(stage *s)
{
    sp_aim_pricing_destroy(s->aims);
    sp_pose_pricing_destroy(s->poses);
    sp_aim_kinds_free(&s->kinds);
    sp_multipliers_free(&s->multipliers);
    free(s->need);
    prepared_free(&s->ready);
    room_close(&s->room);
}

/* What a nozzle is worth: by its field, parts of texels at its spray's edge included. */
static double worth(const stage *s, uint32_t site, size_t speed, const sp_spray *spray, const sp_frame *frame,
                    double flow)
{
    const sp_view *view = &s->ready.visibility.views[site * s->ready.visibility.launch_count + speed];
    float *field = calloc(s->ready.search.patch_count, sizeof *field);
    double price = 0;
    assert_non_null(field);
    sp_posed_spray posed = {
        .spray = *spray, .frame = *frame, .strength = flow / (spray->solid_angle * s->ready.search.plenty)};
    sp_field_view(&s->ready.search, view, &posed, field);
    for (size_t t = 0; t < s->ready.search.patch_count; t++) {
        float share = field[t] < 0 ? -field[t] : fminf(1, field[t] / s->need[t]);
        float strengthened = field[t] < 0 ? share : sp_strengthen(&s->inequalities, s->multipliers.kind[t], share);
        if (share > 0)
            price += (double)share * (double)s->multipliers.plain[t] +
                     (double)strengthened * (double)s->multipliers.strengthened[t];
    }
    free(field);
    return price;
}

static sp_vec3 turned(sp_vec3 v, sp_vec3 about, double angle)
{
    sp_vec3 along = sp_scale(about, sp_dot(about, v) * (1 - cos(angle)));
    return sp_add(sp_add(sp_scale(v, cos(angle)), sp_scale(sp_cross(about, v), sin(angle))), along);
}

/* An aim of the cell at random: an axis within the square or the tilt, to which the cell's frame turns by the shortest
 * way; then its roll. */
static double worth_of_some(const stage *s, const sp_aim_cell *cell, const sp_aim_disc *disc, uint64_t *random)
{
    const sp_aim_kind *kind = &s->kinds.items[cell->kind];
    double edge = ldexp(2, -cell->level);
    sp_vec3 axis = sp_octahedron_decode(cell->u + edge * next_random(random), cell->v + edge * next_random(random));
    double angle = cell->angle_low + (cell->angle_high - cell->angle_low) * next_random(random);
    double low = kind->edge[cell->step], high = kind->edge[cell->step + 1];
    sp_frame frame = sp_nozzle_frame(disc->axis, cell->roll, sp_v(0, 0, 1));
    sp_vec3 about = sp_cross(disc->axis, axis);
    double sine = sp_length(about), away = atan2(sine, sp_dot(disc->axis, axis));
    double roll = cell->roll_half * (2 * next_random(random) - 1);
    assert_true(away <= disc->radius);
    if (sine > 0) {
        about = sp_scale(about, 1 / sine);
        frame = (sp_frame){turned(frame.x, about, away), turned(frame.y, about, away), axis};
    }
    frame.x = turned(frame.x, axis, roll);
    frame.y = turned(frame.y, axis, roll);
    sp_spray spray = sp_spray_create(kind->type, angle);
    return worth(s, cell->site, kind->launch, &spray, &frame, low + (high - low) * next_random(random));
}

/* A piece of a piece of all aims, and so on. False where it has come to nothing. */
static bool draw_cell(const stage *s, int splits, uint64_t *random, sp_aim_cell *cell)
{
    uint32_t site = (uint32_t)(next_random(random) * (double)s->ready.sites.count);
    uint32_t number = (uint32_t)(next_random(random) * TYPES);
    const sp_aim_kind *kind = &s->kinds.items[number];
    double tilt = s->mounts[s->ready.sites.items[site].mount].tilt;
    *cell = sp_aim_cell_whole(kind, site, number, (uint32_t)(next_random(random) * (double)kind->step_count));
    for (int i = 0; i < splits && sp_aim_cell_splits(cell, kind, &s->ready.sites.items[site], tilt); i++) {
        sp_aim_cell children[SP_AIM_CHILDREN];
        size_t count = sp_aim_cell_split(cell, kind, &s->ready.sites.items[site], tilt, children);
        if (!count)
            return false;
        *cell = children[(size_t)(next_random(random) * (double)count)];
    }
    return cell->level >= 0;
}

static void no_aim_is_worth_more_than_its_cell(void **state)
{
    (void)state;
    const sp_trajectory trajectories[] = {SP_TRAJECTORY_LINE, SP_TRAJECTORY_PARABOLA};
    for (int t = 0; t < 4; t++) {
        stage s;
        uint64_t random = 5;
        bool sparse = t > 1;
        stage_open(&s, trajectories[t % 2], sparse, &random);
        double small_upper = 0, small_worth = 0;
        size_t tried = 0;
        for (int i = 0; i < CELLS; i++) {
            int splits = 1 + i % 24;
            sp_aim_cell cell;
            if (!draw_cell(&s, splits, &random, &cell))
                continue;
            const sp_site *site = &s.ready.sites.items[cell.site];
            sp_aim_disc disc = sp_aim_cell_disc(&cell, site, s.mounts[site->mount].tilt);
            double upper = sp_aim_pricing_upper(s.aims, &cell, &s.multipliers), most = 0;
            for (int k = 0; k < AIMS; k++)
                most = fmax(most, worth_of_some(&s, &cell, &disc, &random));
            if (most > upper)
                fail_msg("%s: an aim is worth %g, its cell at most %g", s.type[cell.kind].name, most, upper);
            if (disc.radius < 0.02 && cell.roll_half < 0.03) {
                small_upper += upper;
                small_worth += most;
            }
            tried++;
        }
        print_message("small cells: bounds %.4f, best of a few aims %.4f\n", small_upper, small_worth);
        assert_true(tried > CELLS / 2);
        assert_true(sparse || (small_worth > 0 && small_upper < LOOSE_MOST * small_worth));
        stage_close(&s);
    }
}

/* Pieces leave nothing out: every axis within the tilt lies in one of them. */
static void pieces_hold_all_axes(void **state)
{
    (void)state;
    sp_nozzle_type type = room_cone("cone", 60 * DEGREE, 10);
    sp_aim_kind kind = {.type = &type, .angle_low = type.angle, .angle_high = type.angle, .step_count = 1};
    const double tilts[] = {1 * DEGREE, 4 * DEGREE, 20 * DEGREE, 45 * DEGREE, 180 * DEGREE};
    uint64_t random = 3;
    for (size_t t = 0; t < sizeof tilts / sizeof *tilts; t++) {
        sp_site site = {.axis = sp_unit(sp_v(next_random(&random) - 0.5, next_random(&random) - 0.5, -0.4))};
        sp_aim_cell whole = sp_aim_cell_whole(&kind, 0, 0, 0), children[SP_AIM_CHILDREN];
        size_t count = sp_aim_cell_split(&whole, &kind, &site, tilts[t], children);
        assert_true(count > 1);
        for (int i = 0; i < 2000; i++) {
            double polar = tilts[t] * next_random(&random), azimuth = 2 * M_PI * next_random(&random);
            sp_frame frame = sp_nozzle_frame(site.axis, azimuth, sp_v(0, 0, 1));
            sp_vec3 axis = sp_along(sp_scale(frame.z, cos(polar)), sin(polar), frame.x);
            bool held = false;
            for (size_t k = 0; k < count; k++) {
                sp_aim_disc disc = sp_aim_cell_disc(&children[k], &site, tilts[t]);
                held |= sp_dot(axis, disc.axis) >= cos(disc.radius);
            }
            assert_true(held);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_aim_is_worth_more_than_its_cell),
        cmocka_unit_test(pieces_hold_all_axes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
