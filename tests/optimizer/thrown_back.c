/* Where walls throw liquid back, layouts are ranked by what jets find: each is counted here as reports count it. */
#include "instance.h"
#include "small_room.h"

#define PORTS 4
#define TYPES 2
#define LAYOUTS 81  /* a digit for each port, 0 for none */
#define NOISE 0.015 /* of all the area, by which jets may be wrong of a layout */
#define JETS 10000
#define JETS_MANY 40000 /* so many that drafts are searched with */
#ifdef SPRAYPLAN_SANITIZE
#define ROOMS 1
#else
#define ROOMS 4
#endif

/* Ports anywhere under the lid, and walls that throw three fifths of all that hits them back at half the speed. */
static void open_bouncing(job *j, uint64_t seed, uint64_t jets)
{
    sp_error error = {0};
    job_open_coarse(j, 0.1);
    sp_evaluator_destroy(j->room.evaluator);
    for (size_t i = 0; i < j->room.mesh->part_count; i++) {
        j->room.surfaces[i].restitution = 0.5;
        j->room.surfaces[i].rebound = 0.6;
    }
    j->room.setup.criterion.flux = 0.5 * LITRES_PER_MINUTE;
    j->room.setup.fidelity.method = SP_METHOD_FORWARD;
    j->room.setup.fidelity.reflections = 2;
    j->room.setup.fidelity.jets = jets;
    j->room.evaluator = sp_evaluator_create(&j->room.setup, &error);
    assert_non_null(j->room.evaluator);
    j->options.type_count = TYPES;
    j->options.max_nozzles = 3;
    j->options.coverage = 0.8;
    j->options.objective = SP_OBJECTIVE_MIN_WATER;
    j->options.mount_count = PORTS;
    for (int i = 0; i < PORTS; i++) {
        double x = instance_random(&seed) - 0.5, y = instance_random(&seed) - 0.5;
        j->mounts[i] = (sp_mount){
            .kind = SP_MOUNT_PORT, .position = sp_v(1.6 * x, 1.1 * y, 1.1), .axis = sp_unit(sp_v(x, -y, -1))};
        snprintf(j->mounts[i].name, sizeof j->mounts[i].name, "P%d", i);
    }
}

/* The layout of that number; m³/s that it takes. */
static double make_layout(const job *j, int number, sp_nozzle nozzles[PORTS], size_t *count)
{
    double flow = 0;
    *count = 0;
    for (int i = 0; i < PORTS; i++, number /= TYPES + 1)
        if (number % (TYPES + 1)) {
            nozzles[*count] = (sp_nozzle){.type = j->type_list[number % (TYPES + 1) - 1],
                                          .position = j->mounts[i].position,
                                          .axis = j->mounts[i].axis,
                                          .pressure = j->pressure};
            flow += sp_nozzle_flow(&nozzles[(*count)++], &j->room.setup.liquid);
        }
    return flow;
}

/* No other takes less water for what is aimed at, and none of as much covers more. */
static void expect_best(const job *j, const sp_proposal *proposal)
{
    double noise = NOISE * proposal->coverage->area, flow = proposal->coverage->flow;
    for (int n = 1; n < LAYOUTS; n++) {
        sp_nozzle nozzles[PORTS];
        size_t count;
        double own = make_layout(j, n, nozzles, &count);
        if (count > j->options.max_nozzles || own > flow * (1 + 1e-9))
            continue;
        double area = area_of(j, nozzles, count);
        assert_true(area <= proposal->coverage->covered_area + noise);
        assert_true(own >= flow * (1 - 1e-9) || area <= proposal->target_area + noise);
    }
}

static void the_best_by_jets_is_found(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= ROOMS; seed++) {
        job j;
        open_bouncing(&j, seed * 0x9e3779b97f4a7c15u, seed < 4 ? JETS : JETS_MANY);
        sp_proposal *proposal = job_place(&j);
        /* first impacts alone cannot cover it everywhere */
        assert_true(proposal->target_area == proposal->asked_area && proposal->reached);
        expect_best(&j, proposal);
        sp_proposal_destroy(proposal);
        room_close(&j.room);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_best_by_jets_is_found)};
    return cmocka_run_group_tests_name("thrown back", tests, NULL, NULL);
}
