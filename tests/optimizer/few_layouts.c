/* Where layouts are few, as of some types in some ports, the proposal is the best of all and its bounds say so: each
 * layout is counted here by the evaluator that reports use. */
#include "instance.h"
#include "small_room.h"

#define PORTS 4
#define VARIANTS 4 /* two types at two pressures */
#define LAYOUTS 625
#ifdef SPRAYPLAN_SANITIZE
#define ROOMS 3
#define TEXEL 0.2
#else
#define ROOMS 11
#define TEXEL 0.1
#endif
#define EQUAL 1e-9

static const double pressures[2] = {1e5, 2e5};

typedef struct {
    double flow, area; /* m³/s, m² */
    size_t nozzles;
} counted;

static void set_ports(job *j, uint64_t seed)
{
    j->options.mount_count = PORTS;
    j->options.pressures = pressures;
    j->options.pressure_count = 2;
    for (int i = 0; i < PORTS; i++) {
        double x[4];
        for (int k = 0; k < 4; k++)
            x[k] = instance_random(&seed) - 0.5;
        j->mounts[i] = (sp_mount){.kind = SP_MOUNT_PORT,
                                  .position = sp_v(1.6 * x[0], 1.1 * x[1], 1.1),
                                  .axis = sp_unit(sp_v(x[2], x[3], -1))};
        snprintf(j->mounts[i].name, sizeof j->mounts[i].name, "P%d", i);
    }
}

/* A room of its own for each seed: of the flux asked for, whether one nozzle alone must bring it, whether film rinses
 * too, and of incidence. */
static void open_ports(job *j, uint64_t seed)
{
    sp_error error = {0};
    job_open_coarse(j, TEXEL);
    sp_evaluator_destroy(j->room.evaluator);
    for (int i = 0; i < 8; i++)
        instance_random(&seed);
    set_ports(j, seed);
    j->room.setup.criterion.flux = (seed % 3) * 2 * LITRES_PER_MINUTE;
    j->room.setup.criterion.combine = seed % 5 == 0 ? SP_COMBINE_SINGLE : SP_COMBINE_SUM;
    j->room.setup.criterion.film = seed % 7 == 0 ? 2 * LITRES_PER_MINUTE : 0;
    j->room.setup.criterion.incidence = seed % 2 ? 60 * DEGREE : 90 * DEGREE;
    j->types[0] = room_cone("wide", 100 * DEGREE, 5 + 6 * instance_random(&seed));
    j->types[1] = room_cone("narrow", 60 * DEGREE, 3 + 3 * instance_random(&seed));
    j->room.evaluator = sp_evaluator_create(&j->room.setup, &error);
    assert_non_null(j->room.evaluator);
}

/* The layout of that number: a digit for each port, 0 for none. */
static size_t make_layout(const job *j, size_t number, sp_nozzle nozzles[PORTS])
{
    size_t count = 0;
    for (int i = 0; i < PORTS; i++, number /= VARIANTS + 1) {
        size_t digit = number % (VARIANTS + 1);
        if (digit)
            nozzles[count++] = (sp_nozzle){.type = j->type_list[(digit - 1) / 2],
                                           .position = j->mounts[i].position,
                                           .axis = j->mounts[i].axis,
                                           .pressure = pressures[(digit - 1) % 2]};
    }
    return count;
}

static void count_all(const job *j, counted layouts[LAYOUTS])
{
    for (size_t n = 0; n < LAYOUTS; n++) {
        sp_nozzle nozzles[PORTS];
        size_t count = make_layout(j, n, nozzles);
        layouts[n] = (counted){.area = area_of(j, nozzles, count), .nozzles = count};
        for (size_t i = 0; i < count; i++)
            layouts[n].flow += sp_nozzle_flow(&nozzles[i], &j->room.setup.liquid);
    }
}

/* The most that any covers with so much water. */
static double most_within(const job *j, const counted *layouts, double flow)
{
    double most = 0;
    for (size_t n = 0; n < LAYOUTS; n++)
        if (layouts[n].flow <= flow * (1 + EQUAL) &&
            (!j->options.max_nozzles || layouts[n].nozzles <= j->options.max_nozzles))
            most = fmax(most, layouts[n].area);
    return most;
}

/* The least water that so much is covered with. */
static double least_for(const job *j, const counted *layouts, double area)
{
    double least = INFINITY;
    for (size_t n = 0; n < LAYOUTS; n++)
        if (layouts[n].area >= area * (1 - EQUAL) &&
            (!j->options.max_nozzles || layouts[n].nozzles <= j->options.max_nozzles))
            least = fmin(least, layouts[n].flow);
    return least;
}

static double best_ratio(const counted *layouts, double area)
{
    double best = 0;
    for (size_t n = 0; n < LAYOUTS; n++)
        if (layouts[n].area >= area * (1 - EQUAL))
            best = fmax(best, layouts[n].area / layouts[n].flow);
    return best;
}

/* Nothing between what was found and what cannot be exceeded but what units of water and round-off take. */
static void expect_closed(const job *j, const counted *layouts, const sp_proposal *proposal)
{
    const sp_certificate *certificate = &proposal->certificate;
    double flow = proposal->coverage->flow;
    assert_true(certificate->computed && certificate->every_layout);
    assert_true(certificate->area_bound >= most_within(j, layouts, flow) * (1 - EQUAL));
    assert_true(certificate->area_bound <= most_within(j, layouts, 1.001 * flow) * (1 + 1e-6));
    assert_true(certificate->water_bound <= least_for(j, layouts, certificate->counted) * (1 + EQUAL));
    assert_true(certificate->water_bound >= 0.995 * least_for(j, layouts, certificate->counted * (1 - 1e-6)));
    /* as shares of one whole they hold to the last bit, as that of the proposal is reported beside them */
    assert_int_equal(certificate->texels, sp_evaluator_patches(j->room.evaluator)->count);
    double whole = proposal->coverage->area;
    assert_true(certificate->whole == whole);
    assert_true(certificate->area_bound / certificate->whole >= proposal->coverage->fraction);
    for (size_t i = 0; i < proposal->front_count; i++) {
        double most = most_within(j, layouts, proposal->front[i].flow);
        assert_true(proposal->front[i].bound / certificate->whole >= proposal->front[i].area / whole);
        assert_true(proposal->front[i].bound >= most * (1 - EQUAL));
        assert_true(fabs(proposal->front[i].area - most) <= EQUAL * most);
    }
}

static void the_best_of_all_is_found(void **state)
{
    (void)state;
    static const sp_objective objectives[] = {SP_OBJECTIVE_MIN_WATER, SP_OBJECTIVE_AREA_PER_WATER,
                                              SP_OBJECTIVE_MAX_COVERAGE};
    for (uint64_t seed = 1; seed <= ROOMS; seed++) {
        job j;
        counted layouts[LAYOUTS];
        open_ports(&j, seed * 0x9e3779b97f4a7c15u);
        count_all(&j, layouts);
        j.options.coverage = 0.7;
        j.options.objective = objectives[seed % 3];
        j.options.max_nozzles = seed % 4 == 3 ? 3 : 0;
        sp_proposal *proposal = job_place(&j);
        double area = proposal->coverage->covered_area, target = proposal->target_area;
        double most = most_within(&j, layouts, INFINITY);
        if (most < target || j.options.objective == SP_OBJECTIVE_MAX_COVERAGE)
            assert_true(area >= most * (1 - EQUAL));
        else if (j.options.objective == SP_OBJECTIVE_MIN_WATER)
            assert_true(proposal->coverage->flow <= least_for(&j, layouts, target) * (1 + EQUAL));
        else if (!j.options.max_nozzles)
            assert_true(area / proposal->coverage->flow >= best_ratio(layouts, target) * (1 - EQUAL));
        expect_closed(&j, layouts, proposal);
        sp_proposal_destroy(proposal);
        room_close(&j.room);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_best_of_all_is_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
