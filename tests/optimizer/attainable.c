/* What is attainable, and why the rest is not, where it is known in closed form. */
#include "room.h"

#include "scoring/prepare.h"
#include "scoring/footprints.h"

#define TEXEL 0.04

#define FLOW (20 * LITRES_PER_MINUTE)
#define HEIGHT 2.0 /* m of the nozzle above the floor */

/* A floor of 6 m, and above it what a test adds; straight jets downwards from one point. */
typedef struct {
    room room;
    room_builder builder;
    sp_nozzle_type type;
    const sp_nozzle_type *types[1];
    double pressure;
    sp_mount mount;
    sp_place_options options;
    sp_proposal *proposal;
    double area[SP_REASONS];
    bool hurries; /* too much to look into everything */
} job;

static void job_begin(job *j, double angle)
{
    *j = (job){.pressure = 2e5};
    room_part(&j->builder, "floor");
    room_sheet(&j->builder, sp_v(-3, -3, 0), sp_v(6, 0, 0), sp_v(0, 6, 0));
    j->room.setup = sp_setup_default();
    j->room.setup.fidelity.trajectory = SP_TRAJECTORY_LINE;
    j->type = room_cone("cone", angle, FLOW / LITRES_PER_MINUTE);
    j->types[0] = &j->type;
    j->mount =
        (sp_mount){.kind = SP_MOUNT_BOX, .axis = sp_v(0, 0, -1), .from = sp_v(0, 0, HEIGHT), .to = sp_v(0, 0, HEIGHT)};
    j->options = room_options();
    j->options.objective = SP_OBJECTIVE_MAX_COVERAGE;
    j->options.max_nozzles = 1;
    /* small rooms: what threads would wait for each other is more than they save */
    j->options.run.threads = j->room.setup.run.threads = 1;
}

static void job_place(job *j)
{
    sp_error error = {0};
    j->options.types = j->types;
    j->options.type_count = 1;
    j->options.pressures = &j->pressure;
    j->options.pressure_count = 1;
    j->options.mounts = &j->mount;
    j->options.mount_count = 1;
    j->proposal = sp_place(j->room.evaluator, &j->options, &error);
    assert_string_equal(error.message, "");
    assert_non_null(j->proposal);
    const sp_patches *patches = sp_evaluator_patches(j->room.evaluator);
    double total = 0;
    for (size_t i = 0; i < SP_REASONS; i++)
        j->area[i] = 0;
    for (size_t p = 0; p < patches->count; p++) {
        sp_reason reason = j->proposal->reasons[p];
        assert_int_equal(reason == SP_REASON_ATTAINABLE, j->proposal->attainable[p]);
        j->area[reason] += patches->area[p];
    }
    for (size_t i = 0; i < SP_REASONS; i++)
        total += j->area[i];
    assert_true(fabs(total - patches->total_area) < 1e-9);
    assert_true(fabs(j->area[SP_REASON_ATTAINABLE] - j->proposal->attainable_area) < 1e-9);
    assert_true((j->area[SP_REASON_UNKNOWN] > 0) == j->hurries);
}

static void job_run_coarse(job *j, double texel)
{
    room_open(&j->room, &j->builder, texel);
    job_place(j);
}

static void job_run(job *j)
{
    job_run_coarse(j, TEXEL);
}

static void job_end(job *j)
{
    sp_proposal_destroy(j->proposal);
    room_close(&j->room);
}

static double disc(double radius)
{
    return M_PI * radius * radius;
}

#define assert_area(found, expected)                                                                                   \
    do {                                                                                                               \
        if (!(fabs((found) - (expected)) < 0.02 * (expected) + 1e-9))                                                  \
            fail_msg("%s: %g m2, expected %g", #found, (double)(found), (double)(expected));                           \
    } while (0)

/* Flux of a cone of half-angle a on a floor, at the angle b from its axis: Q cos³b / (2π (1 - cos a) h²). */
static double flux_at(double half_angle, double b)
{
    return FLOW * pow(cos(b), 3) / (2 * M_PI * (1 - cos(half_angle)) * HEIGHT * HEIGHT);
}

static void beyond_the_cone_there_is_no_line(void **state)
{
    (void)state;
    job j;
    job_begin(&j, 60 * DEGREE);
    j.room.setup.criterion.flux = flux_at(30 * DEGREE, 20 * DEGREE);
    job_run(&j);
    double cone = disc(HEIGHT * tan(30 * DEGREE)), wet = disc(HEIGHT * tan(20 * DEGREE));
    assert_area(j.area[SP_REASON_ATTAINABLE], wet);
    assert_area(j.area[SP_REASON_FLUX], cone - wet);
    assert_area(j.area[SP_REASON_NO_LINE], 36 - cone);
    job_end(&j);

    /* a lean of 10 degrees takes the cone's edge from 30 to 40 degrees, and the flux reaches as far as before */
    job_begin(&j, 60 * DEGREE);
    j.room.setup.criterion.flux = flux_at(30 * DEGREE, 20 * DEGREE);
    j.mount.tilt = 10 * DEGREE;
    job_run(&j);
    cone = disc(HEIGHT * tan(40 * DEGREE));
    assert_area(j.area[SP_REASON_ATTAINABLE], wet);
    assert_area(j.area[SP_REASON_FLUX], cone - wet);
    assert_area(j.area[SP_REASON_NO_LINE], 36 - cone);
    job_end(&j);
}

static void a_plate_throws_its_shadow(void **state)
{
    (void)state;
    job j;
    job_begin(&j, 100 * DEGREE);
    room_part(&j.builder, "plate");
    room_sheet(&j.builder, sp_v(-0.2, -0.2, 1), sp_v(0.4, 0, 0), sp_v(0, 0.4, 0));
    room_open(&j.room, &j.builder, TEXEL);
    job_place(&j);
    double cone = disc(HEIGHT * tan(50 * DEGREE));
    /* the plate is half way: its shadow is four times as large */
    assert_area(j.area[SP_REASON_ATTAINABLE], cone - 0.64 + 0.16);
    assert_area(j.area[SP_REASON_NO_LINE], 36 + 0.16 - j.area[SP_REASON_ATTAINABLE]);
    const sp_patches *patches = sp_evaluator_patches(j.room.evaluator);
    for (size_t p = 0; p < patches->count; p++) {
        sp_vec3 at = patches->point[p];
        if (at.z < 0.5 && fabs(at.x) < 0.35 && fabs(at.y) < 0.35)
            assert_int_equal(j.proposal->reasons[p], SP_REASON_NO_LINE);
    }
    job_end(&j);
}

static void slow_and_slanted(void **state)
{
    (void)state;
    job j;
    job_begin(&j, 100 * DEGREE);
    j.room.setup.criterion.incidence = 30 * DEGREE;
    job_run(&j);
    double cone = disc(HEIGHT * tan(50 * DEGREE)), steep = disc(HEIGHT * tan(30 * DEGREE));
    assert_area(j.area[SP_REASON_ATTAINABLE], steep);
    assert_area(j.area[SP_REASON_SLANTED], cone - steep);
    assert_area(j.area[SP_REASON_NO_LINE], 36 - cone);
    job_end(&j);

    /* too slow counts before too slanted: a steeper jet would not help */
    job_begin(&j, 100 * DEGREE);
    j.room.setup.criterion.incidence = 30 * DEGREE;
    j.room.setup.criterion.impact_speed = 1.01 * 0.95 * sqrt(2 * 2e5 / 1000);
    job_run(&j);
    assert_true(j.area[SP_REASON_ATTAINABLE] == 0 && j.area[SP_REASON_SLANTED] == 0);
    assert_area(j.area[SP_REASON_SLOW], cone);
    job_end(&j);
}

/* A nozzle hanging between floor and ceiling sprays the floor; a floor that mirrors sends it to the ceiling. */
static void by_reflection_only(void **state)
{
    (void)state;
    for (int mirror = 0; mirror < 2; mirror++) {
        job j;
        job_begin(&j, 40 * DEGREE);
        room_part(&j.builder, "ceiling");
        room_sheet(&j.builder, sp_v(-3, -3, 3), sp_v(6, 0, 0), sp_v(0, 6, 0));
        room_open(&j.room, &j.builder, TEXEL);
        j.room.surfaces[0].restitution = mirror;
        /* the evaluator has the surfaces at hand, and knows by then that it is to be inverse */
        job_place(&j);
        double cone = disc(HEIGHT * tan(20 * DEGREE)), thrown = disc((HEIGHT + 3) * tan(20 * DEGREE));
        assert_area(j.area[SP_REASON_ATTAINABLE], cone);
        if (!mirror)
            assert_true(j.area[SP_REASON_REFLECTION] == 0);
        else
            assert_true(fabs(j.area[SP_REASON_REFLECTION] - thrown) < 0.05 * thrown);
        assert_area(j.area[SP_REASON_NO_LINE], 72 - cone - j.area[SP_REASON_REFLECTION]);
        job_end(&j);
    }
}

/* Interrupts when it has been asked so many times during the stage. */
typedef struct {
    size_t asked, most;
} patience;

static bool ask(void *user, const char *stage, double done)
{
    patience *own = user;
    (void)done;
    own->asked += !strcmp(stage, "attainable");
    return own->asked <= own->most;
}

/* The same room over a floor that mirrors or does not, until that is asked so many times. */
static double reflected_area(double mirror, patience *patience)
{
    job j;
    job_begin(&j, 40 * DEGREE);
    room_part(&j.builder, "ceiling");
    room_sheet(&j.builder, sp_v(-3, -3, 3), sp_v(6, 0, 0), sp_v(0, 6, 0));
    room_open(&j.room, &j.builder, 4 * TEXEL);
    j.room.surfaces[0].restitution = mirror;
    j.options.run.progress = ask;
    j.options.run.user = patience;
    job_place(&j);
    double area = j.area[SP_REASON_REFLECTION];
    job_end(&j);
    return area;
}

static void reflections_stop_when_they_are_interrupted(void **state)
{
    (void)state;
    patience before = {.most = SIZE_MAX}, all = before;
    assert_true(reflected_area(0, &before) == 0);
    assert_true(reflected_area(1, &all) > 0);
    assert_true(all.asked > before.asked);
    patience little = {.most = before.asked};
    assert_true(reflected_area(1, &little) == 0);
}

/* Two nozzles bring twice the flux of one: with `sum` that counts, with `single` it does not. */
static void together_or_each_alone(void **state)
{
    (void)state;
    double half = 30 * DEGREE, alone = disc(HEIGHT * tan(15 * DEGREE)), cone = disc(HEIGHT * tan(half));
    double twice_the_flux = 0.5 * flux_at(half, 15 * DEGREE), b = acos(cbrt(twice_the_flux / flux_at(half, 0)));
    double together = disc(HEIGHT * tan(fmin(b, half)));
    for (int single = 0; single < 2; single++)
        for (size_t nozzles = 1; nozzles <= 2; nozzles++) {
            job j;
            job_begin(&j, 2 * half);
            j.room.setup.criterion.flux = flux_at(half, 15 * DEGREE);
            j.room.setup.criterion.combine = single ? SP_COMBINE_SINGLE : SP_COMBINE_SUM;
            j.options.max_nozzles = nozzles;
            job_run(&j);
            double expected = single || nozzles == 1 ? alone : together;
            assert_area(j.area[SP_REASON_ATTAINABLE], expected);
            assert_true(fabs(j.area[SP_REASON_FLUX] - (cone - expected)) < 0.02 * cone);
            assert_area(j.proposal->coverage->covered_area, expected);
            job_end(&j);
        }
    assert_true(together > 1.5 * alone);
}

static void assert_same_layouts(const sp_layout *a, const sp_layout *b)
{
    assert_int_equal(a->count, b->count);
    for (size_t i = 0; i < a->count; i++) {
        assert_memory_equal(&a->nozzles[i].position, &b->nozzles[i].position, sizeof(sp_vec3));
        assert_memory_equal(&a->nozzles[i].axis, &b->nozzles[i].axis, sizeof(sp_vec3));
    }
}

typedef struct {
    sp_sites sites;
    sp_candidates candidates;
    sp_deadline deadline;
    sp_visibility visibility;
    sp_evaluator *resampled;
    size_t kept;
} outlook;

static void outlook_begin(const job *j, outlook *o)
{
    sp_error error = {0};
    *o = (outlook){.deadline = sp_deadline_start(&j->options.run)};
    assert_true(sp_sites_create(j->room.evaluator, &j->options, &o->sites, &error));
    assert_true(sp_candidates_create(j->room.evaluator, &j->options, &o->sites, &o->candidates, &error));
}

static void look_around(const job *j, outlook *o)
{
    sp_error error = {0};
    outlook_begin(j, o);
    assert_true(sp_visibility_fit(j->room.evaluator, &j->options, &o->sites, &o->candidates, &o->deadline,
                                  &o->resampled, &o->visibility, &error));
    for (size_t v = 0; v < o->sites.count; v++)
        o->kept += o->visibility.views[v].start != NULL;
}

static void look_away(outlook *o)
{
    sp_visibility_free(&o->visibility);
    sp_evaluator_destroy(o->resampled);
    sp_candidates_free(&o->candidates);
    sp_sites_free(&o->sites);
}

#ifdef SPRAYPLAN_SANITIZE
#define MEMORY_TEXEL 0.14
#else
#define MEMORY_TEXEL 0.1
#endif

/* Little memory means more work, not another answer, of two threads neither; and too little is an error. */
static void little_memory_is_enough(void **state)
{
    (void)state;
    job j;
    job_begin(&j, 60 * DEGREE);
    j.mount.from = sp_v(-2, -2, HEIGHT);
    j.mount.to = sp_v(2, 2, HEIGHT);
    j.mount.spacing = 1.4;
    j.mount.tilt = 20 * DEGREE;
    j.options.max_nozzles = 2;
    j.options.refine = sp_place_options_default().refine;
    job_run_coarse(&j, MEMORY_TEXEL);
    sp_proposal *first = j.proposal;
    outlook plenty, scarce;
    look_around(&j, &plenty);
    j.options.memory = 0.5 * plenty.visibility.bytes;
    look_around(&j, &scarce);
    assert_true(scarce.kept < plenty.kept);
    look_away(&scarce);
    look_away(&plenty);
    j.options.run.threads = 2;
    job_place(&j);
    room_check(j.proposal, &j.options);
    assert_same_layouts(first->layout, j.proposal->layout);
    assert_same_layouts(first->greedy, j.proposal->greedy);
    assert_memory_equal(j.proposal->coverage->deposits.counted, first->coverage->deposits.counted,
                        first->coverage->deposits.count * sizeof(double));
    assert_int_equal(j.proposal->front_count, first->front_count);
    assert_memory_equal(j.proposal->front, first->front, first->front_count * sizeof *first->front);
    assert_true(j.proposal->certificate.area_bound == first->certificate.area_bound);
    assert_true(j.proposal->certificate.water_bound == first->certificate.water_bound);
    assert_true(j.proposal->certificate.texels == first->certificate.texels);
    sp_proposal_destroy(j.proposal);
    j.proposal = first;
    sp_error error = {0};
    j.options.memory = 1e4;
    assert_null(sp_place(j.room.evaluator, &j.options, &error));
    assert_int_equal(error.kind, SP_ERROR_INPUT);
    assert_non_null(strstr(error.message, "memory"));
    job_end(&j);
}

/* Whatever does not fit is traced again when it is looked at, to the same bytes; and all takes what memory allows. */
static void views_keep_within_memory(void **state)
{
    (void)state;
    job j;
    job_begin(&j, 60 * DEGREE);
    j.mount.from = sp_v(-2, -2, HEIGHT);
    j.mount.to = sp_v(2, 2, HEIGHT);
    j.mount.spacing = 0.5;
    j.mount.tilt = 30 * DEGREE;
    job_run_coarse(&j, MEMORY_TEXEL);
    outlook plenty;
    look_around(&j, &plenty);
    size_t views = plenty.sites.count, kept[3] = {views, views, views};
    double whole = (double)views * plenty.visibility.sight_bytes, memories[3];
    assert_int_equal(plenty.kept, views);
    for (size_t v = 0; v < views; v++)
        whole += (double)sp_view_bytes(plenty.visibility.views[v].count, false);
    for (size_t i = 0; i < 3; i++)
        for (int threads = 1; threads <= 2; threads++) {
            memories[i] = whole * (0.9 - 0.25 * (double)i);
            outlook scarce;
            sp_view_buffer *buffer = NULL;
            j.options.memory = memories[i];
            j.options.run.threads = threads;
            look_around(&j, &scarce);
            assert_true(scarce.visibility.bytes <= memories[i]);
            assert_true(scarce.kept < kept[threads]);
            kept[threads] = scarce.kept;
            assert_int_equal(sp_evaluator_patches(scarce.visibility.evaluator)->count,
                             sp_evaluator_patches(plenty.visibility.evaluator)->count);
            for (uint32_t v = 0; v < views; v++) {
                const sp_view *expected = &plenty.visibility.views[v];
                const sp_view *found = sp_visibility_look(&scarce.visibility, v, 0, &buffer);
                assert_int_equal(found->count, expected->count);
                assert_memory_equal(found->start, expected->start, sp_view_bytes(found->count, found->twice != NULL));
            }
            assert_non_null(buffer);
            sp_visibility_release(&scarce.visibility, &buffer);
            look_away(&scarce);
        }
    look_away(&plenty);
    job_end(&j);
}

/* Bytes of all footprints; the search has traced them. */
static double footprints_bytes(const sp_search *search)
{
    const sp_candidates *candidates = search->candidates;
    double bytes = 0;
    for (uint32_t site = 0; site < search->sites->count; site++)
        for (uint32_t k = 0; k < candidates->variant_count; k++) {
            size_t axes = sp_candidates_axes(candidates, search->sites->items[site].mount, k)->count;
            for (uint32_t a = 0; a < axes && !sp_type_is_uniform(candidates->variants[k].type); a++)
                for (uint32_t r = 0; r < candidates->variants[k].roll_count; r++) {
                    const sp_footprint *found = sp_footprints_look(search->footprints, (sp_pose){site, k, a, r});
                    bytes += (double)(sizeof *found + found->count * sizeof *found->prints);
                }
        }
    return bytes;
}

/* Where time ends before all poses of a cluster are traced, it is not known what the rest of them attain: what is aimed
 * at is not less for it. */
static void what_is_not_looked_into_is_not_out_of_reach(void **state)
{
    (void)state;
    double attained[2], no_line[2];
    for (int hurries = 0; hurries < 2; hurries++) {
        job j;
        job_begin(&j, 0);
        sp_member hole = {.type = room_cone("hole", 60 * DEGREE, 1), .axis = sp_v(0, 0, 1), .share = 1};
        j.type.pattern = SP_PATTERN_CLUSTER;
        j.type.members = &hole;
        j.type.member_count = 1;
        j.mount.from = sp_v(-2, -2, HEIGHT);
        j.mount.to = sp_v(2, 2, HEIGHT);
        j.mount.spacing = 0.4;
        j.options.coverage = 0.7;
        j.hurries = hurries;
        j.options.run.time_limit = hurries ? 1e-9 : 0;
        job_run_coarse(&j, 0.1);
        attained[hurries] = j.area[SP_REASON_ATTAINABLE];
        no_line[hurries] = j.area[SP_REASON_NO_LINE];
        assert_true(j.area[SP_REASON_FLUX] == 0);
        assert_true(j.proposal->target_area == j.proposal->asked_area);
        assert_int_equal(j.proposal->attainable_hurried, hurries);
        job_end(&j);
    }
    assert_true(attained[1] < 0.7 * 36 && attained[0] > 0.7 * 36);
    assert_true(no_line[0] == no_line[1]);
}

/* True where the proposal names the stage among what was cut short. */
static bool is_named(const sp_proposal *proposal, const char *stage)
{
    for (size_t i = 0; i < proposal->cut_count; i++)
        if (!strcmp(proposal->cut[i], stage))
            return true;
    return false;
}

#define HURRY 90 /* s, for one thread: a placement hurries, and has more than it takes */

/* With little time the search has coarser patches, by which it is judged what clusters attain: that is told, though
 * nothing was stopped. Cones are judged on the final ones whatever the time. */
static void what_coarser_patches_tell_is_told_as_hurried(void **state)
{
    (void)state;
    for (int cluster = 0; cluster < 2; cluster++)
        for (int hurries = 0; hurries < 2; hurries++) {
            job j;
            sp_member hole = {.type = room_cone("hole", 60 * DEGREE, 1), .axis = sp_v(0, 0, 1), .share = 1};
            job_begin(&j, 60 * DEGREE);
            if (cluster) {
                j.type.pattern = SP_PATTERN_CLUSTER;
                j.type.members = &hole;
                j.type.member_count = 1;
            }
            j.options.run.time_limit = hurries ? HURRY : 0;
            job_run_coarse(&j, 0.1);
            assert_int_equal(j.proposal->attainable_hurried, cluster && hurries);
            assert_int_equal(is_named(j.proposal, "attainable"), cluster && hurries);
            job_end(&j);
        }
}

/* Views and footprints of one scene, each for itself in less than the memory there is, both together in no more. */
static void views_and_footprints_share_memory(void **state)
{
    (void)state;
    job j;
    sp_member hole = {.type = room_cone("hole", 40 * DEGREE, 1), .axis = sp_v(0, 0, 1), .share = 1};
    sp_nozzle_type ball = room_cone("ball", 0, 10);
    const sp_nozzle_type *types[2] = {&ball, &j.type};
    ball.pattern = SP_PATTERN_CLUSTER;
    ball.members = &hole;
    ball.member_count = 1;
    job_begin(&j, 60 * DEGREE);
    j.mount.from = sp_v(-2, -2, HEIGHT);
    j.mount.to = sp_v(2, 2, HEIGHT);
    j.mount.spacing = 0.5;
    room_open(&j.room, &j.builder, 0.1);
    j.options.types = types;
    j.options.type_count = 2;
    j.options.pressures = &j.pressure;
    j.options.pressure_count = 1;
    j.options.mounts = &j.mount;
    j.options.mount_count = 1;
    double memory = 0;
    for (int scarce = 0; scarce < 2; scarce++) {
        outlook o;
        sp_search search;
        sp_error error = {0};
        j.options.memory = memory; /* at first what is the default */
        outlook_begin(&j, &o);
        assert_true(sp_visibility_create(j.room.evaluator, &j.options, &o.sites, &o.candidates, &o.deadline,
                                         &o.visibility, &error)); /* on the same patches twice */
        assert_true(sp_search_create(o.visibility.evaluator, &j.options, &o.sites, &o.candidates, &o.visibility,
                                     &search, &error));
        assert_true(sp_footprints_fill(search.footprints, &o.deadline, &error));
        double views = o.visibility.bytes, footprints = footprints_bytes(&search);
        assert_true(footprints > 0 && (!scarce || views + footprints <= memory));
        memory = 0.8 * views; /* enough for either alone */
        sp_search_free(&search);
        look_away(&o);
    }
    room_close(&j.room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(beyond_the_cone_there_is_no_line),
        cmocka_unit_test(a_plate_throws_its_shadow),
        cmocka_unit_test(slow_and_slanted),
        cmocka_unit_test(by_reflection_only),
        cmocka_unit_test(reflections_stop_when_they_are_interrupted),
        cmocka_unit_test(together_or_each_alone),
        cmocka_unit_test(little_memory_is_enough),
        cmocka_unit_test(views_keep_within_memory),
        cmocka_unit_test(what_is_not_looked_into_is_not_out_of_reach),
        cmocka_unit_test(what_coarser_patches_tell_is_told_as_hurried),
        cmocka_unit_test(views_and_footprints_share_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
