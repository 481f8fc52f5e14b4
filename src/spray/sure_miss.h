/* What a spray surely misses. */
#ifndef SPRAY_SURE_MISS_H
#define SPRAY_SURE_MISS_H

#include "emitter.h"

/* Whether no flight to within `radius` (m) of a point leaves within half_angle + `beyond` (rad) of the unit `axis`,
 * nor, where an emitter is given, within the latitude of its spray and as much beyond. */
bool sp_spray_surely_misses(const sp_source *source, sp_vec3 axis, double half_angle, const sp_emitter *emitter,
                            double beyond, sp_vec3 point, double radius);
/* No less than sp_flight_breadth of any of these flights, of a square of edge `length` (m). */
double sp_breadth_most(const sp_source *source, sp_vec3 point, double radius, double length);

#endif
