/* A study: what speed costs in accuracy on one scene. Its layout is evaluated by every combination of settings that the
 * scene leaves open, each is compared with the same points of the surface, and placements are run by several of them.
 */
#ifndef SPRAYPLAN_STUDY_H
#define SPRAYPLAN_STUDY_H

#include <sprayplan/export.h>
#include <sprayplan/place.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What differs from run to run: seconds are of wall time and of all threads' processor time, each the median of as many
 * runs as fit into a third of a second, at least one and at most five. */
typedef struct {
    double prepare, evaluate;         /* s of wall time: tree, wet sides and atlas; one layout */
    double prepare_cpu, evaluate_cpu; /* s of all threads together */
    size_t memory;                    /* bytes, at most held at a time, beyond the geometry; 0: not known */
    bool front;                       /* no other run has less error and takes less time (see sp_study_front) */
    bool front_misjudged;             /* the same of misjudged area */
} sp_study_speed;

/* One combination of settings. */
typedef struct {
    sp_fidelity fidelity; /* as it was run: nothing left to auto */
    bool chosen;          /* the scene's own settings, auto having chosen what they leave open */
    size_t texels;        /* patches */
    double coverage;      /* fraction */
    double error;         /* mean difference to the reference, points of coverage as a fraction */
    double spread;        /* twice its standard error */
    double misjudged;     /* mean size of the difference */
    sp_study_speed speed;
} sp_study_run;

/* How fast a series of runs, all settings but one the same, comes nearer: loss ~ texel^order, or jets^-order. */
typedef struct {
    sp_fidelity fidelity; /* the series'; the setting that varies is 0 */
    size_t count;         /* runs in the series */
    double error;         /* order of the mean difference's size; NAN where fewer than three are larger than their
                           * spread */
    double misjudged;     /* order of the misjudged area */
} sp_study_order;

/* One placement. Its certificate is not part of it. */
typedef struct {
    sp_fidelity fidelity; /* the evaluator's */
    bool refine;          /* false: candidates alone */
    int shift;            /* -1, 0, 1: its texel is 3 % finer than its group's, the group's, 3 % coarser */
    double limit;         /* s of wall time that it was given */
    bool limited;         /* the limit is what its group is about, and what it found depends on the machine */
    bool ended_early;     /* the limit cut it short: what it found depends on the machine */
    bool reached;         /* it covers what was asked for, by its own count */
    size_t nozzles;
    double water;            /* m³/s */
    double outlay;           /* m³/s, as that of sp_proposal: the price that is minimised */
    bool costly;             /* some mount costs something; else outlay is water */
    double coverage;         /* by its own evaluator, fraction */
    double confirmed;        /* covered share of the points, each judged for itself at the first impact */
    double confirmed_spread; /* twice its standard error */
    double seconds, cpu;     /* until the layout was there, as in sp_study_speed; preparing left out */
    size_t memory;
} sp_study_place;

/* Owned by the caller. */
typedef struct {
    sp_fidelity reference;      /* texel and jets 0: points judged in closed form; else a run to compare with */
    double reference_coverage;  /* fraction */
    double reference_spread;    /* twice the standard error from the points being a sample */
    double reference_check;     /* of a run as reference: its error with reflections left out, measured against points
                                 * judged in closed form; else NAN */
    double reference_film_cell; /* m: on cells so long film is routed for the points; 0 where none is asked for */
    bool passing;               /* goods move: what a point takes is its mean over the pass */
    size_t points;              /* as many were compared */
    double area;                /* m², clean and wet */
    size_t run_count;           /* 0: the scene has no nozzles */
    sp_study_run *runs;         /* in the order of the grid; the scene's own settings last */
    size_t order_count;
    sp_study_order *orders;
    size_t place_count;
    sp_study_place *places; /* groups of three */
    bool interrupted;       /* cancelled or out of time: what there is so far */
} sp_study;

typedef struct {
    sp_run run; /* its time limit is for all: what does not begin before is left out */
    /* Starts counting bytes held, and says how many were held at most since then; both NULL: memory stays unknown. */
    void (*meter_start)(void);
    size_t (*meter_peak)(void);
} sp_study_options;

/* Runs the grid: trajectory (line, parabola), evaluator, texel (4, 2, 1 and ½ times the edge at which all that counts
 * has 100,000 texels, of goods that move 10,000, rounded to one digit; forward not the finest), jets and, where
 * something reflects, reflections. What the setup sets is not varied: a texel that is set is the only one. Drag alone,
 * which auto never takes, stands beside lines and parabolas where the setup sets it, and jets are a tenth as many. Each
 * is compared at 100 / accuracy² points (a million at 1 %; of goods that move a sixteenth) with what holds at the point
 * (sp_reference), by the dearest physics that the setup leaves open, or where walls throw liquid back by ten million
 * jets a nozzle and up to eight reflections on the middle texel.
 *
 * With `place` it then runs placements: by texel (4, 2, 1 times), by line, without refinement and with little time,
 * each three times on texels 3 % apart, which parts the luck of the search from what the settings do. They share what
 * is left of the time limit, or seven minutes.
 *
 * `layout` may have no nozzles where there is `place`. NULL with an error; cancelled before the first run has ended,
 * with SP_ERROR_INTERRUPTED. The same for every number of threads but for sp_study_speed, seconds, memory and what a
 * limit cut. */
SP_API sp_study *sp_study_create(const sp_setup *setup, const sp_layout *layout, const sp_place_options *place,
                                 const sp_study_options *options, sp_error *error);
/* Accepts NULL. */
SP_API void sp_study_destroy(sp_study *study);

/* The least-squares slope of log y over log x, of those points that have both above 0; NAN of fewer than three, or of
 * one x. */
SP_API double sp_study_slope(const double *x, const double *y, size_t count);
/* Pareto's front: on[i] is true where nothing costs no more and loses no more than i, and one of the two less. What is
 * NAN is not on it. */
SP_API void sp_study_front(const double *cost, const double *loss, size_t count, bool *on);

/* study.json: everything; what varies between runs stands in objects named "speed", and in "place_limited". Each text
 * is malloc'd, the caller frees. `scene` is the path as given. */
SP_API char *sp_study_json(const sp_study *study, const char *scene, sp_error *error);
/* study.csv: one row a run; place.csv: one row a placement. The columns that vary between runs are the last, from
 * prepare_s and from seconds on. */
SP_API char *sp_study_csv(const sp_study *study, sp_error *error);
SP_API char *sp_study_place_csv(const sp_study *study, sp_error *error);
/* The tables for a terminal. */
SP_API char *sp_study_text(const sp_study *study, sp_error *error);
/* A self-contained page with plots. */
SP_API char *sp_study_html(const sp_study *study, const char *scene, sp_error *error);

#ifdef __cplusplus
}
#endif
#endif
