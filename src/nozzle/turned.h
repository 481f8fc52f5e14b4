/* What a pattern that turns about the nozzle's axis sprays in the mean. Polar angles (rad, 0 to π) are about that axis;
 * `spray` is one that rotates. */
#ifndef NOZZLE_TURNED_H
#define NOZZLE_TURNED_H

#include <sprayplan/nozzle.h>

/* The pattern that turns, in its own frame. */
sp_spray sp_turned_jet(const sp_spray *spray);
/* Works out `low` and `high`. */
void sp_turned_settle(sp_spray *spray);
/* Share of the liquid per steradian at a polar angle, 1/sr. */
double sp_turned_density(const sp_spray *spray, double polar);
/* As sp_spray_densities. */
void sp_turned_densities(const sp_spray *spray, double from, double to, double *least, double *most);
/* The polar angle within which this share of the liquid leaves. */
double sp_turned_polar(const sp_spray *spray, double share);
/* The polar angles, low and high, of what is `breadth` broad about a direction at a polar angle: a ring or, less than
 * `cap` from either pole, the cap of that radius about it, which is no less than half the breadth. */
void sp_turned_ring(double polar, double breadth, double cap, double ring[2]);

/* turned_fan.c. The solid angle (sr) of what of a fan lies within a polar angle, and the share of the circle of that
 * angle that lies in the fan. */
void sp_turned_fan(const sp_spray *spray, double polar, double *solid_angle, double *share);

/* hub.c. Of a full cone of half angle `outer` on a hub: as sp_spray_within and sp_turned_density. */
double sp_hub_within(double outer, double polar);
double sp_hub_density(double outer, double polar);

#endif
