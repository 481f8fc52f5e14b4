/* A study under way. */
#ifndef STUDY_STATE_H
#define STUDY_STATE_H

#include <sprayplan/evaluator.h>
#include <sprayplan/points.h>
#include <sprayplan/study.h>

/* timing.c */
typedef struct {
    double wall, cpu; /* s */
} sp_clock_reading;
sp_clock_reading sp_moment_now(void);
sp_clock_reading sp_moment_since(sp_clock_reading start);
enum { SP_STUDY_ROUNDS = 5 };
typedef struct {
    sp_clock_reading rounds[SP_STUDY_ROUNDS];
    size_t count;
} sp_stopwatch;
/* True while another round is wanted. */
bool sp_stopwatch_wants(const sp_stopwatch *watch);
sp_clock_reading sp_stopwatch_median(const sp_stopwatch *watch);

/* What all parts of a study see. */
typedef struct {
    const sp_setup *setup;   /* the scene's */
    const sp_layout *layout; /* the scene's own nozzles */
    const sp_evaluator *own; /* on the setup's own settings */
    const sp_study_options *options;
    sp_clock_reading start;
    const char *stage;      /* what the user is shown */
    double done, step;      /* of the stage: so far, and what is under way */
    sp_clock_reading since; /* when that began */
    double expected;        /* s that it will take at most; 0: not known */
    bool cancelled;         /* the user said so, or the time is over */
    bool placing;           /* a placement is under way */
    bool laid, cut;         /* its layout is there; it had no more time */
    double limit;           /* s that it has */
    sp_clock_reading began, taken;
    size_t points;
    double *truth;  /* [points]: 0 to 1, what is covered */
    double *values; /* [points], for what is being looked at */
} sp_studying;

/* study.c */
/* The setup with another fidelity, and with progress that ends up with the study's user. */
sp_setup sp_study_setup(sp_studying *studying, const sp_fidelity *fidelity);
/* How a placement is run on its evaluator. */
sp_run sp_study_place_run(sp_studying *studying);
/* Part `index` of `count` of a stage begins; false, with an error, where the study is to end. */
bool sp_study_next(sp_studying *studying, const char *stage, size_t index, size_t count, double expected,
                   sp_error *error);
/* s until the study's time is over; INFINITY without a limit. */
double sp_study_left(const sp_studying *studying);
/* A placement begins that has `limit` s, and has ended: what it took until its layout was there. The certificate is not
 * waited for. */
void sp_study_placing(sp_studying *studying, double limit);
sp_clock_reading sp_study_placed(sp_studying *studying, bool *ended_early);

/* sample.c: values at points in the order of the surface, [studying->points], the caller's. */
/* The covered share of the patch that holds each point, less what is true of it (`truth` NULL: 0). */
bool sp_sample_difference(const sp_studying *studying, const sp_evaluator *evaluator, const sp_coverage *coverage,
                          const double *truth, double *values, sp_error *error);
/* 1 where the reference, of a layout on studying->own, is that it is covered, else 0. */
bool sp_sample_covered(const sp_studying *studying, const sp_reference *reference, double *values, sp_error *error);
typedef struct {
    double mean, spread; /* spread: twice the standard error of the mean, from pairs of neighbours (see points.h) */
    double size;         /* mean of the values' sizes */
} sp_point_mean;
/* `count` is even. */
sp_point_mean sp_sample_of(const double *values, size_t count);

/* grid.c */
/* True where walls throw liquid back that the setup leaves to be followed. */
bool sp_study_reflects(const sp_setup *setup);
/* How the liquid flies in truth. */
sp_trajectory sp_study_reference_trajectory(const sp_setup *setup);
/* The edge in the middle of the texels, for this much area (m²): what the setup sets, or rounded to one digit. */
double sp_study_texel(const sp_setup *setup, double area);
/* The most jets of each of so many nozzles. */
uint64_t sp_study_most_jets(const sp_setup *setup, size_t nozzles);
/* The trajectories that are run, of less physics first; how many. */
enum { SP_STUDY_TRAJECTORIES = 3 };
size_t sp_study_trajectories(const sp_setup *setup, sp_trajectory trajectories[SP_STUDY_TRAJECTORIES]);
/* Every combination: [*count], malloc'd. */
sp_fidelity *sp_study_grid(const sp_setup *setup, size_t nozzles, double texel, size_t *count, sp_error *error);

/* measure.c */
/* What is compared with, into studying->truth and the study. */
bool sp_study_refer(sp_studying *studying, double texel, sp_study *study, sp_error *error);
/* One run of the grid. */
bool sp_study_measure(sp_studying *studying, const sp_fidelity *fidelity, const sp_layout *layout, sp_study_run *run,
                      sp_error *error);

/* orders.c: from the runs, into study->orders. */
bool sp_study_find_orders(sp_study *study, sp_error *error);

/* places.c: into study->places. */
bool sp_study_run_places(sp_studying *studying, const sp_place_options *place, double texel, sp_study *study,
                         sp_error *error);

#endif
