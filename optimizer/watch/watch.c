#include "watch/watch.h"

#include "clock.h"
#include "mesh/grow.h"
#include "ranks/gather.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LEISURE 100.0 /* s of time limit, added up over the threads of all ranks: with less a placement hurries */

sp_watch sp_watch_start(const sp_run *run)
{
    double start = sp_now(), processor = sp_clock(CLOCK_PROCESS_CPUTIME_ID);
    return (sp_watch){.run = *run,
                      .start = start,
                      .processor = processor,
                      .share = 1,
                      .level = omp_get_level(),
                      .stage_start = start,
                      .stage_processor = processor};
}

/* Whether this rank decides alone, and where not whether it can ask the others. */
static bool is_alone(const sp_watch *watch)
{
    return sp_ranks_count(watch->run.ranks) == 1 || sp_ranks_apart(watch->run.ranks);
}
static bool can_ask(const sp_watch *watch)
{
    return !is_alone(watch) && omp_get_level() == watch->level;
}

/* What all ranks know: who was asked to stop, who has left something out, and how late it is. Where they do not answer,
 * or one has failed, it is time to stop, too. */
static double agree(sp_watch *watch)
{
    double elapsed = sp_now() - watch->start;
    double known[] = {watch->asked || watch->cancelled, watch->interrupted, elapsed};
    if (!sp_ranks_highest(watch->run.ranks, "watch", known, 3, NULL) || sp_ranks_lost(watch->run.ranks))
        known[0] = 1;
    watch->cancelled = known[0] > 0;
    watch->interrupted = watch->cancelled || known[1] > 0;
    return known[2];
}

double sp_watch_elapsed(sp_watch *watch)
{
    return can_ask(watch) ? agree(watch) : sp_now() - watch->start;
}

void sp_watch_allow(sp_watch *watch, double share)
{
    watch->share = share;
}

double sp_watch_left(sp_watch *watch)
{
    double limit = watch->run.time_limit;
    return limit > 0 ? watch->share * limit - sp_watch_elapsed(watch) : INFINITY;
}

double sp_watch_pace(const sp_watch *watch)
{
    double taken = sp_now() - watch->start, worked = sp_clock(CLOCK_PROCESS_CPUTIME_ID) - watch->processor;
    return is_alone(watch) && taken > 0 ? worked / taken : 1;
}

static void ask_callback(sp_watch *watch, const char *stage, double done)
{
    if (!watch->cancelled && !watch->asked && watch->run.progress)
        watch->asked = !watch->run.progress(watch->run.user, stage, done);
}

static void note_cut(sp_watch *watch, const char *stage)
{
    size_t at = 0;
    while (at < watch->cut_count && strcmp(watch->cut[at], stage))
        at++;
    if (at == watch->cut_count && at < SP_STAGES_CUT)
        snprintf(watch->cut[watch->cut_count++], SP_STAGE_NAME, "%s", stage);
}

void sp_watch_cut(sp_watch *watch, const char *stage)
{
#pragma omp critical(sp_watch)
    note_cut(watch, stage);
}

/* `loses`: being out of time leaves something of the stage out. */
static bool decide(sp_watch *watch, const char *stage, double elapsed, bool loses)
{
    double limit = watch->run.time_limit;
    watch->over = limit > 0 && elapsed > watch->share * limit;
    bool on = !watch->cancelled && !watch->over;
    if (!on && loses) {
        watch->interrupted = true;
        note_cut(watch, stage);
    }
    return on;
}

static bool goes_on(sp_watch *watch, const char *stage, double done, bool loses)
{
    bool on;
    if (can_ask(watch)) {
        ask_callback(watch, stage, done);
        return decide(watch, stage, agree(watch), loses);
    }
#pragma omp critical(sp_watch)
    {
        ask_callback(watch, stage, done);
        if (is_alone(watch)) {
            if (watch->asked || sp_ranks_lost(watch->run.ranks))
                watch->cancelled = watch->interrupted = true;
            on = decide(watch, stage, sp_now() - watch->start, loses);
        } else {
            on = !watch->cancelled && !watch->over;
        }
    }
    return on;
}

bool sp_watch_goes_on(sp_watch *watch, const char *stage, double done)
{
    return goes_on(watch, stage, done, true);
}

bool sp_watch_has_time(sp_watch *watch, const char *stage, double done)
{
    return goes_on(watch, stage, done, false);
}

bool sp_watch_stage(sp_watch *watch, const char *name, sp_error *error)
{
    double end = sp_now(), processor = sp_clock(CLOCK_PROCESS_CPUTIME_ID);
    sp_stage own = {.seconds = end - watch->stage_start, .processor_seconds = processor - watch->stage_processor};
    watch->stage_start = end;
    watch->stage_processor = processor;
    for (size_t i = 0; i < watch->stage_count; i++)
        if (!strcmp(watch->stages[i].name, name)) {
            watch->stages[i].seconds += own.seconds;
            watch->stages[i].processor_seconds += own.processor_seconds;
            return true;
        }
    if (!sp_grow(&watch->stages, &watch->stage_capacity, watch->stage_count + 1, sizeof *watch->stages))
        return sp_fail_memory(error);
    snprintf(own.name, sizeof own.name, "%s", name);
    watch->stages[watch->stage_count++] = own;
    return true;
}

bool sp_run_hurries(const sp_run *run)
{
    return run->time_limit > 0 && run->time_limit * sp_threads(run) * (double)sp_ranks_count(run->ranks) < LEISURE;
}

int sp_threads(const sp_run *run)
{
    return run->threads > 0 ? run->threads : omp_get_max_threads();
}
