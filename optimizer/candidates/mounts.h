/* Mounting points: where the mounts let a nozzle be. */
#ifndef OPTIMIZER_MOUNTS_H
#define OPTIMIZER_MOUNTS_H

#include "mounts/mount_geometry.h"

/* A mounting point inside the cavity and clear of walls. */
typedef struct {
    sp_vec3 position;
    sp_vec3 axis;   /* unit, from which a nozzle's axis may lean by the mount's tilt */
    uint32_t mount; /* index into the options' mounts */
    uint32_t own;   /* the mesh's part that the clearance leaves out, or SP_NONE */
} sp_site;

typedef struct {
    size_t count, capacity;
    sp_site *items;
} sp_sites;

/* All mounting points in the mounts' order. Fails with SP_ERROR_INPUT where none is inside and clear. */
bool sp_sites_create(const sp_evaluator *evaluator, const sp_place_options *options, sp_sites *sites, sp_error *error);
void sp_sites_free(sp_sites *sites);

/* Where a port's lance ends at this depth; with steps of depth to the nanometre, so that the place reads as a short
 * number. */
sp_vec3 sp_port_place(const sp_setup *setup, const sp_mount *mount, double depth);
/* True where a nozzle of the mount may be at site->position: inside, clear, and with a port no part but the port's own
 * in the lance's way. */
bool sp_site_allowed(const sp_evaluator *evaluator, const sp_place_options *options, const sp_site *site);
/* Moves a site of a surface mount to the given point as projected on its part and stood off from it. False where the
 * part has no side there that faces the liquid. */
bool sp_site_project(const sp_evaluator *evaluator, const sp_place_options *options, sp_site *site, sp_vec3 point);

#endif
