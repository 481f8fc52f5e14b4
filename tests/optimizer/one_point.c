/* A cluster whose members leave one point is counted by the search, by its certificate and by the evaluator alike, also
 * where the edges of these coincide or abut. */
#include "small_room.h"

#include "prepared.h"
#include "scoring/partial.h"

#define MEMBERS 3

/* A full cone out to 30 or 45 deg from the axis, and rings beyond that or over it. */
static void make_cluster(job *j, sp_member members[MEMBERS], double full, const double hollows[MEMBERS - 1])
{
    j->types[0] = room_cone("cluster", 0, 12);
    j->types[0].pattern = SP_PATTERN_CLUSTER;
    j->types[0].angle = j->types[0].angle_min = j->types[0].angle_max = 0;
    j->types[0].members = members;
    j->types[0].member_count = MEMBERS;
    for (int i = 0; i < MEMBERS; i++)
        members[i] =
            (sp_member){.type = room_cone("member", i ? 90 * DEGREE : full, 1), .axis = sp_v(0, 0, 1), .share = 1};
    for (int i = 1; i < MEMBERS; i++) {
        members[i].type.pattern = SP_PATTERN_HOLLOW_CONE;
        members[i].type.hollow = hollows[i - 1];
    }
    j->options.type_count = 1;
    j->mounts[0].axis = sp_unit(sp_v(0.1, 0.2, -1));
}

static void open_with(job *j, sp_member members[MEMBERS], bool abut, double flux)
{
    static const double beyond[] = {60.0 / 90, 75.0 / 90}, over[] = {0.5, 0.8};
    job_open_coarse(j, 0.1);
    room_close(&j->room);
    room_builder b = {0};
    room_box(&b, sp_v(-1, -0.7, 0), sp_v(1, 0.7, 1.2), "walls", "lid");
    j->room.setup.criterion.flux = flux;
    room_open(&j->room, &b, 0.1);
    make_cluster(j, members, abut ? 60 * DEGREE : 90 * DEGREE, abut ? beyond : over);
}

static void the_search_counts_as_the_evaluator(void **state)
{
    (void)state;
    for (int abut = 0; abut <= 1; abut++)
        for (int some = 0; some <= 1; some++) {
            job j;
            prepared p;
            sp_error error = {0};
            sp_member members[MEMBERS];
            open_with(&j, members, abut, some * LITRES_PER_MINUTE);
            prepare(&p, j.room.evaluator, &j.options);
            for (uint32_t site = 0; site < p.sites.count; site++) {
                sp_partial partial;
                assert_true(sp_partial_create(&p.search, &partial, &error));
                assert_true(sp_partial_add_pose(&p.search, &partial, (sp_pose){site, 0, 0, 0}, &error));
                sp_layout one = {.count = 1, .nozzles = &partial.items[0].nozzle};
                sp_coverage *coverage = sp_evaluate_inverse(p.search.coarse, &one, &error);
                assert_non_null(coverage);
                assert_true(coverage->covered_area > 0);
                assert_float_equal(sp_partial_counted(&p.search, &partial), coverage->covered_area,
                                   1e-6 * coverage->area);
                sp_coverage_destroy(coverage);
                sp_partial_free(&partial);
            }
            prepared_free(&p);
            room_close(&j.room);
        }
}

/* What is proposed covers on the search's patches, where these are the evaluator's, what evaluating it finds, and no
 * more than what is proved. */
static void what_is_proposed_is_what_it_covers(void **state)
{
    (void)state;
    for (int abut = 0; abut <= 1; abut++) {
        job j;
        sp_member members[MEMBERS];
        open_with(&j, members, abut, 0);
        j.options.max_nozzles = 2;
        j.options.objective = SP_OBJECTIVE_MAX_COVERAGE;
        sp_proposal *proposal = job_place(&j);
        const sp_certificate *proved = &proposal->certificate;
        sp_layout *layout = sp_layout_create(proposal->layout->nozzles, proposal->layout->count, NULL);
        double area = room_area_of(&j.room, layout);
        assert_float_equal(proposal->coverage->covered_area, area, 1e-12);
        assert_true(proved->computed);
        assert_int_equal(proved->texels, sp_evaluator_patches(j.room.evaluator)->count);
        assert_float_equal(proved->counted, area, 1e-6 * proved->whole);
        assert_true(proved->area_bound >= area);
        sp_proposal_destroy(proposal);
        room_close(&j.room);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_search_counts_as_the_evaluator),
        cmocka_unit_test(what_is_proposed_is_what_it_covers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
