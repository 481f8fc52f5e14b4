/* The ways in which nozzles' liquid leaves them, with drag each with its wavefronts: found once, for any number of
 * flights.
 */
#ifndef SPRAYPLAN_LAUNCH_H
#define SPRAYPLAN_LAUNCH_H

#include <sprayplan/evaluator.h>
#include <sprayplan/export.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct sp_launch_table sp_launch_table;

/* An empty table, for flights of an evaluator (borrowed) to ends no farther off than `far` (m). NULL on error. */
SP_API sp_launch_table *sp_launch_table_create(const sp_evaluator *evaluator, double far, sp_error *error);
/* Accepts NULL. */
SP_API void sp_launch_table_destroy(sp_launch_table *table);
/* Adds what leaves all patterns of a nozzle, where it is not in the table yet: a launch that leaves as fast, and with
 * drag as drops held back as much and broken up as soon, is the same. Not from several threads. */
SP_API bool sp_launch_table_add(sp_launch_table *table, const sp_nozzle *nozzle, sp_error *error);
/* Of a nozzle of one pattern. Without drag its speed is all there is to know; with drag false, with an error, where it
 * was not added. Safe to call from many threads. */
SP_API bool sp_launch_table_find(const sp_launch_table *table, const sp_nozzle *pattern, sp_launch *launch,
                                 sp_error *error);

#ifdef __cplusplus
}
#endif
#endif
