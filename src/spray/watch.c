#include "watch.h"

#include "clock.h"

#define PERIOD 0.02 /* s, between two questions */

static void ask(sp_watch *watch)
{
    size_t done;
#pragma omp atomic read
    done = watch->done;
    if (sp_evaluator_stage(watch->evaluator, watch->stage, fmin((double)done / (double)watch->all, 1), NULL))
        return;
#pragma omp atomic write
    watch->stopped = true;
}

sp_watch sp_watch_start(const sp_evaluator *evaluator, const char *stage, size_t all)
{
    sp_watch watch = {.evaluator = evaluator,
                      .stage = stage,
                      .all = all ? all : 1,
                      .asks = evaluator->setup.run.progress && !omp_in_parallel()};
    if (watch.asks)
        ask(&watch);
    watch.asked = watch.asks ? sp_now() : 0;
    return watch;
}

bool sp_watch_goes_on(sp_watch *watch, size_t more)
{
    bool stopped;
    if (!watch->asks)
        return true;
#pragma omp atomic
    watch->done += more;
#pragma omp atomic read
    stopped = watch->stopped;
    if (stopped)
        return false;
    if (omp_get_thread_num() == 0 && sp_now() - watch->asked > PERIOD) {
        ask(watch);
        watch->asked = sp_now();
    }
    return true;
}

bool sp_watch_end(sp_watch *watch, sp_error *error)
{
    if (!watch->asks)
        return true;
    if (!watch->stopped) {
        watch->done = watch->all;
        ask(watch);
    }
    return !watch->stopped || sp_watch_fail(watch, error);
}

void *sp_watch_fail(const sp_watch *watch, sp_error *error)
{
    if (!watch || !watch->stopped)
        return sp_fail_memory(error);
    sp_fail(error, SP_ERROR_INTERRUPTED, NULL, 0, 0, "interrupted");
    return NULL;
}
