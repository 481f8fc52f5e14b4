/* How the arrays of meetings, cuts and cells grow: faces are numbered in 31 bits. */
#ifndef SPRAY_GROWTH_H
#define SPRAY_GROWTH_H

#include "mesh/grow.h"

enum { SP_GROWTH_MOST = 1 << 30 };

/* Of several arrays together; {0} at first. */
typedef struct {
    bool failed;  /* memory ran out, or numbers did */
    bool crowded; /* numbers did: an array would have more than SP_GROWTH_MOST */
} sp_growth;

/* Room for one more than `count` in an array (see sp_grow); false where there is none, as from then on. */
static inline bool sp_growth_has_room(sp_growth *growth, void *array, size_t *capacity, size_t count, size_t size)
{
    growth->crowded = growth->crowded || count >= SP_GROWTH_MOST;
    growth->failed = growth->failed || growth->crowded || !sp_grow(array, capacity, count + 1, size);
    return !growth->failed;
}

#endif
