/* Charts of large meshes. */
#ifndef ATLAS_LEVELS_H
#define ATLAS_LEVELS_H

#include "atlas/charts/making.h"

/* Makes sheets of the whole mesh on a coarser one, of about `coarse` triangles, and carries them over. */
bool sp_make_coarsely(sp_making *making, size_t coarse, sp_error *error);

#endif
