/* How what follows the search is kept within the time limit. */
#include "cli.h"

#include "../clock.h"

#include <stdarg.h>
#include <stdlib.h>

/* Of what of the limit is beyond a rough layout, s, at most, for pictures, which get smaller then: without a layout
 * that is worth a look they are worth nothing. */
#define PICTURES_MOST 0.25
#define ROUGH 8.0
/* Of what is left of the limit, for all that follows, at most; but what tables and layouts take, s of processor. */
#define ENDING_MOST 0.25
#define TABLES 0.25
/* Of the limit, for the rest on a machine that has nothing else to do; no more than so many seconds. */
#define OTHERS 0.1
#define OTHERS_MOST 1.0
/* Of the edge of pictures, which take a seventh of the time then. Where they and the files that show patches would end
 * so many seconds beyond the limit, there are none. */
#define SMALLEST 0.33
#define LATE_MOST 1.0

/* What pictures take, s, and what this thread took to find that out, by the clock, for each second of processor: how
 * much other work the machine has. */
static bool try_pictures(const sp_design *design, size_t count, double *pictures, double *busy, sp_error *error)
{
    sp_design *designs = malloc(count * sizeof *designs);
    if (!designs)
        return sp_fail_memory(error);
    for (size_t i = 0; i < count; i++)
        designs[i] = *design;
    sp_result result = {.command = "place", .scene = "", .designs = designs, .design_count = count};
    double start = sp_now(), worked = sp_clock(CLOCK_THREAD_CPUTIME_ID);
    bool known = sp_report_picture_time(&result, pictures, error);
    worked = sp_clock(CLOCK_THREAD_CPUTIME_ID) - worked;
    *busy = worked > 0 ? fmax(1, (sp_now() - start) / worked) : 1;
    free(designs);
    return known;
}

bool cli_picture_time(const cli_options *options, const sp_design *design, size_t count, double *seconds,
                      sp_error *error)
{
    double limit = options->time_limit, pictures = 0, busy = 1;
    *seconds = 0;
    if (!(limit > 0))
        return true;
    if (options->output && !try_pictures(design, count, &pictures, &busy, error))
        return false;
    double others = busy * fmin(OTHERS_MOST, OTHERS * limit);
    double most = fmax(ENDING_MOST * cli_time_left(), busy * TABLES);
    *seconds = fmin(most, others + fmin(PICTURES_MOST * fmax(0, limit - ROUGH), (1 + CLI_FILES) * pictures));
    return true;
}

void cli_leave_out(cli_left_out *left_out, const char *format, ...)
{
    if (left_out->count == CLI_LEFT_OUT)
        return;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(left_out->texts[left_out->count], CLI_LEFT_OUT_TEXT, format, arguments);
    va_end(arguments);
    left_out->list[left_out->count] = left_out->texts[left_out->count];
    left_out->count++;
}

double cli_picture_share(double full, cli_left_out *left_out)
{
    double left = cli_time_left(), spare = left - CLI_FILES * full;
    if (left > 0 && spare >= full)
        return 0;
    if (left <= 0 || left + LATE_MOST < (SMALLEST * SMALLEST + CLI_FILES) * full) {
        cli_leave_out(left_out, "the page's pictures and viewer");
        cli_leave_out(left_out, "coverage.png, deposits.exr, model.glb, surface.vtp, texels.vtp");
        return -1;
    }
    double share = fmax(SMALLEST, sqrt(fmax(0, spare) / full));
    cli_leave_out(left_out, "the size of pictures (to %.0f %%)", 100 * share);
    return share;
}
