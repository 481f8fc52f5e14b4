/* Bounds on what any layout could cover, whatever the number of candidates: multipliers are sought on a few of them and
 * then proved on all. */
#ifndef OPTIMIZER_BOUND_H
#define OPTIMIZER_BOUND_H

#include "bound/dual.h"

/* All candidates, however they are kept. */
typedef struct {
    void *user;
    /* Adds every candidate's total price at multipliers u to `offers`, or something no lower. Appends to `rows` some
     * of those worth more than needed[tier] that are not among them yet (by key). Without `all` it may look at some
     * only, and offer nothing. */
    bool (*price)(void *user, const sp_multipliers *u, const double *needed, bool all, sp_offers *offers, sp_rows *rows,
                  sp_error *error);
} sp_pricer;

/* What has been proved: no layout of at most so much covers more. m², base included. */
typedef struct {
    const sp_cover *cover;
    const sp_pricer *pricer;
    sp_rows rows; /* the few; a caller may put some in at the start */
    sp_dual dual;
    double *by_water; /* [cover->water + 1], with all the nozzles; never falls */
    double *needed;
    sp_knapsack knapsack;
    sp_offers offers;
    uint32_t lightest; /* of the tiers */
    double proved;     /* the bound at the last water by the last multipliers alone */
    bool closed;       /* which is as low as these inequalities go: all candidates bring no more than the few */
    bool complete;     /* the last pricing of all was not broken off; else `proved` and `closed` say nothing new */
    size_t proofs;     /* complete pricings of all */
    size_t iterations; /* of a solve, at most; may be set */
    size_t coarse;     /* of it on groups of texels, before these; may be set */
    double tolerance;  /* at which a solve ends, as a share of the bound; may be set */
    double reach;      /* times a solve's water, that its inequalities are to hold for; may be set */
    sp_valid_inequalities inequalities; /* of the last task */
    bool strengthening;                 /* they have come into use */
} sp_bound;

bool sp_bound_create(const sp_cover *cover, const sp_pricer *pricer, sp_bound *bound, sp_error *error);
void sp_bound_free(sp_bound *bound);
/* Lowers the bounds at and about `water` (units): solves on the few, then proves on all. Meant to be repeated: what all
 * have that the few lack joins them, and texels take up new inequalities. */
bool sp_bound_lower(sp_bound *bound, size_t water, sp_error *error);
/* The same without a proof: only looks for candidates and inequalities, where pricing all takes long. */
bool sp_bound_explore(sp_bound *bound, size_t water, sp_error *error);
/* A bound holds at more water, too, up to the next sum that candidates come to: after by_water was lowered. */
void sp_bound_settle(sp_bound *bound);
/* Lowers the bounds where no more than one nozzle fits, to what the best one covers. Goes before all else. */
bool sp_bound_lower_single(sp_bound *bound, sp_error *error);
/* The least water with which the bound does not rule out that `area` (m²) is covered; SIZE_MAX where it always does. */
size_t sp_bound_water(const sp_bound *bound, double area);

#endif
