/* What callers give, held against the ends that the public headers name; and errors for what lies beyond. */
#ifndef SPRAYPLAN_VALID_RANGE_H
#define SPRAYPLAN_VALID_RANGE_H

#include <sprayplan/run.h>
#include <sprayplan/vector.h>

#include <float.h>
#include <stddef.h>

#define SP_FINITE DBL_MAX
/* rad; 360 degrees may come out a rounding above 2π */
#define SP_HALF_TURN (M_PI * (1 + 1e-12))
#define SP_FULL_TURN (2 * SP_HALF_TURN)

/* A value and what is allowed of it, in SI. High SP_FINITE: as much as is a number; INFINITY: that, too. */
typedef struct {
    const char *name, *unit; /* "pressure", "Pa"; "" where it has none */
    double value, low, high;
    bool above, below; /* the ends themselves are not allowed: low, high */
} sp_limit;
static inline sp_limit sp_from_to(const char *name, const char *unit, double value, double low, double high)
{
    return (sp_limit){name, unit, value, low, high, false, false};
}
static inline sp_limit sp_above_to(const char *name, const char *unit, double value, double low, double high)
{
    return (sp_limit){name, unit, value, low, high, true, false};
}
static inline sp_limit sp_from_below(const char *name, const char *unit, double value, double low, double high)
{
    return (sp_limit){name, unit, value, low, high, false, true};
}

/* Whose value it is: "nozzle" and its name, or "" for what is there once. */
typedef struct {
    const char *kind, *name;
} sp_owner;

/* False, with SP_ERROR_ARGUMENT, where one of them lies beyond its ends, or is not a number. */
bool sp_are_within(sp_owner owner, const sp_limit *limits, size_t count, sp_error *error);
/* The same of a place whose coordinates are not finite; of a direction that has no length. */
bool sp_is_place(sp_owner owner, const char *name, sp_vec3 place, sp_error *error);
bool sp_is_direction(sp_owner owner, const char *name, sp_vec3 direction, sp_error *error);
/* The same where there is no list of the things that are counted. */
bool sp_is_listed(sp_owner owner, const char *name, const void *list, size_t count, sp_error *error);
/* The same of a word of an enumeration whose last one this is. */
bool sp_is_word(sp_owner owner, const char *name, unsigned word, unsigned last, sp_error *error);
/* The same of threads and time. */
bool sp_are_threads(int threads, sp_error *error);
bool sp_run_is_valid(const sp_run *run, sp_error *error);

#endif
