/* How the time limit of a placement is shared out. */
#ifndef OPTIMIZER_TIME_SHARES_H
#define OPTIMIZER_TIME_SHARES_H

#include <sprayplan/place.h>

/* Of the time for the search, for the refining of a proposal before others are looked for, where time is short. */
#define SP_FIRST_SHARE 0.5

/* Of the limit, by when the search has to end, so that the rest is left for what follows. */
double sp_search_share(const sp_place_options *options);
/* The same with what steps allow of all that was found. */
double sp_setting_share(const sp_place_options *options);
/* The same with counting as the scene says what few jets have found. */
double sp_counting_share(const sp_place_options *options);

#endif
