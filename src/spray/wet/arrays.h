/* What wet sides come to, as plain arrays, to be made again where no line of sight is cast. */
#ifndef SPRAY_WET_ARRAYS_H
#define SPRAY_WET_ARRAYS_H

#include "spray/wet/wet.h"

#define SP_WET_CUT 4 /* a node that is a cut; any other is a cell, bit 0: liquid on its front, bit 1: on its back */

typedef struct {
    uint8_t *sides; /* [triangle_count], bits 0 and 1: some of front and back is wet, bits 2 and 3: all of it */
    /* How triangles are cut of which some is wet and not all of it, one after another: a cut, then all below 0, then
     * all above. */
    uint8_t *nodes; /* [node_count] */
    size_t node_count;
    double (*cuts)[3]; /* [cut_count], as sp_cut */
    size_t cut_count;
} sp_wet_arrays;

/* Fills in *arrays, for sp_wet_arrays_free whatever the outcome. */
bool sp_wet_arrays_create(const sp_wet *wet, size_t triangle_count, sp_wet_arrays *arrays, sp_error *error);
void sp_wet_arrays_free(sp_wet_arrays *arrays);
/* For sp_evaluator_restore; of the mesh, which is borrowed. NULL on error, also for nodes that do not belong together.
 */
sp_wet *sp_wet_restore(const sp_mesh *mesh, const sp_wet_arrays *arrays, sp_error *error);

#endif
