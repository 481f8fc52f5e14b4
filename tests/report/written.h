/* A result with a proposal, written: `FOLDER` of the test's own. */
#ifndef TESTS_REPORT_WRITTEN_H
#define TESTS_REPORT_WRITTEN_H

#include "tank.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <jansson.h>

typedef struct {
    sp_mesh *mesh;
    sp_evaluator *evaluator;
    sp_layout *layouts[3];
    sp_coverage *coverages[3];
    sp_contributions *contributions[3];
    sp_design designs[3];
    sp_front_point front[3];
    sp_stage stages[2];
    sp_proposal proposal;
    sp_result result;
} fixture;

static const sp_input read_once = {"<i>.yaml", "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"};

/* Three layouts in the tank, evaluated. False with an error. */
static inline bool evaluate_designs(fixture *f, sp_error *error)
{
    static const char *const names[] = {"manual", "greedy", "proposed"};
    f->mesh = tank_mesh(48, error);
    sp_setup setup = tank_setup(f->mesh, 0.02);
    f->evaluator = sp_evaluator_create(&setup, error);
    f->layouts[0] = sp_layout_create(tank_manual, 3, error);
    f->layouts[1] = sp_layout_create(tank_proposed, 3, error);
    f->layouts[2] = sp_layout_create(tank_proposed, 4, error);
    for (int i = 0; i < 3; i++) {
        f->coverages[i] = sp_evaluate(f->evaluator, f->layouts[i], error);
        sp_evaluate_balance(f->evaluator, f->layouts[i], f->coverages[i], error);
        sp_measure_error(f->evaluator, f->layouts[i], f->coverages[i], SP_TRAJECTORY_AUTO, 1,
                         &f->coverages[i]->measured, error);
        f->contributions[i] = sp_contributions_create(f->evaluator, f->layouts[i], f->coverages[i], error);
        f->designs[i] = (sp_design){.name = names[i],
                                    .evaluator = f->evaluator,
                                    .layout = f->layouts[i],
                                    .coverage = f->coverages[i],
                                    .contributions = f->contributions[i]};
    }
    return error->kind == SP_OK;
}

/* What the last layout covers is attainable; of the rest there are two reasons why not. */
static inline void propose(fixture *f)
{
    const sp_coverage *coverage = f->coverages[2];
    size_t patches = sp_evaluator_patches(f->evaluator)->count;
    bool *attainable = malloc(patches);
    memcpy(attainable, coverage->deposits.covered, patches);
    sp_reason *reasons = malloc(patches * sizeof *reasons);
    for (size_t i = 0; i < patches; i++)
        reasons[i] = attainable[i] ? SP_REASON_ATTAINABLE : i % 3 ? SP_REASON_SLANTED : SP_REASON_NO_LINE;
    for (int i = 0; i < 3; i++)
        f->front[i] = (sp_front_point){.flow = coverage->flow * (i + 1) / 3,
                                       .area = coverage->covered_area * (0.7 + 0.1 * i),
                                       .nozzles = (size_t)i + 1,
                                       .bound = NAN,
                                       .every_aim_bound = NAN,
                                       .counted = NAN,
                                       .outlay = coverage->flow * (i + 1) / 3};
    f->stages[0] = (sp_stage){"visibility", 1.25, 2.25};
    f->stages[1] = (sp_stage){"refine", 2.5, 4.75};
    f->proposal = (sp_proposal){.layout = f->layouts[2],
                                .coverage = f->coverages[2],
                                .greedy = f->layouts[1],
                                .greedy_coverage = f->coverages[1],
                                .attainable = attainable,
                                .reasons = reasons,
                                .attainable_area = 5,
                                .asked_area = 99,
                                .target_area = 50,
                                .positions = 100,
                                .candidates = 4000,
                                .front_count = 3,
                                .front = f->front,
                                .by_number_count = 3,
                                .by_number = f->front,
                                .stage_count = 2,
                                .stages = f->stages};
}

static inline int set_up(void **state)
{
    static fixture f;
    sp_error error = {0};
    if (!evaluate_designs(&f, &error)) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    propose(&f);
    f.result = (sp_result){.command = "place",
                           .scene = "vessel <script>alert(1)</script> & \"co\".yaml",
                           .design_count = 3,
                           .designs = f.designs,
                           .proposal = &f.proposal,
                           .input_count = 1,
                           .inputs = &read_once,
                           .command_line = "sprayplan place '<b>.yaml'",
                           .date = "2026-11-24 12:00 UTC"};
    *state = &f;
    return 0;
}

static inline int tear_down(void **state)
{
    fixture *f = *state;
    for (int i = 0; i < 3; i++) {
        sp_layout_destroy(f->layouts[i]);
        sp_coverage_destroy(f->coverages[i]);
        sp_contributions_destroy(f->contributions[i]);
    }
    free(f->proposal.attainable);
    free(f->proposal.reasons);
    sp_evaluator_destroy(f->evaluator);
    sp_mesh_destroy(f->mesh);
    return 0;
}

static inline char *read_whole(const char *name, size_t *size)
{
    char path[1024];
    snprintf(path, sizeof path, FOLDER "/%s", name);
    FILE *file = fopen(path, "rb");
    if (!file)
        return NULL;
    fseek(file, 0, SEEK_END);
    long length = ftell(file);
    rewind(file);
    char *bytes = malloc((size_t)length + 1);
    assert_int_equal(fread(bytes, 1, (size_t)length, file), (size_t)length);
    fclose(file);
    bytes[length] = 0;
    *size = (size_t)length;
    return bytes;
}

static inline void write_report(const fixture *f)
{
    sp_error error = {0};
    sp_output *output = sp_output_open(FOLDER, &error);
    assert_non_null(output);
    if (!sp_report_write(&f->result, output, &error))
        fail_msg("%s", error.message);
    assert_true(sp_output_commit(output, &error));
}

static inline size_t occurrences(const char *text, const char *part)
{
    size_t count = 0;
    for (; (text = strstr(text, part)); text += strlen(part))
        count++;
    return count;
}

static inline double real_of(const json_t *object, const char *key)
{
    return json_number_value(json_object_get(object, key));
}

static inline void expect_keys(const json_t *object, const char *const *keys, size_t count)
{
    assert_true(json_is_object(object));
    for (size_t i = 0; i < count; i++)
        if (!json_object_get(object, keys[i]))
            fail_msg("no key %s", keys[i]);
    assert_int_equal(json_object_size(object), count);
}

#define EXPECT_KEYS(object, ...)                                                                                       \
    do {                                                                                                               \
        static const char *const keys[] = {__VA_ARGS__};                                                               \
        expect_keys(object, keys, sizeof keys / sizeof *keys);                                                         \
    } while (0)

static inline void same_real(double a, double b)
{
    assert_true((isnan(a) && isnan(b)) || fabs(a - b) <= 1e-12 * fabs(a));
}

#endif
