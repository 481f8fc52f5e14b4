/* What one more nozzle would do for a layout's shadows, against every nozzle that could be added. */
#include "small_room.h"

/* m² of a shadow that a layout covers with one nozzle more, and `coverage` does not. */
static double covers_of(const job *j, const sp_layout *layout, const sp_coverage *coverage, const uint32_t *number,
                        uint32_t shadow, sp_nozzle nozzle)
{
    sp_error error = {0};
    sp_nozzle nozzles[4];
    assert_true(layout->count < 4);
    memcpy(nozzles, layout->nozzles, layout->count * sizeof *nozzles);
    nozzles[layout->count] = nozzle;
    sp_layout *more = sp_layout_create(nozzles, layout->count + 1, &error);
    sp_coverage *covered = sp_evaluate(j->room.evaluator, more, &error);
    assert_non_null(covered);
    const sp_patches *patches = sp_evaluator_patches(j->room.evaluator);
    double area = 0;
    for (size_t p = 0; p < patches->count; p++)
        if (number[p] == shadow)
            area += patches->area[p] * (covered->deposits.share[p] - coverage->deposits.share[p]);
    sp_coverage_destroy(covered);
    sp_layout_destroy(more);
    return area;
}

/* Of every shadow, none of the ten poses of the first two types covers more than its remedy, which covers what it says.
 */
static void expect_the_best(const job *j, const sp_layout *layout, const sp_coverage *coverage,
                            const sp_remedy *remedies, size_t remedy_count)
{
    sp_error error = {0};
    sp_shadow *shadows;
    size_t count;
    uint32_t *number = malloc(sp_evaluator_patches(j->room.evaluator)->count * sizeof *number);
    assert_true(sp_shadows(j->room.evaluator, coverage, NULL, &shadows, &count, &error));
    assert_true(sp_shadow_numbers(j->room.evaluator, coverage, shadows, count, number, &error));
    assert_true(count > 0);
    assert_int_equal(remedy_count, count < SP_REMEDIES ? count : SP_REMEDIES);
    double mended = 0;
    for (size_t s = 0; s < remedy_count; s++) {
        const sp_remedy *remedy = &remedies[s];
        double best = 0;
        for (int pose = 0; pose < 10; pose++)
            best = fmax(best, covers_of(j, layout, coverage, number, (uint32_t)s + 1, nozzle_of(j, pose)));
        assert_true(remedy->area >= best - 1e-6 * shadows[s].area);
        if (!remedy->nozzle.type)
            continue;
        double covers = covers_of(j, layout, coverage, number, (uint32_t)s + 1, remedy->nozzle);
        assert_true(fabs(remedy->area - covers) < 1e-12);
        assert_true(fabs(remedy->flow - remedy->nozzle.type->flow) < 1e-12);
        assert_false(remedy->in_port);
        mended += remedy->area;
    }
    assert_true(mended > 0);
    free(number);
    free(shadows);
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
    expect_the_best(&j, proposal->layout, proposal->coverage, proposal->remedies, proposal->remedy_count);
    assert_int_equal(proposal->own_remedy_count, 0);
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

/* Of the layout there is too, whose nozzles need not be on mounts, and which is more than a proposal may have; the
 * proposal is what it is without. */
static void so_does_each_of_the_layout_there_is(void **state)
{
    (void)state;
    job j;
    sp_error error = {0};
    job_open(&j);
    j.options.objective = SP_OBJECTIVE_MAX_COVERAGE;
    j.options.max_nozzles = 1;
    sp_nozzle nozzles[2] = {nozzle_of(&j, 1), nozzle_of(&j, 9)};
    nozzles[0].position.y = -0.3;
    sp_layout own = {2, nozzles};
    j.options.kept = &own;
    j.options.mend_kept = false;
    sp_proposal *without = job_place(&j);
    assert_int_equal(without->own_remedy_count, 0);
    j.options.mend_kept = true;
    sp_proposal *proposal = job_place(&j);
    sp_coverage *coverage = sp_evaluate(j.room.evaluator, &own, &error);
    expect_the_best(&j, &own, coverage, proposal->own_remedies, proposal->own_remedy_count);
    assert_int_equal(proposal->layout->count, 1);
    assert_true(proposal->coverage->covered_area == without->coverage->covered_area);
    assert_int_equal(proposal->remedy_count, without->remedy_count);
    sp_coverage_destroy(coverage);
    sp_proposal_destroy(proposal);
    sp_proposal_destroy(without);
    room_close(&j.room);
}

/* A port that is taken takes none; one that is free is named, whatever nozzles elsewhere are called. */
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
    sp_nozzle nozzles[2] = {nozzle_of(&j, 1), nozzle_of(&j, 1)};
    nozzles[0].position = j.mounts[0].position;
    strcpy(nozzles[1].name, "P2");
    sp_layout own = {2, nozzles};
    j.options.kept = &own;
    sp_proposal *proposal = job_place(&j);
    bool second = proposal->layout->nozzles[0].position.x > 0;
    assert_true(proposal->remedy_count > 0);
    assert_true(proposal->remedies[0].in_port);
    assert_string_equal(proposal->remedies[0].nozzle.name, second ? "P1" : "P2");
    assert_true(proposal->own_remedy_count > 0);
    assert_true(proposal->own_remedies[0].in_port);
    assert_string_equal(proposal->own_remedies[0].nozzle.name, "P2");
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_shadow_gets_what_covers_most_of_it),
        cmocka_unit_test(so_does_each_of_the_layout_there_is),
        cmocka_unit_test(ports_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
