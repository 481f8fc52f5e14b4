/* The evaluator: what a layout does to the surface. Built once for a setup, asked for many layouts. */
#ifndef SPRAYPLAN_EVALUATOR_H
#define SPRAYPLAN_EVALUATOR_H

#include <sprayplan/atlas.h>
#include <sprayplan/coverage.h>
#include <sprayplan/export.h>
#include <sprayplan/flight.h>
#include <sprayplan/patches.h>
#include <sprayplan/setup.h>
#include <sprayplan/trace.h>

#include <math.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct sp_evaluator sp_evaluator;

/* Builds accelerator, wet sides, atlas and patches. The setup is copied, its mesh and surfaces are borrowed and must
 * outlive the evaluator. Settings left to auto become the plain safe ones: parabolas, 100,000 texels on what is cleaned
 * and counted, jets for them, and jets at all, with three reflections, only where walls throw liquid back. Given NULL
 * it returns NULL and keeps the error. */
SP_API sp_evaluator *sp_evaluator_create(const sp_setup *setup, sp_error *error);
/* The same for a layout (borrowed for the call; NULL or without nozzles: as above), with the cheapest settings that
 * keep the setup's accuracy as measured on it (see sp_measure_error), so that they hold for it and layouts like it:
 *  - the texel, inverse: the longest of those tried on which the error estimated is at most half the accuracy, between
 *    that of 30,000 texels, which is tried first, and that of 1,600,000. Where the first misjudges more area than the
 *    accuracy, the next is shorter in that proportion: as what is misjudged shrinks about as the texel does, it then
 *    comes to about the accuracy, and may come to a little more. Each further one is 0.7 of the one before
 *  - the trajectory, inverse: lines where against parabolas no more is misjudged than the accuracy, the error is at
 *    most half of it and a tenth of the work, as counted, is saved
 *  - forward: shorter texels where the first impact of few jets on long texels is found to cover too much, more jets
 *    where too little, until its error estimated is at most half the accuracy; in the end the best that was tried
 *  - reflections: as many as it takes until the liquid that still flies can change the coverage by no more than a
 *    quarter of the accuracy, eight at most
 * Where goods move neither lines nor more than 100,000 texels are tried. Nothing depends on time or threads. It costs
 * about as much as two or three evaluations. */
SP_API sp_evaluator *sp_evaluator_create_for(const sp_setup *setup, const sp_layout *layout, sp_error *error);
/* A second evaluator on the same geometry with another texel size (m), sharing accelerator, charts and wet sides with
 * `fine`, which must outlive it. On thin parts and on what is not cleaned its texels differ from `texel` in proportion
 * to those of `fine`. Inverse, whatever the setup asks: for searching. Where the criterion asks for film, its
 * patches are of all wet sides, cleaned or not, and film runs from one to the next: see sp_evaluator_counted and
 * sp_runoff. */
SP_API sp_evaluator *sp_evaluator_resample(const sp_evaluator *fine, double texel, sp_error *error);
/* A third on the same geometry, by the scene's own method, to count on again what was found on `evaluator`, which must
 * outlive it: by parabolas where auto took lines, and with `shorter` on texels half as long where auto chose them. NULL
 * in *again where neither changes anything: auto takes no shorter texels than sp_evaluator_create_for says. False on
 * error. */
SP_API bool sp_evaluator_again(const sp_evaluator *evaluator, bool shorter, sp_evaluator **again, sp_error *error);
SP_API void sp_evaluator_destroy(sp_evaluator *evaluator);

SP_API const sp_setup *sp_evaluator_setup(const sp_evaluator *evaluator);
SP_API const sp_fidelity *sp_evaluator_fidelity(const sp_evaluator *evaluator); /* nothing left to auto */
/* True where its figures count liquid that walls throw back. */
SP_API bool sp_evaluator_counts_thrown_back(const sp_evaluator *evaluator);
/* Why settings that the setup left to auto are as they are, a clause of plain text each; "" where the setup itself says
 * or nothing was measured. */
#define SP_WHY 160
typedef struct {
    char trajectory[SP_WHY], method[SP_WHY], reflections[SP_WHY], jets[SP_WHY], texel[SP_WHY];
    bool missed; /* nothing that was tried keeps the accuracy with half of it to spare */
} sp_choice;
SP_API const sp_choice *sp_evaluator_choice(const sp_evaluator *evaluator);
/* Jets per nozzle that so short a texel wants, where the forward evaluator flies fewer (whether they were asked for or
 * are the most that it chooses itself) and they were not measured to be enough; else 0. */
SP_API double sp_evaluator_jets_wanted(const sp_evaluator *evaluator);
/* How many of a nozzle's jets meet a texel that is just covered: its flux is off by about one over their square root,
 * as a share. */
SP_API double sp_evaluator_jets_met(const sp_evaluator *evaluator);
SP_API const sp_atlas *sp_evaluator_atlas(const sp_evaluator *evaluator);
SP_API const sp_patches *sp_evaluator_patches(const sp_evaluator *evaluator);
/* m² of a patch that are to be cleaned: all of its area, or 0 where film only runs over it. */
SP_API double sp_evaluator_counted(const sp_evaluator *evaluator, uint32_t patch);
/* To which parts a patch's surface belongs: calls `visit` with each piece of it that is to be cleaned, the number of
 * its part and m². A part may come several times. */
typedef void sp_part_visitor(void *user, uint32_t part, double area);
SP_API void sp_evaluator_part_areas(const sp_evaluator *evaluator, uint32_t patch, sp_part_visitor *visit, void *user);
SP_API const sp_tracer *sp_evaluator_tracer(const sp_evaluator *evaluator);
/* On which sides some of a triangle faces the liquid: bit 0 front, bit 1 back. Both where no cavity is named. A
 * triangle that others cross or touch may face it in parts. */
SP_API unsigned sp_evaluator_wet(const sp_evaluator *evaluator, uint32_t triangle);
/* On which sides the point (1-u-v, u, v) of a triangle does. */
SP_API unsigned sp_evaluator_wet_at(const sp_evaluator *evaluator, uint32_t triangle, double u, double v);
/* What became of a part's surface, in m². Of closed shells the outer side is counted (of a room's the inner), of sheets
 * both sides, each with its area. Where no cavity is named all is wet, once. */
typedef struct {
    double wet;      /* faces the liquid */
    double dry;      /* faces free space that the liquid does not reach */
    double inside;   /* lies in another solid */
    double touching; /* lies on another surface */
    double both;     /* of wet: of closed shells, wet on both sides; something is wrong with the geometry */
} sp_part_sides;
/* parts: [part_count of the setup's mesh], the caller's. */
SP_API void sp_evaluator_part_sides(const sp_evaluator *evaluator, sp_part_sides *parts);

/* How the whole geometry was understood, sound or not; what only the flood from the cavity finds is 0 where no cavity
 * is named. */
typedef struct {
    size_t left_out;     /* triangles without area */
    bool sides_known;    /* a cavity is named */
    size_t closed;       /* shells that are closed: bodies or rooms */
    sp_flaw turned;      /* of these, drawn inside out and turned round */
    size_t open;         /* shells that are not: sheets, of which both sides count where liquid reaches them */
    double open_area;    /* m², of their triangles */
    sp_part_sides sides; /* of all parts together */
    double outdoors;     /* m², as sp_evaluator_outdoors */
} sp_geometry_account;
SP_API sp_geometry_account sp_evaluator_account(const sp_evaluator *evaluator);

/* Where lines of sight leave the space to be cleaned, for the sky or for what lies outdoors. */
typedef struct {
    sp_vec3 place; /* m */
    double width;  /* m, across its narrow way */
    double share;  /* of all lines from wet sides */
    /* Of a cap about the place that would shut it, as sp_cap has it, and would part nothing else. */
    sp_vec3 normal; /* outward, of length 1 */
    double radius;  /* m; 0: none was found, as the rim is not seen whole */
} sp_opening;
#define SP_OPENINGS 16 /* as many are kept */
/* The openings that are most seen through, in that order. Owned by the evaluator. None but for a cavity's point. */
SP_API const sp_opening *sp_evaluator_openings(const sp_evaluator *evaluator, size_t *count);
/* How many more were found. Of those that few lines pass there may be more still. */
SP_API size_t sp_evaluator_more_openings(const sp_evaluator *evaluator);
/* m² of surface that is seen through openings alone and lies under the sky: it is left out. */
SP_API double sp_evaluator_outdoors(const sp_evaluator *evaluator);
/* What a cap of the setup does for the finding of what is wet. */
typedef enum {
    SP_CAP_SHUTS,  /* it parts what is wet from something, or may do so */
    SP_CAP_PASSED, /* nothing: liquid passes round more than half of its rim */
    SP_CAP_DRY,    /* nothing: no liquid comes to it */
} sp_cap_use;
/* cap: below the setup's cap_count. */
SP_API sp_cap_use sp_evaluator_cap_use(const sp_evaluator *evaluator, size_t cap);
/* m² of surface that liquid would reach without the caps, and does not; 0 where no cavity is named. It takes as long as
 * the finding of what is wet. False, with an error, where memory runs out. */
SP_API bool sp_evaluator_beyond_caps(const sp_evaluator *evaluator, double *area, sp_error *error);
/* Where what runs down the walls stands: hollows up to their rim, flats, and the lowest places of a vessel without its
 * drain. */
typedef struct {
    sp_vec3 place; /* m, its lowest */
    double area;   /* m², of the cells that film is routed on */
    bool drains;   /* over its rim; else all that comes there stays */
} sp_hollow;
#define SP_HOLLOWS 16 /* as many are kept */
/* Those that do not drain, then the others, those of most area first. Owned by the evaluator. None where the criterion
 * does not ask for film. */
SP_API const sp_hollow *sp_evaluator_hollows(const sp_evaluator *evaluator, size_t *count);
/* Where film may be lost: the mesh's cracks, as sp_mesh_diagnose finds them, and how wide these may be (m). NULL where
 * no film is asked for. Owned by the evaluator. */
SP_API const sp_flaw *sp_evaluator_cracks(const sp_evaluator *evaluator, double *width);
/* What comes of one nozzle's liquid once it has arrived: the film that runs down the walls, where the criterion asks
 * for film, or the dose that goods which move take with them. Both are linear in the liquid, so that films of several
 * nozzles add up, and so do doses. It holds one thread's working memory. */
typedef struct sp_runoff sp_runoff;
/* `walls`, borrowed, is an evaluator that sp_evaluator_resample made. NULL on error, also where film does not run from
 * patch to patch and no goods take a dose. */
SP_API sp_runoff *sp_runoff_create(const sp_evaluator *walls, sp_error *error);
/* Accepts NULL. */
SP_API void sp_runoff_destroy(sp_runoff *runoff);
/* Where to write what one nozzle brings to each patch, m³/s, [patches]: the runoff's, all 0 at first. */
SP_API double *sp_runoff_arriving(sp_runoff *runoff);
/* From what was written there, which is 0 again afterwards: the film on every patch [patches], as flow per width over
 * what the criterion asks for; or the dose over what is asked for. A solid stream, all of `flow` (m³/s), first spreads
 * over a disc where it hits. */
SP_API void sp_runoff_find(sp_runoff *runoff, const sp_nozzle_type *type, double flow, float *film);

/* True where the point lies in the space that the wet sides face (no cavity: everywhere). Never in a solid; else by
 * lines of sight in at least 16 directions: what most of them first meet is a wet side (or, with the cavity outside,
 * nothing). */
SP_API bool sp_evaluator_inside(const sp_evaluator *evaluator, sp_vec3 point);
/* False, with an error that names the nozzle, where it cannot stand: in a wall (nearer to a surface than 1e-6 of the
 * geometry's diagonal), or not in the space that the wet sides face (by lines of sight as above, and none to the
 * cavity's point), or in the way of goods that move. Of a cluster that is asked of each pattern. The cavity's
 * point may be what is wrong: where it lies outside a body around the nozzle the error names it too, and where it lies
 * outside the geometry's box, as the nozzle does not, the error is the cavity's. */
SP_API bool sp_evaluator_admits(const sp_evaluator *evaluator, const sp_nozzle *nozzle, sp_error *error);
/* In how many positions goods that move are looked at on their pass; 1 where nothing moves. */
SP_API size_t sp_evaluator_positions(const sp_evaluator *evaluator);
/* True where no surface but that of part `own` (SP_NONE: no exception) comes nearer to the point than `clearance` (m),
 * of goods that move at any time of their pass; and none at all so near that a nozzle there stands in it. */
SP_API bool sp_evaluator_is_clear(const sp_evaluator *evaluator, sp_vec3 point, double clearance, uint32_t own);
/* What pulls at liquid that leaves so, or (NULL) of a type without a trajectory of its own: m/s², zero along lines. */
SP_API sp_vec3 sp_evaluator_gravity(const sp_evaluator *evaluator, const sp_launch *launch);

/* Evaluates by the scene's own method. NULL on error. */
SP_API sp_coverage *sp_evaluate(const sp_evaluator *evaluator, const sp_layout *layout, sp_error *error);
/* By one method whatever the scene asks; both to the first impact, with no `reflections` (0 or more), so that each
 * checks the other. The nozzles share the jets by their flows; a texel that none of few jets meets looks dry, and one
 * that few meet is covered whole. */
SP_API sp_coverage *sp_evaluate_inverse(const sp_evaluator *evaluator, const sp_layout *layout, sp_error *error);
SP_API sp_coverage *sp_evaluate_forward(const sp_evaluator *evaluator, const sp_layout *layout, int reflections,
                                        uint64_t jets, sp_error *error);
/* Works out coverage->balance of this layout where it is not known: 20,000 jets of each nozzle (which a cluster's
 * patterns share) are flown to their first impact, evenly spread, which tells shares of the liquid to about 0.1 %. */
SP_API bool sp_evaluate_balance(const sp_evaluator *evaluator, const sp_layout *layout, sp_coverage *coverage,
                                sp_error *error);

/* What each nozzle of a layout does for its coverage. */
typedef struct {
    size_t count, patches; /* nozzles; patches of the evaluator */
    double *alone;         /* [count], m² that it covers by itself */
    double *lost;          /* [count], m² that the layout covers less without it */
    float *flux;           /* [count][patches], m³/s per m² that arrive of it alone */
} sp_contributions;
/* By the scene's own method; `coverage` is that of the layout. Evaluates every nozzle alone, of which what is lost
 * follows: takes about as long as evaluating the layout, and besides what it returns 16 bytes (24 where the criterion
 * asks for film) for each nozzle and patch meanwhile. The caller destroys; NULL on error. */
SP_API sp_contributions *sp_contributions_create(const sp_evaluator *evaluator, const sp_layout *layout,
                                                 const sp_coverage *coverage, sp_error *error);
/* Accepts NULL. */
SP_API void sp_contributions_destroy(sp_contributions *contributions);

/* Finds the patches whose verdict round-off could turn, for `coverage` that sp_evaluate_inverse found for this layout:
 * where a flux, speed or incidence lies within 1e-9 (relative) of its criterion, or the patch's point, or that of a
 * cell of it, within 1e-9 rad of the edge of a spray or of what stands before it; and with no criterion of flux and
 * incidence where the nozzle lies in the wall's own plane. Two evaluations of one scene that differ in round-off alone
 * (in its unit or place, in compilers) agree on all other patches. What stands before them is looked for where flights
 * to neighbouring patches fare differently: an occluder thinner than a patch that blocks none is not seen.
 *
 * Takes about as long as evaluating. `patches` is NULL or the caller's [patches], true for those found. *borderline is
 * coverage->borderline or another, the caller's; not known where goods move. Given NULL from an earlier failure it
 * returns false and keeps the error. */
SP_API bool sp_find_borderline(const sp_evaluator *evaluator, const sp_layout *layout, const sp_coverage *coverage,
                               bool *patches, sp_borderline *borderline, sp_error *error);

/* How liquid from one position arrives at a patch that leaves as a launch says: nothing else here depends on the
 * nozzle, its axis, roll, angle, type or flow. The flux (m/s) at the patch is Q · intensity(direction) · transfer. A
 * patch so near to the position, or to the limits of reach, that its one point does not tell how liquid arrives there
 * is cut into cells, each an arrival of its own; what is said of the patch then is of the cell. */
typedef struct {
    uint32_t patch;
    bool passes;       /* impact speed and incidence meet the criterion */
    bool blocked;      /* something lies in the way: never in a reach, but where this is asked for */
    uint8_t arc;       /* which of sp_flights */
    double part;       /* share of the patch's area that the cell is; 1: all of it, which is not cut */
    sp_vec3 direction; /* unit, at the nozzle, world coordinates */
    double transfer;   /* 1/m²: |n·w| / (v T √D) for a parabola, cos(incidence)/r² for a line */
    double speed;      /* at impact, m/s */
    double towards;    /* of it, against the patch's normal, m/s */
    double along;      /* of it, in the patch's plane, m/s */
    double breadth;    /* rad, of the patch as seen from the nozzle */
    double time;       /* s, that it takes */
    sp_vec3 point;     /* m, where it arrives */
    sp_vec3 normal;    /* unit, as the patch's */
} sp_arrival;

/* rad from the patch's normal. Not held in an arrival, since few of those that are found are ever asked for it. */
static inline double sp_arrival_incidence(const sp_arrival *arrival)
{
    return atan2(arrival->along, arrival->towards);
}

typedef struct {
    size_t count;
    sp_arrival *arrivals; /* ascending by patch; cell by cell; low arc before high arc */
    sp_work work;         /* that it took */
} sp_reach;

/* All unoccluded arrivals from `position` of what leaves there so, within `half_angle` (rad, π for all) about the unit
 * `axis`, or so near beyond it that a spray which ends there may have a share of their patch (sp_spray_fringe).
 * The caller destroys. Uses the setup's threads; inside a parallel region it runs on one. Fails where the launch has no
 * wavefronts and the evaluator flies with drag, or the other way round: see sp_launch_table. */
SP_API sp_reach *sp_evaluator_reach(const sp_evaluator *evaluator, sp_vec3 position, sp_launch launch, sp_vec3 axis,
                                    double half_angle, sp_error *error);
/* The same, of arrivals that pass the criterion's speed and incidence alone, at the patches that `among` [patches]
 * holds, all where it is NULL: less is traced. */
SP_API sp_reach *sp_evaluator_reach_passing(const sp_evaluator *evaluator, sp_vec3 position, sp_launch launch,
                                            sp_vec3 axis, double half_angle, const bool *among, sp_error *error);
/* The same of the patches first to end alone, and where film runs from patch to patch of all arrivals, for callers with
 * little memory: it takes no more than SP_REACH_WORK bytes for each of these patches and for each arrival of a cell,
 * the answer included. `known` is NULL, or holds the answer of an earlier call, bit 2 patch + arc (least bits first)
 * set for every arrival: then the same arrivals are found, and only ways to cells are traced. */
#define SP_REACH_WORK 1024
SP_API sp_reach *sp_evaluator_reach_part(const sp_evaluator *evaluator, sp_vec3 position, sp_launch launch,
                                         sp_vec3 axis, double half_angle, size_t first, size_t end,
                                         const uint8_t *known, sp_error *error);
SP_API void sp_reach_destroy(sp_reach *reach);

/* True where nothing lies in the way of a flight, one of what leaves `position` (m) so, to the patch's point. */
SP_API bool sp_evaluator_flight_free(const sp_evaluator *evaluator, sp_vec3 position, sp_launch launch,
                                     const sp_flight *flight, uint32_t patch);

/* What liquid meets first that flies along a ray from its start. */
typedef struct {
    sp_hit hit;       /* t: s, from the start of the ray, or with drag of a piece of its way */
    sp_vec3 point;    /* m */
    sp_vec3 velocity; /* there, m/s */
} sp_meeting;
/* `drops`: it has met a wall, so that it is a stream no longer, whatever it was when it left. */
SP_API sp_meeting sp_evaluator_meet(const sp_evaluator *evaluator, sp_launch launch, const sp_ray *ray, bool drops);

#ifdef __cplusplus
}
#endif
#endif
