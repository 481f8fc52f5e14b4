/* How liquid leaves nozzles, with drag. */
#ifndef SPRAY_LAUNCH_H
#define SPRAY_LAUNCH_H

#include <sprayplan/launch.h>

/* Drops so small that air stops them at once are none, nor is anything said of them: false, with an error. */
bool sp_are_drops(const sp_nozzle *pattern, sp_error *error);

#endif
