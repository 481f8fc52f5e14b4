/* What a pattern that turns about the nozzle's axis sprays in the mean. Polar angles (rad, 0 to π) are about that axis;
 * `spray` is one that rotates. */
#ifndef NOZZLE_TURNED_H
#define NOZZLE_TURNED_H

#include <sprayplan/nozzle.h>

/* Share of the liquid per steradian at a polar angle, 1/sr. */
double sp_turned_density(const sp_spray *spray, double polar);

/* turned_mean.c. As sp_spray_share and sp_spray_density. */
double sp_turned_share(const sp_spray *spray, const sp_frame *frame, sp_vec3 direction, double breadth);
double sp_turned_mean(const sp_spray *spray, const sp_frame *frame, sp_vec3 direction, double breadth);

/* turned_fan.c. The solid angle (sr) of what of a fan lies within a polar angle, and the share of the circle of that
 * angle that lies in the fan. */
void sp_turned_fan(const sp_spray *spray, double polar, double *solid_angle, double *share);

/* hub.c. Of a full cone of half angle `outer` on a hub: as sp_spray_within and sp_turned_density. */
double sp_hub_within(double outer, double polar);
double sp_hub_density(double outer, double polar);

#endif
