/* Meetings: where triangles cross, touch or lie on one another, and where caps pass through them. */
#ifndef SPRAY_MEETINGS_H
#define SPRAY_MEETINGS_H

#include "spray/wet/shells.h"

/* The line along which another triangle, or a cap, meets one, from p to q; it may reach beyond the triangle. */
typedef struct {
    uint32_t triangle;
    uint32_t order; /* shuffled */
    sp_vec3 p, q;
} sp_meeting_line;

/* A triangle in whose plane another lies, which covers some of it. */
typedef struct {
    uint32_t triangle, cover;
} sp_covering;

typedef struct {
    sp_meeting_line *items; /* by triangle, then by order */
    size_t count, capacity;
    sp_covering *coverings; /* by triangle, then by cover */
    size_t covering_count, covering_capacity;
    bool *copies; /* [triangles], which lie all over another; these have no meetings with caps */
} sp_meetings;

/* Of the setup's mesh, as far as `contact` (m) tells: what is nearer than this touches. Fills in *meetings, for
 * sp_meetings_free whatever the outcome. Fails where memory runs out, or with SP_ERROR_INPUT on more than
 * SP_GROWTH_MOST. */
bool sp_meetings_find(const sp_setup *setup, const sp_shells *shells, double contact, sp_meetings *meetings,
                      sp_error *error);
void sp_meetings_free(sp_meetings *meetings);

#endif
