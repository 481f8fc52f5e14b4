/* A small room whose every layout of one or two nozzles can be tried. */
#ifndef SMALL_ROOM_H
#define SMALL_ROOM_H

#include "room.h"

#define PRESSURE 2e5

typedef struct {
    room room;
    sp_nozzle_type types[3];
    const sp_nozzle_type *type_list[3];
    double pressure;
    sp_mount mounts[4];
    sp_place_options options;
} job;

/* A closed room of 2 m x 1.4 m x 1.2 m, every spot of which needs 2 L/min/m². One thread: what they would wait for each
 * other is more than they save. */
static inline void job_open_coarse(job *j, double texel)
{
    *j = (job){.pressure = PRESSURE};
    room_builder b = {0};
    room_box(&b, sp_v(-1, -0.7, 0), sp_v(1, 0.7, 1.2), "walls", "lid");
    j->room.setup = sp_setup_default();
    j->room.setup.fidelity.accuracy = ROOM_ACCURACY;
    j->room.setup.cavity = SP_CAVITY_POINT;
    j->room.setup.cavity_point = sp_v(0, 0, 0.5);
    j->room.setup.criterion.flux = 2 * LITRES_PER_MINUTE;
    j->room.setup.run.threads = 1;
    room_open(&j->room, &b, texel);
    j->types[0] = room_cone("wide", 120 * DEGREE, 16);
    j->types[1] = room_cone("narrow", 60 * DEGREE, 6);
    j->types[2] = room_cone("ball", 360 * DEGREE, 40);
    for (int i = 0; i < 3; i++)
        j->type_list[i] = &j->types[i];
    j->options = room_options();
    j->options.run.threads = 1;
    j->options.types = j->type_list;
    j->options.type_count = 2;
    j->options.pressures = &j->pressure;
    j->options.pressure_count = 1;
    j->options.mounts = j->mounts;
    j->options.clearance = 0.02;
    j->mounts[0] = (sp_mount){.kind = SP_MOUNT_LINE,
                              .axis = sp_v(0, 0, -1),
                              .spacing = 0.4,
                              .from = sp_v(-0.8, 0.1, 1),
                              .to = sp_v(0.8, 0.1, 1)};
    j->options.mount_count = 1;
}

#ifdef SPRAYPLAN_SANITIZE
#define SMALL_TEXEL 0.2
#else
#define SMALL_TEXEL 0.1
#endif
static inline void job_open(job *j)
{
    job_open_coarse(j, SMALL_TEXEL);
}

static inline sp_proposal *job_place(job *j)
{
    sp_error error = {0};
    sp_proposal *proposal = sp_place(j->room.evaluator, &j->options, &error);
    assert_string_equal(error.message, "");
    assert_non_null(proposal);
    room_check(proposal, &j->options);
    return proposal;
}

static inline double area_of(const job *j, const sp_nozzle *nozzles, size_t count)
{
    sp_error error = {0};
    return room_area_of(&j->room, sp_layout_create(nozzles, count, &error));
}

/* One of the five places with one of the first two types. */
static inline sp_nozzle nozzle_of(const job *j, int pose)
{
    return (sp_nozzle){.type = j->type_list[pose % 2],
                       .position = sp_v(-0.8 + 0.4 * (pose / 2), 0.1, 1),
                       .axis = sp_v(0, 0, -1),
                       .pressure = j->pressure};
}

/* The most that two of them cover; a place may hold both. */
static inline double best_of_two(const job *j)
{
    double best = 0;
    for (int a = 0; a < 10; a++)
        for (int b = a; b < 10; b++) {
            sp_nozzle pair[2] = {nozzle_of(j, a), nozzle_of(j, b)};
            best = fmax(best, area_of(j, pair, 2));
        }
    return best;
}

#endif
