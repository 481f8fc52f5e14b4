/* How what follows the search is kept within the time limit. */
#include "cli.h"

#include <stdarg.h>
#include <stdlib.h>

#define LONGEST 0.25  /* of the limit, for all that follows: pictures get smaller then */
#define SMALLEST 0.25 /* of the edge of pictures, before there are none */
#define OTHERS 0.1    /* of the limit, for the rest; no more than so many seconds */
#define OTHERS_MOST 1.0

bool cli_ending_time(const cli_options *options, const sp_design *design, size_t count, double *seconds,
                     sp_error *error)
{
    double limit = options->time_limit, pictures = 0;
    *seconds = 0;
    if (!(limit > 0))
        return true;
    if (options->output) {
        sp_design *designs = malloc(count * sizeof *designs);
        for (size_t i = 0; designs && i < count; i++)
            designs[i] = *design;
        sp_result result = {.command = "place", .scene = "", .designs = designs, .design_count = count};
        bool known = designs ? sp_report_picture_time(&result, &pictures, error) : sp_fail_memory(error) != NULL;
        free(designs);
        if (!known)
            return false;
    }
    *seconds = fmin(OTHERS_MOST, OTHERS * limit) + fmin(LONGEST * limit, (1 + CLI_FILES) * pictures);
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
    double left = cli_time_left() - CLI_FILES * full;
    if (left >= full)
        return 0;
    double share = sqrt(fmax(0, left) / full);
    if (share < SMALLEST) {
        cli_leave_out(left_out, "the page's pictures");
        return -1;
    }
    cli_leave_out(left_out, "the size of pictures (to %.0f %%)", 100 * share);
    return share;
}
