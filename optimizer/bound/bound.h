/* Bounds on what any layout could cover, whatever the number of candidates: multipliers are sought on a few of them and
 * then proved on all. */
#ifndef OPTIMIZER_BOUND_H
#define OPTIMIZER_BOUND_H

#include "bound/dual.h"

/* What candidates are priced by, and which of them matter. */
typedef struct {
    const sp_multipliers *u;
    const double *needed; /* [tiers], above which one is worth being among the few */
    const double *idle;   /* [tiers], up to which one need not be offered */
    bool all;             /* else it is enough to look at some, and to offer nothing */
    bool extend;          /* the few */
} sp_pricing_task;

/* All candidates, however they are kept. */
typedef struct {
    void *user;
    bool leaves_idle; /* does not offer all that is idle: whether it is so is to be confirmed */
    /* Appends to `rows`, where these are to be extended, some of the candidates worth more than needed[tier] that are
     * not among them yet (by key). Adds to `offers` the total price, or something no lower, of these and of all that
     * are worth more than idle[tier]. */
    bool (*price)(void *user, const sp_pricing_task *task, sp_offers *offers, sp_rows *rows, sp_error *error);
} sp_pricer;

/* What has been proved: no layout of at most so much covers more. m², base included. */
typedef struct {
    const sp_cover *cover;
    const sp_pricer *pricer;
    sp_rows rows; /* the few; a caller may put some in at the start */
    sp_dual dual;
    double *by_water; /* [cover->water + 1], with all the nozzles; never falls */
    double *needed;   /* [tiers], of the next task */
    double *guess;    /* [tiers], up to which prices are taken to be idle; 0 where nothing is left out */
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
