/* What mounting places offer to one patch: whether enough of them together bring it what it needs. */
#ifndef OPTIMIZER_OFFERS_H
#define OPTIMIZER_OFFERS_H

#include <stdbool.h>
#include <stddef.h>

/* The best that one mounting place can do. */
typedef struct {
    double ratio;     /* what it brings per flow */
    double low, high; /* flow, m³/s */
} sp_offer;

/* Of each port, and of all other mounting points together, the ones that bring most, and most per flow. */
typedef struct {
    sp_offer *strongest, *thriftiest; /* [mount_count + 1], the last for mounts without ports; ratio 0: none */
    size_t count;
} sp_place_offers;

/* A type at a pressure with what refinement may make of it. */
typedef struct {
    double angle_low, angle_high; /* rad */
    double flow_low, flow_high;   /* m³/s */
} sp_scope;

/* True where that is better than what the place had. */
bool sp_place_offers_take(const sp_place_offers *offers, size_t place, sp_offer offer);
/* Whether they bring `need` within number and water (m³/s). */
bool sp_place_offers_suffice(const sp_place_offers *offers, size_t nozzles, double water, double need);

#endif
