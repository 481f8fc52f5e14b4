#include "watch.h"

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
    return (sp_watch){.run = *run, .start = start, .stage_start = start};
}

double sp_watch_elapsed(const sp_watch *watch)
{
    return now() - watch->start;
}

bool sp_watch_goes_on(sp_watch *watch, const char *stage, double done)
{
    bool goes_on;
#pragma omp critical(sp_watch)
    {
        if (!watch->cancelled && watch->run.progress && !watch->run.progress(watch->run.user, stage, done))
            watch->cancelled = watch->interrupted = true;
        bool over = watch->run.time_limit > 0 && sp_watch_elapsed(watch) > watch->run.time_limit;
        if (over)
            watch->interrupted = true;
        goes_on = !watch->cancelled && !over;
    }
    return goes_on;
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
    if (watch->stage_count == watch->stage_capacity) {
        size_t capacity = watch->stage_capacity ? 2 * watch->stage_capacity : 8;
        sp_stage *stages = realloc(watch->stages, capacity * sizeof *stages);
        if (!stages)
            return sp_fail_memory(error);
        watch->stages = stages;
        watch->stage_capacity = capacity;
    }
    sp_stage *stage = &watch->stages[watch->stage_count++];
    snprintf(stage->name, sizeof stage->name, "%s", name);
    stage->seconds = seconds;
    return true;
}

int sp_threads(const sp_run *run)
{
    return run->threads > 0 ? run->threads : omp_get_max_threads();
}
