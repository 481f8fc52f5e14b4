/* What one point can reach. */
#ifndef SPRAY_REACH_H
#define SPRAY_REACH_H

#include "aim.h"

/* All arrivals that are asked for, ascending by patch, low arc before high arc. */
sp_reach *sp_reach_create(const sp_source *source, const sp_aim *aim, sp_error *error);

#endif
