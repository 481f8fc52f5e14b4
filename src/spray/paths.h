/* The ways that a few of a nozzle's jets fly, for readers to see. */
#ifndef SPRAY_PATHS_H
#define SPRAY_PATHS_H

#include "spray/state/state.h"

/* They are followed to this many walls after their first. */
#define SP_PATH_BOUNCES 3
/* About how many of a nozzle are followed: of a cluster at least one of each pattern, of more patterns than these
 * one in so many. */
#define SP_PATH_JETS 32

/* From where the leg before it ends, or the jet starts. It is the quadratic Bézier curve whose control point lies
 * `rise` above the middle between its ends, which is the parabola itself; with drag jets are told in straight legs. */
typedef struct {
    sp_vec3 end;     /* m */
    double rise;     /* m, against gravity */
    unsigned jet;    /* of its nozzle */
    unsigned bounce; /* walls that were met before */
} sp_path_leg;

typedef struct {
    size_t jet_count, leg_count, jet_room, leg_room;
    size_t *pattern;   /* [jet_count], of sp_nozzle_patterns, ascending: where it starts */
    sp_path_leg *legs; /* [leg_count], in the order of the jets */
} sp_paths;

/* As far as the evaluator's reflections go as well, goods that move being where the mesh has them; what meets nothing
 * is followed for about the geometry's size. `paths` is zeroed first; false on error. */
bool sp_paths_fly(const sp_evaluator *evaluator, const sp_nozzle *nozzle, sp_paths *paths, sp_error *error);
/* Accepts what is all zeros. */
void sp_paths_free(sp_paths *paths);

#endif
