#include "tank.h"

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <unistd.h>

#include <cmocka.h>
#include <jansson.h>

#define FOLDER BINARY_DIR "/report-test"

typedef struct {
    sp_mesh *mesh;
    sp_evaluator *evaluator;
    sp_layout *layouts[3];
    sp_coverage *coverages[3];
    sp_design designs[3];
    sp_front_point front[3];
    sp_stage stages[2];
    sp_proposal proposal;
    sp_result result;
} fixture;

static int set_up(void **state)
{
    static fixture f;
    sp_error error = {0};
    f.mesh = tank_mesh(48, &error);
    sp_setup setup = tank_setup(f.mesh, 0.02);
    f.evaluator = sp_evaluator_create(&setup, &error);
    f.layouts[0] = sp_layout_create(tank_manual, 3, &error);
    f.layouts[1] = sp_layout_create(tank_proposed, 3, &error);
    f.layouts[2] = sp_layout_create(tank_proposed, 4, &error);
    const char *const names[] = {"manual", "greedy", "proposed"};
    for (int i = 0; i < 3; ++i) {
        f.coverages[i] = sp_evaluate(f.evaluator, f.layouts[i], &error);
        f.designs[i] = (sp_design){names[i], f.evaluator, f.layouts[i], f.coverages[i], NULL};
    }
    if (error.kind != SP_OK) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    size_t patches = sp_evaluator_patches(f.evaluator)->count;
    bool *attainable = malloc(patches);
    memcpy(attainable, f.coverages[2]->deposits.covered, patches);
    for (int i = 0; i < 3; ++i)
        f.front[i] = (sp_front_point){f.coverages[2]->flow * (i + 1) / 3, f.coverages[2]->covered_area * (0.7 + 0.1 * i), (size_t)i + 1};
    f.stages[0] = (sp_stage){"visibility", 1.25};
    f.stages[1] = (sp_stage){"refine", 2.5};
    f.proposal = (sp_proposal){.layout = f.layouts[2], .coverage = f.coverages[2], .greedy = f.layouts[1],
                               .greedy_coverage = f.coverages[1], .attainable = attainable, .attainable_area = 5, .target_area = 99,
                               .positions = 100, .candidates = 4000, .front_count = 3, .front = f.front, .stage_count = 2,
                               .stages = f.stages};
    f.result = (sp_result){"place", "vessel <script>alert(1)</script> & \"co\".yaml", 3, f.designs, &f.proposal, 0, NULL};
    *state = &f;
    return 0;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    for (int i = 0; i < 3; ++i) {
        sp_layout_destroy(f->layouts[i]);
        sp_coverage_destroy(f->coverages[i]);
    }
    free(f->proposal.attainable);
    sp_evaluator_destroy(f->evaluator);
    sp_mesh_destroy(f->mesh);
    return 0;
}

static void dump(void **state)
{
    fixture *f = *state;
    sp_error error = {0};
    sp_output *output = sp_output_open("/tmp/report-look", &error);
    assert_true(sp_report_write(&f->result, output, &error) || !fprintf(stderr, "%s\n", error.message));
    assert_true(sp_output_commit(output, &error));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(dump),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
