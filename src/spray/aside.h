/* What a spray surely misses. */
#ifndef SPRAY_ASIDE_H
#define SPRAY_ASIDE_H

#include "emitter.h"

/* Whether no flight to within `radius` (m) of a point leaves within `half_angle` (rad) of the unit `axis`. */
bool sp_cone_is_aside(const sp_source *source, sp_vec3 axis, double half_angle, sp_vec3 point, double radius);
/* The same of a fan, where the emitter has one: within its thickness and `beyond` (rad) that. */
bool sp_fan_is_aside(const sp_emitter *emitter, sp_vec3 position, double beyond, sp_vec3 point, double radius);
/* No less than sp_flight_breadth of any of these flights, of a square of edge `length` (m). */
double sp_breadth_most(const sp_source *source, sp_vec3 point, double radius, double length);

#endif
