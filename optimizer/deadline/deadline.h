/* Time, progress, cancelling and threads of a placement. */
#ifndef OPTIMIZER_DEADLINE_H
#define OPTIMIZER_DEADLINE_H

#include <sprayplan/run.h>

#include <sprayplan/place.h>

typedef struct {
    sp_run run;
    double start;     /* s, of a monotonic clock */
    double processor; /* s of the process by then */
    double share;     /* of the time limit, if there is one, that may be spent by now */
    bool cancelled;   /* the progress callback said so */
    bool interrupted; /* cancelled, or something was left out for want of time */
    bool asked;       /* the callback said so to this rank, of which the others have not heard yet */
    bool over;        /* the ranks have agreed that the time is over */
    bool lent;        /* the share is lent: what it cuts short is taken up again */
    int level;        /* parallel regions around the caller: in further ones nothing can be agreed */
    size_t cut_count;
    char cut[SP_STAGES_CUT][SP_STAGE_NAME]; /* stages that were not carried out whole */
    size_t stage_count, stage_capacity;
    sp_stage *stages;
    double stage_start, stage_processor; /* s, of the monotonic clock and of the process's processor time */
} sp_deadline;

/* Of several ranks each decision below is one that all agree on, so that all do the same: outside of parallel regions
 * they ask one another, and no rank goes on where one of them would not; inside what was last agreed on holds. Between
 * sp_ranks_part and sp_ranks_rejoin each decides for itself, and the next decision that is agreed on counts that in. */

sp_deadline sp_deadline_start(const sp_run *run);
/* Seconds since the start. */
double sp_deadline_elapsed(sp_deadline *deadline);
/* From now on this share of the time limit may be spent. */
void sp_deadline_allow(sp_deadline *deadline, double share);
/* Until sp_deadline_allow only this share of what is left of that; running out of it leaves nothing out, as what is cut
 * short is taken up again. */
void sp_deadline_lend(sp_deadline *deadline, double share);
/* Seconds until that is spent, negative afterwards; INFINITY without a limit. */
double sp_deadline_left(sp_deadline *deadline);
/* Processor seconds that this process gets in a second by the clock, since the start; 1 where ranks decide together,
 * which may get different ones. */
double sp_deadline_pace(const sp_deadline *deadline);
/* Reports progress; false once cancelled or out of time. Safe to call from many threads. */
bool sp_deadline_goes_on(sp_deadline *deadline, const char *stage, double done);
/* The same for what may end anywhere, so that being out of time leaves nothing out; if it does, that is to be noted. */
bool sp_deadline_has_time(sp_deadline *deadline, const char *stage, double done);
/* Notes that this stage was cut short or left out, once each. */
void sp_deadline_cut(sp_deadline *deadline, const char *stage);
bool sp_deadline_was_cut(const sp_deadline *deadline, const char *stage);
/* Books the time since the last stage's end, or the start, under `name`; stages of equal name add up. */
bool sp_deadline_stage(sp_deadline *deadline, const char *name, sp_error *error);

/* Whether the time limit is too short for all that a placement does at leisure: a matter of the limit and the threads
 * of all ranks alone, so that equal runs choose the same. */
bool sp_run_hurries(const sp_run *run);
/* Whether what is left of a time limit is less than a placement takes at leisure, judged by how long all has taken
 * that goes before its first layout. False without a limit. */
bool sp_deadline_presses(sp_deadline *deadline);
/* The number of threads that a run asks for. */
int sp_threads(const sp_run *run);

#endif
