#include "watch.h"

#include "mesh/grow.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

sp_watch sp_watch_start(const sp_run *run)
{
    double start = now();
    return (sp_watch){.run = *run, .start = start, .share = 1, .stage_start = start};
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
    double end = now(), seconds = end - watch->stage_start;
    watch->stage_start = end;
    for (size_t i = 0; i < watch->stage_count; i++)
        if (!strcmp(watch->stages[i].name, name)) {
            watch->stages[i].seconds += seconds;
            return true;
        }
    if (!sp_grow(&watch->stages, &watch->stage_capacity, watch->stage_count + 1, sizeof *watch->stages))
        return sp_fail_memory(error);
    sp_stage *stage = &watch->stages[watch->stage_count++];
    snprintf(stage->name, sizeof stage->name, "%s", name);
    stage->seconds = seconds;
    return true;
}

int sp_threads(const sp_run *run)
{
    return run->threads > 0 ? run->threads : omp_get_max_threads();
}
