/* Which triangles may meet. */
#ifndef SPRAY_PAIRS_H
#define SPRAY_PAIRS_H

#include "spray/wet/shells.h"

typedef struct {
    uint32_t a, b; /* triangles, a < b */
    bool copy;     /* they have the same corners, and a stands for b */
} sp_pair;

/* All pairs of triangles whose boxes are nearer than `margin` (m), of different shells or of one that is not simple,
 * but for those that lie side by side at a common edge, and of copies but for the first: they are paired with that
 * alone. Ordered by a, then b. Malloc'd; NULL with an error. */
sp_pair *sp_pairs_create(const sp_mesh *mesh, const sp_shells *shells, double margin, size_t *count, sp_error *error);

#endif
