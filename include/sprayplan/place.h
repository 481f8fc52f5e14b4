/* Placement: from the allowed mounts to a proposed layout. */
#ifndef SPRAYPLAN_PLACE_H
#define SPRAYPLAN_PLACE_H

#include <sprayplan/evaluator.h>
#include <sprayplan/export.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum { SP_MOUNT_PORT, SP_MOUNT_SURFACE, SP_MOUNT_LINE, SP_MOUNT_BOX } sp_mount_kind;

/* Where nozzles may be. Fields that a kind does not name are zero; no length is below that, and all are finite. */
typedef struct {
    sp_mount_kind kind;
    char name[SP_NAME]; /* a port has one; others may, "" where not */
    size_t most;        /* nozzles that it takes besides kept ones; 0: any number. A port takes one whatever it says */
    double cost; /* m³/s, 0 or more: the water that a nozzle placed there must save to be worth its weld or fitting */
    sp_vec3 position; /* port, m */
    sp_vec3 axis;     /* port, line, box: unit reference axis */
    double tilt;      /* rad, [0, π], that a nozzle's axis may lean from the reference axis; π is any direction */
    double depth_from, depth_to, depth_spacing; /* port, m along its axis; all 0 without a lance */
    size_t type_count;                          /* port: types that fit; 0: all of the options' */
    const sp_nozzle_type *const *types;         /* borrowed */
    double bore;                                /* port, m: types with a wider body do not fit; 0: not known */
    sp_step depth_step, tilt_step; /* port: depths that can be set count from depth_from, tilts from the axis */
    uint32_t geometry;             /* surface */
    uint32_t part;                 /* surface: index of the mesh's part, SP_NONE: every part of that geometry */
    double standoff;               /* surface, m along the normal towards the liquid */
    double spacing;                /* surface, line, box, m */
    sp_vec3 from, to;              /* line: ends; box: minimum and maximum, m */
} sp_mount;

/* Of the settings `from` + k steps (k a whole number) within [low, high] the one nearest to `value`, in SI: the value
 * of a number of at most 12 digits, times step.unit in long double. `value` itself, held within [low, high], where
 * anything can be set; `from` where no setting is within. */
SP_API double sp_step_nearest(sp_step step, double from, double value, double low, double high);

/* True where the type may be mounted there: a port's own list has it, and its body passes the bore. */
SP_API bool sp_mount_takes(const sp_mount *mount, const sp_nozzle_type *type);
/* Index of the mount that a point of the setup lies on, to within 4e-4 of the geometry's diagonal: in a port's
 * depth, no farther from a surface than its standoff, on a line, in a box; ports first, then in this order, of one kind
 * the first. SIZE_MAX: none. */
SP_API size_t sp_mount_at(const sp_setup *setup, const sp_mount *mounts, size_t count, sp_vec3 position);
/* False, with an error "nozzles: NAME, of type '..", where the nozzle sits in a port whose bore its body does not pass.
 */
SP_API bool sp_mounts_admit(const sp_setup *setup, const sp_mount *mounts, size_t count, const sp_nozzle *nozzle,
                            sp_error *error);

/* The step in which coverages are reported, as a fraction of the surface to be cleaned. Where no layout reaches what
 * was asked for, those that cover less than the best by no more than this count as covering as much. */
#define SP_COVERAGE_TOLD 1e-3

/* A layout's outlay is its water and what the mounts of its nozzles cost, but for kept ones, which are there already;
 * its water alone where no mount costs anything. */
typedef enum {
    SP_OBJECTIVE_AREA_PER_WATER, /* highest ratio of area to outlay among layouts that reach the coverage asked for;
                                  * where none does, least outlay within SP_COVERAGE_TOLD of the most covered */
    SP_OBJECTIVE_MIN_WATER,      /* least outlay that reaches it; where none does as above */
    SP_OBJECTIVE_MAX_COVERAGE,   /* most coverage within max_nozzles and max_water; of equal ones least outlay */
} sp_objective;

/* How far refinement may move each nozzle; 0 or false: not at all. */
typedef struct {
    double position; /* m; -1: half the mount's spacing, on a surface all of it */
    double axis;     /* rad */
    bool roll;
    double angle; /* rad; INFINITY: the type's whole range */
    double flow;  /* share of the rated flow; INFINITY: the type's whole range */
} sp_refine;

/* What a placement found, for another one to begin with. */
typedef struct sp_found sp_found;
typedef struct sp_proposal sp_proposal;

typedef struct {
    sp_objective objective;
    double coverage;    /* asked for, share of the surface to be cleaned; where less is attainable the search aims at
                         * this share of what is */
    size_t max_nozzles; /* 0: unlimited */
    double max_water;   /* m³/s, 0 or more, of water alone; INFINITY: unlimited */
    size_t type_count;
    const sp_nozzle_type *const *types; /* borrowed: what may be chosen */
    size_t pressure_count;
    const double *pressures; /* Pa, 0 or more, borrowed */
    double clearance;        /* m, 0 or more */
    double memory; /* bytes that all that the candidates can reach may take; 0: 1 GB. Less takes longer: what is not
                    * kept is worked out again. The answer does not depend on it, but where clusters, measured types or
                    * rotating ones are among the types, whose poses are all kept, on texels that leave room for them;
                    * too little for one mounting point, or for those poses, is SP_ERROR_INPUT */
    bool prove; /* goes on lowering the certificate's bounds, by more layouts looked at one by one, until the time limit
                 * or, where there is none, until all are within 0.1 % of what was found or much was tried */
    size_t mount_count;
    const sp_mount *mounts; /* borrowed */
    size_t other_count;
    const sp_mount *others; /* borrowed: of ports among them that are not to be used no nozzle gets the name */
    sp_refine refine;
    const sp_layout *kept; /* borrowed, may be NULL: the scene's own; its nozzles marked keep are in every proposal */
    size_t known_count;
    const sp_proposal *const *known; /* borrowed: proposals for the same evaluator and options but for mounts, types,
                                      * pressures, numbers, water, time and memory. What they found is found here, too,
                                      * as far as it is allowed, at the prices of these mounts: nothing that is
                                      * reported here is worse. Of clusters, and of types that do not spray as densely
                                      * all over, that holds at poses that are candidates here as well */
    bool mend_kept;                  /* default true: what would mend the shadows of all of `kept` is looked for, too */
    sp_run run;
} sp_place_options;

/* The defaults of a scene file's `place:`, with no mounts, types or pressures. */
SP_API sp_place_options sp_place_options_default(void);

typedef struct {
    double flow; /* m³/s */
    double area; /* covered, m², by the scene's own evaluator on the final atlas */
    size_t nozzles;
    double counted; /* m² that it covers on the certificate's patches; NAN: no certificate */
    double bound;   /* m² of the same patches that no layout of as much outlay covers (see sp_certificate); NAN */
    double every_aim_bound; /* the same of nozzles aimed in any way (see sp_certificate); NAN */
    size_t fittings;        /* of the nozzles, those that are neither kept nor in ports */
    double outlay;          /* m³/s, at least the flow */
} sp_front_point;

/* How far from the best the proposal can be: no layout of the candidate poses and of the poses of the layouts found
 * (the proposal's and the front's), within the limits on number, water and ports, does better than these bounds. They
 * are proved, rounded outwards. Areas are counted by the inverse evaluation on the search's own patches, which may be
 * coarser than the evaluator's; poses in between the candidates are not covered. Where mounts cost something
 * `water` is outlay here, and layouts beyond max_water are among those that do no better. */
typedef struct {
    bool computed;      /* false: nothing below means anything */
    bool every_layout;  /* that bodies allow was looked at: area_bound and water_bound are what the best of them do */
    size_t texels;      /* patches that areas are counted on */
    size_t candidates;  /* poses priced */
    size_t own;         /* poses of layouts found, besides */
    double whole;       /* m² of these patches */
    double counted;     /* m² of them that the proposal covers */
    double area_bound;  /* m² of them that no layout with the proposal's water exceeds */
    double water_bound; /* m³/s that every layout needs at least to cover what the proposal does */
    double gap;         /* (area_bound - counted) / area_bound */
    /* The same, as far as it could be proved, of all layouts of nozzles at the candidates' mounting points whichever
     * way they are aimed: every axis within the mount's tilt, every roll, every angle and flow that refinement may set,
     * not only the candidates'; and of the poses of the layouts found. Places between the mounting points are not
     * covered. */
    struct {
        bool computed;      /* false: nothing is proved that says more than `whole` */
        size_t places;      /* mounting points */
        double area_bound;  /* m² */
        double water_bound; /* m³/s */
        double gap;
    } every_aim;
} sp_certificate;

/* The proposal counted again by the other method: jets flown forward from its nozzles to their first impact, against
 * the inverse evaluation on the same patches, which are the search's and may be coarser than the evaluator's. */
typedef struct {
    bool computed; /* false: there was no time, and nothing below means anything */
    size_t texels; /* patches that both count on */
    uint64_t jets;
    double coverage;   /* by the jets, as a fraction: what is hit, without film */
    double difference; /* that less the inverse evaluation's, points as a fraction */
    double tolerance;  /* the accuracy asked for, or half a point where that is more */
    bool agrees;       /* the difference is no more than that */
} sp_forward_check;

/* What one more nozzle could do for a shadow of a layout, whatever the limits on number and water: the most that was
 * found, not a bound. The most promising places are chosen on the search's patches, which may be coarser than the
 * report's. */
typedef struct {
    sp_nozzle nozzle; /* the candidate found that covers most of it beside the layout; type NULL: none covers any */
    bool in_port;     /* whose name it has */
    double area;      /* m² of the shadow that it covers, by the scene's own settings; it may be 0 */
    double flow;      /* m³/s */
} sp_remedy;
#define SP_REMEDIES 10

#define SP_STAGE_NAME 32
#define SP_STAGES_CUT 12
typedef struct {
    char name[SP_STAGE_NAME];
    double seconds;
    double processor_seconds; /* of all threads of the process, whatever they did besides */
} sp_stage;

/* Owned by the caller. */
struct sp_proposal {
    sp_objective objective; /* the options' */
    sp_layout *layout;      /* the proposal, refined */
    bool *fittings;         /* [layout->count]: neither kept nor in a port, so that it wants a fitting made for it */
    double *costs, *greedy_costs; /* [count] of `layout` and of `greedy`, m³/s: of its mount; 0 of a kept one */
    double outlay;                /* m³/s, of `layout` */
    bool costly;                  /* some mount costs something; else outlay is water */
    sp_coverage *coverage;        /* of it, by the scene's own settings, its error measured */
    sp_evaluator *again; /* NULL; or owned, and all here is counted on it: what auto had chosen for the search did not
                          * keep the accuracy on the proposal (sp_evaluator_again) */
    sp_layout *greedy;   /* the best found on the candidates, before refinement */
    sp_coverage *greedy_coverage;
    bool *attainable; /* [patches], of `again` where there is one: nozzles at the mounting points, aimed in any way that
                       * mounts and types allow, not only as candidates are, could cover the point that it is judged
                       * by within the limits; or either layout above covers half of it. Where the evaluator counts
                       * what walls throw back: any liquid gets there */
    sp_reason *reasons;      /* [patches]: why not */
    double attainable_area;  /* m² */
    bool attainable_hurried; /* these three are as far as the time allowed to look, on coarser patches than at leisure
                              * perhaps: more, or less, may be attainable. Then `cut` has "attainable" */
    double asked_area;       /* m²: options' coverage of the surface to be cleaned */
    double target_area;      /* m² aimed at: asked_area, or where the allowed nozzles attain less that share of it */
    bool reached;            /* the proposal covers asked_area within all limits */
    bool interrupted;        /* cancelled or out of time: the best so far */
    size_t max_nozzles;      /* the options': 0: no limit */
    double max_water;        /* the options', m³/s: INFINITY: no limit */
    double water_lacking; /* m³/s, that max_water is short of what the kept nozzles and the least further one of those
                           * that are allowed take together: `layout` has kept ones alone; 0 where one fits */
    size_t positions,
        candidates; /* mounting points kept; poses considered (position × axis × roll × type × pressure) */
    size_t front_count;
    sp_front_point *front; /* best found for rising outlay, both strictly rising */
    size_t by_number_count;
    sp_front_point *by_number; /* best found for rising numbers of nozzles, whatever their outlay; bounds NAN */
    /* Of its largest shadows, as sp_shadows lists them: as many as there was time for. */
    size_t remedy_count;
    sp_remedy remedies[SP_REMEDIES];
    /* With mend_kept, of those of all nozzles of the options' `kept`, marked or not, as the evaluator counts them that
     * the proposal is counted on: what to add to the layout there is. */
    size_t own_remedy_count;
    sp_remedy own_remedies[SP_REMEDIES];
    sp_forward_check forward_check;
    sp_certificate certificate;
    size_t stage_count;
    sp_stage *stages;
    /* Names of stages that were cut short or left out, for lack of time or because progress said so. */
    size_t cut_count;
    char cut[SP_STAGES_CUT][SP_STAGE_NAME];
    sp_found *found; /* its layout and those of the fronts, for other options' `known` */
};

/* As many may all mounts give together: beyond that a spacing is taken for a mistake. */
#define SP_MOUNTING_POINTS 100000
/* How many mounting points each of the options' mounts gives, into [mount_count] of the caller's: `all`, and the
 * `usable` ones, which are inside the cavity and clear of walls. False, with an error, that names the mount of most
 * points where all give more than SP_MOUNTING_POINTS together, and where memory runs out. */
SP_API bool sp_place_count_points(const sp_evaluator *evaluator, const sp_place_options *options, size_t *all,
                                  size_t *usable, sp_error *error);

/* Greedy next-best-view placement by the inverse evaluator, then refinement with Ceres accepted only where the
 * re-traced objective improves, then brought to what ports and types can be set to: all that is reported is of such
 * settings, as the candidates are. The error of the proposal's coverage is measured; where it is above the accuracy,
 * and auto chose the settings of the simulation, everything found is counted again by dearer ones. Deterministic.
 * Returns NULL on error, never for a target that cannot be reached. Fails with SP_ERROR_ARGUMENT where an option is
 * none that the fields above allow, with SP_ERROR_INPUT where no mount, type or
 * pressure is given, no mounting point is inside and clear, or a kept nozzle is in a wall, outside, or in a port that
 * it does not pass. Clusters, and types that do not spray as densely all over, stay at the poses of candidates:
 * refinement moves the others about them; in the end each nozzle is tried as every other type and pressure that its
 * mount allows, where it stands, of those that take no more or may be set to no more. */
SP_API sp_proposal *sp_place(const sp_evaluator *evaluator, const sp_place_options *options, sp_error *error);
SP_API void sp_proposal_destroy(sp_proposal *proposal);

/* Which of proposals [count >= 1] with one objective, for the same surface and coverage, is best by it: of those that
 * cover what was asked for the one of most area per outlay, of least outlay or of most coverage; where none does, the
 * one that covers most, or of those within SP_COVERAGE_TOLD of it where the objective saves that of least outlay. Of
 * equal ones that of less outlay, of these that of more coverage, then the first. */
SP_API size_t sp_place_best(const sp_proposal *const *proposals, size_t count);
/* By the same order, whether a layout that no search found, such as the engineer's own, is better than the proposal:
 * its coverage, on the same evaluator, and its outlay. Limits on number and water are not looked at. */
SP_API bool sp_place_is_beaten(const sp_proposal *proposal, const sp_coverage *coverage, double outlay);

#ifdef __cplusplus
}
#endif
#endif
