/* Tracks of two-axis jet heads: how close the mesh is that their jets draw on the walls. */
#ifndef SPRAYPLAN_TRACKS_H
#define SPRAYPLAN_TRACKS_H

#include <sprayplan/evaluator.h>
#include <sprayplan/export.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Turns of the body after which the jets are where they began: gears[1] over the gears' greatest common divisor. */
SP_API unsigned sp_track_turns(const sp_rotation *rotation);
/* The angle (rad) at the head between a unit direction of the nozzle's frame and the nearest track, after so many turns
 * of the body (0: until the tracks repeat). With r the gear ratio, jet j of n comes to the polar angle ϑ after
 * (±ϑ - 2πj/n + 2πm) / 2πr turns, m a whole number, at the body's azimuth for + and opposite it for -; the angle from a
 * track that comes there Δφ aside is Δφ sin ϑ r / √(r² + sin²ϑ). No time steps; where tracks are far apart it takes
 * them for straighter than they are. */
SP_API double sp_track_angle(const sp_rotation *rotation, unsigned turns, sp_vec3 direction);

/* How far patches that a head reaches are from the nearest track: the angle times the distance to the patch (m). Walls
 * that are met at a slant are not stretched. */
typedef struct {
    bool known;                 /* false of any nozzle but a two-axis head, and where it reaches nothing */
    size_t turns;               /* of the body */
    double duration;            /* s, of these; NAN where the type does not say how fast it turns */
    double area;                /* m², of the patches reached */
    double mean, p95, greatest; /* m, by area: mean, what 95 % lie within, greatest */
} sp_track_gaps;
/* Of one nozzle after the turns that its type asks for; flights as the evaluator's, first impact only. */
SP_API bool sp_find_track_gaps(const sp_evaluator *evaluator, const sp_nozzle *nozzle, sp_track_gaps *gaps,
                               sp_error *error);

#ifdef __cplusplus
}
#endif
#endif
