/* Patches: the surface as it is judged. Plain data. */
#ifndef SPRAYPLAN_PATCHES_H
#define SPRAYPLAN_PATCHES_H

#include <sprayplan/vector.h>

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum { SP_SIDE_BOTH, SP_SIDE_FRONT, SP_SIDE_BACK } sp_side;

/* What is cleaned and counted: a patch is the clean, wet part of one texel, on one side (with no cavity: both sides as
 * one). Ordered by texel, front before back. Read-only. */
typedef struct {
    size_t count;
    uint32_t *texel;           /* [count] */
    sp_side *side;             /* [count] */
    double *area;              /* [count], m² */
    sp_vec3 *point;            /* [count], where it is judged if not cut: its point nearest to its centroid, m */
    sp_vec3 *normal;           /* [count], unit, towards the side that is wet (the front where both are) */
    uint32_t *triangle;        /* [count], the one that holds `point` */
    double *length;            /* [count], m: its texel's edge, or where its chart has less area than a texel, the root
                                * of that */
    uint32_t *neighbour_start; /* [count + 1] */
    uint32_t *neighbours;      /* patches of the same side that touch, ascending */
    double total_area;         /* Σ area, m² */
} sp_patches;

#ifdef __cplusplus
}
#endif
#endif
