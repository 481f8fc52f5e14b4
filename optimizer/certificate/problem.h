/* A placement as a problem of maximum coverage: all candidate poses and the nozzles of the layouts found, none of their
 * rows stored. */
#ifndef OPTIMIZER_PROBLEM_H
#define OPTIMIZER_PROBLEM_H

#include "certificate/pose_pricing.h"
#include "certificate/water_units.h"
#include "search/front.h"

typedef struct {
    const sp_search *search;
    const sp_front *front;
    sp_cover cover;
    sp_water_units units;
    float *area, *need; /* [patches] */
    float *film_need;   /* [patches], NULL where film is not asked for */
    uint32_t *weight;   /* [tiers] */
    uint32_t *tier_of;  /* [mounts x variants] */
    size_t *ports;      /* [mounts] */
    bool *sums;         /* [cover.water + 1], as the cover's; NULL where no mount costs anything */
    double *costs;      /* [cost_count], m³/s: of mounts, each once */
    size_t cost_count;
    double *outlays; /* [costs x variants], then one for each nozzle of the front */
    size_t own;      /* nozzles of the front */
    sp_pose_pricing *pricing;
    sp_rows nozzles; /* of the front */
    sp_pose_order order;
    sp_candidate_list list;
    sp_pricer pricer;
} sp_problem;

/* *possible becomes false, and the problem is not to be used, where nothing can be placed, or too many nozzles at a
 * time. search and front are borrowed; the problem must stay where it is. Freed in any case. */
bool sp_problem_create(const sp_search *search, const sp_front *front, sp_problem *problem, bool *possible,
                       sp_error *error);
void sp_problem_free(sp_problem *problem);

/* Units of water for so much outlay, kept nozzles included, no more than the problem is about. */
size_t sp_problem_budget(const sp_problem *problem, double outlay);
/* Candidate poses. */
size_t sp_problem_poses(const sp_problem *problem);

/* What the mounts cost, each once, in their order; malloc'd, NULL when memory runs out. */
double *sp_list_costs(const sp_place_options *options, size_t *count);

#endif
