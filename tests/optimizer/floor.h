/* A floor, and nozzles of one type to be placed above it. */
#ifndef TESTS_FLOOR_H
#define TESTS_FLOOR_H

#include "room.h"

#define PRESSURE 2e5

typedef struct {
    room room;
    sp_nozzle_type type;
    const sp_nozzle_type *types[1];
    double pressure;
    sp_mount mount;
    sp_place_options options;
} job;

/* For as much coverage as so many nozzles of the job's type give. */
static inline void job_ask(job *j, size_t most)
{
    j->types[0] = &j->type;
    j->options = room_options();
    j->options.types = j->types;
    j->options.type_count = 1;
    j->options.pressures = &j->pressure;
    j->options.pressure_count = 1;
    j->options.mounts = &j->mount;
    j->options.mount_count = 1;
    j->options.max_nozzles = most;
    j->options.objective = SP_OBJECTIVE_MAX_COVERAGE;
}

/* An open floor of `edge` m, straight jets, one mounting point 2 m above its middle. */
static inline void job_open(job *j, double edge, double texel, double flux)
{
    *j = (job){.pressure = PRESSURE};
    room_builder b = {0};
    room_part(&b, "floor");
    room_sheet(&b, sp_v(-0.5 * edge, -0.5 * edge, 0), sp_v(edge, 0, 0), sp_v(0, edge, 0));
    j->room.setup = sp_setup_default();
    j->room.setup.fidelity.accuracy = ROOM_ACCURACY;
    j->room.setup.fidelity.trajectory = SP_TRAJECTORY_LINE;
    j->room.setup.criterion.flux = flux;
    room_open(&j->room, &b, texel);
    j->type = room_cone("set", 60 * DEGREE, 20);
    j->mount = (sp_mount){.kind = SP_MOUNT_BOX, .axis = sp_v(0, 0, -1), .from = sp_v(0, 0, 2), .to = sp_v(0, 0, 2)};
    job_ask(j, 1);
}

static inline sp_proposal *job_place(job *j)
{
    sp_error error = {0};
    sp_proposal *proposal = sp_place(j->room.evaluator, &j->options, &error);
    assert_string_equal(error.message, "");
    assert_non_null(proposal);
    room_check(proposal, &j->options);
    if (j->options.objective == SP_OBJECTIVE_MAX_COVERAGE)
        assert_true(proposal->coverage->covered_area >= proposal->greedy_coverage->covered_area);
    else if (proposal->greedy_coverage->covered_area >= proposal->target_area)
        assert_true(proposal->coverage->flow <= proposal->greedy_coverage->flow);
    return proposal;
}

/* Flux at the rim of a cone of half-angle a over a floor at distance h: Q cos³a / (2π (1 - cos a) h²). Wider, the rim
 * falls dry; narrower, the disc is smaller than it could be. */
static inline double rim_flux(double flow, double half_angle, double height)
{
    return flow * pow(cos(half_angle), 3) / (2 * M_PI * (1 - cos(half_angle)) * height * height);
}

#endif
