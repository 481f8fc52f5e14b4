/* What one more nozzle would do for a proposal's shadows, against every nozzle that could be added. */
#include "small_room.h"

/* m² of a shadow that the layout covers with one nozzle more. */
static double covers_of(const job *j, const sp_proposal *proposal, const uint32_t *number, uint32_t shadow,
                        sp_nozzle nozzle)
{
    sp_error error = {0};
    size_t count = proposal->layout->count;
    sp_nozzle nozzles[4];
    assert_true(count < 4);
    memcpy(nozzles, proposal->layout->nozzles, count * sizeof *nozzles);
    nozzles[count] = nozzle;
    sp_layout *layout = sp_layout_create(nozzles, count + 1, &error);
    sp_coverage *coverage = sp_evaluate(j->room.evaluator, layout, &error);
    assert_non_null(coverage);
    const sp_patches *patches = sp_evaluator_patches(j->room.evaluator);
    double area = 0;
    for (size_t p = 0; p < patches->count; p++)
        if (number[p] == shadow)
            area += patches->area[p] * (coverage->deposits.share[p] - proposal->coverage->deposits.share[p]);
    sp_coverage_destroy(coverage);
    sp_layout_destroy(layout);
    return area;
}

static void each_shadow_gets_what_covers_most_of_it(void **state)
{
    (void)state;
    job j;
    job_open(&j);
    j.options.objective = SP_OBJECTIVE_MAX_COVERAGE;
    j.options.coverage = 1;
    j.options.max_nozzles = 1;
    sp_proposal *proposal = job_place(&j);
    sp_error error = {0};
    sp_shadow *shadows;
    size_t count;
    uint32_t *number = malloc(sp_evaluator_patches(j.room.evaluator)->count * sizeof *number);
    assert_true(sp_shadows(j.room.evaluator, proposal->coverage, NULL, &shadows, &count, &error));
    assert_true(sp_shadow_numbers(j.room.evaluator, proposal->coverage, shadows, count, number, &error));
    assert_true(count > 0);
    assert_int_equal(proposal->remedy_count, count < SP_REMEDIES ? count : SP_REMEDIES);
    double mended = 0;
    for (size_t s = 0; s < proposal->remedy_count; s++) {
        const sp_remedy *remedy = &proposal->remedies[s];
        double best = 0;
        for (int pose = 0; pose < 10; pose++)
            best = fmax(best, covers_of(&j, proposal, number, (uint32_t)s + 1, nozzle_of(&j, pose)));
        assert_true(remedy->area >= best - 1e-6 * shadows[s].area);
        if (!remedy->nozzle.type)
            continue;
        assert_true(fabs(remedy->area - covers_of(&j, proposal, number, (uint32_t)s + 1, remedy->nozzle)) < 1e-12);
        assert_true(fabs(remedy->flow - remedy->nozzle.type->flow) < 1e-12);
        assert_false(remedy->in_port);
        mended += remedy->area;
    }
    assert_true(mended > 0);
    free(number);
    free(shadows);
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

/* A port that is taken takes none; one that is free is named. */
static void ports_are_named(void **state)
{
    (void)state;
    job j;
    job_open_coarse(&j, 0.2);
    for (int i = 0; i < 2; i++)
        j.mounts[i] = (sp_mount){.kind = SP_MOUNT_PORT,
                                 .name = {'P', (char)('1' + i)},
                                 .position = sp_v(i ? 0.7 : -0.7, 0.1, 1),
                                 .axis = sp_v(0, 0, -1)};
    j.options.mount_count = 2;
    j.options.max_nozzles = 1;
    j.options.objective = SP_OBJECTIVE_MAX_COVERAGE;
    sp_proposal *proposal = job_place(&j);
    bool second = proposal->layout->nozzles[0].position.x > 0;
    assert_true(proposal->remedy_count > 0);
    assert_true(proposal->remedies[0].in_port);
    assert_string_equal(proposal->remedies[0].nozzle.name, second ? "P1" : "P2");
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_shadow_gets_what_covers_most_of_it),
        cmocka_unit_test(ports_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
