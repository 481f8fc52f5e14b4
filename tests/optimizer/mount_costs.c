/* Mounts that cost something, against every layout that they allow: what is proposed and what is proved count water and
 * cost, what limits water counts water alone. */
#include "small_room.h"

#include <string.h>

#define SLACK 1e-5 /* m² between a sum of texels in single precision and one in double */

/* The line of five places, which takes two nozzles, and a port in the lid. */
static void open_costly(job *j, double line, double port)
{
    job_open_coarse(j, 0.2);
    j->mounts[0].most = 2;
    j->mounts[0].cost = line;
    j->mounts[1] = (sp_mount){
        .kind = SP_MOUNT_PORT, .name = "P1", .position = sp_v(0.1, -0.4, 1), .axis = sp_v(0, 0, -1), .cost = port};
    j->options.mount_count = 2;
    j->options.max_nozzles = 3;
    j->options.refine = (sp_refine){0};
    j->options.objective = SP_OBJECTIVE_MIN_WATER;
}

typedef struct {
    double area, flow;
    size_t line, port; /* nozzles on it, in it */
} tried;

enum { MOST_LAYOUTS = 200 }; /* 66 on the line, with nothing or one of two in the port */
static tried layouts[MOST_LAYOUTS];
static size_t layout_count;

/* Pose 0 to 9 on the line, 10 and 11 in the port; -1: no nozzle. */
static void try_one(const job *j, const int poses[3])
{
    sp_nozzle nozzles[3];
    size_t count = 0;
    tried *found = &layouts[layout_count];
    *found = (tried){0};
    for (int i = 0; i < 3; i++) {
        if (poses[i] < 0)
            continue;
        nozzles[count] = nozzle_of(j, poses[i] % 10);
        if (poses[i] >= 10)
            nozzles[count].position = j->mounts[1].position;
        found->line += poses[i] < 10;
        found->port += poses[i] >= 10;
        found->flow += nozzles[count++].type->flow;
    }
    found->area = count ? area_of(j, nozzles, count) : 0;
    layout_count++;
}

static int try_all(void **state)
{
    (void)state;
    job j;
    open_costly(&j, 0, 0);
    for (int a = -1; a < 10; a++)
        for (int b = -1; b <= a; b++)
            for (int port = -1; port < 2; port++) {
                const int poses[] = {a, b, port < 0 ? -1 : 10 + port};
                try_one(&j, poses);
            }
    room_close(&j.room);
    return 0;
}

static double outlay_of(const job *j, const tried *layout)
{
    return layout->flow + (double)layout->line * j->mounts[0].cost + (double)layout->port * j->mounts[1].cost;
}

static bool is_allowed(const job *j, const tried *layout)
{
    return layout->line + layout->port <= j->options.max_nozzles && layout->flow <= j->options.max_water * (1 + 1e-9);
}

static double most_area(const job *j, double outlay)
{
    double area = 0;
    for (size_t i = 0; i < layout_count; i++)
        if (is_allowed(j, &layouts[i]) && outlay_of(j, &layouts[i]) <= outlay * (1 + 1e-9))
            area = fmax(area, layouts[i].area);
    return area;
}

static double least_outlay(const job *j, double area)
{
    double outlay = INFINITY;
    for (size_t i = 0; i < layout_count; i++)
        if (is_allowed(j, &layouts[i]) && layouts[i].area >= area)
            outlay = fmin(outlay, outlay_of(j, &layouts[i]));
    return outlay;
}

/* What each nozzle's mount costs is told, and comes to the outlay. */
static void check_costs(const job *j, const sp_proposal *proposal)
{
    double outlay = proposal->coverage->flow;
    for (size_t i = 0; i < proposal->layout->count; i++) {
        assert_true(proposal->costs[i] == j->mounts[proposal->fittings[i] ? 0 : 1].cost);
        outlay += proposal->costs[i];
    }
    assert_true(fabs(proposal->outlay - outlay) <= 1e-9 * outlay);
    assert_true(proposal->coverage->flow <= j->options.max_water * (1 + 1e-9));
}

/* No layout is beyond a bound. */
static void check_bounds(const job *j, const sp_proposal *proposal)
{
    const sp_certificate *certificate = &proposal->certificate;
    assert_true(certificate->computed && proposal->costly);
    assert_true(certificate->area_bound + SLACK >= most_area(j, proposal->outlay));
    assert_true(certificate->water_bound <= least_outlay(j, certificate->counted - SLACK) * (1 + 1e-9));
    for (size_t i = 0; i < proposal->front_count; i++) {
        const sp_front_point *point = &proposal->front[i];
        double costs = point->outlay - point->flow, line = (double)point->fittings * j->mounts[0].cost;
        assert_true(i == 0 || point->outlay > point[-1].outlay);
        assert_true(fabs(costs - line) < 1e-12 || fabs(costs - line - j->mounts[1].cost) < 1e-12);
        assert_true(point->bound + SLACK >= most_area(j, point->outlay));
        assert_true(point->area <= most_area(j, point->outlay) + SLACK);
    }
    if (!certificate->every_aim.computed)
        return;
    assert_true(certificate->every_aim.area_bound + SLACK >= most_area(j, proposal->outlay));
    assert_true(certificate->every_aim.water_bound <= least_outlay(j, certificate->counted - SLACK) * (1 + 1e-9));
}

/* Costs of a nozzle on the line and in the port, L/min. */
static void open_with(job *j, double line, double port)
{
    open_costly(j, line * LITRES_PER_MINUTE, port * LITRES_PER_MINUTE);
}

static void least_outlay_is_proposed_and_proved(void **state)
{
    (void)state;
    static const struct {
        double line, port, wanted; /* L/min, share of the most that can be covered */
    } cases[] = {{30, 0, 0.8}, {5, 11, 0.5}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        job j;
        open_with(&j, cases[k].line, cases[k].port);
        j.options.coverage =
            cases[k].wanted * most_area(&j, INFINITY) / sp_evaluator_patches(j.room.evaluator)->total_area;
        sp_proposal *proposal = job_place(&j);
        double best = least_outlay(&j, proposal->asked_area);
        assert_true(proposal->reached);
        assert_true(fabs(proposal->outlay - best) <= 1e-6 * best);
        check_costs(&j, proposal);
        check_bounds(&j, proposal);
        /* the proof knows what a nozzle costs: water alone would be far less */
        double least = least_outlay(&j, proposal->certificate.counted - SLACK);
        assert_true(proposal->certificate.water_bound >= 0.75 * least);
        sp_proposal_destroy(proposal);
        room_close(&j.room);
    }
}

static void area_per_outlay_is_proposed(void **state)
{
    (void)state;
    job j;
    double best = 0;
    open_with(&j, 3, 0);
    j.options.objective = SP_OBJECTIVE_AREA_PER_WATER;
    j.options.coverage = 0.3;
    sp_proposal *proposal = job_place(&j);
    for (size_t i = 0; i < layout_count; i++)
        if (layouts[i].area >= proposal->asked_area)
            best = fmax(best, layouts[i].area / outlay_of(&j, &layouts[i]));
    assert_true(proposal->coverage->covered_area / proposal->outlay >= best * (1 - 1e-6));
    check_costs(&j, proposal);
    check_bounds(&j, proposal);
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

/* Coverage is not traded for money, but for water: the most within max_water, whatever it costs. */
static void max_water_limits_water_alone(void **state)
{
    (void)state;
    job j;
    open_with(&j, 30, 0);
    j.options.objective = SP_OBJECTIVE_MAX_COVERAGE;
    j.options.max_water = 22 * LITRES_PER_MINUTE;
    sp_proposal *proposal = job_place(&j);
    assert_true(proposal->outlay > 2 * j.options.max_water);
    assert_true(proposal->coverage->covered_area >= most_area(&j, INFINITY) - SLACK);
    assert_true(proposal->outlay <= least_outlay(&j, proposal->coverage->covered_area - SLACK) * (1 + 1e-6));
    check_costs(&j, proposal);
    check_bounds(&j, proposal);
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

/* What takes more than max_water may cost less than what is allowed: bounds are of outlay. */
static void beyond_max_water_is_among_the_bounded_where_layouts_are_few(void **state)
{
    (void)state;
    job j;
    open_with(&j, 0, 12);
    j.mounts[0] = j.mounts[1];
    j.mounts[1].position = sp_v(-0.3, 0.2, 1);
    j.mounts[1].cost = 0;
    for (int i = 0; i < 2; i++) {
        j.mounts[i].types = &j.type_list[1 - i];
        j.mounts[i].type_count = 1;
    }
    strcpy(j.mounts[1].name, "P2");
    j.options.objective = SP_OBJECTIVE_MAX_COVERAGE;
    j.options.max_water = 10 * LITRES_PER_MINUTE;
    const sp_nozzle beyond = {
        .type = j.type_list[0], .position = j.mounts[1].position, .axis = sp_v(0, 0, -1), .pressure = j.pressure};
    double area = area_of(&j, &beyond, 1);
    sp_proposal *proposal = job_place(&j);
    const sp_certificate *certificate = &proposal->certificate;
    assert_int_equal(proposal->layout->count, 1);
    assert_true(proposal->layout->nozzles[0].type == j.type_list[1]);
    assert_true(proposal->outlay > j.types[0].flow && proposal->coverage->covered_area < area);
    assert_true(certificate->computed && certificate->every_layout);
    assert_true(certificate->area_bound + SLACK >= area);
    assert_true(certificate->water_bound <= j.types[0].flow * (1 + 1e-9));
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

/* Of nozzles that may lean and be moved every_aim knows the costs, too; refinement keeps within the water. */
static void moved_and_aimed_nozzles_keep_their_mounts_costs(void **state)
{
    (void)state;
    job j;
    open_with(&j, 4, 1);
    j.options.refine = (sp_refine){.axis = 10 * DEGREE};
    j.options.max_nozzles = 2;
    j.options.objective = SP_OBJECTIVE_MAX_COVERAGE;
    j.options.max_water = 22 * LITRES_PER_MINUTE;
    j.mounts[0].tilt = j.mounts[1].tilt = 10 * DEGREE;
    sp_proposal *proposal = job_place(&j);
    check_costs(&j, proposal);
    assert_true(proposal->certificate.every_aim.computed);
    assert_true(proposal->certificate.every_aim.area_bound + SLACK >= most_area(&j, proposal->outlay));
    assert_true(proposal->certificate.every_aim.area_bound + SLACK >= proposal->certificate.counted);
    assert_true(proposal->certificate.every_aim.water_bound <= proposal->outlay * (1 + 1e-9));
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

/* What is there already costs nothing, and its port is taken. */
static void kept_nozzles_cost_nothing(void **state)
{
    (void)state;
    job j;
    sp_error error = {0};
    open_with(&j, 3, 50);
    sp_nozzle kept = nozzle_of(&j, 0);
    kept.position = j.mounts[1].position;
    kept.keep = true;
    strcpy(kept.name, "there");
    sp_layout *own = sp_layout_create(&kept, 1, &error);
    assert_non_null(own);
    j.options.kept = own;
    j.options.max_nozzles = 2;
    j.options.coverage = 0.4;
    sp_proposal *proposal = job_place(&j);
    assert_true(proposal->costs[0] == 0);
    double costs_of_line = 3 * LITRES_PER_MINUTE * (double)(proposal->layout->count - 1);
    assert_true(fabs(proposal->outlay - proposal->coverage->flow - costs_of_line) < 1e-12);
    sp_proposal_destroy(proposal);
    sp_layout_destroy(own);
    room_close(&j.room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(least_outlay_is_proposed_and_proved),
        cmocka_unit_test(area_per_outlay_is_proposed),
        cmocka_unit_test(max_water_limits_water_alone),
        cmocka_unit_test(beyond_max_water_is_among_the_bounded_where_layouts_are_few),
        cmocka_unit_test(moved_and_aimed_nozzles_keep_their_mounts_costs),
        cmocka_unit_test(kept_nozzles_cost_nothing),
    };
    return cmocka_run_group_tests_name("costs of mounts", tests, try_all, NULL);
}
