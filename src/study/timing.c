/* Seconds of wall time and of processor time. */
#include "clock.h"
#include "state.h"

#include <stdlib.h>

#define ENOUGH 0.33 /* s after which there is no further round */

sp_clock_reading sp_moment_now(void)
{
    return (sp_clock_reading){sp_now(), sp_clock(CLOCK_PROCESS_CPUTIME_ID)};
}

sp_clock_reading sp_moment_since(sp_clock_reading start)
{
    sp_clock_reading now = sp_moment_now();
    return (sp_clock_reading){now.wall - start.wall, now.cpu - start.cpu};
}

bool sp_stopwatch_wants(const sp_stopwatch *watch)
{
    double sum = 0;
    for (size_t i = 0; i < watch->count; i++)
        sum += watch->rounds[i].wall;
    return watch->count < SP_STUDY_ROUNDS && sum < ENOUGH;
}

static int ascending(const void *left, const void *right)
{
    double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

static double median(double *values, size_t count)
{
    qsort(values, count, sizeof *values, ascending);
    return count % 2 ? values[count / 2] : 0.5 * (values[count / 2 - 1] + values[count / 2]);
}

sp_clock_reading sp_stopwatch_median(const sp_stopwatch *watch)
{
    double wall[SP_STUDY_ROUNDS], cpu[SP_STUDY_ROUNDS];
    for (size_t i = 0; i < watch->count; i++) {
        wall[i] = watch->rounds[i].wall;
        cpu[i] = watch->rounds[i].cpu;
    }
    return (sp_clock_reading){median(wall, watch->count), median(cpu, watch->count)};
}
