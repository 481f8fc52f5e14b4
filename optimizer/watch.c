#include "watch.h"

#include "mesh/grow.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define LEISURE 100.0 /* s of time limit, added up over the threads: with less a placement hurries */

static double read_clock(clockid_t clock)
{
    struct timespec time = {0};
    clock_gettime(clock, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static double now(void)
{
    return read_clock(CLOCK_MONOTONIC);
}

sp_watch sp_watch_start(const sp_run *run)
{
    double start = now();
    return (sp_watch){.run = *run,
                      .start = start,
                      .share = 1,
                      .stage_start = start,
                      .stage_processor = read_clock(CLOCK_PROCESS_CPUTIME_ID)};
}

double sp_watch_elapsed(const sp_watch *watch)
{
    return now() - watch->start;
}

void sp_watch_allow(sp_watch *watch, double share)
{
    watch->share = share;
}

double sp_watch_left(const sp_watch *watch)
{
    double limit = watch->run.time_limit;
    return limit > 0 ? watch->share * limit - sp_watch_elapsed(watch) : INFINITY;
}

/* `loses`: being out of time leaves something out. */
static bool goes_on(sp_watch *watch, const char *stage, double done, bool loses)
{
    bool on;
#pragma omp critical(sp_watch)
    {
        if (!watch->cancelled && watch->run.progress && !watch->run.progress(watch->run.user, stage, done))
            watch->cancelled = watch->interrupted = true;
        bool over = sp_watch_left(watch) < 0;
        if (over && loses)
            watch->interrupted = true;
        on = !watch->cancelled && !over;
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
    double end = now(), processor = read_clock(CLOCK_PROCESS_CPUTIME_ID);
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
    return run->time_limit > 0 && run->time_limit * sp_threads(run) < LEISURE;
}

int sp_threads(const sp_run *run)
{
    return run->threads > 0 ? run->threads : omp_get_max_threads();
}
