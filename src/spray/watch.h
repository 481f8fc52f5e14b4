/* How far work has come that threads do side by side, and whether it is to stop. */
#ifndef SPRAY_WATCH_H
#define SPRAY_WATCH_H

#include "spray/state/state.h"

/* Pieces (patches, points) between two questions whether to go on: some microseconds of the cheapest. */
#define SP_WATCHED 64

typedef struct {
    const sp_evaluator *evaluator;
    const char *stage;
    size_t all, done; /* pieces */
    double asked;     /* s, when the caller was asked last */
    bool asks;        /* else nobody is asked, and nothing stops */
    bool stopped;
} sp_watch;

/* Asks the caller once. Within a parallel region nobody is asked: callbacks are called from one thread at a time, and
 * another of the region's threads may be in one. Then sp_watch_goes_on is true. */
sp_watch sp_watch_start(const sp_evaluator *evaluator, const char *stage, size_t all);
/* By any thread of a team, which has done so many more pieces: false where it had better leave the rest, as the
 * caller's wish. The team's first thread asks the caller, a few times in a tenth of a second. */
bool sp_watch_goes_on(sp_watch *watch, size_t more);
/* When all threads are done: asks the caller once more. False, with the error, where the work was stopped. */
bool sp_watch_end(sp_watch *watch, sp_error *error);
/* NULL, with the error of work that was given up: that it was stopped, or else memory. `watch` may be NULL. */
void *sp_watch_fail(const sp_watch *watch, sp_error *error);

#endif
