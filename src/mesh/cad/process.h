/* Running sprayplan-cad, or what takes its place in tests. */
#ifndef MESH_CAD_PROCESS_H
#define MESH_CAD_PROCESS_H

#include "mesh/cad/stream.h"

#include <sprayplan/run.h>

/* Starts arguments[0] with these arguments, NULL behind the last, and hands what it writes to the stream until it has
 * ended. Whether it ends in `seconds` of wall time, dies, or writes what the stream refuses, or `run` is cancelled: it
 * is gone when this returns. Errors name the stream's file. */
bool sp_cad_process_run(char *const *arguments, double seconds, sp_cad_stream *stream, const sp_run *run,
                        sp_error *error);

#endif
