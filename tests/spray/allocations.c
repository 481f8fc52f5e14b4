/* What evaluates, on several threads, with each of its allocations failing in turn. */
#include <sprayplan/deviation.h>
#include <sprayplan/points.h>
#include <sprayplan/scene.h>

#include "../cli/faults/each.h"

#include <stdio.h>
#include <stdlib.h>

#ifdef SPRAYPLAN_SANITIZE
enum { STEP = 60 };
#else
enum { STEP = 4 };
#endif

#define ROOM "room-test.obj"
#define CATALOGUE "catalogue-test.yaml"

static const char room_obj[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                               "f 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";

static const char catalogue_yaml[] =
    "nozzles:\n"
    "  - {name: cone, pattern: full_cone, angle: 120 deg, flow: 12 L/min, at: 2 bar, exponent: 0.46, drop: 1 mm}\n";

#define SCENE(criterion, simulate)                                                                                     \
    "geometry:\n"                                                                                                      \
    "  - file: " ROOM "\n"                                                                                             \
    "criterion: {" criterion "}\n"                                                                                     \
    "catalogue: " CATALOGUE "\n"                                                                                       \
    "nozzles:\n"                                                                                                       \
    "  - {name: N1, type: cone, position: [0.5 m, 0.5 m, 0.9 m], axis: [0, 0, -1], pressure: 2 bar}\n"                 \
    "  - {name: N2, type: cone, position: [0.4 m, 0.5 m, 0.4 m], axis: [1, 0, 0], pressure: 3 bar}\n"                  \
    "simulate: {accuracy: 20 %" simulate "}\n"

static sp_scene *load(const char *text, sp_error *error)
{
    FILE *file = fopen("scene-test.yaml", "wb");
    assert_true(file && fputs(text, file) >= 0 && fclose(file) == 0);
    sp_scene *scene = sp_scene_load("scene-test.yaml", error);
    assert_int_equal(remove("scene-test.yaml"), 0);
    return scene;
}

static bool measure(const sp_evaluator *evaluator, const sp_layout *layout, sp_coverage *coverage, sp_error *error)
{
    double bound;
    return sp_evaluate_balance(evaluator, layout, coverage, error) &&
           sp_measure_error(evaluator, layout, coverage, SP_TRAJECTORY_AUTO, 1, &coverage->measured, error) &&
           sp_find_borderline(evaluator, layout, coverage, NULL, &coverage->borderline, error) &&
           (sp_evaluator_fidelity(evaluator)->trajectory != SP_TRAJECTORY_LINE ||
            sp_bound_lines(evaluator, layout, &bound, NULL, error));
}

static const sp_evaluator *seen;
static const sp_setup *setup;
static const sp_layout *layout;

static bool evaluate(uint64_t *digest, sp_error *error)
{
    sp_evaluator *evaluator = sp_evaluator_create_for(setup, layout, error);
    sp_coverage *coverage = evaluator ? sp_evaluate(evaluator, layout, error) : NULL;
    bool good = coverage && measure(evaluator, layout, coverage, error);
    if (good) {
        *digest = hash(*digest, coverage->deposits.covered, sp_evaluator_patches(evaluator)->count);
        *digest = hash(*digest, &coverage->covered_area, sizeof coverage->covered_area);
        *digest = hash(*digest, &coverage->measured, sizeof coverage->measured);
    }
    sp_coverage_destroy(coverage);
    sp_evaluator_destroy(evaluator);
    return good;
}

/* All but the bytes between what it holds, which may be any. */
static uint64_t hash_arrival(uint64_t digest, const sp_arrival *arrival)
{
    const bool flags[] = {arrival->passes, arrival->blocked};
    digest = hash(digest, &arrival->patch, sizeof arrival->patch);
    digest = hash(digest, flags, sizeof flags);
    digest = hash(digest, &arrival->arc, sizeof arrival->arc);
    return hash(digest, &arrival->part, sizeof *arrival - offsetof(sp_arrival, part));
}

static bool reach(uint64_t *digest, sp_error *error)
{
    sp_reach *found =
        sp_evaluator_reach(seen, sp_v(0.4, 0.5, 0.6), (sp_launch){.speed = 20}, sp_v(0, 0, 1), M_PI, error);
    for (size_t i = 0; found && i < found->count; i++)
        *digest = hash_arrival(*digest, &found->arrivals[i]);
    sp_reach_destroy(found);
    return found != NULL;
}

/* Several threads trace at a time. */
static void reaches(void **state)
{
    (void)state;
    sp_error error = {0};
    sp_scene *scene = load(SCENE("flux: 1 L/min/m2", ", trajectory: line, texel: 40 mm"), &error);
    sp_setup own = *sp_scene_setup(scene);
    own.run.threads = 3;
    sp_evaluator *evaluator = sp_evaluator_create_for(&own, NULL, &error);
    assert_non_null(evaluator);
    seen = evaluator;
    print_message("reach: %ld allocations\n", fail_each("reach", reach, 1));
    sp_evaluator_destroy(evaluator);
    sp_scene_destroy(scene);
}

static void fail_each_of(const char *name, const char *text)
{
    sp_error error = {0};
    sp_scene *scene = load(text, &error);
    if (!scene)
        fail_msg("%s", error.message);
    sp_setup own = *sp_scene_setup(scene);
    own.run.threads = 3;
    setup = &own;
    layout = sp_scene_layout(scene);
    print_message("%s: %ld allocations\n", name, fail_each(name, evaluate, getenv("SPRAYPLAN_LONG") ? 1 : STEP));
    sp_scene_destroy(scene);
}

static void lines(void **state)
{
    (void)state;
    fail_each_of("lines", SCENE("flux: 1 L/min/m2", ", texel: 250 mm, trajectory: line"));
}

static void parabolas_one_nozzle_alone(void **state)
{
    (void)state;
    fail_each_of("parabolas", SCENE("flux: 1 L/min/m2, combine: single", ", texel: 250 mm, trajectory: parabola"));
}

static void jets(void **state)
{
    (void)state;
    fail_each_of("jets",
                 SCENE("impact_speed: 1 m/s", ", texel: 250 mm, evaluator: forward, jets: 100, reflections: 1"));
}

static int open_files(void **state)
{
    (void)state;
    FILE *room = fopen(ROOM, "wb"), *catalogue = fopen(CATALOGUE, "wb");
    return room && catalogue && fputs(room_obj, room) >= 0 && fputs(catalogue_yaml, catalogue) >= 0 && !fclose(room) &&
                   !fclose(catalogue)
               ? 0
               : -1;
}

static int close_files(void **state)
{
    (void)state;
    return remove(ROOM) || remove(CATALOGUE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reaches),
        cmocka_unit_test(lines),
        cmocka_unit_test(parabolas_one_nozzle_alone),
        cmocka_unit_test(jets),
    };
    return cmocka_run_group_tests(tests, open_files, close_files);
}
