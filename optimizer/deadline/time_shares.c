#include "deadline/time_shares.h"

#include "deadline/deadline.h"

#include <math.h>

/* At most, for all that goes before the certificate; the second with --prove, the third where time is so short that
 * next to nothing would be proved. */
#define SEARCH 0.75
#define SEARCH_PROVING 0.6
#define SEARCH_HURRIED 0.95
/* More, for what follows it. */
#define SETTING 0.05
#define COUNTING 0.15

double sp_search_share(const sp_place_options *options)
{
    return options->prove ? SEARCH_PROVING : sp_run_hurries(&options->run) ? SEARCH_HURRIED : SEARCH;
}

double sp_setting_share(const sp_place_options *options)
{
    return fmin(1, sp_search_share(options) + SETTING);
}

double sp_counting_share(const sp_place_options *options)
{
    return fmin(1, sp_search_share(options) + SETTING + COUNTING);
}
