/* How the edges of patterns that leave one point lie in a patch: what one of them covers of it another may cover too,
 * or leave to it, which no share alone tells. */
#ifndef SPRAY_EDGES_H
#define SPRAY_EDGES_H

#include <sprayplan/evaluator.h>

#define SP_EDGE_SAMPLES 64

/* Samples of a patch, a bit each: those that edges leave dry, of all that it has. */
typedef struct {
    uint64_t dark, all;
} sp_edge_samples;
/* As many as sp_edges_sample takes. */
static inline sp_edge_samples sp_edge_samples_dark(void)
{
    return (sp_edge_samples){~(uint64_t)0, ~(uint64_t)0};
}

/* What patterns of one nozzle that leave one point, one after the other in their list, cover of each patch. */
typedef struct {
    const sp_evaluator *evaluator;
    bool shared;  /* the pattern in hand leaves the point of the one before or after it */
    sp_vec3 from; /* m, of that pattern, as what follows */
    sp_spray spray;
    sp_frame frame;
    double least, most;                 /* beyond these cosines of polar angles it surely sprays nothing */
    double *dry;                        /* [patches], share that those laid so far from this point leave dry */
    uint64_t *dark;                     /* [patches], samples that these do */
    double blurred[SP_EDGE_SAMPLES][2]; /* where samples are from a patch's middle, over its breadth, in its blur */
    double even[SP_EDGE_SAMPLES][2];    /* and over its length, on itself */
} sp_edges;

/* For sp_edges_free whatever the outcome. */
bool sp_edges_create(const sp_evaluator *evaluator, sp_edges *edges, sp_error *error);
void sp_edges_free(sp_edges *edges);
/* Takes pattern i of a nozzle's [count] in hand. */
void sp_edges_begin(sp_edges *edges, const sp_nozzle *patterns, size_t i, size_t count);
/* Takes those samples of an arrival's patch from the dark ones that lie inside the spray of the pattern in hand, as
 * `share` of the patch, or of its cell, does. None where no other pattern leaves the point. */
void sp_edges_sample(const sp_edges *edges, const sp_arrival *arrival, double share, sp_edge_samples *samples);
/* The pattern in hand leaves this share of a patch dry, and these samples: `dry` [patches] has what all points do. */
void sp_edges_add(sp_edges *edges, uint32_t patch, double share, sp_edge_samples samples, double *dry);
/* All of pattern i is laid. */
void sp_edges_end(sp_edges *edges, const sp_nozzle *patterns, size_t i, size_t count, double *dry);

#endif
