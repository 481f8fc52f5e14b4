/* Points of the surface, each judged for itself: no texel stands between them and the closed form. What an evaluator's
 * coverage is measured against. */
#ifndef SPRAYPLAN_POINTS_H
#define SPRAYPLAN_POINTS_H

#include <sprayplan/evaluator.h>
#include <sprayplan/export.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A point of what is cleaned and counted. */
typedef struct {
    sp_vec3 position; /* m */
    sp_vec3 normal;   /* unit, towards the side that is wet (the front where both are) */
    sp_side side;
    uint32_t triangle;
    double u, v;    /* weights of the second and third corner */
    uint32_t patch; /* that holds it, SP_NONE where round-off left none */
} sp_point;

/* The counted surface (what sp_patches covers, with sides) as one length along which its area is spread evenly:
 * triangle after triangle in the mesh's order, each along Sierpinski's curve, so that what is close on it is close on
 * the triangle. The evaluator is borrowed and must outlive it. NULL, and the error kept, given NULL. */
typedef struct sp_points sp_points;
SP_API sp_points *sp_points_create(const sp_evaluator *evaluator, sp_error *error);
/* Accepts NULL. */
SP_API void sp_points_destroy(sp_points *points);
/* m², all of it: the evaluator's total area but for round-off. */
SP_API double sp_points_area(const sp_points *points);
/* Point i of n, each standing for an n-th of the area: one at random in every n-th part of that length, drawn from the
 * seed for itself (jittered sampling). Two points of one seed never depend on each other, and a number of points that
 * fall on a region is off by about the root of the parts that its outline crosses, not of all. The same whatever the
 * texels, and whatever the order in which it is asked. i < n, of an area above 0. */
SP_API sp_point sp_points_draw(const sp_points *points, size_t i, size_t n, uint64_t seed);

/* What holds at single points for a layout: every flight that reaches a point, in closed form, with the spray's
 * intensity in the flight's own direction, against the setup's criterion, where nothing lies in the way. First impact
 * only. Lines, parabolas (as auto) or drag, whatever the evaluator's own are.
 *
 * Of goods that move the flux is the mean over the pass: the trapezoidal rule on four steps a texel where spray reaches
 * the point, halved further, down to a thousandth of a texel, where spray or shadow begins or ends in between.
 *
 * A film has no closed form. Where the evaluator routes film, it is routed once more, on cells half as long, from what
 * arrives there, and a point is covered as well where the cell that holds it has enough.
 *
 * Evaluator and layout are borrowed and must outlive it. NULL on error, and given NULL. */
typedef struct sp_reference sp_reference;
SP_API sp_reference *sp_reference_create(const sp_evaluator *evaluator, const sp_layout *layout,
                                         sp_trajectory trajectory, sp_error *error);
/* Accepts NULL. */
SP_API void sp_reference_destroy(sp_reference *reference);
/* m, the edge of the cells on which it routes film; 0 where there is none. */
SP_API double sp_reference_film_cell(const sp_reference *reference);
/* Whether the layout covers each point. covered [count] is the caller's; points are judged each for itself, so that
 * neither threads nor the other points matter. About as quick as a patch. False where memory ran out. */
SP_API bool sp_reference_judge(const sp_reference *reference, const sp_point *points, size_t count, bool *covered,
                               sp_error *error);
/* All of that, for who asks once. */
SP_API bool sp_points_judge(const sp_evaluator *evaluator, const sp_layout *layout, sp_trajectory trajectory,
                            const sp_point *points, size_t count, bool *covered, sp_error *error);

/* Measures how far `coverage`, which this evaluator found for this layout, is off: for each of n points the covered
 * share of its patch less what sp_points_judge says of the point itself. The estimate is the size of the mean
 * difference and twice its standard error, the misjudged share the mean size of the difference. n doubles from 10,000
 * until twice the standard error is no more than a sixteenth of the setup's accuracy, or of the mean difference where
 * that is more, or n is 5,120,000: that what is then left is more shows in the estimate. Where goods move a point is
 * followed over the whole pass, which takes as long as some patches: it is then no more than a quarter, or n is 80,000.
 *
 * The standard error is that of pairs of neighbouring points (Cochran, Sampling techniques, 5A.12, collapsed strata),
 * which on average is never less than the true one, on a count of three more points than were found to differ: where
 * none of n differs, up to 3/n of the surface may (the rule of three).
 *
 * `reference` is how the liquid flies in truth; auto: as the setup says, parabolas where that leaves it open. The seed
 * draws the points. *measured is coverage->measured or another, the caller's. Where liquid that walls throw back was
 * followed points know nothing of it, and where nothing is counted there are none: `known` is false. Of film the error
 * is what cells half as long change.
 * Given NULL from an earlier failure it returns false and keeps the error. */
SP_API bool sp_measure_error(const sp_evaluator *evaluator, const sp_layout *layout, const sp_coverage *coverage,
                             sp_trajectory reference, uint64_t seed, sp_measured_error *measured, sp_error *error);

#ifdef __cplusplus
}
#endif
#endif
