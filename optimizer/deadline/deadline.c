#include "deadline/deadline.h"

#include "clock.h"
#include "mesh/grow.h"
#include "ranks/messages.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LEISURE 160.0 /* s of time limit, added up over the threads of all ranks: with less a placement hurries */
#define PLENTY 90.0   /* times what goes before the first layout: more than the search takes at leisure */

sp_deadline sp_deadline_start(const sp_run *run)
{
    double start = sp_now(), processor = sp_clock(CLOCK_PROCESS_CPUTIME_ID);
    return (sp_deadline){.run = *run,
                         .start = start,
                         .processor = processor,
                         .share = 1,
                         .level = omp_get_level(),
                         .stage_start = start,
                         .stage_processor = processor};
}

/* Whether this rank decides alone, and where not whether it can ask the others. */
static bool is_alone(const sp_deadline *deadline)
{
    return sp_ranks_count(deadline->run.ranks) == 1 || sp_ranks_apart(deadline->run.ranks);
}
static bool can_ask(const sp_deadline *deadline)
{
    return !is_alone(deadline) && omp_get_level() == deadline->level;
}

/* What all ranks know: who was asked to stop, who has left something out, and how late it is. Where they do not answer,
 * or one has failed, it is time to stop, too. */
static double agree(sp_deadline *deadline)
{
    double elapsed = sp_now() - deadline->start;
    double known[] = {deadline->asked || deadline->cancelled, deadline->interrupted, elapsed};
    if (!sp_ranks_highest(deadline->run.ranks, "deadline", known, 3, NULL) || sp_ranks_lost(deadline->run.ranks))
        known[0] = 1;
    deadline->cancelled = known[0] > 0;
    deadline->interrupted = deadline->cancelled || known[1] > 0;
    return known[2];
}

double sp_deadline_elapsed(sp_deadline *deadline)
{
    return can_ask(deadline) ? agree(deadline) : sp_now() - deadline->start;
}

void sp_deadline_allow(sp_deadline *deadline, double share)
{
    deadline->share = share;
    deadline->lent = false;
}

void sp_deadline_lend(sp_deadline *deadline, double share)
{
    double limit = deadline->run.time_limit, left = sp_deadline_left(deadline);
    if (!(limit > 0))
        return;
    deadline->share -= (1 - share) * fmax(0, left) / limit;
    deadline->lent = true;
}

double sp_deadline_left(sp_deadline *deadline)
{
    double limit = deadline->run.time_limit;
    return limit > 0 ? deadline->share * limit - sp_deadline_elapsed(deadline) : INFINITY;
}

double sp_deadline_pace(const sp_deadline *deadline)
{
    double taken = sp_now() - deadline->start, worked = sp_clock(CLOCK_PROCESS_CPUTIME_ID) - deadline->processor;
    return is_alone(deadline) && taken > 0 ? worked / taken : 1;
}

static void ask_callback(sp_deadline *deadline, const char *stage, double done)
{
    if (!deadline->cancelled && !deadline->asked && deadline->run.progress)
        deadline->asked = !deadline->run.progress(deadline->run.user, stage, done);
}

bool sp_deadline_was_cut(const sp_deadline *deadline, const char *stage)
{
    size_t at = 0;
    while (at < deadline->cut_count && strcmp(deadline->cut[at], stage))
        at++;
    return at < deadline->cut_count;
}

static void note_cut(sp_deadline *deadline, const char *stage)
{
    if (!sp_deadline_was_cut(deadline, stage) && deadline->cut_count < SP_STAGES_CUT)
        snprintf(deadline->cut[deadline->cut_count++], SP_STAGE_NAME, "%s", stage);
}

void sp_deadline_cut(sp_deadline *deadline, const char *stage)
{
#pragma omp critical(sp_deadline)
    note_cut(deadline, stage);
}

/* `loses`: being out of time leaves something of the stage out. */
static bool decide(sp_deadline *deadline, const char *stage, double elapsed, bool loses)
{
    double limit = deadline->run.time_limit;
    deadline->over = limit > 0 && elapsed > deadline->share * limit;
    bool on = !deadline->cancelled && !deadline->over;
    if (!on && loses && (deadline->cancelled || !deadline->lent)) {
        deadline->interrupted = true;
        note_cut(deadline, stage);
    }
    return on;
}

static bool goes_on(sp_deadline *deadline, const char *stage, double done, bool loses)
{
    bool on;
    if (can_ask(deadline)) {
        ask_callback(deadline, stage, done);
        return decide(deadline, stage, agree(deadline), loses);
    }
#pragma omp critical(sp_deadline)
    {
        ask_callback(deadline, stage, done);
        if (is_alone(deadline)) {
            if (deadline->asked || sp_ranks_lost(deadline->run.ranks))
                deadline->cancelled = deadline->interrupted = true;
            on = decide(deadline, stage, sp_now() - deadline->start, loses);
        } else {
            on = !deadline->cancelled && !deadline->over;
        }
    }
    return on;
}

bool sp_deadline_goes_on(sp_deadline *deadline, const char *stage, double done)
{
    return goes_on(deadline, stage, done, true);
}

bool sp_deadline_has_time(sp_deadline *deadline, const char *stage, double done)
{
    return goes_on(deadline, stage, done, false);
}

bool sp_deadline_stage(sp_deadline *deadline, const char *name, sp_error *error)
{
    double end = sp_now(), processor = sp_clock(CLOCK_PROCESS_CPUTIME_ID);
    sp_stage own = {.seconds = end - deadline->stage_start, .processor_seconds = processor - deadline->stage_processor};
    deadline->stage_start = end;
    deadline->stage_processor = processor;
    for (size_t i = 0; i < deadline->stage_count; i++)
        if (!strcmp(deadline->stages[i].name, name)) {
            deadline->stages[i].seconds += own.seconds;
            deadline->stages[i].processor_seconds += own.processor_seconds;
            return true;
        }
    if (!sp_grow(&deadline->stages, &deadline->stage_capacity, deadline->stage_count + 1, sizeof *deadline->stages))
        return sp_fail_memory(error);
    snprintf(own.name, sizeof own.name, "%s", name);
    deadline->stages[deadline->stage_count++] = own;
    return true;
}

bool sp_run_hurries(const sp_run *run)
{
    return run->time_limit > 0 && run->time_limit * sp_threads(run) * (double)sp_ranks_count(run->ranks) < LEISURE;
}

bool sp_deadline_presses(sp_deadline *deadline)
{
    double taken = sp_deadline_elapsed(deadline);
    return sp_deadline_left(deadline) < PLENTY * taken;
}

int sp_threads(const sp_run *run)
{
    return run->threads > 0 ? run->threads : omp_get_max_threads();
}
