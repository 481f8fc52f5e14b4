/* What a film runs on. */
#ifndef FILM_SURFACE_H
#define FILM_SURFACE_H

#include <sprayplan/atlas.h>
#include <sprayplan/patches.h>
#include <sprayplan/trace.h>

/* What liquid runs on; all of it borrowed. */
typedef struct {
    const sp_mesh *mesh;
    const sp_atlas *atlas; /* of the mesh */
    const sp_tracer *tracer;
    const sp_patches *cells;      /* of every wet side, whatever is to be cleaned; each has one side */
    const uint32_t (*cell_of)[2]; /* [texel_count], on front and back; SP_NONE where that is dry */
    sp_vec3 down;                 /* unit */
    double wave;                  /* m, sp_film_wave of the liquid: what is smaller on a ceiling makes nothing drip */
} sp_film_surface;

#endif
