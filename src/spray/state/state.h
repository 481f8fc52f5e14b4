/* What an evaluator holds, for the files of this room. */
#ifndef SPRAY_STATE_H
#define SPRAY_STATE_H

#include <sprayplan/evaluator.h>

#include <omp.h>

struct sp_evaluator {
    sp_setup setup;
    sp_fidelity fidelity;       /* resolved: nothing left to auto */
    sp_choice choice;           /* why */
    sp_vec3 gravity;            /* zero for lines */
    sp_vec3 low, high;          /* m, the geometry's box */
    double farthest;            /* m, the geometry's farthest coordinate, wherever it moves */
    bool everything;            /* counts every wet side, whatever is to be cleaned: film runs over it all */
    const sp_evaluator *origin; /* of a resampled evaluator: owns tracer, charts and wet; else NULL */
    sp_tracer *tracer;
    sp_charts *charts;
    double extent;      /* m: longer charts were cut */
    struct sp_wet *wet; /* wet.h */
    sp_atlas *atlas;
    sp_fragments fragments; /* of the atlas */
    sp_patches patches;
    uint32_t (*texel_patch)[2]; /* [texel_count], patch on the front (or both sides) and on the back, or SP_NONE */
    struct sp_falling_film *falling_film; /* falling_film.h; NULL where the criterion does not ask for film */
    struct sp_movers *movers;             /* movers.h; NULL where nothing moves; the origin owns it */
    double began;                         /* s, of a monotonic clock: when it was asked for */
    const char *stage; /* of which all that it does is a part, for the progress; NULL: each has its own */
    size_t positions;  /* in which goods are looked at on their pass; 1 where nothing moves */
};

/* Threads to use for sp_run's `threads`. */
static inline int sp_thread_count(int threads)
{
    return threads > 0 ? threads : omp_get_max_threads();
}
/* What pulls at liquid that flies so, m/s²; zero for lines. What is left to auto flies as parabolas. */
sp_vec3 sp_gravity_for(const sp_setup *setup, sp_trajectory trajectory);
/* How the liquid of a type, or of a launch, flies whose own trajectory this is; never auto. */
sp_trajectory sp_trajectory_of(const sp_evaluator *evaluator, sp_trajectory own);
/* What pulls at it, m/s². */
sp_vec3 sp_acceleration_at(const sp_evaluator *evaluator, sp_trajectory own);
/* setup_limits.c: false, with the error set, where a setup is not as <sprayplan/setup.h> says. */
bool sp_setup_is_valid(const sp_setup *setup, sp_error *error);
/* Whether air and liquid tell how drops are held back. */
bool sp_air_is_known(const sp_setup *setup);
/* Reports progress; false, with the error set, where the caller is to stop. */
bool sp_evaluator_progress(const sp_setup *setup, const char *stage, double done, sp_error *error);
/* The same of what an evaluator does, unless that is a part of another stage. */
bool sp_evaluator_stage(const sp_evaluator *evaluator, const char *stage, double done, sp_error *error);
/* False, with the error that nothing is to be cleaned. */
bool sp_fail_nothing(sp_error *error);

/* m off a wall that liquid starts from: what double precision tells surely. */
static inline double sp_stand_off(const sp_evaluator *evaluator)
{
    return 0x1p-40 * evaluator->farthest; /* flights are told to 2^-42 of it */
}

/* limits.c: the largest coordinate of a box, whatever its sign, m. */
double sp_farthest_coordinate(sp_vec3 low, sp_vec3 high);
/* False, with an error, where double precision does not tell what is asked: a geometry too large, too small or too far
 * off the origin, too strong a gravity; too short a texel; what leaves a nozzle too fast or too slowly. */
bool sp_geometry_is_resolved(const sp_setup *setup, sp_error *error);
bool sp_texel_is_resolved(const sp_evaluator *evaluator, double texel, sp_error *error);
bool sp_evaluator_takes(const sp_evaluator *evaluator, const sp_layout *layout, sp_error *error);

/* evaluator.c: another on the geometry of `fine`, texels to come. */
sp_evaluator *sp_evaluator_share(const sp_evaluator *fine, double texel, sp_error *error);

/* patches.c: from atlas, wet sides and roles. */
bool sp_patches_create(sp_evaluator *evaluator, sp_error *error);
void sp_patches_free(sp_patches *patches);
/* Whether any of a triangle's `side` (0 front, or both where no cavity is named; 1 back) is cleaned and counted, and
 * whether its point (1-u-v, u, v) is: a triangle that others cross or touch may be wet in parts. */
bool sp_side_is_counted(const sp_evaluator *evaluator, uint32_t triangle, unsigned side);
/* The area (m²) of a triangle once for every side of which any is cleaned and counted. */
double sp_counted_area(const sp_evaluator *evaluator, uint32_t triangle);
bool sp_point_is_counted(const sp_evaluator *evaluator, uint32_t triangle, double u, double v, unsigned side);
/* Calls `visit` with every convex piece of a texel's fragment that is counted on a side: its corners on the surface (m)
 * and its area (m²) as the atlas measured it. Where round-off left no corners of a fragment, `corners` is 0. */
typedef void sp_counted_visitor(void *user, const sp_vec3 *polygon, int corners, double area);
void sp_counted_pieces(const sp_evaluator *evaluator, uint32_t texel, const sp_fragment *fragment, unsigned side,
                       sp_counted_visitor *visit, void *user);
/* The same of a whole triangle. */
void sp_counted_parts(const sp_evaluator *evaluator, uint32_t triangle, unsigned side, sp_counted_visitor *visit,
                      void *user);
/* The patch that takes what arrives at the point (1-u-v, u, v) of a triangle, on its back or else its front; SP_NONE
 * where that side is dry or an obstacle. */
uint32_t sp_patch_at(const sp_evaluator *evaluator, uint32_t triangle, double u, double v, bool back);

/* measured.c: sp_measure_error as far as a choice needs it, until twice the standard error is no more than a quarter of
 * the accuracy, or 80,000 points were judged. */
bool sp_measure_roughly(const sp_evaluator *evaluator, const sp_layout *layout, const sp_coverage *coverage,
                        sp_measured_error *measured, sp_error *error);

/* forward.c: with the evaluator's reflections and jets. *able, where it is not NULL, is the liquid (m³/s) that flies on
 * in the end and may yet, for all that it can fall, be fast enough to count. */
sp_coverage *sp_evaluate_jets(const sp_evaluator *evaluator, const sp_layout *layout, double *able, sp_error *error);

/* balance.c: what a jet does to the balance where it arrives, or does not; `onward` (m³/s) of what arrives is thrown
 * back. */
void sp_balance_add(sp_balance *balance, bool hit, bool clean, double arrived, double onward);

/* coverage.c: everything zero, [patches.count]. */
sp_coverage *sp_coverage_create(const sp_evaluator *evaluator, sp_error *error);
/* One arrival of `flux` (m³/s per m²) and `jets` at a patch. speed, incidence and impact are summed weighted by flux
 * until sp_coverage_conclude divides. Does not touch `counted`. */
void sp_deposit(sp_deposits *deposits, uint32_t patch, double flux, double jets, double speed, double incidence,
                double density);
/* Divides the means and applies the criterion, once; and that with what runs down, the flow and the flux's figures. */
struct sp_bodies;
void sp_coverage_judge(const sp_evaluator *evaluator, sp_coverage *coverage);
bool sp_coverage_conclude(const sp_evaluator *evaluator, const struct sp_bodies *bodies, sp_coverage *coverage,
                          sp_error *error);

#endif
