/* Types and nozzles as rows of numbers, in SI, for the way into a page and back. */
#ifndef LIVE_NUMBERS_H
#define LIVE_NUMBERS_H

#include <sprayplan/nozzle.h>

#define SP_LIVE_TYPE_NUMBERS 22
#define SP_LIVE_MEMBER_NUMBERS 10
#define SP_LIVE_NOZZLE_NUMBERS 13

/* pattern, angle, hollow, thickness, flow, at, exponent, cv, drop, angle_min, angle_max, flow_min, flow_max; of the
 * rotation jet, tilt, roll, jets, gears; of its members the first one's row and how many: a type of a member is
 * a row of the types; then its trajectory. */
void sp_live_write_type(const sp_nozzle_type *type, size_t first_member, double numbers[SP_LIVE_TYPE_NUMBERS]);
/* Row of its type, offset, axis, roll, share, speed. */
void sp_live_write_member(const sp_member *member, size_t type, double numbers[SP_LIVE_MEMBER_NUMBERS]);
/* Row of its type, position, axis, roll, pressure, angle, flow, speed, whether it is on. */
void sp_live_write_nozzle(const sp_nozzle *nozzle, size_t type, double numbers[SP_LIVE_NOZZLE_NUMBERS]);

/* The same back. Numbers that no type can have make none: false. */
bool sp_live_read_type(const double numbers[SP_LIVE_TYPE_NUMBERS], sp_nozzle_type *type, size_t *first_member);
/* Its type stays the caller's to copy from the row that the first number names. */
sp_member sp_live_read_member(const double numbers[SP_LIVE_MEMBER_NUMBERS]);
sp_nozzle sp_live_read_nozzle(const double numbers[SP_LIVE_NOZZLE_NUMBERS]);

#endif
