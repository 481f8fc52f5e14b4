#include "search/exhaustive_best.h"

#include <stdlib.h>

#define THINNED 0.01     /* share of the outlay by which layouts that are measured differ */
#define MEASURED_MOST 96 /* of the front; besides, the best, and the best of each number */

static sp_front_point point_of(const sp_exhaustive_record *record)
{
    return (sp_front_point){.outlay = record->outlay, .area = record->area};
}

/* Numbers of the sorted records that are worth measuring; returns how many. */
static size_t choose(const sp_search *search, const sp_front *front, const sp_exhaustive_record *records, size_t count,
                     size_t *chosen)
{
    size_t found = 0, best = 0, most[SP_EVERY_NOZZLES + 1];
    double top = 0, tie = SP_TIE * search->all;
    for (size_t n = 0; n <= SP_EVERY_NOZZLES; n++)
        most[n] = SIZE_MAX;
    for (size_t i = 0; i < count; i++) {
        sp_front_point own = point_of(&records[i]), other = point_of(&records[best]);
        size_t *rival = &most[records[i].count];
        if (sp_front_better(front, &own, &other))
            best = i;
        if (*rival == SIZE_MAX || records[i].area > records[*rival].area + tie)
            *rival = i;
        if (!(records[i].area > top + tie))
            continue;
        top = records[i].area;
        if (found && records[i].outlay <= records[chosen[found - 1]].outlay * (1 + THINNED))
            chosen[found - 1] = i;
        else if (found < MEASURED_MOST)
            chosen[found++] = i;
    }
    for (size_t n = 0; n <= SP_EVERY_NOZZLES; n++)
        if (most[n] != SIZE_MAX)
            chosen[found++] = most[n];
    if (count)
        chosen[found++] = best;
    return found;
}

static bool build(const sp_search *search, const sp_poses_alone *poses, const sp_exhaustive_record *record,
                  sp_partial *partial, sp_error *error)
{
    bool done = sp_partial_create(search, partial, error);
    for (size_t i = 0; done && i < record->count; i++)
        done = sp_partial_add_pose(search, partial, poses->poses[record->pose[i]], error);
    return done;
}

static bool collect(const sp_search *search, const sp_front *front, const sp_exhaustive *every, sp_partial **partials,
                    size_t *count, sp_error *error)
{
    size_t chosen[MEASURED_MOST + SP_EVERY_NOZZLES + 2];
    size_t found = choose(search, front, every->records, every->count, chosen);
    *partials = calloc(found + 1, sizeof **partials);
    bool done = *partials || sp_fail_memory(error);
    for (size_t i = 0; done && i < found; i++) {
        done = build(search, &every->poses, &every->records[chosen[i]], &(*partials)[i], error);
        *count = i + 1;
    }
    return done;
}

bool sp_exhaustive_best(const sp_search *search, const sp_front *front, double budget, sp_deadline *deadline,
                        sp_partial **partials, size_t *count, bool *whole, sp_error *error)
{
    *partials = NULL;
    *count = 0;
    sp_exhaustive every;
    const sp_evaluator *fine = front->fine, *coarse = search->coarse;
    bool inverse = sp_evaluator_fidelity(fine)->method == SP_METHOD_INVERSE;
    const sp_exhaustive_limits limits = {.outlay = budget, .water = sp_water_most(search)};
    bool done = sp_exhaustive_create(search, fine, limits, deadline, "front", &every, error);
    *whole = every.count && every.whole;
    if (done && !every.count && inverse && coarse != fine) {
        /* too much to keep of so many patches; on fewer it is as near as the search comes */
        sp_exhaustive_free(&every);
        done = sp_exhaustive_create(search, coarse, limits, deadline, "front", &every, error);
    }
    done = done && (!every.count || collect(search, front, &every, partials, count, error));
    sp_exhaustive_free(&every);
    return done;
}
