/* Caps of the unit sphere: how much of one, or of its rim, lies within another. Angles in rad, from 0 to π. */
#ifndef NOZZLE_CAPS_H
#define NOZZLE_CAPS_H

/* cos low - cos high without cancellation: the solid angle between two polar angles over 2π. */
double sp_cap_height(double low, double high);
/* Half the length, as an angle about its own centre (0 to π), of what of a circle of this radius lies within a cap
 * whose centre is `apart` from the circle's. */
double sp_cap_arc(double circle, double cap, double apart);
/* The solid angle (sr) that two caps have in common. */
double sp_cap_overlap(double one, double other, double apart);

#endif
