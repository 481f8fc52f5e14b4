/* The kernels against one question at a time: what a view holds, what a pose's field is, and what scores add up to. */
#include "prepared.h"

#include "scoring/scoring.h"

#ifdef SPRAYPLAN_SANITIZE
#define TEXEL 0.12
#else
#define TEXEL 0.05
#endif

#define TYPES 7

/* A room of 2 m with a block in it, nozzles on a line and in a port. */
typedef struct {
    room room;
    sp_nozzle_type type[TYPES];
    const sp_nozzle_type *types[TYPES];
    double pressures[2];
    sp_mount mounts[2];
    sp_place_options options;
    prepared ready;
} stage;

static void set_types(stage *s)
{
    s->type[0] = room_cone("wide", 90 * DEGREE, 20);
    s->type[1] = room_cone("narrow", 30 * DEGREE, 9);
    s->type[2] = room_cone("round", 360 * DEGREE, 40);
    s->type[3] = room_cone("hollow", 120 * DEGREE, 16);
    s->type[3].pattern = SP_PATTERN_HOLLOW_CONE;
    s->type[3].hollow = 0.7;
    s->type[4] = room_cone("fan", 80 * DEGREE, 10);
    s->type[4].pattern = SP_PATTERN_FLAT_FAN;
    s->type[4].thickness = 25 * DEGREE;
    s->type[5] = room_cone("sheet", 240 * DEGREE, 10);
    s->type[5].pattern = SP_PATTERN_FLAT_FAN;
    s->type[5].thickness = 40 * DEGREE;
    s->type[6] = room_cone("up", 360 * DEGREE, 28);
    s->type[6].pattern = SP_PATTERN_HOLLOW_CONE;
    s->type[6].hollow = 0.5;
    for (int i = 0; i < TYPES; i++)
        s->types[i] = &s->type[i];
}

static void stage_open(stage *s, sp_criterion criterion, sp_trajectory trajectory)
{
    *s = (stage){.pressures = {1e5, 2e5}};
    room_builder b = {0};
    room_box(&b, sp_v(-1, -1, 0), sp_v(1, 1, 2), "walls", "lid");
    room_box(&b, sp_v(-0.3, -0.2, 0.6), sp_v(0.2, 0.2, 1.1), "block", "top");
    s->room.setup = sp_setup_default();
    s->room.setup.cavity = SP_CAVITY_POINT;
    s->room.setup.cavity_point = sp_v(0.6, 0.6, 0.5);
    s->room.setup.criterion = criterion;
    s->room.setup.fidelity.trajectory = trajectory;
    room_open(&s->room, &b, TEXEL);
    set_types(s);
    s->mounts[0] = (sp_mount){.kind = SP_MOUNT_LINE,
                              .axis = sp_v(0, 0, -1),
                              .tilt = M_PI,
                              .spacing = 0.7,
                              .from = sp_v(-0.7, 0.4, 1.5),
                              .to = sp_v(0.7, 0.4, 1.5)};
    s->mounts[1] = (sp_mount){.kind = SP_MOUNT_PORT,
                              .position = sp_v(0.6, -0.5, 2),
                              .axis = sp_v(0, 0, -1),
                              .tilt = 50 * DEGREE,
                              .depth_from = 0.2,
                              .depth_to = 0.2};
    s->options = room_options();
    s->options.types = s->types;
    s->options.type_count = TYPES;
    s->options.pressures = s->pressures;
    s->options.pressure_count = 2;
    s->options.mounts = s->mounts;
    s->options.mount_count = 2;
    prepare(&s->ready, s->room.evaluator, &s->options);
    assert_int_equal(s->ready.sites.count, 4);
    assert_int_equal(s->ready.candidates.launch_count, 2);
}

static void stage_close(stage *s)
{
    prepared_free(&s->ready);
    room_close(&s->room);
}

static const sp_criterion criterion_of_all = {
    .flux = 2 * LITRES_PER_MINUTE, .impact_speed = 3, .incidence = 80 * DEGREE, .combine = SP_COMBINE_SUM};

/* A number in [0, 1), the next of its sequence: xorshift64*. */
static double next_random(uint64_t *state)
{
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    return (double)((*state * 0x2545f4914f6cdd1du) >> 11) * 0x1p-53;
}

/* Every `stride`-th pose of the stage, as visited by its number. */
static sp_pose pose_of(const stage *s, size_t number)
{
    const sp_candidates *candidates = &s->ready.candidates;
    sp_pose pose = {0};
    while (candidates->pose_start[pose.site + 1] <= number)
        pose.site++;
    number -= candidates->pose_start[pose.site];
    for (;; pose.variant++) {
        uint32_t rolls = (uint32_t)candidates->variants[pose.variant].roll_count;
        size_t count =
            sp_candidates_axes(candidates, s->ready.sites.items[pose.site].mount, pose.variant)->count * rolls;
        if (number < count) {
            pose.axis = (uint32_t)number / rolls;
            pose.roll = (uint32_t)number % rolls;
            return pose;
        }
        number -= count;
    }
}

/* A view holds what is found by asking for every patch and arc alone, and nothing else; but for patches that are cut,
 * since the limit of reach goes through them. */
static void views_hold_what_single_rays_find(void **state)
{
    (void)state;
    stage s;
    stage_open(&s, criterion_of_all, SP_TRAJECTORY_PARABOLA);
    const sp_patches *patches = sp_evaluator_patches(s.room.evaluator);
    sp_vec3 gravity = sp_evaluator_gravity(s.room.evaluator, NULL);
    double speed = s.ready.candidates.launches[1].speed;
    bool *is_cut = calloc(patches->count, sizeof *is_cut);
    for (uint32_t site = 0; site < s.ready.sites.count; site++) {
        const sp_view *view = &s.ready.visibility.views[site * 2 + 1];
        size_t expected = 0, whole = 0;
        double sum = 0, found = 0;
        for (size_t i = 0; i < view->count; i++)
            is_cut[view->patch[i]] = view->part && view->part[i] < 1;
        for (size_t p = 0; p < patches->count; p++) {
            sp_flight flights[2];
            if (is_cut[p])
                continue;
            int count = sp_flights(s.ready.sites.items[site].position, patches->point[p], speed, gravity, flights);
            for (int k = 0; k < count; k++) {
                sp_vec3 w = flights[k].velocity;
                double against = -sp_dot(w, patches->normal[p]) / sp_length(w);
                sp_ray ray = {s.ready.sites.items[site].position, sp_scale(flights[k].direction, speed),
                              1e-7 * flights[k].time, (1 - 1e-7) * flights[k].time, patches->triangle[p]};
                if (against <= 0 || acos(against) > 80 * DEGREE || sp_length(w) < 3 ||
                    sp_trace_occluded(sp_evaluator_tracer(s.room.evaluator), &ray, gravity))
                    continue;
                expected++;
                sum += against * sp_length(w) / flights[k].spread;
            }
        }
        assert_true(expected > 100);
        for (size_t i = 0; i < view->count; i++)
            if (!is_cut[view->patch[i]]) {
                found += (double)view->transfer[i] / s.ready.search.all;
                whole++;
            }
        assert_int_equal(whole, expected);
        assert_int_equal(view->start[SP_BINS], view->count);
        assert_true(fabs(found - sum) < 1e-5 * sum);
        for (size_t i = view->count; i < view->count + SP_LANES; i++)
            assert_true(view->x[i] == 0 && view->y[i] == 0 && view->z[i] == 0 && view->transfer[i] == 0);
    }
    free(is_cut);
    stage_close(&s);
}

/* How far a direction is from the pattern's edge, rad. */
static double margin_of(const sp_nozzle *nozzle, sp_vec3 up, sp_vec3 d)
{
    sp_spray spray = sp_spray_create(nozzle->type, sp_nozzle_angle(nozzle));
    sp_frame frame = sp_nozzle_frame(nozzle->axis, nozzle->roll, up);
    return sp_spray_margin(&spray, sp_v(sp_dot(d, frame.x), sp_dot(d, frame.y), sp_dot(d, frame.z)));
}

/* The field of a pose is what the evaluator deposits, but where a patch's point lies on the pattern's very edge. */
static void fields_are_the_evaluators(void **state)
{
    (void)state;
    const sp_trajectory trajectories[] = {SP_TRAJECTORY_LINE, SP_TRAJECTORY_PARABOLA};
    for (int t = 0; t < 2; t++) {
        stage s;
        sp_error error = {0};
        stage_open(&s, criterion_of_all, trajectories[t]);
        const sp_patches *patches = sp_evaluator_patches(s.room.evaluator);
        float *field = malloc(patches->count * sizeof *field);
        size_t poses = s.ready.candidates.pose_start[s.ready.sites.count], compared = 0, at_edges = 0;
        sp_vec3 up = sp_v(0, 0, 1);
        for (size_t number = 0; number < poses; number += poses / 60) {
            sp_pose pose = pose_of(&s, number);
            sp_nozzle nozzle = sp_pose_nozzle(&s.ready.candidates, &s.ready.sites, pose, up);
            sp_layout *layout = sp_layout_create(&nozzle, 1, &error);
            sp_coverage *coverage = sp_evaluate_inverse(s.room.evaluator, layout, &error);
            sp_field_pose(&s.ready.search, pose, field);
            for (size_t p = 0; p < patches->count; p++) {
                sp_flight flights[2];
                double speed = sp_nozzle_speed(&nozzle, &s.room.setup.liquid);
                int count = sp_flights(nozzle.position, patches->point[p], speed,
                                       sp_evaluator_gravity(s.room.evaluator, NULL), flights);
                bool at_edge = false;
                for (int k = 0; k < count; k++)
                    at_edge |= fabs(margin_of(&nozzle, up, flights[k].direction)) < 1e-5;
                double even = coverage->deposits.even[p] / criterion_of_all.flux, dry = coverage->deposits.dry[p];
                double expected = dry < 1 ? dry - 1 : even, allowed = dry < 1 ? 1e-4 : 1e-5 * even;
                if (at_edge)
                    continue;
                if (fabs((double)field[p] - expected) > allowed)
                    fail_msg("pose %zu patch %zu: field %g, deposits %g", number, p, (double)field[p], expected);
                compared += expected != 0;
                at_edges += dry < 1;
            }
            sp_coverage_destroy(coverage);
            sp_layout_destroy(layout);
        }
        assert_true(compared > 1000 && at_edges > 1000);
        free(field);
        stage_close(&s);
    }
}

/* How much an arrival of a view counts for. */
static double part_of(const sp_view *view, size_t i, const sp_spray *spray, const sp_frame *frame, double strength)
{
    sp_vec3 d = sp_unit(sp_v((double)view->x[i], (double)view->y[i], (double)view->z[i]));
    if (strength * (double)view->transfer[i] >= 1)
        return sp_spray_share(spray, frame, d, 1 / (double)view->sharp[i]);
    return sp_spray_intensity(spray, sp_v(sp_dot(d, frame->x), sp_dot(d, frame->y), sp_dot(d, frame->z))) > 0;
}

/* Every instruction set that this processor has gives the same bits, and the sums are those of a plain loop. */
static void every_instruction_set_gives_the_same_bits(void **state)
{
    (void)state;
    stage s;
    stage_open(&s, criterion_of_all, SP_TRAJECTORY_PARABOLA);
    uint64_t random = 7;
    size_t room = s.ready.visibility.largest + 2 * SP_LANES, poses = s.ready.candidates.pose_start[s.ready.sites.count];
    size_t told_early = 0; /* by the bins alone */
    float *items[2] = {malloc(room * sizeof(float)), malloc(room * sizeof(float))}, totals[2][SP_BINS];
    for (size_t number = 0; number < poses; number += poses / 300) {
        sp_pose pose = pose_of(&s, number);
        const sp_variant *variant = &s.ready.candidates.variants[pose.variant];
        const sp_view *view = &s.ready.visibility.views[pose.site * 2 + variant->launch];
        sp_nozzle nozzle = sp_pose_nozzle(&s.ready.candidates, &s.ready.sites, pose, sp_v(0, 0, 1));
        sp_frame frame = sp_nozzle_frame(nozzle.axis, nozzle.roll, sp_v(0, 0, 1));
        /* of some arrivals enough for one nozzle alone */
        const double strength = 1 / (s.ready.search.all * (0.3 + 2 * next_random(&random)));
        sp_region region = sp_region_create(&variant->spray, &frame, strength, 0);
        sp_cull cull;
        sp_cull_create(&s.ready.visibility.bins, view, &variant->spray, SP_COUNT_SHARE, &cull);
        double naive[2] = {0}, first[2], sums[2];
        for (size_t i = 0; i < room; i++)
            for (int k = 0; k < 2; k++)
                items[k][i] = (float)next_random(&random);
        for (size_t i = 0; i < view->count; i++)
            for (int k = 0; k < 2; k++)
                naive[k] += part_of(view, i, &variant->spray, &frame, strength) * (double)items[k][i];
        for (size_t set = 0; set < sp_pattern_kernel_set_count; set++) {
            const sp_pattern_kernels *kernels = sp_pattern_kernel_sets[set];
            if (!kernels->available())
                continue;
            const sp_weight weights[2] = {{items[0], totals[0]}, {items[1], totals[1]}};
            for (int k = 0; k < 2; k++)
                kernels->total(view, items[k], totals[k]);
            kernels->sum(&s.ready.visibility.bins, &cull, &region, view, weights, 2, 0, sums);
            for (int k = 0; k < 2; k++) {
                double alone;
                kernels->sum(&s.ready.visibility.bins, &cull, &region, view, &weights[k], 1, 0, &alone);
                assert_true(alone == sums[k]);
                assert_true(fabs(sums[k] - naive[k]) <= 1e-4 * naive[k] + 1e-3);
                if (kernels == sp_pattern_kernels_best())
                    first[k] = sums[k];
                assert_true(sums[k] == first[k]);
            }
            for (double share = 0.5; share < 20; share *= 2) {
                double least = share * sums[0], early[2];
                kernels->sum(&s.ready.visibility.bins, &cull, &region, view, weights, 2, least, early);
                bool exact = early[0] == sums[0] && early[1] == sums[1];
                assert_true(exact || (early[0] >= sums[0] && early[1] >= sums[1] && early[0] < least));
                told_early += !exact;
            }
        }
    }
    assert_true(told_early > 0);
    free(items[0]);
    free(items[1]);
    stage_close(&s);
}

/* A score is what the field adds to what is wet, patch by patch, where no two arcs meet. */
static void scores_are_what_fields_add(void **state)
{
    (void)state;
    for (int single = 0; single < 2; single++) {
        stage s;
        sp_error error = {0};
        sp_criterion criterion = criterion_of_all;
        criterion.combine = single ? SP_COMBINE_SINGLE : SP_COMBINE_SUM;
        stage_open(&s, criterion, SP_TRAJECTORY_LINE);
        size_t patches = s.ready.search.patch_count, poses = s.ready.candidates.pose_start[s.ready.sites.count];
        float *field = malloc(patches * sizeof *field);
        sp_partial partial;
        assert_true(sp_partial_create(&s.ready.search, &partial, &error));
        sp_scorer *scorer = sp_scorers_create(&s.ready.search, 1, &error);
        uint64_t random = 11;
        double total = 0;
        for (size_t p = 0; p < patches; p++) {
            partial.wet[p] = (float)(1.5 * next_random(&random));
            partial.dry[p] = (float)next_random(&random);
        }
        for (size_t number = 0; number < poses; number += 1 + poses / 500) {
            sp_pose pose = pose_of(&s, number);
            sp_score score = sp_score_pose(scorer, &s.ready.search, &partial, pose, 0);
            sp_field_pose(&s.ready.search, pose, field);
            double gain = sp_field_gain(&s.ready.search, &partial, field), room = 0;
            for (size_t p = 0; p < patches; p++)
                room += field[p] != 0 && partial.wet[p] < 1
                            ? s.ready.search.all * (double)s.ready.search.area[p] *
                                  fmin(1, fabs((double)fminf(field[p], 0)) + (field[p] > 0)) *
                                  (1 - (double)sp_worth(&s.ready.search, partial.wet[p], partial.dry[p]))
                            : 0;
            /* single precision may see two points on the pattern's very edge otherwise */
            assert_true(fabs(score.gain - gain) <= 1e-4 * gain + 2 * TEXEL * TEXEL);
            assert_true(fabs(score.room - room) <= 1e-4 * room + 2 * TEXEL * TEXEL);
            total += gain;
        }
        assert_true(total > 0);
        /* what is wet by now counts only once the scorer has been told */
        sp_pose pose = pose_of(&s, poses - 1);
        double before = sp_score_pose(scorer, &s.ready.search, &partial, pose, 0).gain;
        for (size_t p = 0; p < patches; p++)
            partial.wet[p] = 2;
        assert_true(before > 0 && sp_score_pose(scorer, &s.ready.search, &partial, pose, 0).gain == before);
        sp_scorers_forget(scorer, 1);
        assert_true(sp_score_pose(scorer, &s.ready.search, &partial, pose, 0).gain == 0);
        sp_scorers_destroy(scorer, 1);
        free(field);
        sp_partial_free(&partial);
        stage_close(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(views_hold_what_single_rays_find),
        cmocka_unit_test(fields_are_the_evaluators),
        cmocka_unit_test(every_instruction_set_gives_the_same_bits),
        cmocka_unit_test(scores_are_what_fields_add),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
