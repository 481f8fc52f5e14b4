#include "valid_range.h"

#include <math.h>
#include <stdio.h>

enum { EXPECTED = 100, NAMED = 63 };

static void say_expected(const sp_limit *limit, char expected[EXPECTED])
{
    bool endless = limit->high >= SP_FINITE;
    if (endless && limit->low <= -SP_FINITE)
        snprintf(expected, EXPECTED, "a finite number");
    else if (endless)
        snprintf(expected, EXPECTED, limit->above ? "more than %g" : "%g or more", limit->low);
    else if (limit->above)
        snprintf(expected, EXPECTED, "more than %g and at most %g", limit->low, limit->high);
    else
        snprintf(expected, EXPECTED, limit->below ? "%g or more and less than %g" : "%g to %g", limit->low,
                 limit->high);
}

static bool is_within(const sp_limit *limit)
{
    return (limit->above ? limit->value > limit->low : limit->value >= limit->low) &&
           (limit->below ? limit->value < limit->high : limit->value <= limit->high);
}

/* "nozzle N1: ", or nothing. */
static void say_owner(sp_owner owner, char text[EXPECTED])
{
    const char *gap = owner.name[0] && owner.kind[0] ? " " : "";
    bool any = owner.name[0] || owner.kind[0];
    snprintf(text, EXPECTED, "%s%s%.*s%s", owner.kind, gap, NAMED, owner.name, any ? ": " : "");
}

bool sp_are_within(sp_owner owner, const sp_limit *limits, size_t count, sp_error *error)
{
    for (size_t i = 0; i < count; i++)
        if (!is_within(&limits[i])) {
            char whose[EXPECTED], expected[EXPECTED];
            say_owner(owner, whose);
            say_expected(&limits[i], expected);
            return sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "%s%s: %g%s%s found, expected %s", whose,
                           limits[i].name, limits[i].value, limits[i].unit[0] ? " " : "", limits[i].unit, expected);
        }
    return true;
}

static bool fail_vector(sp_owner owner, const char *name, sp_vec3 vector, const char *expected, sp_error *error)
{
    char whose[EXPECTED];
    say_owner(owner, whose);
    return sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "%s%s: (%g, %g, %g) found, expected %s", whose, name, vector.x,
                   vector.y, vector.z, expected);
}

bool sp_is_place(sp_owner owner, const char *name, sp_vec3 place, sp_error *error)
{
    return isfinite(sp_length(place)) || fail_vector(owner, name, place, "finite coordinates", error);
}

bool sp_is_direction(sp_owner owner, const char *name, sp_vec3 direction, sp_error *error)
{
    double length = sp_length(direction);
    return (length > 0 && isfinite(length)) || fail_vector(owner, name, direction, "one of length 1", error);
}

bool sp_is_listed(sp_owner owner, const char *name, const void *list, size_t count, sp_error *error)
{
    char whose[EXPECTED];
    say_owner(owner, whose);
    return list || !count ||
           sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "%s%s: no list found, expected one of %zu", whose, name,
                   count);
}

bool sp_is_word(sp_owner owner, const char *name, unsigned word, unsigned last, sp_error *error)
{
    char whose[EXPECTED];
    say_owner(owner, whose);
    return word <= last || sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0,
                                   "%s%s: %u found, expected one of its enumeration", whose, name, word);
}

bool sp_are_threads(int threads, sp_error *error)
{
    return (threads >= 0 && threads <= SP_THREADS) ||
           sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "threads: %d found, expected 1 to %d, or 0 for one per core",
                   threads, SP_THREADS);
}

bool sp_run_is_valid(const sp_run *run, sp_error *error)
{
    const sp_limit limit = sp_from_to("time limit", "s", run->time_limit, 0, INFINITY);
    return sp_are_threads(run->threads, error) && sp_are_within((sp_owner){"", ""}, &limit, 1, error);
}
